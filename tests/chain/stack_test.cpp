// A stack of two plies through the program: every answer says which ply it is of, stages and threads and kills change no
// bit, wrong stacks are refused with their place, and its plies are layers for structural analysis.
#include "mesher/mesh/stack.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "app/stages/checked_model.hpp"
#include "app/stages/stages.hpp"
#include "core/error.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "solver/result/result.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

using namespace test;
namespace fs = std::filesystem;

const std::string two_ply_hemisphere = std::string(WEAVEFORM_SOURCE_DIR) + "/examples/hemisphere_two_plies.toml";
const std::string stack_settings =
    " --set blank.coarsening=4 --set tools.punch.travel=25 --set analysis.duration=0.03 --set output.frames=2 --set "
    "output.history=20 --quiet";
const std::vector<std::string> stack_files = {"mesh.vtu", "history.csv", "contours.vtp", "frames/frame_0000.vtu",
                                              "frames/frame_0002.vtu"};

class StackChain : public testing::Test {
protected:
  void run(const std::string& command) const {
    const CommandResult result = run_command(command, folder_.path());
    EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.err;
  }
  // What a scene that is refused says; it must end with `exit_code`.
  [[nodiscard]] std::string refused(const std::string& scene, int exit_code = 2) const {
    write_text(scene, folder_.path() / "wrong.toml");
    const CommandResult result = run_command("weaveform check wrong.toml", folder_.path());
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    return result.err;
  }
  void expect_same(const std::string& one, const std::string& other) const {
    for (const std::string& name : stack_files)
      EXPECT_TRUE(read_text(folder_.path() / one / name) == read_text(folder_.path() / other / name)) << name;
  }
  [[nodiscard]] nlohmann::json summary(const std::string& of) const {
    return nlohmann::json::parse(read_text(folder_.path() / of / "summary.json"));
  }
  test::TemporaryFolder folder_;
};

TEST_F(StackChain, EveryAnswerSaysOfWhichPlyItIs) {
  run("weaveform run " + two_ply_hemisphere + " --output one" + stack_settings);
  const nlohmann::json answers = summary("one");
  EXPECT_EQ(answers.at("symmetry"), "quarter");
  EXPECT_LT(answers.at("energy_error").get<double>(), 0.0025);
  int cells = 0;
  for (const char* ply : {"lower", "upper"}) {
    const auto& of = answers.at("plies").at(ply);
    cells += of.at("cells").get<int>();
    EXPECT_GT(of.at("max_shear_angle_deg").get<double>(), 5.0) << ply;
    EXPECT_GT(of.at("forming").at("draw_in_mm").at("largest").get<double>(), 1.0) << ply;
    EXPECT_TRUE(fs::exists(folder_.path() / "one/plies" / ply / "outline.csv")) << ply;
  }
  EXPECT_EQ(answers.at("cells"), cells);
  const auto& pair = answers.at("pairs").at("lower/upper");
  EXPECT_GT(pair.at("max_slip_mm").get<double>(), pair.at("mean_slip_mm").get<double>());
  EXPECT_GT(pair.at("mean_slip_mm").get<double>(), 0.5);
  EXPECT_GT(pair.at("friction_work_mJ").get<double>(), 0.0);
  EXPECT_LT(pair.at("max_penetration_mm").get<double>(), 0.25) << "half of a thickness";
  EXPECT_NEAR(pair.at("mean_pressure_MPa").get<double>() * pair.at("contact_area_mm2").get<double>(),
              pair.at("force_N").get<double>(), 1e-9 * pair.at("force_N").get<double>());
  EXPECT_GT(pair.at("max_pressure_MPa").get<double>(), pair.at("mean_pressure_MPa").get<double>());
  // the binder's force goes through the upper ply into the lower one, and with the punch's into the die
  const double binder = answers.at("tools").at("binder").at("force_N"),
               punch = answers.at("tools").at("punch").at("force_N");
  EXPECT_NEAR(pair.at("force_N").get<double>(), binder + punch, 0.1 * (binder + punch));
  EXPECT_NEAR(answers.at("tools").at("die").at("force_N").get<double>(), binder + punch, 0.03 * (binder + punch));

  const Mesh mesh = read_mesh(folder_.path() / "one/mesh.vtu");
  ASSERT_EQ(mesh.ply.size(), 2U);
  const fs::path frame = folder_.path() / "one/frames/frame_0002.vtu";
  const auto slip = read_frame_array(frame, "slip_mm"), path = read_frame_array(frame, "slip_path_mm");
  ASSERT_EQ(slip.size(), 3 * path.size());
  ASSERT_EQ(static_cast<int>(path.size()), mesh.node_count());
  // a way counts while the two touch, where it leads always
  const double greatest = *std::max_element(path.begin(), path.end());
  double farthest = 0.0;
  for (std::size_t n = 0; n < path.size(); ++n)
    farthest = std::max(farthest, std::hypot(slip[3 * n], slip[3 * n + 1], slip[3 * n + 2]));
  EXPECT_GT(farthest, 0.5 * greatest);
  EXPECT_NEAR(greatest, pair.at("max_slip_mm").get<double>(), 0.05 * greatest);
  const auto of_elements = read_frame_array(frame, "ply");
  EXPECT_EQ(std::set<double>(of_elements.begin(), of_elements.end()), (std::set<double>{0.0, 1.0}));
  EXPECT_EQ(static_cast<int>(of_elements.size()), mesh.yarn_count() + mesh.cells.size());
  const auto of_cells = ply_of_cells(mesh);
  for (int c = 0; c < mesh.cells.size(); ++c) EXPECT_EQ(of_elements[mesh.yarn_count() + c], of_cells[c]);

  const History history = read_history(folder_.path() / "one/history.csv");
  for (const char* column : {"lower.max_shear_angle_deg", "upper.max_shear_angle_deg", "lower/upper.force_N",
                             "lower/upper.slip_mm", "lower/upper.friction_work_mJ"})
    EXPECT_GT(history.values(column).back(), 0.0) << column;
}

TEST_F(StackChain, StagesAndThreadsChangeNoBit) {
  run("weaveform run " + two_ply_hemisphere + " --output one --threads 1" + stack_settings);
  run("weaveform mesh " + two_ply_hemisphere + " --output staged" + stack_settings);
  run("weaveform solve staged --threads 3 --quiet");
  run("weaveform post staged --quiet");
  expect_same("one", "staged");
}

// Yarns at 45 deg to the planes are mirrored from one family onto the other, and touch there as in the whole.
TEST_F(StackChain, AQuarterIsTheWhole) {
  const std::string slow =
      " --set blank.coarsening=4 --set tools.punch.travel=15 --set analysis.duration=0.08 --set output.frames=2 --set "
      "output.history=20 --quiet";
  run("weaveform run " + two_ply_hemisphere + " --output quarter" + slow);
  run("weaveform run " + two_ply_hemisphere + " --output whole --set model.symmetry=none" + slow);
  EXPECT_EQ(summary("whole").at("symmetry"), "none");
  const fs::path quarter = folder_.path() / "quarter/frames/frame_0002.vtu",
                 whole = folder_.path() / "whole/frames/frame_0002.vtu";
  const auto one = read_frame_positions(quarter), other = read_frame_positions(whole);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t n = 0; n < one.size(); ++n)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(one[n][c], other[n][c], 0.1) << n;
  const auto touches = read_frame_array(quarter, "other_ply"), all = read_frame_array(whole, "other_ply");
  int differ = 0;
  for (std::size_t n = 0; n < touches.size(); ++n) differ += touches[n] != all[n] ? 1 : 0;
  EXPECT_LE(differ, 4);
  const nlohmann::json a = summary("quarter").at("pairs").at("lower/upper"),
                       b = summary("whole").at("pairs").at("lower/upper");
  for (const char* name : {"contact_area_mm2", "force_N", "mean_slip_mm", "friction_work_mJ"})
    EXPECT_NEAR(a.at(name).get<double>(), b.at(name).get<double>(), 0.02 * b.at(name).get<double>()) << name;
}

TEST_F(StackChain, AStoppedRunGoesOnToTheSameBits) {
  const std::vector<std::string> quick = {"blank.coarsening=4", "tools.punch.travel=25", "analysis.duration=0.03",
                                          "output.frames=2", "output.history=20"};
  const auto solved = [&](const std::string& to, SolveOptions how) {
    how.quiet = true;
    if (how.resume) {
      ResultFolder there(folder_.path() / to);
      solve_folder(there, how, {}, true);
      return;
    }
    ResultFolder made =
        write_model(checked_model(two_ply_hemisphere, quick, true, Look::for_first_complaint), folder_.path() / to, {});
    solve_folder(made, how, {}, true);
  };
  fs::create_directories(folder_.path() / "whole");
  fs::create_directories(folder_.path() / "stopped");
  solved("whole", {.threads = 1});
  const long steps = read_statistics(folder_.path() / "whole/solve.json").steps;
  EXPECT_THROW(solved("stopped", {.threads = 1, .stop_at_step = 1}), Interrupted);
  for (const long step : {2L, steps / 3, steps / 3 + 1, steps / 2, 9 * steps / 10})
    EXPECT_THROW(solved("stopped", {.threads = step % 2 == 0 ? 1 : 2, .resume = true, .stop_at_step = step}),
                 Interrupted);
  solved("stopped", {.threads = 1, .resume = true});
  for (const char* name : {"history.csv", "frames/frame_0001.vtu", "frames/frame_0002.vtu"})
    EXPECT_TRUE(read_text(folder_.path() / "whole" / name) == read_text(folder_.path() / "stopped" / name)) << name;
}

const std::string stack_blank = "[blank]\nsize = [100, 100]\nyarn_angle = 0\ncoarsening = 4\n";
const std::string stack_plies = "[[ply]]\nname = \"lower\"\n[[ply]]\nname = \"upper\"\nyarn_angle = 45\n";
const std::string stack_pull =
    "[[grip]]\nname = \"pull\"\nedge = \"top\"\ntravel = 1\n[[grip]]\nname = \"hold\"\nedge = \"bottom\"\n";

TEST_F(StackChain, WrongStacksAreRefusedWithTheirPlace) {
  const std::string inside = refused(stack_blank + stack_plies + "position = [0, 0, 0.1]\n" + stack_pull);
  EXPECT_TRUE(says(inside, "lower") && says(inside, "upper") && says(inside, "mm")) << inside;
  EXPECT_TRUE(says(refused(stack_blank + stack_plies + "[stack]\nfrction = 1\n"),
                   "wrong.toml:11:1: unknown key 'frction' in [stack]"));
  EXPECT_TRUE(says(refused(stack_blank + stack_plies + "[stack]\nfriction_law = \"none.csv\"\n" + stack_pull, 4),
                   "wrong.toml: stack.friction_law: "));
  write_text("0,0\n0,1\n", folder_.path() / "law.csv");
  EXPECT_TRUE(says(refused(stack_blank + stack_plies + "[stack]\nfriction_law = \"law.csv\"\n" + stack_pull),
                   "law.csv:2: the slip is 0 after 0"));
  const std::string cards = refused(stack_blank + stack_plies + "material = \"none.toml\"\n" + stack_pull, 4);
  EXPECT_TRUE(says(cards, "ply 'upper'")) << cards;
  EXPECT_TRUE(says(refused(stack_blank + stack_plies + "[frame]\n"), "set rigid = true for a stack in the frame"));
  EXPECT_TRUE(says(refused(stack_blank + stack_plies + "size = [90, 90]\n[frame]\nrigid = true\n"),
                   "ply 'upper' does not lie in the frame as 'lower' does"));
}

TEST_F(StackChain, CheckAndPlanSpeakOfEveryPly) {
  write_text(stack_blank + stack_plies + "coarsening = 3\n" + stack_pull, folder_.path() / "s.toml");
  const CommandResult check = run_command("weaveform check s.toml --json --resolved", folder_.path());
  ASSERT_EQ(check.exit_code, 0) << check.err;
  const auto json = nlohmann::json::parse(check.out);
  EXPECT_EQ(json.at("mesh").at("plies").size(), 2U);
  EXPECT_EQ(json.at("resolved").at("ply").at("upper").at("mesh").at("coarsening").size(), 2U);
  EXPECT_EQ(json.at("scene").at("ply").size(), 2U);
  run("weaveform check s.toml > echo.toml && weaveform check echo.toml > again.toml && cmp echo.toml again.toml");
  const CommandResult plan = run_command("weaveform mesh s.toml --plan --json", folder_.path());
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  const auto rows = nlohmann::json::parse(plan.out);
  const auto& own =
      *std::find_if(rows.begin(), rows.end(), [](const auto& row) { return row["coarsening_factor"] == 1.0; });
  EXPECT_EQ(own.at("cells"), json.at("mesh").at("cells"));
  EXPECT_EQ(own.at("plies").size(), 2U);
}

TEST_F(StackChain, AStudyVariesAPlyAndItsMeasures) {
  write_text("scene = \"" + two_ply_hemisphere +
                 "\"\nmeasures = [\"plies.upper.max_shear_angle_deg\", \"pairs.lower/upper.mean_slip_mm\"]\n[set]\n"
                 "\"blank.coarsening\" = 4\n\"tools.punch.travel\" = 15\n\"analysis.duration\" = "
                 "0.02\n\"output.frames\" = 1\n[grid]\n"
                 "\"ply.upper.yarn_angle\" = [45, 30]\n",
             folder_.path() / "study.toml");
  const CommandResult result = run_command("weaveform study study.toml --output study --quiet", folder_.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

// One ply drawn as a whole over another that is held, as a slip test does: what a file says of tau(slip) is the force per
// area, whether the plies lie pressed or just on each other.
TEST_F(StackChain, AMeasuredSlipLawIsGivenBackByItsOwnTest) {
  write_text("0, 0.0001\n0.1, 0.012\n1, 0.03\n", folder_.path() / "slip.csv");
  const auto tau = [](double slip) {
    return slip < 0.1 ? 0.0001 + 0.119 * slip : 0.012 + 0.02 * (slip - 0.1);  // MPa
  };
  const auto whole_ply = [](const std::string& name, const std::string& ply, const std::string& more) {
    return "[[grip]]\nname = \"" + name + "\"\nbox = [-100, -100, 100, 100]\nplies = [\"" + ply + "\"]\n" + more;
  };
  const std::string plates =
      "[tools.lower]\nshape = \"plane\"\n[tools.upper]\nshape = \"plane\"\naxis = [0, 0, -1]\nforce = 10\n";
  for (const bool pressed : {false, true}) {
    const std::string free = pressed ? "free = [\"z\"]\n" : "";
    write_text(
        "[blank]\nsize = [60, 120]\nyarn_angle = 0\ncoarsening = 4\n[[ply]]\nname = \"a\"\n[[ply]]\nname = \"b\"\n"
        "[stack]\nfriction_law = \"slip.csv\"\n" +
            whole_ply("held", "a", free) + whole_ply("drawn", "b", free + "travel = 1\n") + (pressed ? plates : "") +
            "[analysis]\nduration = 0.1\n[output]\nframes = 1\n",
        folder_.path() / "s.toml");
    run("weaveform run s.toml --output done --quiet");
    const History history = read_history(folder_.path() / "done/history.csv");
    const auto way = history.values("drawn.displacement_mm"), force = history.values("drawn.force_N");
    int compared = 0;
    for (std::size_t row = 0; row < way.size(); ++row) {
      if (way[row] < 0.2 || way[row] > 0.95) continue;
      const double expected = tau(way[row]) * 60.0 * 120.0;
      EXPECT_NEAR(force[row], expected, 0.01 * expected) << (pressed ? "pressed, " : "") << way[row] << " mm";
      ++compared;
    }
    EXPECT_GT(compared, 20);
  }
}

// What the camera sees is one ply, by its own yarns and in its own blank's frame.
TEST_F(StackChain, ACameraSeesThePlyItIsToldOrTheHighest) {
  write_text(
      "[blank]\nsize = [100, 200]\nyarn_angle = 45\ncoarsening = 4\n[[ply]]\nname = \"back\"\n[[ply]]\nname = "
      "\"front\"\nyarn_angle = 30\n" +
          stack_pull + "[analysis]\nduration = 0.1\n[output]\nframes = 2\nhistory = 20\n",
      folder_.path() / "s.toml");
  run("weaveform run s.toml --output done --quiet --set grip.pull.travel=10");
  for (const char* ply : {"back", "front"}) {
    const std::string name = ply;
    run("weaveform post virtual done --set instrument.facet_size=4 --set instrument.step=4 --set instrument.ply=" +
        name + " --output seen_" + name + " --quiet");
    run("weaveform post compare done seen_" + name + "/stages --settings seen_" + name +
        "/settings.toml --output compared_" + name + " --quiet");
    const auto compared = nlohmann::json::parse(read_text(folder_.path() / ("compared_" + name) / "comparison.json"));
    EXPECT_EQ(compared.at("instrument").at("ply"), name);
    EXPECT_LT(std::abs(compared.at("stages").back().at("all").at("difference_deg").at("mean").get<double>()), 0.05);
  }
  const CommandResult other = run_command(
      "weaveform post virtual done --set instrument.facet_size=4 --set instrument.step=4 --set instrument.ply=bakc "
      "--output none --quiet",
      folder_.path());
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(says(other, "did you mean 'back'?")) << other.err;
}

// Without a structural mesh the lowest ply's own cells are the shells, all of them with every ply above them.
TEST_F(StackChain, ExportsLayersOfItsOwnShellsAndPliesOneByOne) {
  write_text(stack_blank + stack_plies + stack_pull + "[analysis]\nduration = 0.01\n[output]\nframes = 1\n",
             folder_.path() / "s.toml");
  run("weaveform run s.toml --output done --quiet");
  for (const char* format :
       {"orientation-calculix", "orientation-abaqus", "drape-openradioss", "composite-lsdyna", "csv"})
    run("weaveform export done --format " + std::string(format) + " --output " + format + ".txt --quiet");
  const std::string deck = read_text(folder_.path() / "orientation-calculix.txt");
  const Mesh mesh = read_mesh(folder_.path() / "done/mesh.vtu");
  std::size_t layers = 0, sections = 0;
  for (std::size_t at = deck.find("TWINTEX_PW, WARP_"); at != std::string::npos;
       at = deck.find("TWINTEX_PW, WARP_", at + 1))
    ++layers;
  for (std::size_t at = deck.find("COMPOSITE\n"); at != std::string::npos; at = deck.find("COMPOSITE\n", at + 1))
    ++sections;
  EXPECT_GT(sections, 0U);
  EXPECT_GT(layers, sections) << "where both plies have cells";
  EXPECT_TRUE(says(read_text(folder_.path() / "drape-openradioss.txt"), "/DRAPE/4\nweft of upper"));
  EXPECT_TRUE(says(read_text(folder_.path() / "csv.txt"), "\nupper,"));
  run("weaveform export done --format abaqus --ply upper --output upper.inp --quiet");
  const CommandResult both = run_command("weaveform export done --format abaqus --output both.inp", folder_.path());
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_TRUE(says(both, "say with --ply which: lower, upper")) << both.err;
  EXPECT_EQ(mesh.ply.size(), 2U);
}

TEST_F(StackChain, EachPlyDrapesAsAloneSoFarOffTheTool) {
  const auto scene = [](const std::string& plies, const std::string& offset) {
    return "[blank]\nsize = [60, 60]\nyarn_angle = 45\ncoarsening = 2\n" + plies +
           "[tools.dome]\nshape = \"sphere\"\naxis = [0, 0, -1]\nradius = 50\nposition = [0, 0, -50]\n" + offset +
           "[drape]\ntool = \"dome\"\n";
  };
  write_text(scene("[[ply]]\nname = \"under\"\nyarn_angle = 0\n[[ply]]\nname = \"over\"\n", ""),
             folder_.path() / "s.toml");
  run("weaveform drape s.toml --output draped --quiet");
  const auto drape = nlohmann::json::parse(read_text(folder_.path() / "draped/drape.json"));
  const auto &under = drape.at("plies").at("under"), &over = drape.at("plies").at("over");
  EXPECT_EQ(drape.at("cells"), under.at("cells").get<int>() + over.at("cells").get<int>());
  EXPECT_EQ(drape.at("cells_placed"), drape.at("cells"));
  EXPECT_GT(over.at("off_tool_mm").get<double>(), 3.0 * under.at("off_tool_mm").get<double>())
      << "half, one and a half";
  EXPECT_NEAR(over.at("flat_area_mm2").get<double>(), 3600.0, 1.0) << "all of it lies on the dome";
  EXPECT_TRUE(fs::exists(folder_.path() / "draped/plies/under/flat_pattern.csv"));

  write_text(scene("", fmt::format("offset = {}\n", over.at("off_tool_mm").get<double>())),
             folder_.path() / "one.toml");
  run("weaveform drape one.toml --output alone --quiet");
  const fs::path all = folder_.path() / "draped/drape.vtu", one = folder_.path() / "alone/drape.vtu";
  const auto alone = read_frame_positions(one), stack = read_frame_positions(all);
  ASSERT_GT(stack.size(), alone.size());
  EXPECT_TRUE(std::equal(alone.rbegin(), alone.rend(), stack.rbegin())) << "the upper ply's nodes come last";
  const auto of = read_frame_array(all, "ply");
  EXPECT_EQ(std::count(of.begin(), of.end(), 1.0), static_cast<std::ptrdiff_t>(read_frame_array(one, "family").size()));

  run("weaveform drape one.toml --output draped --quiet");
  EXPECT_FALSE(fs::exists(folder_.path() / "draped/plies")) << "nothing of an older scene stays";
}

TEST_F(StackChain, AReportShowsSlipAndHidesPlies) {
  run("weaveform run " + two_ply_hemisphere + " --output one --report" + stack_settings);
  const std::string page = read_text(folder_.path() / "one/report.html");
  for (const char* what : {"\"slip_path\"", "\"ply_pressure\"", "slip of upper on lower", "\"plies\":\"", "ply lower"})
    EXPECT_TRUE(says(page, what)) << what;
}

// Each ply as a part of one file, as a preprocessor would write it.
std::string parts_of(const Mesh& stack) {
  std::string parts, instances;
  for (std::size_t k = 0; k < stack.ply.size(); ++k) {
    const Mesh mesh = ply_mesh(stack, k);
    const std::string& name = stack.ply[k].name;
    parts += "*PART, NAME=" + name + "\n*NODE\n";
    for (int n = 0; n < mesh.node_count(); ++n)
      parts += fmt::format("{}, {}, {}, {}\n", n + 1, mesh.nodes.position[n][0], mesh.nodes.position[n][1],
                           mesh.nodes.position[n][2]);
    parts += "*ELEMENT, TYPE=T3D2\n";
    for (int e = 0; e < mesh.yarn_count(); ++e)
      parts += fmt::format("{}, {}, {}\n", e + 1, mesh.yarns.node[e][0] + 1, mesh.yarns.node[e][1] + 1);
    parts += "*ELEMENT, TYPE=M3D4\n";
    for (int c = 0; c < mesh.cells.size(); ++c) {
      parts += std::to_string(mesh.yarn_count() + c + 1);
      for (int a = mesh.cells.offset[c]; a < mesh.cells.offset[c + 1]; ++a)
        parts += fmt::format(", {}", mesh.cells.node[a] + 1);
      parts += "\n";
    }
    for (const NodeSet& set : mesh.sets) {
      parts += "*NSET, NSET=" + set.name + "\n";
      for (const int n : set.node) parts += fmt::format("{}\n", n + 1);
    }
    parts += "*END PART\n";
    instances += fmt::format("*INSTANCE, NAME={0}-1, PART={0}\n*END INSTANCE\n", name);
  }
  return parts + "*ASSEMBLY, NAME=all\n" + instances + "*END ASSEMBLY\n";
}

// Blanks cut along yarns have whole cells only, of which everything can be recovered.
TEST_F(StackChain, PliesImportedAsPartsGiveTheRunOfTheirOwnMesh) {
  write_text(
      "[blank]\nsize = [98.4, 98.4]\nyarn_angle = 0\ncoarsening = 4\n[stack]\nfriction = 0.2\n[[ply]]\nname = "
      "\"lower\"\n[[ply]]\nname = \"upper\"\n" +
          stack_pull + "[analysis]\nduration = 0.01\n[output]\nframes = 1\nhistory = 10\n",
      folder_.path() / "s.toml");
  run("weaveform run s.toml --output direct --quiet");
  write_text(parts_of(read_mesh(folder_.path() / "direct/mesh.vtu")), folder_.path() / "parts.inp");
  run("weaveform import parts.inp --scene s.toml --output back --quiet");
  const Mesh direct = read_mesh(folder_.path() / "direct/mesh.vtu"), back = read_mesh(folder_.path() / "back/mesh.vtu");
  ASSERT_EQ(back.ply.size(), 2U);
  EXPECT_EQ(back.cells.size(), direct.cells.size());
  EXPECT_DOUBLE_EQ(ply_mesh(back, 1).nodes.position[0][2], direct.ply[0].thickness);
  run("weaveform solve back --quiet");
  const double one = read_history(folder_.path() / "direct/history.csv").values("pull.force_N").back(),
               other = read_history(folder_.path() / "back/history.csv").values("pull.force_N").back();
  EXPECT_NEAR(other, one, 1e-6 * std::abs(one));
  const auto says_of = [&](const std::string& options, const std::string& words) {
    const CommandResult told =
        run_command("weaveform import parts.inp --scene s.toml --output no" + options, folder_.path());
    EXPECT_EQ(told.exit_code, 2) << options;
    EXPECT_TRUE(says(told, words)) << told.err;
  };
  says_of(" --part lower", "the plies of a stack are the parts of their names");
  says_of(" --set ply.1.name=top", "ply 'top': parts.inp: no part or instance is named 'top'");
}

// In a quarter plies thicken and press as in the whole.
TEST_F(StackChain, ShearedThicknessOfAQuarterIsThatOfTheWhole) {
  const std::string sheared =
      " --set blank.coarsening=5 --set model.contact_thickness=sheared --set tools.punch.travel=12 --set "
      "analysis.duration=0.05 --set output.frames=1 --set output.history=10 --quiet";
  run("weaveform run " + two_ply_hemisphere + " --output quarter" + sheared);
  run("weaveform run " + two_ply_hemisphere + " --output whole --set model.symmetry=none" + sheared);
  EXPECT_EQ(summary("quarter").at("symmetry"), "quarter");
  const auto one = read_frame_positions(folder_.path() / "quarter/frames/frame_0001.vtu"),
             other = read_frame_positions(folder_.path() / "whole/frames/frame_0001.vtu");
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t n = 0; n < one.size(); ++n)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(one[n][c], other[n][c], 0.1) << n;
  EXPECT_LT(summary("whole").at("energy_error").get<double>(), 0.01);
}

TEST_F(StackChain, ThicknessAfterShearIsRefusedWhereItMeansNothing) {
  const std::string plate = "[tools.plate]\nshape = \"plane\"\n";
  EXPECT_TRUE(says(refused("[model]\ncontact_thickness = \"sheared\"\n" + stack_pull),
                   "wrong.toml:2:21: 'contact_thickness' is of no use here: nothing touches the fabric"));
  EXPECT_TRUE(says(refused("[model]\ncontact_thickness = \"sheared\"\nthickness = \"constant\"\n" + plate + stack_pull),
                   "it needs thickness = \"constant-volume\""));
  EXPECT_TRUE(
      says(refused("[model]\ncontact_thickness = \"sheared\"\n[drape]\ntool = \"plate\"\n" + plate + stack_pull),
           "a blank that starts draped lies its card's thickness off its tool"));
}

// Plies that do not touch know nothing of each other: each has the bits of its run alone, and their grip feels both.
TEST_F(StackChain, PliesApartAreTheirRunsAloneAndAGripFeelsAllItHolds) {
  write_text(stack_blank + stack_pull, folder_.path() / "alone.toml");
  write_text(stack_blank + "[stack]\ngap = 5\n[[ply]]\nname = \"a\"\n[[ply]]\nname = \"b\"\n" + stack_pull,
             folder_.path() / "stack.toml");
  run("weaveform run alone.toml --output alone --quiet --set output.frames=1 --threads 1");
  run("weaveform run stack.toml --output stack --quiet --set output.frames=1 --threads 1");
  const auto alone = read_frame_positions(folder_.path() / "alone/frames/frame_0001.vtu"),
             stack = read_frame_positions(folder_.path() / "stack/frames/frame_0001.vtu");
  ASSERT_EQ(stack.size(), 2 * alone.size());
  for (std::size_t n = 0; n < alone.size(); ++n) {
    EXPECT_EQ(stack[n], alone[n]);
    for (const std::size_t c : {0U, 1U}) EXPECT_EQ(stack[alone.size() + n][c], alone[n][c]);
  }
  const double one = read_history(folder_.path() / "alone/history.csv").values("pull.force_N").back(),
               two = read_history(folder_.path() / "stack/history.csv").values("pull.force_N").back();
  EXPECT_NEAR(two, 2.0 * one, 1e-9 * std::abs(two));
}

// Two plies in the grips of a bias extension are a bias extension: its loads are twice the one's, ideal and simulated.
TEST_F(StackChain, StackedSpecimensAreComparedAsOneTest) {
  write_text(tiny_scene(), folder_.path() / "alone.toml");
  write_text(
      tiny_scene() + "\n[stack]\nfriction = 0.3\n[[ply]]\nname = \"a\"\n[[ply]]\nname = \"b\"\nyarn_angle = -45\n",
      folder_.path() / "stack.toml");
  run("weaveform run alone.toml --output alone --quiet");
  run("weaveform run stack.toml --output stack --quiet");
  const nlohmann::json alone = summary("alone"), stack = summary("stack");
  EXPECT_NEAR(stack["ideal"]["force_N"].get<double>(), 2.0 * alone["ideal"]["force_N"].get<double>(), 1e-9);
  EXPECT_EQ(stack["ideal"]["shear_angle_deg"], alone["ideal"]["shear_angle_deg"]);
  EXPECT_EQ(stack["bias_extension"], alone["bias_extension"]);
  EXPECT_EQ(stack["travel"].size(), alone["travel"].size());
  for (const auto& [name, sign] : {std::pair{"a", 1.0}, {"b", -1.0}})
    for (const char* zone : {"A", "B", "C"}) {
      const auto &its = stack["plies"][name]["zones"][zone], &the = alone["zones"][zone];
      EXPECT_EQ(its["cells"], the["cells"]) << name << zone;
      EXPECT_NEAR(its["shear_angle_deg"].get<double>(), sign * the["shear_angle_deg"].get<double>(), 1e-3) << zone;
      EXPECT_NEAR(its["ideal_deg"].get<double>(), sign * the["ideal_deg"].get<double>(), 1e-9) << zone;
    }
}

TEST_F(StackChain, ARunOfOnePlyInAStackIsThatPlysRun) {
  write_text(stack_blank + stack_pull, folder_.path() / "alone.toml");
  write_text(stack_blank + "[[ply]]\nname = \"only\"\n" + stack_pull, folder_.path() / "stack.toml");
  run("weaveform run alone.toml --output alone --quiet --set output.frames=1 --threads 1");
  run("weaveform run stack.toml --output stack --quiet --set output.frames=1 --threads 1");
  EXPECT_EQ(read_frame_positions(folder_.path() / "alone/frames/frame_0001.vtu"),
            read_frame_positions(folder_.path() / "stack/frames/frame_0001.vtu"));
}

}  // namespace
}  // namespace weaveform
