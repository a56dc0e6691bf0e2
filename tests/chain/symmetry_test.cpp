// A quarter through the program: stage by stage the same files as in one go, all of them of the whole blank.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "mesher/mesh/mesh_io.hpp"
#include "solver/result/result.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

using namespace test;

const std::string hemisphere = std::string(WEAVEFORM_SOURCE_DIR) + "/examples/hemisphere_pw.toml";
const std::string settings =
    " --set blank.coarsening=8 --set analysis.duration=0.1 --set output.frames=2 --set output.history=20 --quiet";

TEST(QuarterChain, StagesGiveTheFilesOfTheWholeBlank) {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& command) {
    const CommandResult result = run_command(command, folder.path());
    EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.err;
  };
  run("weaveform run " + hemisphere + " --output one" + settings);
  run("weaveform mesh " + hemisphere + " --output staged" + settings);
  run("weaveform solve staged --quiet");
  run("weaveform post staged --quiet");
  for (const char* name : {"mesh.vtu", "history.csv", "contours.vtp", "frames/frame_0002.vtu"})
    EXPECT_TRUE(read_text(folder.path() / "one" / name) == read_text(folder.path() / "staged" / name)) << name;

  const auto summary = nlohmann::json::parse(read_text(folder.path() / "one" / "summary.json"));
  const Mesh mesh = read_mesh(folder.path() / "one" / "mesh.vtu");
  EXPECT_EQ(summary.at("symmetry"), "quarter");
  EXPECT_EQ(summary.at("cells"), mesh.cells.size());
  EXPECT_EQ(4 * summary.at("cells_solved").get<int>(), mesh.cells.size());
  EXPECT_NEAR(summary.at("tools").at("binder").at("force_N").get<double>(), 650.0, 1.0);
  const auto position = read_frame_positions(folder.path() / "one" / "frames/frame_0002.vtu");
  EXPECT_EQ(position.size(), mesh.nodes.position.size());
  // a frame shows both signs of the angle, as a whole does
  const auto angle = read_frame_array(folder.path() / "one" / "frames/frame_0002.vtu", "shear_angle_deg");
  const auto [least, greatest] = std::minmax_element(angle.begin(), angle.end());
  EXPECT_GT(*greatest, 30.0);
  EXPECT_NEAR(*least, -*greatest, 1e-9 * *greatest);
}

TEST(QuarterChain, SaysWhyAWholeIsSolvedAndRefusesAQuarterThatIsNone) {
  const TemporaryFolder folder;
  const std::string turned = settings.substr(0, settings.rfind(" --quiet")) + " --set blank.yarn_angle=30";
  const CommandResult whole = run_command("weaveform run " + hemisphere + " --output whole" + turned, folder.path());
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_NE(whole.err.find("symmetry: none, the whole blank is solved; plane x = 0: the yarns do not run along it"),
            std::string::npos)
      << whole.err;
  const CommandResult refused = run_command(
      "weaveform run " + hemisphere + " --output none" + turned + " --set model.symmetry=quarter", folder.path());
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  EXPECT_NE(refused.err.find("the scene is no quarter: plane x = 0 of the blank: the yarns"), std::string::npos)
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "none"));
}

}  // namespace
}  // namespace weaveform
