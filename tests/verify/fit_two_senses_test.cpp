// Bending from synthetic tests of a fabric that bends otherwise with its face outwards than with its back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/bending_readings.hpp"

namespace weaveform {
namespace {

using test::bending_truth;
using test::covered;
using test::Points;
using test::table;
using test::table_fit;

// Four tables bent with each side outwards, the back's moments `ratio` times the face's; specimens 3 % apart.
std::string both_sides(const test::FitFolder& folder, double ratio, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::string text = test::head_of_fit;
  for (const bool of_face : {true, false}) {
    const std::string side = of_face ? "face" : "back";
    std::string files;
    for (int k = 0; k < 4; ++k) {
      const std::string name = fmt::format("{}{}.csv", side, k);
      const Points points = table((of_face ? 1.0 : ratio) * (1.0 + 0.03 * normal(random)), 0.001, random);
      folder.write_curve(name, points.x, points.y);
      files += fmt::format("{}'{}'", k == 0 ? "" : ", ", name);
    }
    text += fmt::format(
        "[[moment_curvature]]\nname = '{}'\nsense = '{}'\nfiles = [{}]\ncurvature_column = 'x'\ncurvature_unit = "
        "'1/mm'\nmoment_column = 'y'\nmoment_unit = 'N'\n",
        side, side, files);
  }
  return text;
}

TEST(FitTwoSenses, SensesThatDifferAreTwoLawsWithinTheirBands) {
  const test::FitFolder folder;
  constexpr int seeds = 10;
  constexpr double ratio = 0.7;
  double mean = 0.0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const auto found = folder.identify(both_sides(folder, ratio, seed));
    ASSERT_EQ(found.bends.size(), 2U) << seed;
    EXPECT_EQ(found.bends[0].name(), "moment_curvature_face");
    EXPECT_EQ(found.bends[1].name(), "moment_curvature_back");
    mean += 0.5 * (covered(found.bends[0]) + covered(found.bends[1], 1.0, ratio)) / seeds;
    for (const auto& yarn : found.card.yarn) {
      const double at = 0.02, m = yarn.interval * bending_truth.moment(at);
      EXPECT_NEAR(yarn.bending_out_of_plane.moment(at), m, 0.1 * m);
      EXPECT_NEAR(yarn.bending_out_of_plane.moment(-at), -ratio * m, 0.1 * m);
    }
    EXPECT_TRUE(found.makes_bending(0) && found.makes_bending(1));
    EXPECT_NE(identify::summary_markdown(found).find("bending along the warp, back outwards"), std::string::npos);
  }
  RecordProperty("covered", std::to_string(mean));
  EXPECT_GT(mean, 0.95 - 0.12);
}

// Where they do not differ there is one law, of all eight: a false alarm is rarer than one in twenty.
TEST(FitTwoSenses, SensesThatAreAlikeAreOneLaw) {
  const test::FitFolder folder;
  constexpr int seeds = 20;
  int two = 0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const auto found = folder.identify(both_sides(folder, 1.0, seed));
    two += found.bends.size() == 2 ? 1 : 0;
    if (found.bends.size() != 1) continue;
    EXPECT_EQ(found.bends[0].specimens.size(), 8U);
    EXPECT_NE(found.bends[0].senses.find("within their bands"), std::string::npos) << found.bends[0].senses;
    EXPECT_TRUE(found.card.yarn[0].bending_out_of_plane.is_odd());
  }
  RecordProperty("two", std::to_string(two));
  EXPECT_LE(two, 1);
}

// One record of both senses, its zero off: positive curvatures have the side outwards that `sense` names.
TEST(FitTwoSenses, ARecordOfBothWaysGivesBothLawsAndItsZeroIsTakenOut) {
  const test::FitFolder folder;
  std::mt19937 random(5);
  const auto noise = test::correlated_noise(random, 301, 0.0);
  std::vector<double> x, y;
  for (int i = -150; i <= 150; ++i) {
    x.push_back((i > 0 ? 0.03 : 0.024) * i / 150);  // not as far one way as the other
    y.push_back(bending_truth.moment(x.back()) * (i > 0 ? 1.2 : 0.8) + 0.002 + 0.0003 * noise[i + 150]);
  }
  folder.write_curve("a.csv", x, y);
  for (const bool face_first : {true, false}) {
    const auto found = folder.identify(table_fit("'a.csv'", face_first ? "sense = 'face'\n" : "sense = 'back'\n"));
    ASSERT_EQ(found.bends.size(), 2U);
    const auto& law = found.card.yarn[0].bending_out_of_plane;
    const double interval = found.card.yarn[0].interval, end = interval * bending_truth.moment(0.03);
    for (const double at : {0.002, 0.005, 0.01, 0.02}) {
      EXPECT_NEAR(law.moment(at), interval * bending_truth.moment(at) * (face_first ? 1.2 : 0.8), 0.02 * end) << at;
      EXPECT_NEAR(law.moment(-at), -interval * bending_truth.moment(at) * (face_first ? 0.8 : 1.2), 0.02 * end) << at;
    }
  }
  // nobody says which is which: the odd part, as ever
  const auto odd = folder.identify(table_fit("'a.csv'"));
  ASSERT_EQ(odd.bends.size(), 1U);
  const auto& notes = odd.bends[0].specimens[0].notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const auto& note) {
    return note.find("sense = \"face\" or \"back\"") != std::string::npos;
  }));
}

TEST(FitTwoSenses, ALoopOfBothWaysGivesBothLawsBesideItsFriction) {
  const test::FitFolder folder;
  constexpr double friction = 0.01, rise = 0.0015;
  std::vector<double> x, y;
  for (int i = 0; i <= 50; ++i) x.push_back(0.025 * i / 50);
  for (int i = 1; i <= 100; ++i) x.push_back(0.025 - 0.05 * i / 100);
  for (int i = 1; i <= 100; ++i) x.push_back(-0.025 + 0.05 * i / 100);
  const auto share = identify::friction_share(x, rise, 0.0);
  std::mt19937 random(3);
  const auto noise = test::correlated_noise(random, x.size(), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i)
    y.push_back(bending_truth.moment(x[i]) * (x[i] > 0.0 ? 1.3 : 0.7) + friction * share[i] + 0.0005 * noise[i]);
  folder.write_curve("a.csv", x, y);
  const auto found = folder.identify(table_fit("'a.csv'", "sense = 'face'\n"));
  ASSERT_EQ(found.bends.size(), 2U);
  const YarnCard& yarn = found.card.yarn[0];
  EXPECT_NEAR(yarn.bending_friction.moment, yarn.interval * friction, 0.05 * yarn.interval * friction);
  EXPECT_NEAR(yarn.bending_friction.rise, rise, 0.15 * rise);
  for (const double at : {0.005, 0.01, 0.02}) {
    const double m = yarn.interval * bending_truth.moment(at);
    EXPECT_NEAR(yarn.bending_out_of_plane.moment(at), 1.3 * m, 0.03 * m) << at;
    EXPECT_NEAR(yarn.bending_out_of_plane.moment(-at), -0.7 * m, 0.03 * m) << at;
  }
}

// One table a side of so few readings that nothing is known of their errors: no difference is one.
TEST(FitTwoSenses, ReadingsWithoutABandTellNothingApart) {
  const test::FitFolder folder;
  std::string text = test::head_of_fit;
  for (const std::string side : {"face", "back"}) {
    Points points;
    for (int i = 0; i < 9; ++i) {
      points.x.push_back(0.03 * i / 8);
      points.y.push_back((side == "face" ? 1.0 : 0.8) * bending_truth.moment(points.x.back()));
    }
    folder.write_curve(side + ".csv", points.x, points.y);
    text += fmt::format(
        "[[moment_curvature]]\nname = '{0}'\nsense = '{0}'\nfiles = ['{0}.csv']\ncurvature_column = "
        "'x'\ncurvature_unit "
        "= '1/mm'\nmoment_column = 'y'\nmoment_unit = 'N'\n",
        side);
  }
  const auto found = folder.identify(text);
  ASSERT_EQ(found.bends.size(), 1U);
  EXPECT_NE(found.bends[0].senses.find("are not known"), std::string::npos) << found.bends[0].senses;
  EXPECT_FALSE(found.bends[0].warnings.empty());
}

// Strips that hang face up and face down.
TEST(FitTwoSenses, ShapesOfBothSidesGiveBothLaws) {
  const test::FitFolder folder;
  std::mt19937 random(2);
  std::string text = test::head_of_fit;
  for (const bool up : {true, false}) {
    const std::string side = up ? "face" : "back";
    std::string files;
    for (int k = 0; k < 3; ++k) {
      const std::string name = fmt::format("{}{}.csv", side, k);
      const Points points = test::profile(150.0 + 15.0 * k, (up ? 1.0 : 2.0) * (1.0 + 0.01 * k), 0.1, random);
      folder.write_curve(name, points.x, points.y);
      files += fmt::format("{}'{}'", k == 0 ? "" : ", ", name);
    }
    text += fmt::format("[[cantilever]]\nname = '{0}'\nsense = '{0}'\nfiles = [{1}]\nx_column = 'x'\ny_column = 'y'\n",
                        side, files);
  }
  const auto found = folder.identify(text);
  ASSERT_EQ(found.bends.size(), 2U);
  const auto& law = found.card.yarn[0].bending_out_of_plane;
  const double interval = found.card.yarn[0].interval;
  for (const double at : {0.003, 0.006}) {
    const double m = interval * bending_truth.moment(at);
    EXPECT_NEAR(law.moment(at), m, 0.2 * m) << at;
    EXPECT_NEAR(law.moment(-at), -2.0 * m, 0.4 * m) << at;
  }
}

// Peirce's numbers of both sides: two constants where they differ, one number of all where they do not, or where one number
// a side says nothing of its scatter.
TEST(FitTwoSenses, PeircesNumbersOfBothSidesAreTwoConstants) {
  const test::FitFolder folder;
  const auto numbers = [](const std::string& face, const std::string& back) {
    return test::head_of_fit + "[[peirce]]\nname = 'up'\nsense = 'face'\nrigidities = [" + face +
           "]\n[[peirce]]\nname = 'down'\nsense = 'back'\nrigidities = [" + back + "]\n";
  };
  const auto two = folder.identify(numbers("2.0, 2.1, 1.9", "4.0, 4.1, 3.9"));
  ASSERT_EQ(two.bends.size(), 2U);
  EXPECT_EQ(two.bends[1].name(), "peirce_back");
  EXPECT_FALSE(two.card.bending.rigidity);
  for (const auto& yarn : two.card.yarn) {
    EXPECT_NEAR(yarn.bending_out_of_plane.face().tangent(0.0), 2.0 * yarn.interval, 1e-6);
    EXPECT_NEAR(yarn.bending_out_of_plane.back().tangent(0.0), 4.0 * yarn.interval, 1e-6);
  }
  for (const auto& text : {numbers("2.0, 2.1, 1.9", "2.1, 2.2, 2.0"), numbers("2.0", "4.0")}) {
    const auto one = folder.identify(text);
    ASSERT_EQ(one.bends.size(), 1U);
    EXPECT_TRUE(one.card.bending.rigidity);
  }
}

}  // namespace
}  // namespace weaveform
