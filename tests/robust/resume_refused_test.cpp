// A run goes on only as it began: whatever else lies in its folder now, or in what its scene leads to, is refused by
// name, by `solve DIR --resume` and by `run SCENE --resume`.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>

#include "app/stages/checked_model.hpp"
#include "app/stages/stages.hpp"
#include "core/error.hpp"
#include "core/version/version.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;
using test::read_text;
using test::run_command;
using test::write_text;

// Two triangles over the whole blank, 40 mm below it.
std::string plate(double z) {
  const std::string low = " -300 -300 ", height = std::to_string(z);
  const auto facet = [&](const char* b, const char* c) {
    return "facet normal 0 0 1\nouter loop\nvertex" + low + height + "\nvertex " + b + " " + height + "\nvertex " + c +
           " " + height + "\nendloop\nendfacet\n";
  };
  return "solid plate\n" + facet("300 -300", "300 300") + facet("300 300", "-300 300") + "endsolid plate\n";
}

std::string shells(double z) {
  const std::string height = std::to_string(z);
  return "*Node\n1, -300, -300, " + height + "\n2, 300, -300, " + height + "\n3, 300, 300, " + height +
         "\n4, -300, 300, " + height + "\n*Element, type=S4R\n1, 1, 2, 3, 4\n";
}

std::string script(double z) {
  return "SetFactory(\"OpenCASCADE\");\nBox(1) = {-300, -300, " + std::to_string(z) + ", 600, 600, 50};\n";
}

void replace(const fs::path& file, const std::string& what, const std::string& by) {
  std::string text = read_text(file);
  const auto at = text.find(what);
  ASSERT_NE(at, std::string::npos) << what << " in " << text;
  write_text(text.replace(at, what.size(), by), file);
}

// A run with a card, an outline and three tools from files, stopped at its twentieth step.
class StoppedRun : public testing::Test {
protected:
  void SetUp() override {
    write_text(card_text_of("twintex-pw"), file("card.toml"));
    write_text("x_mm,y_mm\n-50,-100\n50,-100\n50,100\n-50,100\n-50,-100\n", file("blank.csv"));
    write_text(plate(-40.0), file("plate.stl"));
    write_text("*Include, input=shells.inp\n", file("tool.inp"));
    write_text(shells(60.0), file("shells.inp"));
    write_text(script(80.0), file("box.geo"));
    write_text(R"(
[fabric]
material = "card.toml"
[blank]
shape = "file"
outline = "blank.csv"
yarn_angle = 45
coarsening = 4
[tools.plate]
shape = "triangles"
file = "plate.stl"
friction = 0.25
travel = 1
[tools.shells]
shape = "triangles"
file = "tool.inp"
[tools.box]
shape = "triangles"
file = "box.geo"
[analysis]
duration = 0.02
[output]
frames = 2
)",
               file("scene.toml"));
    stop(version_line());
  }

  void stop(const std::string& program) {
    const Resolved model = checked_model(file("scene.toml"), {}, false, Look::for_first_complaint);
    ResultFolder result = write_model(model, file("out"), {});
    EXPECT_THROW(
        (void)solve(result.model(), file("out"), {.threads = 1, .quiet = true, .stop_at_step = 20, .program = program}),
        Interrupted);
  }

  [[nodiscard]] fs::path file(const std::string& name) const { return folder_.path() / name; }

  void expect_refused(const std::string& command, const std::string& named, int code = 2) const {
    const auto resumed = run_command(command, folder_.path());
    EXPECT_EQ(resumed.exit_code, code) << command << "\n" << resumed.err;
    EXPECT_NE(resumed.err.find(named), std::string::npos) << command << "\n" << resumed.err;
    EXPECT_TRUE(fs::exists(file("out/checkpoint.bin"))) << "it is still worth having";
  }
  void expect_refused_by_both(const std::string& named) const {
    expect_refused("weaveform solve out --resume --quiet", named);
    expect_refused("weaveform run scene.toml --output out --resume --quiet", named);
  }

private:
  test::TemporaryFolder folder_;
};

TEST_F(StoppedRun, GoesOnAsItBegan) {
  const auto resumed = run_command("weaveform solve out --resume --quiet", file(""));
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
}

TEST_F(StoppedRun, NotUnderAnotherScene) {
  replace(file("scene.toml"), "friction = 0.25", "friction = 0.5");
  expect_refused("weaveform run scene.toml --output out --resume --quiet", "tools.plate.friction: 0.25");
  replace(file("out/scene.toml"), "friction = 0.25", "friction = 0.5");
  expect_refused("weaveform solve out --resume --quiet", "tools.plate.friction: 0.25 in the checkpoint, 0.5 now");
}

TEST_F(StoppedRun, NotWithAnotherCard) {
  replace(file("card.toml"), "[shear]", "[shear]  # the same");
  EXPECT_EQ(run_command("weaveform solve out --resume --quiet", file("")).exit_code, 0) << "a comment changes nothing";
  stop(version_line());
  replace(file("card.toml"), "thickness = ", "thickness = 1");
  expect_refused_by_both("card twintex-pw: content differs");
}

TEST_F(StoppedRun, NotWithOtherTools) {
  write_text(plate(-41.0), file("plate.stl"));
  expect_refused_by_both("tool file plate.stl: content differs");
  write_text(plate(-40.0), file("plate.stl"));
  write_text(script(81.0), file("box.geo"));
  expect_refused_by_both("tool file box.geo: content differs");
}

TEST_F(StoppedRun, NotWithAnotherFileThatAToolsFileTakesIn) {
  write_text(shells(61.0), file("shells.inp"));
  expect_refused_by_both("surface of tool shells: content differs");
}

TEST_F(StoppedRun, NotWithAnotherOutline) {
  replace(file("blank.csv"), "50,100", "50,90");
  expect_refused_by_both("outline file blank.csv: content differs");
}

TEST_F(StoppedRun, NotWithAnotherMesh) {
  ASSERT_EQ(
      run_command("weaveform mesh scene.toml --output other --set blank.yarn_angle=44.9 --quiet", file("")).exit_code,
      0);
  fs::copy_file(file("other/mesh.vtu"), file("out/mesh.vtu"), fs::copy_options::overwrite_existing);
  expect_refused_by_both("mesh: content differs");
}

TEST_F(StoppedRun, NotWithoutItsTool) {
  fs::remove(file("plate.stl"));
  expect_refused("weaveform solve out --resume --quiet", "plate.stl", 4);
}

TEST_F(StoppedRun, NotByAnotherProgram) {
  stop("weaveform 0.0.1 (commit 0123456789ab)");
  expect_refused_by_both("program: weaveform 0.0.1 (commit 0123456789ab) in the checkpoint");
}

}  // namespace
}  // namespace weaveform
