#include "post/post.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/scene/reader.hpp"
#include "post/output/contours.hpp"
#include "solver/result/result.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/post/measure/ideal_bias.hpp"

namespace weaveform {
namespace {

// The result folder of a bias extension that went exactly as Eq. 14 has it, 30 mm at the upper grip.
class PostProcess : public testing::Test {
protected:
  PostProcess() {
    const double travel = 30.0;  // mm
    Scene scene = test::bias_scene(115.0, 230.0);
    scene.grip[1].travel = travel;
    scene.measure = {{"centre", {}, std::array{-0.2, -0.2, 0.2, 0.2}}};
    std::ofstream(dir() / "scene.toml") << scene_to_toml(scene);
    const Mesh mesh = test::bias_lattice(115.0, 230.0, 4.92);
    write_mesh(mesh, dir() / "mesh.vtu");

    const BiasSpecimen specimen = *find_bias_extension(scene);
    angle_ = kinematic_shear_angle(specimen, travel) * 180.0 / std::numbers::pi;
    FrameWriter frames(dir(), mesh);
    frames.write(compute_fields(mesh, test::small_card(), {}, 0.0, mesh.nodes.position));
    const double radians = angle_ * std::numbers::pi / 180.0;
    frames.write(compute_fields(mesh, test::small_card(), {}, 1.0, test::ideal_positions(mesh, specimen, radians)));

    write_history(
        {{"time_s", "lower.displacement_mm", "lower.force_N", "upper.displacement_mm", "upper.force_N",
          "centre.shear_angle_deg", "centre.shear_angle_sd_deg", "centre.shear_angle_min_deg",
          "centre.shear_angle_max_deg"},
         {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, {1.0, 0.0, 5.0, travel, 5.1, angle_, 0.0, angle_, angle_}}},
        dir() / "history.csv");
    write_statistics({}, dir() / "solve.json");
  }
  [[nodiscard]] const std::filesystem::path& dir() const { return folder_.path(); }

  test::TemporaryFolder folder_;
  double angle_ = 0.0;  // deg
};

TEST_F(PostProcess, IdealRunMeetsTheIdealInEveryZone) {
  ResultFolder folder(dir());
  const std::string table = post_process(folder).table;
  std::ifstream stream(dir() / "summary.json");
  const nlohmann::json json = nlohmann::json::parse(stream);
  // The travel has ten digits in history.csv, hence 1e-7 deg.
  EXPECT_NEAR(json["zones"]["A"]["shear_angle_deg"].get<double>(), angle_, 1e-7);
  EXPECT_NEAR(json["zones"]["B"]["shear_angle_deg"].get<double>(), angle_ / 2.0, 1e-7);
  EXPECT_NEAR(json["zones"]["C"]["shear_angle_deg"].get<double>(), 0.0, 1e-7);
  EXPECT_NEAR(json["ideal"]["shear_angle_deg"].get<double>(), angle_, 1e-7);
  EXPECT_GT(json["ideal"]["force_N"].get<double>(), 0.0);
  EXPECT_NE(table.find("bias extension, W 115 x L 230 mm"), std::string::npos) << table;
}

TEST_F(PostProcess, ContoursLieBetweenTheZonesAtMultiplesOfTheStep) {
  ResultFolder folder(dir());
  (void)post_process(folder);
  std::set<double> levels;
  for (const Isoline& line : read_contours(dir() / "contours.vtp")) levels.insert(line.level);
  std::set<double> expected;
  for (double level = 5.0; level < angle_; level += 5.0) expected.insert(level);
  EXPECT_EQ(levels, expected);
}

TEST_F(PostProcess, RunAgainGivesTheSameFiles) {
  ResultFolder folder(dir()), again(dir());
  EXPECT_EQ(post_process(folder).table, post_process(again).table);
}

TEST_F(PostProcess, MissingFileIsNamed) {
  for (const char* name : {"history.csv", "solve.json", "result.pvd", "mesh.vtu", "scene.toml"}) {
    std::filesystem::rename(dir() / name, dir() / "elsewhere");
    try {
      ResultFolder folder(dir());
      (void)post_process(folder);
      FAIL() << "no error without " << name;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
    std::filesystem::rename(dir() / "elsewhere", dir() / name);
  }
}

TEST_F(PostProcess, FrameOfAnotherMeshIsRefused) {
  write_mesh(test::lattice(3, 3, 5.0), dir() / "mesh.vtu");
  ResultFolder folder(dir());
  EXPECT_THROW((void)post_process(folder), InputError);
}

}  // namespace
}  // namespace weaveform
