// Stacks through the program that are hard on contact: eight plies between binder and die, plies of unlike meshes, a ply
// torn by a grip.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

using namespace test;

// A deep drawing of 120 x 120 mm by a sphere of 20 mm, of plies with these keys.
std::string drawn_plies(const std::vector<std::string>& plies, double opening, double travel) {
  std::string scene = "[blank]\nsize = [120, 120]\nyarn_angle = 0\ncoarsening = 3\n[stack]\nfriction = 0.2\n";
  for (std::size_t k = 0; k < plies.size(); ++k) scene += fmt::format("[[ply]]\nname = \"p{}\"\n{}\n", k, plies[k]);
  return scene +
         fmt::format(
             "[tools.binder]\nshape = \"ring\"\naxis = [0, 0, -1]\nopening_radius = {0}\nforce = 50\nfriction = "
             "0.3\n[tools.die]\nshape = \"ring\"\nopening_radius = {0}\nfillet_radius = 8\nfriction = 0.3\n"
             "[tools.punch]\nshape = \"sphere\"\nradius = 20\ntravel = {1}\nfriction = 0.3\n"
             "[analysis]\nloading_speed = 300\n[output]\nframes = 1\nhistory = 20\n",
             opening, travel);
}

class StackCasesChain : public testing::Test {
protected:
  nlohmann::json answers(const std::string& scene) const {
    write_text(scene, folder_.path() / "s.toml");
    const CommandResult result = run_command("weaveform run s.toml --output done --quiet", folder_.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.exit_code == 0 ? nlohmann::json::parse(read_text(folder_.path() / "done/summary.json"))
                                 : nlohmann::json();
  }
  static double force(const nlohmann::json& of, const char* tool) { return of.at("tools").at(tool).at("force_N"); }
  TemporaryFolder folder_;
};

// Thick stacks over coarse cells, where cells meet at 40 degrees: nodes lie on edges and in dents of the next ply, of one
// direction on all of its crossings. 17 %, 5 % and 1 % of the balance were missing while the surface had edges.
TEST_F(StackCasesChain, EightPliesOverCoarseCellsKeepTheirBalance) {
  for (const std::vector<int>& angles :
       {std::vector{0, 45, 0, 45, 0, 45, 0, 45}, {0, 30, 60, 90, 15, 45, 0, 75}, {0, 0, 0, 0, 0, 0, 0, 0}}) {
    std::vector<std::string> plies;
    for (const int angle : angles) plies.push_back(fmt::format("yarn_angle = {}", angle));
    const auto of = answers(drawn_plies(plies, 30.0, 10.0) + "[model]\nsymmetry = \"none\"\n");
    ASSERT_FALSE(of.is_null());
    EXPECT_LT(of.at("energy_error").get<double>(), 0.001) << angles[1] << " deg";
    EXPECT_NEAR(force(of, "die"), force(of, "binder") + force(of, "punch"), 0.01 * force(of, "die"));
  }
}

TEST_F(StackCasesChain, EightPliesBetweenBinderAndDie) {
  std::vector<std::string> plies;
  for (int k = 0; k < 8; ++k) plies.emplace_back(k % 2 == 0 ? "yarn_angle = 0" : "yarn_angle = 45");
  const auto of = answers(drawn_plies(plies, 30.0, 10.0));
  ASSERT_FALSE(of.is_null());
  const double binder = force(of, "binder"), punch = force(of, "punch"), die = force(of, "die");
  EXPECT_NEAR(binder, 50.0, 1.0);
  EXPECT_NEAR(die, binder + punch, 0.01 * die);
  int neighbours = 0;
  for (const auto& [name, pair] : of.at("pairs").items()) {  // that have touched
    EXPECT_LT(pair.at("max_penetration_mm").get<double>(), 0.1) << name << ": a fifth of a ply";
    const double force = pair.at("force_N");
    if (name[4] != name[1] + 1) {
      EXPECT_LT(force, 0.001 * die) << name << " have plies between them";
      continue;
    }
    EXPECT_NEAR(force, die, 0.03 * die) << name << ": it goes through every ply";
    ++neighbours;
  }
  EXPECT_EQ(neighbours, 7);
  EXPECT_LT(of.at("energy_error").get<double>(), 0.01);
}

TEST_F(StackCasesChain, PliesOfUnlikeMeshesAreDrawnAlike) {
  std::vector<double> punch, slip;
  for (const auto& [lower, upper] : {std::pair{1, 1}, {2, 1}, {1, 2}}) {
    const auto of = answers(drawn_plies(
        {fmt::format("coarsening = {}", lower), fmt::format("coarsening = {}\nyarn_angle = 45", upper)}, 24.0, 12.0));
    ASSERT_FALSE(of.is_null());
    EXPECT_NEAR(force(of, "die"), force(of, "binder") + force(of, "punch"), 0.01 * force(of, "die"));
    const auto& pair = of.at("pairs").at("p0/p1");
    EXPECT_LT(pair.at("max_penetration_mm").get<double>(), 0.1);
    EXPECT_LT(of.at("energy_error").get<double>(), 0.005);
    punch.push_back(force(of, "punch"));
    slip.push_back(pair.at("mean_slip_mm"));
  }
  for (const std::size_t mixed : {1U, 2U}) {
    EXPECT_NEAR(punch[mixed], punch[0], 0.12 * punch[0]);
    EXPECT_NEAR(slip[mixed], slip[0], 0.08 * slip[0]);
  }
}

// A grip that pulls one ply further than its yarns bear stops the run, and says which ply.
TEST_F(StackCasesChain, APlyTornByAGripIsNamed) {
  write_text(
      "[blank]\nsize = [100, 100]\nyarn_angle = 0\ncoarsening = 4\n"
      "[[ply]]\nname = \"lower\"\n[[ply]]\nname = \"upper\"\n[stack]\nfriction = 0.2\n[[grip]]\nname = "
      "\"hold\"\nedge = \"bottom\"\n[[grip]]\nname = \"tear\"\nedge = \"top\"\nplies = [\"upper\"]\n"
      "travel = 30\n[analysis]\nduration = 0.05\n",
      folder_.path() / "s.toml");
  const CommandResult result = run_command("weaveform run s.toml --output torn --quiet", folder_.path());
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_TRUE(says(result, "ply 'upper': ")) << result.err;
  EXPECT_TRUE(says(result, "yarn")) << result.err;
  EXPECT_FALSE(says(result, "ply 'lower': ")) << result.err;
}

}  // namespace
}  // namespace weaveform
