// Wrinkles of several coarsenings side by side, from summaries made up.
#include "app/study/wrinkle_report.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "post/output/summary.hpp"
#include "tests/support/temporary_folder.hpp"

namespace weaveform::study {
namespace {

using Json = nlohmann::ordered_json;

struct MadeUp {
  test::TemporaryFolder folder;
  Table table{{"blank.coarsening"}, {}, {}};

  // A case of coarsening k whose summary is `summary`.
  void add(const std::string& k, const Json& summary, int exit_code = 0) {
    Case one{"k" + k, "", {{"blank.coarsening", k, std::stod(k), {}}}};
    table.row.push_back({one, Outcome{exit_code, ""}, {}, 5.0 * std::stod(k), 1.0});
    const auto results = case_files(folder.path(), one.name).results;
    std::filesystem::create_directories(results);
    write_text_whole(results / weaveform::file_name::summary, summary.dump());
  }
};

Json wrinkles(const Json& of, double wavelength, double amplitude, double area, double compressed) {
  const auto known = [&](double value) { return of.is_null() ? Json() : Json(value); };
  return {{"wrinkles",
           {{"of", of},
            {"wavelength_mm", known(wavelength)},
            {"amplitude_mm", known(amplitude)},
            {"cells_per_wave", known(wavelength / 5.0)},
            {"area_share", area},
            {"compressed_fibre_share", compressed}}}};
}

TEST(StudyWrinkles, AgreeFromTheCoarsestThatAllFinerOnesConfirm) {
  MadeUp study;
  study.add("4", wrinkles("mesh", 40.0, 3.0, 0.30, 0.002));
  study.add("2", wrinkles("mesh", 31.0, 2.1, 0.21, 0.0015));
  study.add("1", wrinkles("fabric", 29.5, 2.05, 0.20, 0.0));
  study.add("0.5", wrinkles("fabric", 30.0, 2.0, 0.20, 0.0));
  const auto all = wrinkles_of(study.table, study.folder.path());
  ASSERT_EQ(all.size(), 1U);
  ASSERT_EQ(all[0].level.size(), 4U);
  EXPECT_EQ(all[0].level[0].size, 2.5) << "finest first";
  EXPECT_EQ(all[0].agrees_from, (std::array<std::size_t, wrinkle_measures>{2, 2, 2, 1}));
  EXPECT_EQ(all[0].all_agree_from(), 1U);
  const std::string text = wrinkles_markdown(all, study.table);
  EXPECT_NE(text.find("the wrinkles of blank.coarsening = 1 and finer agree within 10 % (wavelength from 2; amplitude "
                      "from 2; area from 2; compressed fibre from 1)"),
            std::string::npos)
      << text;
  const auto json = wrinkles_json(all, study.table);
  EXPECT_EQ(json[0]["agree"], true);
  EXPECT_EQ(json[0]["agree_from_case"], "k1");
  EXPECT_EQ(json[0]["levels"][3]["of"], "mesh");
  EXPECT_NE(wrinkles_csv(all, study.table).find(",k2,2,10,31,2.1,0.21,0.0015,6.2,mesh,0\n"), std::string::npos)
      << wrinkles_csv(all, study.table);
}

TEST(StudyWrinkles, ThatOneMeshHasAloneDoNotAgree) {
  MadeUp study;
  study.add("2", wrinkles(nullptr, 0.0, 0.0, 0.0, 0.2));
  study.add("1", wrinkles("fabric", 29.5, 2.05, 0.20, 0.0));
  const auto all = wrinkles_of(study.table, study.folder.path());
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].all_agree_from(), 0U);
  const std::string text = wrinkles_markdown(all, study.table);
  EXPECT_NE(text.find("do NOT agree within 10 % (wavelength not; "), std::string::npos) << text;
  EXPECT_NE(text.find("| 2 | 10 | - | - | 0 | 0.2 | - | - |"), std::string::npos) << text;
}

TEST(StudyWrinkles, AreNotSpokenOfWhereNothingWrinklesOrNothingIsRefined) {
  MadeUp smooth;
  smooth.add("2", wrinkles(nullptr, 0.0, 0.0, 0.0, 0.2));
  smooth.add("1", wrinkles(nullptr, 0.0, 0.0, 0.0, 0.1));
  EXPECT_TRUE(wrinkles_of(smooth.table, smooth.folder.path()).empty());
  MadeUp alone;
  alone.add("2", wrinkles("mesh", 31.0, 2.1, 0.21, 0.0));
  alone.add("1", wrinkles("fabric", 31.0, 2.1, 0.21, 0.0), 3);  // failed
  EXPECT_TRUE(wrinkles_of(alone.table, alone.folder.path()).empty());
}

TEST(StudyWrinkles, AreApartForEachPlyAndOlderResultsHaveNone) {
  MadeUp study;
  const Json own = wrinkles("fabric", 31.0, 2.1, 0.21, 0.0);
  for (const char* k : {"2", "1"}) study.add(k, {{"plies", {{"low", own}, {"high", own}}}});
  const auto all = wrinkles_of(study.table, study.folder.path());
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].ply, "low");
  EXPECT_EQ(all[1].all_agree_from(), 1U);
  MadeUp older;
  for (const char* k : {"2", "1"}) older.add(k, {{"cells", 3}});
  EXPECT_TRUE(wrinkles_of(older.table, older.folder.path()).empty());
  MadeUp damaged;
  damaged.add("2", "none");
  EXPECT_THROW((void)wrinkles_of(damaged.table, damaged.folder.path()), InputError);
}

}  // namespace
}  // namespace weaveform::study
