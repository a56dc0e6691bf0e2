// The program on a terminal, and what it says to somebody who does not know it yet.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command_folder.hpp"
#include "tests/support/run_in_terminal.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::read_text;
using weaveform::test::run_in_terminal;
using weaveform::test::says;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

class Terminal : public weaveform::test::CommandFolder {
protected:
  void SetUp() override { write_text(tiny_scene() + "\n[analysis]\nduration = 0.2\n", file("tiny.toml")); }
};

// What was drawn from one line's begin to the next, of the bar.
std::vector<std::string> drawn_bars(const std::string& screen) {
  std::vector<std::string> bars;
  std::string piece;
  std::istringstream pieces(screen);
  while (std::getline(pieces, piece, '\r'))
    if (piece.starts_with("solve ") && says(piece, "%")) bars.push_back(piece.substr(0, piece.find('\x1b')));
  return bars;
}

TEST_F(Terminal, TheBarFitsAnyWidthAndIsRedrawnInPlace) {
  // runs of more than a few tenths of a second, after each of which the bar is drawn, on fast machines too
  for (const int columns : {24, 40, 60, 80, 120, 200}) {
    const std::string screen =
        run_in_terminal("weaveform run tiny.toml -o out --set analysis.duration=8", folder(), columns);
    const auto bars = drawn_bars(screen);
    ASSERT_GE(bars.size(), 2U) << screen;
    for (const std::string& bar : bars) EXPECT_LT(static_cast<int>(bar.size()), columns) << bar;
    EXPECT_TRUE(says(bars.back(), "100 %") && says(bars.back(), "left")) << bars.back();
    EXPECT_EQ(says(bars.front(), "["), columns >= 40) << bars.front();
    // a line's end between two drawings would leave a trail of bars
    const auto first = screen.find("\rsolve "), last = screen.rfind("\rsolve ");
    EXPECT_EQ(screen.substr(first, last - first).find('\n'), std::string::npos) << screen;
  }
}

TEST_F(Terminal, AnErrorDuringTheRunStandsBelowTheBar) {
  const std::string screen = run_in_terminal("weaveform run tiny.toml -o out --set grip.top.travel=300", folder(), 80);
  const auto error = screen.find("error: ");
  ASSERT_NE(error, std::string::npos) << screen;
  EXPECT_EQ(screen[error - 1], '\n') << screen;
}

TEST_F(Terminal, ADumbTerminalGetsPlainLines) {
  const std::string screen = run_in_terminal("export TERM=dumb; weaveform run tiny.toml -o out", folder(), 80);
  EXPECT_EQ(screen.find('\x1b'), std::string::npos) << screen;
  EXPECT_TRUE(says(screen, "elapsed")) << screen;
}

TEST_F(Terminal, UnknownCommandsAndOptionsGetTheNearestOne) {
  const std::vector<std::pair<std::string, std::string>> slips = {
      {"rnu tiny.toml", "unknown command 'rnu'; did you mean 'run'?"},
      {"chek tiny.toml", "did you mean 'check'?"},
      {"unitcell", "did you mean 'unit-cell'?"},
      {"post compar a b", "did you mean 'compare'?"},
      {"run tiny.toml --outptu out", "unknown option '--outptu' of 'weaveform run'; did you mean '--output'?"},
      {"run tiny.toml --thread=2", "did you mean '--threads'?"},
      {"run tiny.toml --cores 3", "unknown option '--cores' of 'weaveform run'; valid: "},
      {"--verion", "did you mean '--version'?"},
      {"help rnu", "did you mean 'run'?"},
      {"run tiny.toml other.toml", "'other.toml' is one word too many for 'weaveform run'"},
      {"", "no command is given"}};
  for (const auto& [command, words] : slips) {
    const auto result = run("weaveform " + command);
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_TRUE(says(result.err, words)) << command << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST_F(Terminal, HelpAndVersionAnswerByEveryUsualName) {
  EXPECT_EQ(run("weaveform -V").out, run("weaveform --version").out);
  EXPECT_EQ(run("weaveform help").out, run("weaveform --help").out);
  EXPECT_EQ(run("weaveform help run").out, run("weaveform run --help").out);
  EXPECT_EQ(run("weaveform help post compare").out, run("weaveform post compare --help").out);
  EXPECT_TRUE(says(run("weaveform help").out, "unit-cell"));
}

TEST_F(Terminal, ARunEndsWithItsFolderAndEchoesItsSceneOnlyWhenAsked) {
  const auto plain = run("weaveform run tiny.toml -o out");
  EXPECT_TRUE(says(plain.err, "written to out: result.pvd")) << plain.err;
  EXPECT_FALSE(says(plain.err, "[blank]")) << plain.err;
  EXPECT_TRUE(says(run("weaveform run tiny.toml -o out --verbose").err, "[blank]"));
  // warnings, which stay: of a mesh this coarse there is one
  const std::string quiet = run("weaveform run tiny.toml -o out --quiet").err;
  EXPECT_TRUE(quiet.starts_with("warning: ")) << quiet;
  EXPECT_EQ(std::count(quiet.begin(), quiet.end(), '\n'), 1) << quiet;
}

TEST_F(Terminal, ASummaryNamesVersionCommitSceneAndDigests) {
  ASSERT_EQ(run("weaveform run tiny.toml -o out -q").exit_code, 0);
  const std::string summary = read_text(file("out/summary.json"));
  for (const char* part : {"\"program\": \"weaveform ", "commit ", "\"scene\": \"tiny.toml\"", "\"scene_digest\": \"",
                           "\"card_digest\": \"", "\"mesh_digest\": \""})
    EXPECT_TRUE(says(summary, part)) << part << summary;
}

// Its name stands in the folder's own scene, which must stay one.
TEST_F(Terminal, NoNameOfASceneSpoilsItsResults) {
  for (const std::string name : {"line\nbreak.toml", "quote\"back\\slash.toml", "caf\xc3\xa9.toml", "latin\xe9.toml"}) {
    fs::copy_file(file("tiny.toml"), file(name));
    write_text(name, file("name"));
    const auto result = run("weaveform run \"$(cat name)\" -o out -q && weaveform check out/scene.toml");
    EXPECT_EQ(result.exit_code, 0) << name << result.err;
    fs::remove(file(name));
  }
}

TEST_F(Terminal, AChartOfAnUnknownKindIsRefusedBeforeAnythingIsRead) {
  const auto result = run("weaveform chart absent.csv -o x.png");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(says(result.err, "x.png: a chart is written as .svg or .html")) << result.err;
}

// A scene with everything wrong at once, each of which `run` refuses.
TEST_F(Terminal, CheckFindsWhatRunRefusesAndAllOfItAtOnce) {
  write_text(R"(name = "bare"
thickness = 0.5
[yarn]
linear_density = 1870
section = 1.25
interval = 5
area_density = 1e-9
tension = [ { from = 0.0, coefficients = [20000] } ]
[shear]
tangent = [ { from = 0.0, coefficients = [0.3] } ]
)",
             file("bare.toml"));
  const std::string scene = R"([fabric]
material = "twintex-pw"
[blank]
size = [200, 200]
coarsening = 4
[model]
cell = "shell"
cell_bending = [0, 0, 0]
[tools.first]
shape = "triangles"
file = "absent.stl"
[tools.second]
shape = "triangles"
file = "absent.step"
travel = 5
[tools.third]
shape = "sphere"
radius = 50
position = [0, 0, 0]
travel = 5
)";
  write_text(scene, file("all.toml"));
  const auto all = run("weaveform check all.toml");
  EXPECT_EQ(all.exit_code, 2) << all.err;
  for (const char* part : {"tools.first.file", "tools.second.file", "no bending stiffness of their own"})
    EXPECT_TRUE(says(all.err, part)) << part << all.err;
  const auto inside = run("weaveform check all.toml --set model.cell=membrane --set model.cell_bending=[1,1,1]");
  EXPECT_EQ(inside.exit_code, 2) << inside.err;

  std::string membrane = scene;
  membrane.erase(membrane.find("[model]"), membrane.find("[tools.first]") - membrane.find("[model]"));
  write_text(membrane, file("tools.toml"));
  const auto tools = run("weaveform check tools.toml");
  EXPECT_EQ(tools.exit_code, 2) << tools.err;
  for (const char* part : {"tools.first.file", "tools.second.file", "[tools.third]: node"})
    EXPECT_TRUE(says(tools.err, part)) << part << tools.err;

  write_text(membrane.substr(0, membrane.find("[tools.third]")), file("files.toml"));
  const auto files = run("weaveform check files.toml --set blank.shape=file --set blank.outline=absent.csv");
  EXPECT_EQ(files.exit_code, 4) << files.err;
  for (const char* part : {"blank.outline", "tools.first.file", "tools.second.file"})
    EXPECT_TRUE(says(files.err, part)) << part << files.err;
}

}  // namespace
