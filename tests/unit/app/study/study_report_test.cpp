// From a table of cases to convergence, tables and tolerances, on cases whose order and limit are known.
#include <gtest/gtest.h>

#include <cmath>

#include "app/study/accuracy.hpp"
#include "app/study/convergence_report.hpp"
#include "app/study/work_precision_report.hpp"
#include "core/error.hpp"
#include "tests/unit/app/study/two_laws.hpp"

namespace weaveform::study {
namespace {

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

TEST(StudyTable, FieldsSurviveCommasAndQuotes) {
  EXPECT_EQ(csv_field("a, \"b\""), "\"a, \"\"b\"\"\"");
  Table table = two_laws();
  table.row[0].one.settings[1].value = "[4, 2]";
  table.row[0].outcome = Outcome{3, "lost, at 1 s"};
  table.row[0].value = {std::nan("")};
  const std::string csv = to_csv(table, 1);
  EXPECT_NE(csv.find("card8,card,\"[4, 2]\",3,\"lost, at 1 s\",\n"), std::string::npos) << csv;
}

TEST(StudyTable, CasesAreNamedByWhatVaries) {
  Table table = two_laws();
  EXPECT_EQ(short_description(table.row[1].one, table), "yarn law card, coarsening 4");
  table.row.resize(4);  // of one law
  EXPECT_EQ(short_description(table.row[1].one, table), "coarsening 4");
  table.row.resize(1);
  EXPECT_EQ(short_description(table.row[0].one, table), "the scene as it is");
  table = two_laws();
  table.keys.emplace_back("other.coarsening");
  EXPECT_EQ(short_description(table.row[1].one, table), "yarn law card, blank.coarsening 4") << "two keys end alike";
}

TEST(StudyTable, HasASeriesColumnWhenThereIsOne) {
  Table table = two_laws();
  EXPECT_EQ(to_csv(table, 1).substr(0, 20), "case,model.yarn_law,");
  table.row[1].one.series = "mesh";
  const std::string csv = to_csv(table, 1);
  EXPECT_EQ(csv.substr(0, 12), "case,series,");
  EXPECT_NE(csv.find("\ncard4,mesh,card,4,0,"), std::string::npos) << csv;
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
