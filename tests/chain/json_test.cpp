// --json: one document on standard output, of every command that prints an answer, with the numbers of the file or of
// the text that it stands for.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "tests/support/command_folder.hpp"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using weaveform::test::CommandResult;
using weaveform::test::read_text;
using weaveform::test::says;
using weaveform::test::write_text;

const std::string our_examples = WEAVEFORM_SOURCE_DIR "/examples/";

class JsonAnswer : public weaveform::test::CommandFolder {
protected:
  // What the command says on standard output, all of it one document; null, and a failure, when it is none.
  [[nodiscard]] json answer(const std::string& command, int exit_code = 0) const {
    const CommandResult result = run("weaveform " + command + " --json");
    EXPECT_EQ(result.exit_code, exit_code) << command << "\n" << result.err;
    json found = json::parse(result.out, nullptr, false);
    EXPECT_FALSE(found.is_discarded()) << command << "\n" << result.out;
    return found.is_discarded() ? json() : found;
  }
  [[nodiscard]] std::string text(const std::string& command) const {
    const CommandResult result = run("weaveform " + command);
    EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.err;
    return result.out;
  }
  [[nodiscard]] json file_json(const std::string& name) const { return json::parse(read_text(file(name))); }
};

TEST_F(JsonAnswer, OfRunAndPostIsTheSummaryToTheByte) {
  const CommandResult ran = run("weaveform run tiny.toml --output done --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.out, read_text(file("done/summary.json")));
  EXPECT_TRUE(says(ran, "written to done")) << "the log stays where it is: " << ran.err;
  const CommandResult again = run("weaveform post done --json");
  EXPECT_EQ(again.out, read_text(file("done/summary.json")));
  EXPECT_EQ(json::parse(again.out)["measures"].size(), 1U);
}

// One level is too few to know an error: the run fails, and says what it has.
TEST_F(JsonAnswer, OfARunToAnAccuracyHasItsLevelsBesideTheSummary) {
  const json found = answer("run tiny.toml --accuracy 20% --output done", 3);
  ASSERT_TRUE(found.contains("accuracy")) << found;
  json summary = found;
  summary.erase("accuracy");
  EXPECT_EQ(summary, file_json("done/summary.json"));
  EXPECT_FALSE(found["accuracy"]["met"].get<bool>());
  ASSERT_EQ(found["accuracy"]["levels"].size(), 1U);
  const json& level = found["accuracy"]["levels"][0];
  EXPECT_EQ(level["coarsening_factor"], 1.0);
  EXPECT_EQ(level["measures"]["grips.top.force_N"]["value"], summary["grips"]["top"]["force_N"]);
  EXPECT_TRUE(level["measures"]["grips.top.force_N"]["error_bound"].is_null());
}

TEST_F(JsonAnswer, OfCheckIsTheSceneThatItPrints) {
  const json plain = answer("check tiny.toml");
  EXPECT_EQ(plain["scene"]["blank"]["size"], json({115.0, 230.0}));
  EXPECT_EQ(plain["scene"]["grip"][1]["name"], "top");
  EXPECT_FALSE(plain.contains("resolved"));
  const json resolved = answer("check tiny.toml --resolved");
  EXPECT_EQ(resolved["scene"], plain["scene"]);
  EXPECT_EQ(resolved["resolved"]["mesh"]["cells"], plain["mesh"]["cells"]);
  EXPECT_EQ(resolved["resolved"]["analysis"]["cells_solved"], plain["expected"]["cells_solved"]);
  EXPECT_TRUE(says(text("check tiny.toml"), "# mesh: " + plain["mesh"]["cells"].dump() + " cells"));
  // nothing that the text has is missing
  const std::string printed = text("check tiny.toml --resolved");
  const std::regex table(R"(\n\[\[?([a-z_]+))");
  for (std::sregex_iterator it(printed.begin(), printed.end(), table), end; it != end; ++it) {
    const std::string name = (*it)[1].str();
    EXPECT_TRUE(name == "resolved" ? resolved.contains(name) : resolved["scene"].contains(name)) << name;
  }
}

TEST_F(JsonAnswer, OfMeshesHasTheirNumbers) {
  const json mesh = answer("mesh tiny.toml --output meshed");
  EXPECT_EQ(mesh, answer("check tiny.toml")["mesh"]);
  const json exported = answer("export tiny.toml --format gmsh --output mesh.msh");
  EXPECT_EQ(exported["files"], json::array({"mesh.msh"}));
  EXPECT_EQ(exported["mesh"], mesh);
  const json imported = answer("import mesh.msh --output back");
  for (const char* name : {"cells", "yarn_elements", "nodes", "spacing_mm"}) EXPECT_EQ(imported[name], mesh[name]);
}

TEST_F(JsonAnswer, OfAPlanHasARowForEachCoarsening) {
  const json plan = answer("mesh tiny.toml --plan --threads 1");
  ASSERT_EQ(plan.size(), 5U);
  EXPECT_TRUE(says(plan[0]["no_mesh"].get<std::string>(), "blank.")) << plan[0];
  EXPECT_EQ(plan[3]["coarsening_factor"], 1.0);
  EXPECT_EQ(plan[3]["cells"], answer("check tiny.toml")["mesh"]["cells"]);
  EXPECT_GT(plan[4]["steps"].get<double>(), plan[3]["steps"].get<double>());
}

TEST_F(JsonAnswer, OfAFibreExportCountsTheShells) {
  must("weaveform run tiny.toml --output done --quiet");
  const json found = answer("export done --format csv --output fibres.csv");
  const std::string table = read_text(file("fibres.csv"));
  EXPECT_EQ(found["files"], json::array({"fibres.csv"}));
  const std::string said = text("export done --format csv --output fibres.csv");
  EXPECT_TRUE(says(said, "fibres.csv: " + found["shells"].dump() + " shells")) << said;
}

TEST_F(JsonAnswer, OfADrapeIsItsFile) {
  const CommandResult draped =
      run("weaveform drape '" + our_examples + "drape_hemisphere.toml' --set blank.coarsening=4 --output net --json");
  ASSERT_EQ(draped.exit_code, 0) << draped.err;
  EXPECT_EQ(draped.out, read_text(file("net/drape.json")));
}

TEST_F(JsonAnswer, OfAFitIsItsReport) {
  const CommandResult fitted = run("weaveform fit '" + our_examples + "fit/twintex.toml' --output fitted --json");
  ASSERT_EQ(fitted.exit_code, 0) << fitted.err;
  EXPECT_EQ(fitted.out, read_text(file("fitted/report.json")));
}

TEST_F(JsonAnswer, OfAComparisonIsItsFileAndOfBordersTheirTable) {
  must("weaveform run tiny.toml --output done --quiet");
  must("weaveform post virtual done --set instrument.facet_size=6 --output measured --quiet");
  const CommandResult compared =
      run("weaveform post compare done measured/stages --settings measured/settings.toml --output out --json");
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  EXPECT_EQ(compared.out, read_text(file("out/comparison.json")));
  const json form = answer("post compare done measured/stages --write-settings form.toml");
  EXPECT_EQ(form["settings"], "form.toml");
  EXPECT_TRUE(form["questions"].is_array());
  const json borders = answer("post border done --facet 4");
  ASSERT_EQ(borders["widths"].size(), 2U);
  EXPECT_TRUE(borders["widths"][0]["facet_size_mm"].is_null()) << "of the raw field";
  EXPECT_EQ(borders["widths"][1]["facet_size_mm"], 4.0);
  EXPECT_EQ(borders["widths"][1]["step_mm"], 2.0);
  EXPECT_GT(borders["shear_angle_deg"]["A"].get<double>(), borders["shear_angle_deg"]["C"].get<double>());
}

TEST_F(JsonAnswer, OfAToolHasItsBox) {
  write_text("SetFactory(\"OpenCASCADE\");\nBox(1) = {-2, 1, 0.5, 4, 3, 2};\n", file("box.geo"));
  const json box = answer("tool box.geo");
  EXPECT_EQ(box["triangles"], 12);
  EXPECT_TRUE(box["closed"].get<bool>());
  EXPECT_NEAR(box["volume_mm3"].get<double>(), 24.0, 1e-6);
  EXPECT_NEAR(box["low_mm"][0].get<double>(), -2.0, 1e-6);
  EXPECT_TRUE(box["faults"]["gaps"].empty());
}

TEST_F(JsonAnswer, OfTheUnitCellHasAVariantForEachRow) {
  const std::string options = "unit-cell --increments 70 --to 50 --output cell";
  const json found = answer(options);
  const std::string table = text(options);
  for (const json& variant : found["variants"]) {
    EXPECT_TRUE(says(table, "| " + variant["name"].get<std::string>() + " ")) << variant["name"];
    EXPECT_TRUE(variant["relative_error_at_deg"]["60"].is_null()) << "beyond 50 deg";
    EXPECT_TRUE(variant["relative_error_at_deg"]["45"].is_number());
  }
  EXPECT_EQ(found["variants"].size(), static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')) - 2U);
}

TEST_F(JsonAnswer, OfAStudyHasItsCasesConvergenceAndWork) {
  write_text(
      "scene = \"tiny.toml\"\nmeasures = [\"grips.top.force_N\"]\n[set]\nanalysis.duration = 0.1\n"
      "[grid]\nblank.coarsening = [4, 3, 2, 30]\n[convergence]\nkey = \"blank.coarsening\"\n"
      "[work_precision]\nreference = \"case\"\n[work_precision.case]\nblank.coarsening = 2\n",
      file("s.toml"));
  const json found = answer("study s.toml --output out");
  EXPECT_EQ(found["done"], 3);
  EXPECT_EQ(found["failed"], 1);
  ASSERT_EQ(found["cases"].size(), 4U);
  const json& first = found["cases"][0];
  EXPECT_EQ(first["settings"]["blank.coarsening"], 4);
  EXPECT_TRUE(found["cases"][3]["measures"]["grips.top.force_N"].is_null()) << "it failed";
  EXPECT_EQ(found["cases"][3]["exit_code"], 2);
  const std::string folder = "out/cases/" + first["case"].get<std::string>();
  EXPECT_EQ(first["measures"]["grips.top.force_N"], file_json(folder + "/summary.json")["grips"]["top"]["force_N"]);
  ASSERT_EQ(found["convergence"]["measures"].size(), 1U);
  EXPECT_EQ(found["convergence"]["measures"][0]["levels"].size(), 3U);
  EXPECT_TRUE(found["convergence"]["measures"][0]["limit"].is_number());
  EXPECT_EQ(found["work_precision"]["measures"][0]["measure"], "grips.top.force_N");
  // people read words, scripts the names they asked for
  const std::string table = text("study s.toml --output out --collect");
  EXPECT_TRUE(says(table, "| force of top at the end (N) |")) << table;
  EXPECT_FALSE(says(table, "grips.top.force_N")) << table;
  EXPECT_TRUE(says(read_text(file("out/study.csv")), "grips.top.force_N"));
  const json workflow = answer("study s.toml --output snake --export snakemake");
  EXPECT_EQ(workflow["cases"], 4);
}

TEST_F(JsonAnswer, OfABorderHasBothSides) {
  write_text(
      "scene = \"tiny.toml\"\nmeasures = [\"grips.top.force_N\"]\n[set]\nmodel.yarn_law = \"linear\"\n"
      "analysis.duration = 0.05\nanalysis.step_check = false\n"
      "[border]\nkey = \"analysis.step_factor\"\nholds = 0.9\nfails = 1.6\ntolerance = 0.5\n",
      file("s.toml"));
  const json found = answer("study s.toml --output out");
  EXPECT_EQ(found["border"]["key"], "analysis.step_factor");
  ASSERT_EQ(found["border"]["groups"].size(), 1U);
  const json& group = found["border"]["groups"][0];
  EXPECT_LT(group["holds"].get<double>(), group["fails"].get<double>());
  EXPECT_TRUE(says(group["failure"].get<std::string>(), "exit code 3"));
}

TEST_F(JsonAnswer, OfReferencesListsEveryKeyOfTheText) {
  for (const std::string command : {"keys", "keys --card", "study --keys", "fit --keys", "post compare --keys"}) {
    const json keys = answer(command);
    ASSERT_TRUE(keys.is_array()) << command;
    EXPECT_GE(keys.size(), 10U) << command;
    const std::string printed = text(command);
    for (const json& key : keys) {
      const std::string path = key["key"];
      EXPECT_TRUE(says(printed, "| `" + path.substr(path.rfind('.') + 1) + "` |")) << command << ": " << path;
      for (const char* name : {"type", "unit", "default", "range", "description"})
        EXPECT_TRUE(key.contains(name)) << command << ": " << path << " lacks " << name;
    }
  }
  for (const json& key : answer("keys")) {
    if (key["key"] != "blank.size") continue;
    EXPECT_EQ(key["default"], json({115.0, 230.0})) << key;
    EXPECT_EQ(key["unit"], "mm");
  }
}

// A name in Latin-1 is no UTF-8: the document is valid all the same.
TEST_F(JsonAnswer, IsValidWhateverAFileIsCalled) {
  write_text("SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n", file("box.geo"));
  must("weaveform tool box.geo --output \"$(printf 'b\\366x.stl')\"");
  EXPECT_EQ(answer("tool \"$(printf 'b\\366x.stl')\"")["file"], "b\xEF\xBF\xBDx.stl");
}

TEST_F(JsonAnswer, ErrorsAreLinesAsEver) {
  const CommandResult plain = run("weaveform check tiny.toml --set blank.coarsning=2");
  const CommandResult asked = run("weaveform check tiny.toml --set blank.coarsning=2 --json");
  EXPECT_EQ(asked.exit_code, 2);
  EXPECT_EQ(asked.out, "");
  EXPECT_EQ(asked.err, plain.err);
  const CommandResult both = run("weaveform run tiny.toml --quiet --json");
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_TRUE(says(both, "--json")) << both.err;
}

// A command that is new is named here or has the option.
TEST_F(JsonAnswer, IsHadByEveryCommandThatPrintsOne) {
  // Pictures, pages and folders are their answers; help is for people; the bare `post` is a command too.
  const std::set<std::string> without = {"solve", "render", "chart", "help", "post report", "post virtual"};
  const std::string page = std::regex_replace(text("help --man"), std::regex(R"(\\-)"), "-");
  const std::regex heading("\n\\.SS ([a-z -]+)\n");
  std::size_t found = 0;
  for (std::sregex_iterator it(page.begin(), page.end(), heading), end; it != end; ++it) {
    const std::string command = (*it)[1].str();
    ++found;
    EXPECT_NE(says(text("help " + command), "--json"), without.contains(command)) << command;
  }
  EXPECT_GE(found, 18U) << "the search itself is broken";
  // and whoever prints an answer asks whether it is to be JSON
  for (const auto& entry : fs::directory_iterator(WEAVEFORM_SOURCE_DIR "/app/commands")) {
    const std::string source = read_text(entry.path());
    if (entry.path().filename() == "help.cpp" || !says(source, "print_answer(")) continue;
    EXPECT_TRUE(says(source, "add_json_argument(")) << entry.path();
  }
}

}  // namespace
