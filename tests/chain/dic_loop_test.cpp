// A virtual experiment closes the loop: a bias extension is exported as an instrument would have measured it, turned,
// shifted, noisy and with points lost, and compared with itself and with a fabric 10 % stiffer in shear.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "post/dic/comparison/compare.hpp"
#include "post/dic/virtual/zone_border.hpp"
#include "tests/support/run_command.hpp"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace weaveform;
using test::run_command;

class DicLoop : public testing::Test {
protected:
  static void SetUpTestSuite() {
    folder_ = new test::TemporaryFolder;
    test::write_text(test::tiny_scene(), path() / "scene.toml");
    std::string card = test::read_text(fs::path(WEAVEFORM_SOURCE_DIR) / "fabric/cards/twintex-pw.toml");
    const std::string table3 = "[0.264, -1.066, 0.939, 1.68]";
    const auto at = card.find(table3);
    ASSERT_NE(at, std::string::npos) << "the card's Table 3 is written differently";
    card.replace(at, table3.size(), "[0.2904, -1.1726, 1.0329, 1.848]");  // times 1.1
    test::write_text(card, path() / "stiffer.toml");
    ASSERT_EQ(run("weaveform run scene.toml -o pw -q").exit_code, 0);
    ASSERT_EQ(run("weaveform run scene.toml -o stiffer -q --set fabric.material=stiffer.toml").exit_code, 0);
  }
  static void TearDownTestSuite() { delete folder_; }

  static const fs::path& path() { return folder_->path(); }
  static test::CommandResult run(const std::string& command) { return run_command(command, path()); }
  static json compare(const std::string& result, const std::string& measured, const std::string& options = "") {
    const auto told = run(fmt::format("weaveform post compare {0} {1}/stages --settings {1}/settings.toml -o out {2}",
                                      result, measured, options));
    EXPECT_EQ(told.exit_code, 0) << told.err;
    return json::parse(test::read_text(path() / "out" / "comparison.json"));
  }
  static void make(const std::string& options) {
    const auto told = run(fmt::format("weaveform post virtual pw --set instrument.facet_size=6 {}", options));
    ASSERT_EQ(told.exit_code, 0) << told.err;
  }

private:
  static inline test::TemporaryFolder* folder_ = nullptr;
};

struct Motion {
  std::string format;
  double rotation, x, y;  // deg, mm
};

TEST_F(DicLoop, RecoversTheMotionAndDiffersByTheNoiseOnly) {
  const Motion motions[] = {{"aramis", 7.0, 12.0, -30.0},
                            {"dice", -80.0, 200.0, -160.0},
                            {"aramis", 171.0, 0.0, 0.0},
                            {"dice", 33.0, 150.0, -150.0},
                            {"dice", 0.0, 70.0, -130.0}};
  double squares = 0.0;
  int means = 0, seed = 0;
  for (const Motion& motion : motions) {
    ++seed;
    make(fmt::format(
        "--format {} -o measured --set virtual.noise=0.02 --set virtual.drop=0.05 --set virtual.fail=0.03 --set "
        "virtual.seed={} --set virtual.rotation={} --set virtual.shift=[{},{}] {}",
        motion.format, seed, motion.rotation, motion.x, motion.y,
        motion.format == "aramis" ? "--set virtual.decimal_comma=true" : "--set virtual.delimiter=';'"));
    const json found = compare("pw", "measured");
    const json& placement = found["registration"]["measurement_to_blank"];
    // The blank's centre in the measurement must be laid on the origin. Standard errors are told; five of them, and the
    // five digits of DICe files (0.01 px of 0.1 mm in the largest displacements).
    const double slack = motion.format == "dice" ? 0.002 : 0.0;
    const double angle = placement["angle_deg"].get<double>() * degree;
    const double x = std::cos(angle) * motion.x - std::sin(angle) * motion.y + placement["shift_mm"][0].get<double>();
    const double y = std::sin(angle) * motion.x + std::cos(angle) * motion.y + placement["shift_mm"][1].get<double>();
    const double shift_error = found["registration"]["shift_error_mm"],
                 angle_error = found["registration"]["angle_error_deg"];
    EXPECT_LT(shift_error, 0.01);
    EXPECT_NEAR(std::remainder(angle / degree + motion.rotation, 360.0), 0.0, 5.0 * angle_error) << seed;
    EXPECT_NEAR(x, 0.0, 5.0 * shift_error + slack) << seed;
    EXPECT_NEAR(y, 0.0, 5.0 * shift_error + slack) << seed;

    ASSERT_EQ(found["stages"].size(), 4U);
    for (const json& stage : found["stages"]) {
      EXPECT_TRUE(stage["agrees"]) << seed << ": " << stage["verdict"];
      EXPECT_NEAR(stage["displacement_uncertainty_mm"].get<double>(), 0.02, 0.001) << seed;
      const json& all = stage["all"];
      // Some 100 windows do not overlap: the rms scatters by 1/sqrt(4 * 100) of itself; three times that.
      EXPECT_NEAR(all["difference_deg"]["rms"].get<double>() / all["noise_rms_deg"].get<double>(), 1.0, 0.15) << seed;
      // 95.4 % of normal numbers lie within two standard deviations.
      EXPECT_NEAR(all["within_uncertainty"].get<double>(), 0.954, 0.03) << seed;
      const int lost = motion.format == "dice" ? stage["failed_correlations"] : stage["rows_without_values"];
      EXPECT_NEAR(lost / stage["points"].get<double>(), 0.03 / 0.95, 0.012) << seed;
      for (const char* zone : {"A", "B", "C"}) {
        const json& difference = stage["zones"][zone]["difference_deg"];
        squares += std::pow(difference["mean"].get<double>() / difference["mean_uncertainty"].get<double>(), 2);
        ++means;
      }
    }
  }
  // The zones' means scatter as much as their uncertainties say: chi squared over 60 draws, within 4 standard
  // deviations above; placement and noise are fitted to the same data, so it may well be less.
  EXPECT_LT(squares / means, 1.0 + 4.0 * std::sqrt(2.0 / means));
  EXPECT_GT(squares / means, 0.3);
}

TEST_F(DicLoop, SeesAMaterialTenPerCentStiffer) {
  make("-o pw_measured --set virtual.noise=0.02");
  // At the same load the stiffer fabric is sheared less, by far more than the noise.
  std::string settings = test::read_text(path() / "pw_measured" / "settings.toml");
  const auto from = settings.find("displacement = [");
  settings.replace(from, settings.find('\n', from) - from, "match = \"force\"");
  const json itself = [&] {
    test::write_text(settings, path() / "pw_measured" / "settings.toml");
    return compare("pw", "pw_measured");
  }();
  EXPECT_TRUE(itself["stages"].back()["agrees"]) << itself["stages"].back()["verdict"];
  const json by_force = compare("stiffer", "pw_measured");
  const json& last = by_force["stages"].back();
  EXPECT_FALSE(last["agrees"]);
  EXPECT_GT(last["all"]["difference_deg"]["rms"].get<double>(), 3.0 * last["all"]["noise_rms_deg"].get<double>());
  EXPECT_GT(last["zones"]["A"]["difference_deg"]["mean"].get<double>(), 0.5);
  // The loads at the same travel tell it too: 1 / 1.1 where shear alone bears, a little more where yarns stretch.
  EXPECT_NEAR(itself["load"]["measured_over_simulated"].get<double>(), 1.0, 1e-3);
  EXPECT_NEAR(by_force["load"]["measured_over_simulated"].get<double>(), 1.0 / 1.1, 0.03);
}

TEST_F(DicLoop, SymmetricAveragesAndMarksAndAxesGiveTheSameAnswer) {
  make("-o plain --set virtual.noise=0.01 --set virtual.stages=1 --set virtual.rotation=20 --set virtual.shift=[5,6]");
  // The blank's point (40, 90) lies at R(20) (40, 90) + (5, 6) in the measurement.
  const double c = std::cos(20.0 * degree), s = std::sin(20.0 * degree);
  const auto mark = [&](double x, double y) {
    return fmt::format("[{},{}]", c * x - s * y + 5.0, s * x + c * y + 6.0);
  };
  const std::string marks = fmt::format(
      "--set registration.method=marks --set 'registration.measured_marks=[{},{},{}]' --set "
      "'registration.simulated_marks=[[40,90],[-40,90],[0,-100]]'",
      mark(40, 90), mark(-40, 90), mark(0, -100));
  const std::string axes =
      " --set registration.method=axes --set registration.angle=20 --set registration.origin=[5,6]";
  double noise = 0.0;
  for (const std::string& options : {std::string(), marks, axes, axes + " --set comparison.symmetry=xy"}) {
    const json found = compare("pw", "plain", options);
    const json& last = found["stages"].back();
    EXPECT_TRUE(last["agrees"]) << options << last["verdict"];
    EXPECT_NEAR(found["registration"]["measurement_to_blank"]["angle_deg"].get<double>(), -20.0, 0.01);
    noise = last["all"]["noise_rms_deg"];
  }
  const double single = compare("pw", "plain")["stages"].back()["all"]["noise_rms_deg"];
  EXPECT_NEAR(noise / single, 0.5, 0.1) << "four images halve the noise, but for points without all of them";
}

TEST_F(DicLoop, AsksWhatItCannotDecide) {
  make("-o asked --set virtual.noise=0.01 --set virtual.stages=2");
  const std::string compare_asked = "weaveform post compare pw asked/stages --set instrument.facet_size=6 ";
  const auto refused = [&](const std::string& command, const std::string& words) {
    const auto told = run(command);
    EXPECT_EQ(told.exit_code, 2) << command;
    EXPECT_NE(told.err.find(words), std::string::npos) << command << "\n" << told.err;
  };
  // A specimen that may have moved as a whole looks the same upside down.
  refused(compare_asked + "--set registration.motion=free", "which way does the blank's x axis point");
  EXPECT_EQ(run(compare_asked + "--set registration.motion=free --set registration.angle=0 -o free").exit_code, 0);
  refused(compare_asked + "--set stages.displacement=[1,2,3]", "the measurement has 2 stage(s)");
  refused(compare_asked + "--set stages.displacement=[10,45]", "simulate further");
  refused(compare_asked + "--set stages.grip=tpo", "did you mean 'top'");
  refused(compare_asked + "--set registration.method=axes --set registration.origin=[1000,0]",
          "no point could be compared");
  refused("weaveform post compare pw", "MEASUREMENT is required");
  refused("weaveform post virtual pw --format gom", "it must be 'aramis' or 'dice'");
  refused("weaveform post virtual pw", "how large is a facet");
  EXPECT_EQ(run("weaveform post compare pw nowhere").exit_code, 4);
  EXPECT_EQ(run("weaveform post compare nowhere asked/stages").exit_code, 4);
  run("weaveform post virtual pw --format dice -o dice --set instrument.facet_size=6 --set virtual.stages=1");
  refused("weaveform post compare pw dice/stages", "how many mm is one pixel?");
  refused("weaveform post compare pw dice/stages --set measurement.pixel_size=0.1", "at which travel of the crosshead");
}

TEST_F(DicLoop, WritesEveryPromisedFileForEveryStage) {
  make("-o earlier --set virtual.noise=0.01 --set virtual.stages=3");
  (void)compare("pw", "earlier");
  EXPECT_TRUE(fs::exists(path() / "out" / "stages" / "stage_003.csv"));
  make("-o written --set virtual.noise=0.01 --set virtual.stages=2");
  test::write_text(test::read_text(path() / "written" / "settings.toml") +
                       "\n[[zone]]\nname = \"middle\"\nbox = [-15, -15, 15, 15]\n"
                       "\n[[line]]\nname = \"across\"\nfrom = [0, -20]\nto = [0, 20]\npoints = 11\n",
                   path() / "written" / "settings.toml");
  const json found = compare("pw", "written", "--set comparison.contour_step=5");
  for (const char* name : {"stages.csv", "angles.svg", "loads.csv", "loads.svg", "lines.csv", "stages/stage_001.csv",
                           "stages/stage_002.vtu", "stages/stage_002_isolines.vtp"})
    EXPECT_TRUE(fs::is_regular_file(path() / "out" / name)) << name;
  EXPECT_FALSE(fs::exists(path() / "out" / "stages" / "stage_003.csv")) << "a stage of an older comparison";
  ASSERT_EQ(found["stages"].size(), 2U);
  // The middle of the specimen lies in zone A, and so does the line: their angles are the zone's.
  const json& zones = found["stages"][1]["zones"];
  EXPECT_NEAR(zones["middle"]["measured_deg"].get<double>(), zones["A"]["measured_deg"].get<double>(), 2.0);
  std::istringstream lines(test::read_text(path() / "out" / "lines.csv"));
  std::string row;
  std::getline(lines, row);
  EXPECT_EQ(row, "stage,line,distance_mm,x_mm,y_mm,measured_deg,levelled_deg,raw_deg");
  int rows = 0;
  while (std::getline(lines, row)) ++rows;
  EXPECT_EQ(rows, 22);
}

// With `free`, a turn and shift of the deformed specimen as a whole is found and does not touch the angles.
TEST_F(DicLoop, FollowsASpecimenThatMovedAsAWhole) {
  make("-o moving --set virtual.noise=0.01 --set virtual.stages=1");
  const dic::Simulation simulation(path() / "pw", "");
  const auto state = simulation.at_frame(simulation.frame_count() - 1);
  auto stage = dic::read_stages(path() / "moving" / "stages" / "stage_001.txt", {}).front();
  dic::RigidMotion truth;
  truth.angle = 0.1;
  truth.shift = {3.0, -9.0};
  for (std::size_t i = 0; i < stage.size(); ++i) {
    const Vec3& p = stage.reference[i];
    Vec3& u = stage.displacement_field[i];
    const weaveform::Vec2 now = truth.moved({p[0] + u[0], p[1] + u[1]});
    u = {now[0] - p[0], now[1] - p[1], u[2]};
  }
  dic::RegistrationSpec spec;
  spec.motion = dic::SpecimenMotion::free;
  spec.angle = 0.0;
  const auto placement = dic::place(stage, simulation, state, spec, 6.0);
  EXPECT_NEAR(placement.reference.angle, 0.0, 5.0 * placement.angle_error);
  EXPECT_NEAR(placement.current.angle, -truth.angle, 5.0 * placement.angle_error);
  const auto followed = dic::follow(stage, simulation, state, placement.reference, 4.0);
  EXPECT_NEAR(followed.angle, -truth.angle, 1e-3);
}

// Points that are wrong by up to 20 mm and not flagged do not move the placement; they are counted.
TEST_F(DicLoop, OutliersAreRejectedAndCounted) {
  make(
      "--format dice -o outliers --set virtual.noise=0.01 --set virtual.fail=0.1 --set virtual.stages=1 --set "
      "virtual.rotation=12 --set virtual.shift=[90,-150]");
  const dic::Simulation simulation(path() / "pw", "");
  const auto state = simulation.at_frame(simulation.frame_count() - 1);
  dic::MeasurementSpec measurement;
  measurement.pixel_size = 0.1;
  auto stage = dic::read_stages(path() / "outliers" / "stages" / "stage_001.txt", measurement).front();
  ASSERT_GT(stage.failed, 100);
  stage.valid.assign(stage.size(), true);
  const auto placement = dic::place(stage, simulation, state, {}, 6.0);
  EXPECT_NEAR(placement.reference.angle, -12.0 * degree, 5.0 * placement.angle_error);
  const weaveform::Vec2 centre = placement.reference.moved({90.0, -150.0});
  EXPECT_NEAR(centre[0], 0.0, 5.0 * placement.shift_error + 0.002);
  EXPECT_NEAR(centre[1], 0.0, 5.0 * placement.shift_error + 0.002);
  // A wrong point is wrong by chance; few are right within 4 standard deviations of the noise, and few right ones are
  // not.
  EXPECT_NEAR(placement.rejected, stage.failed, 0.02 * static_cast<double>(stage.size()));
  EXPECT_LT(placement.residual, 1.6 * 0.01 * std::sqrt(2.0));
}

// A sharp border through an instrument: the width of the closed form's profile (dic_instrument_test.cpp) in proportion
// to the instrument; and a simulated border seen through it is never narrower than the instrument makes a sharp one.
TEST_F(DicLoop, BorderWidthsGrowInProportionToTheInstrument) {
  const auto study = dic::zone_border_widths(path() / "pw", {2.0, 4.0, 8.0}, {});
  ASSERT_EQ(study.width.size(), 4U);
  EXPECT_NEAR(study.width[2].ideal / study.width[1].ideal, 2.0, 0.02);
  EXPECT_NEAR(study.width[3].ideal / study.width[2].ideal, 2.0, 0.02);
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_GT(study.width[k].ab, 0.97 * study.width[k].ideal);
    EXPECT_LT(study.width[k].ab, study.width[k].ideal + study.width[0].ab + 1.0);
  }
}

}  // namespace
