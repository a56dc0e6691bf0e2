// Time against error, on cases whose order and limit are known: what errors are relative to, the front, the choice.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/study/work_precision_report.hpp"
#include "core/error.hpp"
#include "tests/unit/app/study/two_laws.hpp"

namespace weaveform::study {
namespace {

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// The study's points of the measure "force", the complaints left out.
WorkPrecision points(const Study& study, const Table& table) {
  std::vector<std::string> complaints;
  return work_precision_of(study, {"force"}, convergence_of(by_coarsening, {"force"}, table), table, complaints).at(0);
}

TEST(WorkPrecision, ErrorsAreRelativeToTheLimitOfTheirGroup) {
  Study study;
  study.convergence = by_coarsening;
  study.work_precision.emplace();
  const Table table = two_laws();
  std::vector<std::string> complaints;
  const auto all =
      work_precision_of(study, {"force"}, convergence_of(by_coarsening, {"force"}, table), table, complaints);
  ASSERT_EQ(all.size(), 1U);
  ASSERT_EQ(all[0].point.size(), 8U);
  for (const WorkPoint& point : all[0].point) {
    const double h = table.row[point.row].size;
    const bool linear = point.row >= 4;
    EXPECT_NEAR(point.error, linear ? h * h / 200.0 : h / 100.0, 1e-9);
    // At one cost the lesser error leads: h^2/200 < h/100 for h < 2, equal at 2 (where the order of rows decides).
    if (h != 2.0) {
      EXPECT_EQ(point.on_front, linear == (h < 2.0));
    }
  }
  EXPECT_TRUE(complaints.empty());
  const std::string svg = to_svg(work_precision_chart(all[0], table));
  EXPECT_NE(svg.find(">Pareto front<"), std::string::npos);
  EXPECT_NE(svg.find(">yarn law linear, coarsening 1<"), std::string::npos) << "the front is named";
  EXPECT_EQ(svg.find(">yarn law linear, coarsening 8<"), std::string::npos) << "and nothing else";
}

TEST(WorkPrecision, AReferenceCaseHasNoErrorOfItsOwn) {
  Study study;
  study.file = "s.toml";
  study.work_precision = WorkPrecisionSpec{.measures = {}, .reference = ErrorReference::one_case};
  Settings& pick = study.reference.reference_case.settings;
  pick = {{"model.yarn_law", "card", std::nullopt, {}}, {"blank.coarsening", "1", 1.0, {}}};
  const Table table = two_laws();
  std::vector<std::string> complaints;
  const auto all = work_precision_of(study, {"force"}, {}, table, complaints);
  ASSERT_EQ(all.at(0).point.size(), 7U);
  EXPECT_NEAR(all[0].point[0].error, 7.0 / 101.0, 1e-12);
  pick.pop_back();
  EXPECT_THROW((void)work_precision_of(study, {"force"}, {}, table, complaints), InputError) << "picks four cases";
}

TEST(WorkPrecision, WithoutALimitSaysSo) {
  Study study;
  study.convergence = by_coarsening;
  study.work_precision.emplace();
  Table table = two_laws();
  table.row[2].value = {90.0};
  std::vector<std::string> complaints;
  const auto all =
      work_precision_of(study, {"force"}, convergence_of(by_coarsening, {"force"}, table), table, complaints);
  ASSERT_EQ(complaints.size(), 1U);
  EXPECT_NE(complaints[0].find("do not agree"), std::string::npos) << complaints[0];
  EXPECT_GT(all.at(0).point.at(3).floor, 0.05) << "what stands for it is as uncertain as it is";
}

TEST(WorkPrecision, CasesAloneAreToldOf) {
  Study study;
  study.convergence = by_coarsening;
  study.work_precision.emplace();
  Table table = two_laws();
  table.row.resize(5);  // one law at one coarsening: refined by nothing
  std::vector<std::string> complaints;
  const auto convergence = convergence_of(by_coarsening, {"force"}, table);
  EXPECT_EQ(convergence.size(), 1U);
  EXPECT_EQ(work_precision_of(study, {"force"}, convergence, table, complaints).at(0).point.size(), 4U);
  ASSERT_EQ(complaints.size(), 1U);
  EXPECT_TRUE(says(complaints[0], "1 cases are in no refinement series")) << complaints[0];
}

TEST(WorkPrecision, ChartNamesAreFileNames) {
  EXPECT_EQ(chart_name("max(a/b c)"), "work_precision_max_a_b_c_.svg");
}

Study with_reference(ErrorReference kind) {
  Study study;
  study.file = "s.toml";
  study.convergence = by_coarsening;
  study.work_precision = WorkPrecisionSpec{.measures = {}, .reference = kind};
  return study;
}

// One law judged by the limit of the other: what a setting costs against the exact, not what its own limit hides.
TEST(WorkPrecision, OneGroupsLimitMayCountForAllCases) {
  Study study = with_reference(ErrorReference::limit);
  study.reference.limit_of = Variant{{{"model.yarn_law", "card", std::nullopt, {}}}};
  const Table table = two_laws();
  const WorkPrecision one = points(study, table);
  ASSERT_EQ(one.point.size(), 8U);
  EXPECT_NEAR(one.point[0].error, 0.08, 1e-9);
  EXPECT_NEAR(one.point[7].error, 1.01, 1e-9) << "201 against 100";
  for (const WorkPoint& point : one.point) EXPECT_NEAR(point.floor, one.point[0].floor, 1e-15);
  EXPECT_GT(one.point[0].floor, 0.0);
}

TEST(WorkPrecision, TheGroupWhoseLimitCountsMustBeOne) {
  Study study = with_reference(ErrorReference::limit);
  study.reference.limit_of = Variant{};
  EXPECT_THROW((void)points(study, two_laws()), InputError) << "two groups have a limit";
  Table table = two_laws();
  table.row.resize(6);  // the second group has two levels: single cases beside the refinement series
  EXPECT_EQ(points(study, table).point.size(), 6U) << "the only group with three levels needs no picking";
  study.reference.limit_of = Variant{{{"model.yarn_law", "other", std::nullopt, {}}}};
  EXPECT_THROW((void)points(study, table), InputError);
}

TEST(WorkPrecision, ValuesAreNumbersOrOtherMeasuresOfTheCase) {
  Study study = with_reference(ErrorReference::value);
  Table table = two_laws();
  table.measures = {"force", "ideal"};
  for (Row& row : table.row) row.value.push_back(row.value[0] - 3.0);
  study.reference.value = {{"force", std::nullopt, "ideal", {}}};
  WorkPrecision one = points(study, table);
  EXPECT_NEAR(one.point.at(0).error, 3.0 / 105.0, 1e-12);
  EXPECT_EQ(one.point[0].floor, 0.0);
  study.reference.value = {{"force", 100.0, "", {}}};
  study.reference.uncertainty = {{"force", 2.0, "", {}}};
  one = points(study, table);
  EXPECT_NEAR(one.point[2].error, 0.02, 1e-12);
  EXPECT_NEAR(one.point[2].floor, 0.02, 1e-12);
}

TEST(WorkPrecision, AbsoluteErrorsAreInTheMeasuresUnit) {
  Study study = with_reference(ErrorReference::value);
  study.work_precision->absolute = {"force"};
  study.reference.value = {{"force", 100.0, "", {}}};
  const WorkPrecision one = points(study, two_laws());
  EXPECT_NEAR(one.point.at(0).error, 8.0, 1e-12);
  EXPECT_EQ(unit_of("max(top.shear_angle_deg)"), "deg");
  EXPECT_EQ(unit_of("grips.top.force_N"), "N");
  EXPECT_EQ(unit_of("energy_error"), "%") << "a pure number";
  WorkPrecision angle = one;
  angle.unit = "deg";
  EXPECT_EQ(work_precision_chart(angle, two_laws()).y.title, "error (deg)");
  EXPECT_TRUE(says(work_precision_markdown(*study.work_precision, {angle}, two_laws()),
                   "cheapest within | 2 deg | 1 deg | 0.5 deg |"));
}

TEST(WorkPrecision, PeopleReadWordsAndScriptsNames) {
  Study study = with_reference(ErrorReference::value);
  study.reference.value = {{"force", 100.0, "", {}}};
  const Table table = two_laws();
  WorkPrecision one = points(study, table);
  const auto json = work_precision_json(*study.work_precision, {one}, table);
  ASSERT_EQ(json["measures"][0]["points"].size(), one.point.size());
  for (std::size_t i = 0; i < one.point.size(); ++i) {
    EXPECT_EQ(json["measures"][0]["points"][i]["error"].get<double>(), one.point[i].error);
    EXPECT_EQ(json["measures"][0]["points"][i]["pareto_front"].get<bool>(), one.point[i].on_front);
  }
  EXPECT_EQ(json["measures"][0]["cheapest_within"].size(), 3U) << "one for each tolerance";
  one.measure = "tools.punch.force_N";
  EXPECT_EQ(work_precision_chart(one, table).title, "force of punch at the end (N)");
  EXPECT_TRUE(says(work_precision_markdown(*study.work_precision, {one}, table), "\nforce of punch at the end (N)\n"));
  EXPECT_EQ(chart_name(one.measure), "work_precision_tools.punch.force_N.svg") << "files keep the name";
}

// A measure that is itself an error has 0 for its reference.
TEST(WorkPrecision, PureNumbersMayBeErrorsThemselves) {
  Study study = with_reference(ErrorReference::value);
  study.work_precision->absolute = {"force"};
  study.reference.value = {{"force", 0.0, "", {}}};
  Table table = two_laws();
  table.row.resize(4);
  for (std::size_t i = 0; i < 4; ++i) table.row[i].value = {0.04 / (1.0 + static_cast<double>(i))};
  const WorkPrecision one = points(study, table);
  EXPECT_NEAR(one.point.at(0).error, 0.04, 1e-15);
  EXPECT_TRUE(says(work_precision_markdown(*study.work_precision, {one}, table),
                   "| all | coarsening 8: 0.00195 s | coarsening 4: 0.0156 s | coarsening 1: 1 s |"));
}

// Costs rise from row 0 to 3; row 1 is nearest to the reference by luck, within what is known of it.
TEST(WorkPrecision, LuckWithinTheUncertaintyDoesNotWin) {
  Study study = with_reference(ErrorReference::value);
  study.reference.value = {{"force", 100.0, "", {}}};
  study.reference.uncertainty = {{"force", 2.5, "", {}}};
  Table table = two_laws();
  table.row.resize(4);
  const std::vector<double> results = {102.0, 100.0, 101.0, 103.0};
  for (std::size_t i = 0; i < 4; ++i) table.row[i].value = {results[i]};
  const WorkPrecision one = points(study, table);
  EXPECT_TRUE(one.point[0].on_front) << "the cheapest of those that cannot be told apart";
  for (std::size_t i = 1; i < 4; ++i) EXPECT_FALSE(one.point[i].on_front) << i;
  EXPECT_TRUE(one.point[1].within_uncertainty());
  EXPECT_FALSE(one.point[3].within_uncertainty());
  EXPECT_TRUE(says(work_precision_markdown(*study.work_precision, {one}, table), "within the uncertainty, 2.5 %"));
  EXPECT_TRUE(says(work_precision_csv({one}, table), ",100,0,1,0.025,1,0\n"));
}

// A choice is within a tolerance only with the uncertainty counted: error 2 % and 2.5 % of uncertainty may be 4.5 %.
TEST(WorkPrecision, TheChoiceIsTheCheapestThatIsSurelyWithin) {
  Study study = with_reference(ErrorReference::value);
  study.reference.value = {{"force", 100.0, "", {}}};
  study.reference.uncertainty = {{"force", 0.5, "", {}}};
  Table table = two_laws();
  table.row.resize(4);  // 108, 104, 102, 101 at 1/512, 1/64, 1/8, 1 s
  table.row[2].one.series = table.row[3].one.series = "fine";
  const WorkPrecision one = points(study, table);
  EXPECT_EQ(cheapest_within({&one, 1}, table, "", {0.05})->row, 1U);
  EXPECT_EQ(cheapest_within({&one, 1}, table, "", {0.04})->row, 2U) << "4 % and 0.5 % are not within 4 %";
  EXPECT_EQ(cheapest_within({&one, 1}, table, "fine", {0.05})->row, 2U);
  EXPECT_EQ(cheapest_within({&one, 1}, table, "", {0.01}), nullptr);
  const std::string text = work_precision_markdown(*study.work_precision, {one}, table);
  EXPECT_TRUE(says(text, "| all | coarsening 4: 0.0156 s | coarsening 1: 1 s | none |")) << text;
  EXPECT_TRUE(says(text, "| fine | coarsening 2: 0.125 s | coarsening 1: 1 s | none |")) << text;
}

// The cheapest is right in the force by chance: its angle tells.
TEST(WorkPrecision, AChoiceForAllMeasuresIsWithinInEach) {
  Study study = with_reference(ErrorReference::value);
  study.work_precision->absolute = {"angle_deg"};
  study.reference.value = {{"force", 100.0, "", {}}, {"angle_deg", 30.0, "", {}}};
  Table table = two_laws();
  table.measures = {"force", "angle_deg"};
  table.row.resize(4);
  const std::vector<std::vector<double>> results = {{100.0, 35.0}, {104.0, 31.5}, {101.0, 29.5}, {100.5, 30.1}};
  for (std::size_t i = 0; i < 4; ++i) table.row[i].value = results[i];
  std::vector<std::string> complaints;
  const auto all = work_precision_of(study, {"force", "angle_deg"}, {}, table, complaints);
  const std::string text = work_precision_markdown(*study.work_precision, all, table);
  EXPECT_TRUE(says(text, "| all | coarsening 8: 0.00195 s | coarsening 8: 0.00195 s | coarsening 8: 0.00195 s |"));
  EXPECT_TRUE(says(text,
                   "\nAll of these measures at once\n\n| cheapest within | 5 %, 2 deg | 2 %, 1 deg | 1 %, 0.5 deg |\n"
                   "|---|---|---|---|\n"
                   "| all | coarsening 4: 0.0156 s | coarsening 2: 0.125 s | coarsening 2: 0.125 s |\n"))
      << text;
}

TEST(WorkPrecision, SeriesHaveAColourEach) {
  Study study = with_reference(ErrorReference::value);
  study.reference.value = {{"force", 100.0, "", {}}};
  Table table = two_laws();
  EXPECT_EQ(work_precision_chart(points(study, table), table).series.size(), 2U) << "the front, and the cases";
  for (std::size_t i = 0; i < 8; ++i) table.row[i].one.series = i < 4 ? "card" : "linear";
  const Chart chart = work_precision_chart(points(study, table), table);
  ASSERT_EQ(chart.series.size(), 3U);
  EXPECT_EQ(chart.series[1].label, "card");
  EXPECT_EQ(chart.series[2].label, "linear");
  EXPECT_EQ(chart.series[2].x.size(), 4U);
}

// A study over the step: the local error of central differences is of order 2 in the step factor.
TEST(WorkPrecision, AnyNumericKeyMayRefine) {
  Table table{{"analysis.step_factor"}, {"force"}, {}};
  for (const double factor : {0.8, 0.4, 0.2, 0.1}) {
    const Case one{std::to_string(factor), "", {{"analysis.step_factor", std::to_string(factor), factor, {}}}};
    table.row.push_back({one, Outcome{0, ""}, {50.0 + factor * factor}, 1.0, 1.0 / factor});
  }
  Study study;
  study.convergence = ConvergenceSpec{.key = "analysis.step_factor", .measures = {}};
  study.work_precision.emplace();
  std::vector<std::string> complaints;
  const auto convergence = convergence_of(*study.convergence, {"force"}, table);
  EXPECT_NEAR(convergence.at(0).refinement->finest.order, 2.0, 1e-6);
  const auto all = work_precision_of(study, {"force"}, convergence, table, complaints);
  EXPECT_NEAR(all.at(0).point.at(3).error, 0.01 / 50.0, 1e-9);
}

}  // namespace
}  // namespace weaveform::study
