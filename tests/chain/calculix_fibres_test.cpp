// Fibre directions in the hands of CalculiX: an orthotropic strip under tension stretches as its warp's angle says.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/run_command.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::read_text;
using weaveform::test::run_command;
using weaveform::test::TemporaryFolder;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

// mm, MPa, N
constexpr double length = 60.0, width = 16.0, force = 100.0, e1 = 50000.0, e2 = 10000.0, poisson = 0.3, shear = 4000.0;
constexpr int along = 6, across = 4;

// Shells of 10 x 4 mm about the origin, whole (S4), as two triangles (S3) or with nodes between the corners (S8R).
struct Strip {
  std::string type;
  [[nodiscard]] static int node(int i, int j) { return j * (along + 1) + i + 1; }
  [[nodiscard]] bool second_order() const { return type == "S8R"; }
  // Between two corners along the strip and across it.
  [[nodiscard]] static int between_i(int i, int j) { return 100 + j * along + i; }
  [[nodiscard]] static int between_j(int i, int j) { return 200 + j * (along + 1) + i; }
  static void place(std::ostream& out, int number, double i, double j) {
    out << number << ", " << length * (i / along - 0.5) << ", " << width * (j / across - 0.5) << ", 0.\n";
  }
  [[nodiscard]] std::string mesh() const {
    std::ostringstream out;
    out << "*NODE, NSET=ALL\n";
    for (int j = 0; j <= across; ++j)
      for (int i = 0; i <= along; ++i) {
        place(out, node(i, j), i, j);
        if (second_order() && i < along) place(out, between_i(i, j), i + 0.5, j);
        if (second_order() && j < across) place(out, between_j(i, j), i, j + 0.5);
      }
    out << "*ELEMENT, TYPE=" << type << ", ELSET=STRIP\n";
    int number = 0;
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < along; ++i) {
        const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
        std::vector<std::vector<int>> shells = {{a, b, c, d}};
        if (second_order())
          shells = {{a, b, c, d, between_i(i, j), between_j(i + 1, j), between_i(i, j + 1), between_j(i, j)}};
        if (type == "S3") shells = {{a, b, c}, {a, c, d}};
        for (const auto& shell : shells) {
          out << ++number;
          for (const int n : shell) out << ", " << n;
          out << "\n";
        }
      }
    return out.str();
  }
  // Held so that it may stretch and shear as it will, pulled evenly at both ends.
  [[nodiscard]] std::string load() const {
    std::ostringstream out;
    out << "*NSET, NSET=END\n"
        << node(along, 0) << "\n*STEP\n*STATIC\n*BOUNDARY\n"
        << node(0, 0) << ", 1, 2\n"
        << node(along, 0) << ", 2\nALL, 3\n*CLOAD\n";
    const auto pull = [&](int right, int left, double share) {
      out << right << ", 1, " << force / across * share << "\n" << left << ", 1, " << -force / across * share << "\n";
    };
    for (int j = 0; j < across; ++j) {  // each side as its shape functions share an even load
      const double corner = second_order() ? 1.0 / 6.0 : 0.5;
      for (const int end : {j, j + 1}) pull(node(along, end), node(0, end), corner);
      if (second_order()) pull(between_j(along, j), between_j(0, j), 4.0 / 6.0);
    }
    out << "*NODE PRINT, NSET=END\nU\n*END STEP\n";
    return out.str();
  }
};

const std::string material =
    "*MATERIAL, NAME=FABRIC\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n50000., 10000., 10000., .3, .3, .3, 4000., "
    "4000.,\n4000.\n";

class CalculixFibres : public testing::Test {
protected:
  void SetUp() override {
    if (run("command -v ccx").exit_code != 0) GTEST_SKIP() << "ccx (calculix-ccx) is not installed";
    write_text(tiny_scene(), file("tiny.toml"));
  }
  [[nodiscard]] weaveform::test::CommandResult run(const std::string& command) const {
    return run_command(command, folder_.path());
  }
  [[nodiscard]] fs::path file(const std::string& name) const { return folder_.path() / name; }
  // mm; how far the strip's end moves on a fabric whose warp lies at `angle` to it.
  [[nodiscard]] double stretch(const std::string& type, double angle) const {
    write_text(Strip{type}.mesh(), file("strip.inp"));
    const std::string flat = "flat_" + std::to_string(std::lround(angle));
    if (!fs::exists(file(flat))) {
      const auto made =
          run("weaveform run tiny.toml --quiet --set grip.top.travel=0.001 --set blank.size=[120,240] "
              "--set blank.fit=none --set output.frames=1 --set blank.yarn_angle=" +
              std::to_string(angle) + " --output " + flat);
      EXPECT_EQ(made.exit_code, 0) << made.err;
    }
    const auto exported =
        run("weaveform export " + flat + " --onto strip.inp --format orientation-calculix --output fibres.inp --force");
    EXPECT_EQ(exported.exit_code, 0) << exported.err;
    write_text("*INCLUDE, INPUT=strip.inp\n" + material + "*INCLUDE, INPUT=fibres.inp\n" + Strip{type}.load(),
               file("job.inp"));
    return solved_stretch();
  }
  // mm; of job.inp.
  [[nodiscard]] double solved_stretch() const {
    const auto solved = run("ccx job");
    EXPECT_NE(solved.out.find("Job finished"), std::string::npos) << solved.out;
    EXPECT_EQ(solved.out.find("*WARNING"), std::string::npos) << solved.out;
    std::istringstream in(read_text(file("job.dat")));
    std::string line, last;
    while (std::getline(in, line))
      if (line.find_first_not_of(' ') != std::string::npos) last = line;
    std::istringstream fields(last);
    int node = 0;
    double u = 0.0;
    fields >> node >> u;
    EXPECT_EQ(node, Strip::node(along, 0)) << last;
    return u;
  }
  TemporaryFolder folder_;
};

// 1/E(a) = c^4/E1 + (1/G - 2 nu/E1) s^2 c^2 + s^4/E2 (Jones, "Mechanics of Composite Materials", eq. 2.97).
double closed_form(double angle, double thickness) {
  const double c = std::cos(angle * std::numbers::pi / 180.0), s = std::sin(angle * std::numbers::pi / 180.0);
  const double compliance =
      c * c * c * c / e1 + (1.0 / shear - 2.0 * poisson / e1) * s * s * c * c + s * s * s * s / e2;
  return force / (width * thickness) * length * compliance;
}

double thickness_in(const std::string& text) {
  const std::size_t section = text.find("\n*SHELL SECTION") + 1;
  return std::stod(text.substr(text.find('\n', section)));
}

TEST_F(CalculixFibres, WarpAndWeftDifferAsTheClosedFormSays) {
  std::map<double, double> found;
  for (const auto& [type, angle] : {std::pair{"S4", 0.0}, std::pair{"S4", 90.0}, std::pair{"S4", 30.0},
                                    std::pair{"S4R", 30.0}, std::pair{"S3", 30.0}, std::pair{"S8R", 30.0}}) {
    const double u = stretch(type, angle);
    const double thickness = thickness_in(read_text(file("fibres.inp")));
    const double exact = closed_form(angle, thickness);
    // the fabric is stretched by 4e-6 only; six digits are printed
    EXPECT_NEAR(u, exact, 2e-4 * exact) << type << " " << angle;
    found[angle] = u;
  }
  EXPECT_NEAR(found[90.0] / found[0.0], e1 / e2, 1e-3 * e1 / e2);
}

// In-plane stiffness of a layer turned by 90 deg or not at all: Q11 = E1/(1 - nu12 nu21), Q12 = nu12 Q22, Q22 likewise
// (Jones, eq. 2.66); of layers 0, 90, 0 of one thickness A = t (2 Q + Q turned), B = 0 for they are symmetric, and a strip
// free at its sides stretches by A22 / (A11 A22 - A12^2) times its force per width.
double cross_ply(double thickness) {
  const double poisson_21 = poisson * e2 / e1, part = 1.0 - poisson * poisson_21;
  const double a11 = thickness * (2.0 * e1 + e2) / part, a22 = thickness * (e1 + 2.0 * e2) / part,
               a12 = 3.0 * thickness * poisson * e2 / part;
  return force / width * length * a22 / (a11 * a22 - a12 * a12);
}

// Three plies, 0, 90 and 0, are three layers of each shell. CalculiX layers S8R.
TEST_F(CalculixFibres, PliesOfAStackAreLayersOfALaminate) {
  write_text(Strip{"S8R"}.mesh(), file("strip.inp"));
  write_text(tiny_scene() +
                 "[[ply]]\nname = \"lower\"\nyarn_angle = 0\n[[ply]]\nname = \"middle\"\nyarn_angle = 90\n[[ply]]\n"
                 "name = \"upper\"\nyarn_angle = 0\n",
             file("stack.toml"));
  const auto made =
      run("weaveform run stack.toml --quiet --set grip.top.travel=0.001 --set blank.size=[120,240] --set "
          "blank.fit=none --set "
          "output.frames=1 --output stack");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto exported =
      run("weaveform export stack --onto strip.inp --format orientation-calculix --output layers.inp --force");
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  const std::string layers = read_text(file("layers.inp"));
  EXPECT_LT(layers.find("WARP_1_LOWER\n"), layers.find("WARP_1_MIDDLE\n")) << "the shells' normals point up";
  EXPECT_LT(layers.find("WARP_1_MIDDLE\n"), layers.find("WARP_1_UPPER\n"));
  std::string named = material;
  named.replace(named.find("FABRIC"), 6, "TWINTEX_PW");
  write_text("*INCLUDE, INPUT=strip.inp\n" + named + "*INCLUDE, INPUT=layers.inp\n" + Strip{"S8R"}.load(),
             file("job.inp"));
  const double u = solved_stretch();
  const double exact = cross_ply(0.5);
  EXPECT_NEAR(u, exact, 5e-4 * exact);
}

}  // namespace
