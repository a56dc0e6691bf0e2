#include "post/output/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/post/measure/ideal_bias.hpp"

namespace weaveform {
namespace {

// History of an ideal bias extension pulled at both ends, `upper` by 2/3 of the travel.
History ideal_history(double travel, int rows) {
  History history;
  history.column = {"time_s",
                    "lower.displacement_mm",
                    "lower.force_N",
                    "upper.displacement_mm",
                    "upper.force_N",
                    "centre.shear_angle_deg",
                    "centre.shear_angle_sd_deg",
                    "centre.shear_angle_min_deg",
                    "centre.shear_angle_max_deg"};
  for (int r = 0; r <= rows; ++r) {
    const double part = static_cast<double>(r) / rows;
    const double spike = r == rows / 2 ? -50.0 : 0.0;
    history.row.push_back({part, part * travel / 3.0, 10.0 * part + spike, part * travel * 2.0 / 3.0, 9.0 * part,
                           30.0 * part, 0.5, 29.0, 31.0});
  }
  return history;
}

struct IdealRun {
  Scene scene = test::bias_scene(115.0, 230.0);
  Mesh mesh = test::bias_lattice(115.0, 230.0, 4.92);
  Card card = test::small_card();
  double travel = 30.0;  // mm
  History history = ideal_history(travel, 200);
  IdealRun() { scene.measure = {{"centre", {}, {}}}; }

  [[nodiscard]] Summary summary(double sign) const {
    const BiasSpecimen specimen = *find_bias_extension(scene);
    const double angle = kinematic_shear_angle(specimen, travel);
    Fields end = compute_fields(mesh, card, {}, 1.0, test::ideal_positions(mesh, specimen, angle));
    for (double& g : end.shear_angle) g *= sign;
    Summary result;
    result.statistics.folded_cells = 3;
    result.statistics.energy_error = 0.00123;
    result.grip = summarise_grips(scene, history);
    result.measure = summarise_measures(scene, history);
    result.bias = compare_bias_extension(specimen, scene, {{scene, card, mesh, end}}, history);
    return result;
  }
};

TEST(Summary, IdealRunAgreesWithTheIdealWithTheSignOfTheSimulation) {
  const IdealRun run;
  for (const double sign : {1.0, -1.0}) {
    const BiasComparison bias = *run.summary(sign).bias;
    for (std::size_t z = 0; z < 3; ++z) EXPECT_NEAR(bias.zones[0].simulated[z].mean, bias.zones[0].ideal[z], 1e-12);
    EXPECT_EQ(bias.zones[0].ideal[0] > 0.0, sign > 0.0);
    EXPECT_GT(bias.row.back().ideal_load, 0.0);
  }
}

TEST(Summary, StackOfSpecimensAddsUpTheIdealLoadsAndHasZonesOfEachPly) {
  const IdealRun run;
  Summary alone = run.summary(1.0), stack = run.summary(1.0);
  const BiasSpecimen specimen = *find_bias_extension(run.scene);
  Fields end = compute_fields(run.mesh, run.card, {}, 1.0,
                              test::ideal_positions(run.mesh, specimen, kinematic_shear_angle(specimen, run.travel)));
  Fields turned = end;
  for (double& g : turned.shear_angle) g = -g;
  stack.bias = compare_bias_extension(specimen, run.scene,
                                      {{run.scene, run.card, run.mesh, end}, {run.scene, run.card, run.mesh, turned}},
                                      run.history);
  stack.ply.resize(2);
  stack.ply[0].name = "lower";
  stack.ply[1].name = "upper";
  EXPECT_DOUBLE_EQ(stack.bias->row.back().ideal_load, 2.0 * alone.bias->row.back().ideal_load);
  EXPECT_EQ(stack.bias->row.back().ideal_angle, alone.bias->row.back().ideal_angle);
  const nlohmann::ordered_json json = summary_json(stack), single = summary_json(alone);
  EXPECT_FALSE(json.contains("zones"));
  EXPECT_EQ(json["plies"]["lower"]["zones"], single["zones"]);
  EXPECT_EQ(json["plies"]["upper"]["zones"]["A"]["ideal_deg"].get<double>(),
            -single["zones"]["A"]["ideal_deg"].get<double>());
  EXPECT_NE(summary_table(stack).find("upper"), std::string::npos);
}

TEST(Summary, RowsOverTheTravelRiseToTheEnd) {
  const BiasComparison bias = *IdealRun().summary(1.0).bias;
  ASSERT_EQ(bias.row.size(), 6U);
  for (std::size_t r = 0; r < bias.row.size(); ++r)
    EXPECT_NEAR(bias.row[r].travel, 5.0 * static_cast<double>(r + 1), 30.0 / 200.0);  // nearest history row
  EXPECT_DOUBLE_EQ(bias.row.back().travel, 30.0);
  EXPECT_DOUBLE_EQ(bias.row.back().load[1], 9.0);
  EXPECT_NEAR(bias.row.back().measured_angle.at(0), 30.0 * degree, 1e-14);
}

TEST(Summary, GripMovingInwardsCountsAgainstTheTravelAndItsForceTurns) {
  IdealRun run;
  run.scene.grip[0].direction = {0.0, 1.0, 0.0};
  const BiasComparison bias = *run.summary(1.0).bias;
  EXPECT_NEAR(bias.row.back().travel, 10.0, 1e-12);  // 20 mm out at the top, 10 mm after it at the bottom
  EXPECT_DOUBLE_EQ(bias.row.back().load[0], -10.0);
}

TEST(Summary, LargestForceKeepsItsSign) {
  const std::vector<GripSummary> grips = summarise_grips(IdealRun().scene, ideal_history(30.0, 200));
  EXPECT_DOUBLE_EQ(grips[0].largest_force, -45.0);
  EXPECT_DOUBLE_EQ(grips[0].force, 10.0);
  EXPECT_DOUBLE_EQ(grips[1].largest_force, 9.0);
  EXPECT_DOUBLE_EQ(grips[1].displacement, 20.0);
}

TEST(Summary, EmptyHistoryIsAnInputError) {
  EXPECT_THROW((void)summarise_grips(IdealRun().scene, {ideal_history(1.0, 2).column, {}}), InputError);
  EXPECT_THROW((void)summarise_measures(IdealRun().scene, {}), InputError);
}

TEST(Summary, FileHasThePromisedNames) {
  const test::TemporaryFolder folder;
  write_summary(IdealRun().summary(1.0), folder.path() / "summary.json");
  std::ifstream stream(folder.path() / "summary.json");
  const nlohmann::json json = nlohmann::json::parse(stream);
  for (const char* name : {"cells", "steps", "wall_s", "cell_steps_per_s", "max_shear_angle_deg", "energy_error",
                           "kinetic_to_internal", "measures", "grips", "zones", "ideal", "folded_cells"})
    EXPECT_TRUE(json.contains(name)) << name;
  EXPECT_EQ(json["measures"]["centre"]["shear_angle_deg"], 30.0);
  EXPECT_EQ(json["measures"]["centre"]["sd"], 0.5);
  EXPECT_EQ(json["measures"]["centre"]["min"], 29.0);
  EXPECT_EQ(json["measures"]["centre"]["max"], 31.0);
  EXPECT_EQ(json["grips"]["upper"]["force_N"], 9.0);
  EXPECT_NEAR(json["zones"]["A"]["shear_angle_deg"].get<double>(), json["ideal"]["shear_angle_deg"].get<double>(),
              1e-9);
}

TEST(Summary, SceneThatIsNoBiasExtensionHasTableAndFileWithoutIt) {
  const test::TemporaryFolder folder;
  Summary summary;
  summary.statistics.max_shear_angle_deg = 12.5;
  write_summary(summary, folder.path() / "summary.json");
  std::ifstream stream(folder.path() / "summary.json");
  const nlohmann::json json = nlohmann::json::parse(stream);
  EXPECT_FALSE(json.contains("zones"));
  EXPECT_TRUE(json["measures"].is_object());
  const std::string table = summary_table(summary);
  EXPECT_NE(table.find("12.50 deg"), std::string::npos);
  EXPECT_EQ(table.find("bias"), std::string::npos);
}

TEST(Summary, TableTellsWhatSpeaksAgainstTheRun) {
  const std::string table = summary_table(IdealRun().summary(1.0));
  EXPECT_NE(table.find("energy error 0.123 %"), std::string::npos) << table;
  EXPECT_NE(table.find("3 at worst"), std::string::npos);
  EXPECT_NE(table.find("differ by 1 N (10 % of the larger)"), std::string::npos);
}

TEST(Summary, TableMarksAnIdealPastNinetyDegreesAsNone) {
  IdealRun run;
  run.history = ideal_history(60.0, 50);  // (sqrt 2 - 1) 115 mm = 47.6 mm is the end of Eq. 14
  const std::string table = summary_table(run.summary(1.0));
  EXPECT_NE(table.find("  -"), std::string::npos);
  EXPECT_EQ(table.find("nan"), std::string::npos) << table;
}

}  // namespace
}  // namespace weaveform
