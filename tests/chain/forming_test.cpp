// A coarse hemisphere through the program: every output of docs/forming.md is there and says what it should.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/run_command.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::read_text;
using weaveform::test::run_command;
using weaveform::test::TemporaryFolder;
using weaveform::test::write_text;

std::string first_line(const fs::path& file) {
  const std::string text = read_text(file);
  return text.substr(0, text.find('\n'));
}

TEST(FormingChain, CoarseHemisphereGivesAllOutputs) {
  const TemporaryFolder folder;
  const auto run =
      run_command("weaveform run '" WEAVEFORM_SOURCE_DIR
                  "/examples/hemisphere_pw.toml' --output out --set blank.coarsening=8 --set analysis.duration=0.4",
                  folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("forming, about the axis of punch"), std::string::npos) << run.out;
  const fs::path out = folder.path() / "out";
  EXPECT_EQ(first_line(out / "meridians.csv"), "azimuth_deg,arc_mm,shear_angle_deg,height_mm,radius_mm,x_mm,y_mm,z_mm");
  EXPECT_EQ(first_line(out / "outline.csv"), "azimuth_deg,radius_before_mm,radius_after_mm,draw_in_mm");
  EXPECT_EQ(first_line(out / "sphere_net.csv"), "cell,u_mm,v_mm,s,shear_angle_deg,net_deg,on_sphere");
  for (const char* name : {"meridians.svg", "sphere_net.svg", "punch_force.svg", "outline.vtp", "wrinkles.vtp"})
    EXPECT_TRUE(fs::exists(out / name)) << name;
  EXPECT_NE(read_text(out / "frames/frame_0020.vtu").find("contact_tool"), std::string::npos);

  std::ifstream stream(out / "summary.json");
  const auto forming = nlohmann::json::parse(stream)["forming"];
  EXPECT_EQ(forming["punch"]["tool"], "punch");
  EXPECT_GT(forming["punch"]["largest_force_N"].get<double>(), 0.0);
  EXPECT_LT(forming["force_balance"]["largest_relative_difference"].get<double>(), 0.01);
  // The four corners move in least, the sides' middles most; the part is symmetric in x and y.
  const auto& draw = forming["draw_in_mm"];
  EXPECT_GT(draw["at_0_deg"].get<double>(), draw["at_45_deg"].get<double>());
  EXPECT_NEAR(draw["at_0_deg"].get<double>(), draw["at_90_deg"].get<double>(), 0.01);
  // Sheared fabric is thicker: t = t0/cos at the angle reached, the yarns' stretch being about 1 %.
  const double angle = forming["shear_angle"]["largest_deg"].get<double>() * 3.14159265358979 / 180.0;
  EXPECT_NEAR(forming["thickness_mm"]["largest"].get<double>(), 0.5 / std::cos(angle), 0.02);

  ASSERT_EQ(run_command("weaveform mesh out/scene.toml --output out --quiet", folder.path()).exit_code, 0);
  for (const char* name : {"meridians.csv", "outline.vtp", "wrinkles.vtp", "sphere_net.svg", "punch_force.svg"})
    EXPECT_FALSE(fs::exists(out / name)) << name << " of the run before";
}

// A membrane has nothing to set the length of its wrinkles but the mesh, and says so; with bending it does not fold
// here.
TEST(FormingChain, AMembraneThatWrinklesSaysThatTheFoldsAreTheMeshs) {
  const TemporaryFolder folder;
  const auto draw = [&](const std::string& cell) {
    const auto run =
        run_command("weaveform run '" WEAVEFORM_SOURCE_DIR "/examples/hemisphere_pw.toml' --output " + cell +
                        " --set blank.coarsening=4 "
                        "--set tools.binder.force=50 --set model.cell=" +
                        cell,
                    folder.path());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const bool told = run.out.find("the model has no bending stiffness") != std::string::npos;
    std::ifstream stream(folder.path() / cell / "summary.json");
    const auto wrinkles = nlohmann::json::parse(stream)["forming"]["wrinkles"];
    EXPECT_EQ(wrinkles["of_the_mesh"].get<bool>(), told);
    return std::pair(told, wrinkles["area_share"].get<double>());
  };
  const auto membrane = draw("membrane"), bending = draw("rotation-free");
  EXPECT_TRUE(membrane.first);
  EXPECT_GT(membrane.second, 0.01);
  EXPECT_FALSE(bending.first);
  EXPECT_LT(bending.second, membrane.second);
}

// No sphere, a tool that is pushed instead of travelling, a blank that lies askew.
TEST(FormingChain, PressedBlankWithoutPunchHasNoPunchOutputs) {
  const TemporaryFolder folder;
  write_text(
      "[fabric]\nmaterial = \"twintex-pw\"\n[blank]\nsize = [120, 80]\nyarn_angle = 30\ncoarsening = 3\n"
      "position = [10, 20, 5]\norientation = 15\n[tools.base]\nshape = \"plane\"\n"
      "[tools.roll]\nshape = \"cylinder\"\nradius = 20\naxis = [0, 1, 0]\nposition = [10, 20, 25.25]\n"
      "direction = [0, 0, -1]\nforce = 20\n[analysis]\nduration = 0.02\n",
      folder.path() / "pressed.toml");
  const auto run = run_command("weaveform run pressed.toml --output out", folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("forming, about the blank's centre"), std::string::npos) << run.out;
  EXPECT_FALSE(fs::exists(folder.path() / "out/sphere_net.csv"));
  EXPECT_FALSE(fs::exists(folder.path() / "out/punch_force.svg"));
  EXPECT_TRUE(fs::exists(folder.path() / "out/meridians.csv"));
}

}  // namespace
