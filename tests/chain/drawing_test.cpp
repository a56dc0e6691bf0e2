// Drawings that another program (ezdxf) wrote, as blanks: the mesh has the area of the closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numeric>
#include <sstream>
#include <string>

#include "mesher/mesh/mesh_io.hpp"
#include "tests/support/run_command.hpp"

namespace {

using weaveform::test::run_command;
using weaveform::test::TemporaryFolder;
using weaveform::test::write_text;

TEST(Drawing, BlanksHaveTheDrawnArea) {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& command) { return run_command(command, folder.path()); };
  if (run("/usr/bin/python3 -c 'import ezdxf'").exit_code != 0) GTEST_SKIP() << "python3-ezdxf is not installed";
  const auto drawn = run(std::string("/usr/bin/python3 ") + WEAVEFORM_SOURCE_DIR + "/tests/data/drawings.py");
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  std::istringstream in(drawn.out);
  int drawings = 0;
  double exact = 0.0;
  for (std::string name; in >> name >> exact; ++drawings) {
    write_text("[fabric]\nmaterial = \"twintex-pw\"\n[blank]\nshape = \"file\"\noutline = \"" + name +
                   ".dxf\"\nyarn_angle = 20.0\ncoarsening = " + (exact > 1e5 ? "16" : "2") +
                   "\n[analysis]\nduration = 0.01\n",
               folder.path() / "scene.toml");
    const auto meshed = run("weaveform mesh scene.toml --output made --quiet");
    ASSERT_EQ(meshed.exit_code, 0) << name << meshed.err;
    EXPECT_EQ(meshed.err.find("names no unit") != std::string::npos, name == "old") << meshed.err;
    const weaveform::Mesh mesh = weaveform::read_mesh(folder.path() / "made" / "mesh.vtu");
    const double area = std::accumulate(mesh.cells.area.begin(), mesh.cells.area.end(), 0.0);
    // chords within 0.01 mm
    EXPECT_NEAR(area, exact, 0.02 * std::sqrt(exact)) << name;
  }
  EXPECT_EQ(drawings, 7);
}

}  // namespace
