// From a table of cases to convergence, charts and tolerances, on cases whose order and limit are known.
#include <gtest/gtest.h>

#include <cmath>

#include "app/study/accuracy.hpp"
#include "app/study/convergence_report.hpp"
#include "app/study/work_precision.hpp"
#include "mesher/base/error.hpp"

namespace weaveform::study {
namespace {

// f = limit + h^order at sizes 1, 2, 4, 8, costing 1/h^3 s.
void add_levels(Table& table, const std::string& law, double limit, double order) {
  for (const double h : {8.0, 4.0, 2.0, 1.0}) {
    Case one{
        law + std::to_string(static_cast<int>(h)),
        "",
        {{"model.yarn_law", law, std::nullopt, {}}, {"blank.coarsening", std::to_string(static_cast<int>(h)), h, {}}}};
    table.row.push_back({one, Outcome{0, ""}, {limit + std::pow(h, order)}, h, std::pow(h, -3.0)});
  }
}

Table two_laws() {
  Table table{{"model.yarn_law", "blank.coarsening"}, {"force"}, {}};
  add_levels(table, "card", 100.0, 1.0);
  add_levels(table, "linear", 200.0, 2.0);
  return table;
}

const ConvergenceSpec by_coarsening{.key = "blank.coarsening", .measures = {}};

TEST(StudyConvergence, IsApartForEveryCombinationOfTheOtherKeys) {
  const auto all = convergence_of(by_coarsening, {"force"}, two_laws());
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].group, "model.yarn_law=card");
  EXPECT_NEAR(all[0].refinement->finest.limit, 100.0, 1e-9);
  EXPECT_NEAR(all[0].refinement->finest.order, 1.0, 1e-9);
  EXPECT_NEAR(all[1].refinement->finest.limit, 200.0, 1e-9);
  EXPECT_NEAR(all[1].refinement->finest.order, 2.0, 1e-9);
  EXPECT_NE(convergence_markdown(by_coarsening, all, two_laws()).find("cheapest within 2 %: blank.coarsening = 1"),
            std::string::npos);
}

TEST(StudyConvergence, LeavesFailedCasesOut) {
  Table table = two_laws();
  table.row[3].outcome = Outcome{3, "unstable"};
  table.row[3].value = {std::nan("")};
  EXPECT_EQ(convergence_of(by_coarsening, {"force"}, table)[0].level.size(), 3U);
  table.row[0].outcome.reset();
  EXPECT_FALSE(convergence_of(by_coarsening, {"force"}, table)[0].refinement.has_value());
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
  EXPECT_NE(svg.find(">model.yarn_law=linear blank.coarsening=1<"), std::string::npos) << "the front is named";
  EXPECT_EQ(svg.find(">model.yarn_law=linear blank.coarsening=8<"), std::string::npos) << "and nothing else";
}

TEST(WorkPrecision, AReferenceCaseHasNoErrorOfItsOwn) {
  Study study;
  study.file = "s.toml";
  study.work_precision = WorkPrecisionSpec{.measures = {}, .reference = "case"};
  study.reference_case = {{"model.yarn_law", "card", std::nullopt, {}}, {"blank.coarsening", "1", 1.0, {}}};
  const Table table = two_laws();
  std::vector<std::string> complaints;
  const auto all = work_precision_of(study, {"force"}, {}, table, complaints);
  ASSERT_EQ(all.at(0).point.size(), 7U);
  EXPECT_NEAR(all[0].point[0].error, 7.0 / 101.0, 1e-12);
  study.reference_case.pop_back();
  EXPECT_THROW((void)work_precision_of(study, {"force"}, {}, table, complaints), InputError) << "picks four cases";
}

TEST(WorkPrecision, WithoutALimitSaysSo) {
  Study study;
  study.work_precision.emplace();
  Table table = two_laws();
  table.row[2].value = {90.0};
  std::vector<std::string> complaints;
  (void)work_precision_of(study, {"force"}, convergence_of(by_coarsening, {"force"}, table), table, complaints);
  ASSERT_EQ(complaints.size(), 1U);
  EXPECT_NE(complaints[0].find("do not agree"), std::string::npos) << complaints[0];
}

TEST(WorkPrecision, ChartNamesAreFileNames) {
  EXPECT_EQ(chart_name("max(a/b c)"), "work_precision_max_a_b_c_.svg");
}

TEST(StudyTable, FieldsSurviveCommasAndQuotes) {
  EXPECT_EQ(csv_field("a, \"b\""), "\"a, \"\"b\"\"\"");
  Table table = two_laws();
  table.row[0].one.settings[1].value = "[4, 2]";
  table.row[0].outcome = Outcome{3, "lost, at 1 s"};
  table.row[0].value = {std::nan("")};
  const std::string csv = to_csv(table, 1);
  EXPECT_NE(csv.find("card8,card,\"[4, 2]\",3,\"lost, at 1 s\",\n"), std::string::npos) << csv;
}

TEST(Accuracy, IsPercentOrAFraction) {
  EXPECT_DOUBLE_EQ(parse_accuracy("2%"), 0.02);
  EXPECT_DOUBLE_EQ(parse_accuracy("0.5 %"), 0.005);
  EXPECT_DOUBLE_EQ(parse_accuracy("0.02"), 0.02);
  for (const char* wrong : {"2", "0%", "-1%", "100%", "fine", "2%%", "", "nan"})
    EXPECT_THROW((void)parse_accuracy(wrong), InputError) << wrong;
}

}  // namespace
}  // namespace weaveform::study
