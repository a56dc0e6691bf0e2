// Scene to verdict on a tiny bias extension: the files, columns and keys that scripts rely on (README.md, "The results
// folder"), and the physics in its coarsest strokes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "solver/result/result.hpp"
#include "tests/support/run_command.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::read_history;
using weaveform::test::read_text;
using weaveform::test::run_command;
using weaveform::test::TemporaryFolder;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

// One run serves all tests of this file.
class BiasExtension : public testing::Test {
protected:
  static void SetUpTestSuite() {
    folder = new TemporaryFolder();
    write_text(tiny_scene(), folder->path() / "tiny.toml");
    const auto result = run_command("weaveform run tiny.toml --output out", folder->path());
    ASSERT_EQ(result.exit_code, 0) << result.err;
    table = result.out;
  }
  static void TearDownTestSuite() {
    delete folder;
    folder = nullptr;
  }
  [[nodiscard]] static fs::path out(const std::string& name = "") { return folder->path() / "out" / name; }
  [[nodiscard]] static nlohmann::json summary() { return nlohmann::json::parse(read_text(out("summary.json"))); }

  static inline TemporaryFolder* folder = nullptr;
  static inline std::string table;
};

TEST_F(BiasExtension, LeavesThePromisedFilesAndNoUnfinishedOnes) {
  for (const std::string name :
       {"scene.toml", "mesh.vtu", "result.pvd", "contours.vtp", "history.csv", "summary.json", "frames"})
    EXPECT_TRUE(fs::exists(out(name))) << name;
  for (const auto& entry : fs::recursive_directory_iterator(out())) {
    const std::string ending = entry.path().extension().string();
    if (entry.path().filename() == ".weaveform.lock") continue;  // marks the folder as Weaveform's
    EXPECT_TRUE(entry.is_directory() || ending == ".toml" || ending == ".vtu" || ending == ".pvd" || ending == ".vtp" ||
                ending == ".csv" || ending == ".json")
        << entry.path();
  }
}

TEST_F(BiasExtension, HistoryHasThePromisedColumns) {
  const auto history = read_history(out("history.csv"));
  ASSERT_FALSE(history.column.empty());
  EXPECT_EQ(history.column.front(), "time_s");
  for (const std::string name : {"bottom.displacement_mm", "bottom.force_N", "top.displacement_mm", "top.force_N",
                                 "center.shear_angle_deg", "kinetic_energy_mJ", "internal_energy_mJ"})
    EXPECT_GE(history.index(name), 0) << name;
  EXPECT_EQ(history.row.size(), 21u) << "the initial row and output.history = 20";
}

TEST_F(BiasExtension, HistoryEndsAtTheTravelAskedFor) {
  const auto history = read_history(out("history.csv"));
  EXPECT_NEAR(history.values("top.displacement_mm").back(), 30.0, 1e-9 * 30.0);  // %.10g in the file
  EXPECT_EQ(history.values("bottom.displacement_mm").back(), 0.0);
}

TEST_F(BiasExtension, SummaryHasThePromisedKeys) {
  const auto answer = summary();
  for (const std::string name : {"cells", "steps", "wall_s", "cell_steps_per_s", "max_shear_angle_deg", "energy_error",
                                 "kinetic_to_internal", "measures"})
    EXPECT_TRUE(answer.contains(name)) << name;
  EXPECT_GT(answer["cells"], 0);
  EXPECT_GT(answer["steps"], 0);
  EXPECT_TRUE(answer["measures"].contains("center"));
}

TEST_F(BiasExtension, FramesCarryThePromisedFields) {
  const std::string frame = read_text(out("frames/frame_0004.vtu"));
  for (const std::string name : {"shear_angle_deg", "yarn_strain", "yarn_force_N", "displacement_mm"})
    EXPECT_NE(frame.find("Name=\"" + name + "\""), std::string::npos) << name;
  EXPECT_EQ(weaveform::list_frames(out()).size(), 5u) << "the initial frame and output.frames = 4";
}

TEST_F(BiasExtension, PrintsItsTable) {
  EXPECT_NE(table.find("center"), std::string::npos) << table;
}

// Inextensible pin-jointed yarns shear by gamma = pi/2 - 2 acos((D + delta) / (D sqrt 2)), D = L - W (Eq. 14). Yarns
// that stretch shear less, and a mesh of every fourth yarn much less; a wrong unit or travel would still leave this
// range.
TEST_F(BiasExtension, CentreShearsLessThanInextensibleYarnsMust) {
  const double length = 115.0, travel = 30.0;  // mm; D and delta
  const double half_angle = std::acos((length + travel) / (length * std::numbers::sqrt2));
  const double kinematic = 90.0 - 2.0 * half_angle * 180.0 / std::numbers::pi;
  const double angle = std::abs(read_history(out("history.csv")).values("center.shear_angle_deg").back());
  EXPECT_GT(angle, kinematic / 3.0);
  EXPECT_LT(angle, kinematic);
}

// The specimen is in balance but for inertia and damping, so both ends carry the load: pulled up at the top, down
// below.
TEST_F(BiasExtension, EndsCarryTheSameLoad) {
  const auto history = read_history(out("history.csv"));
  const double top = history.values("top.force_N").back();
  const double bottom = history.values("bottom.force_N").back();
  EXPECT_GT(top, 0.0);
  EXPECT_NEAR(std::abs(bottom), top, 0.05 * top);
}

// The run itself fails above analysis.energy_limit (5 %); so small a case must be well below.
TEST_F(BiasExtension, KeepsItsEnergyBalance) {
  EXPECT_LT(summary()["energy_error"], 0.01);
}

}  // namespace
