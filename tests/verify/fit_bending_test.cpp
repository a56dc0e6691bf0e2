// Bending from synthetic tests: the law that made them comes back within its band over many seeds, from tables and from
// the shapes of hanging strips (made by the tests' own integration of the elastica); traps are right or complained of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fabric/identify/hanging_strip.hpp"
#include "tests/support/elastica.hpp"
#include "tests/support/fit_folder.hpp"

namespace weaveform {
namespace {

using identify::BendingCurve;
using identify::BendingFit;

// Per width, N mm and 1/mm: a fabric that yields, with the weight of the base card (7.455e-6 N/mm^2).
const BendingCurve truth{{0.0, 0.004, 0.006, 0.03}, {12.0, 11.0, 3.0, 1.0}};
double base_weight() {
  static const double weight = load_card("twintex-pw").area_density() * 9806.65;
  return weight;
}

const std::string head = "name = 'a'\nbase = 'twintex-pw'\n";
std::string table_fit(const std::string& files, const std::string& more = "") {
  return head + "[[moment_curvature]]\nname = 'bend'\nfiles = [" + files +
         "]\ncurvature_column = 'x'\ncurvature_unit = '1/mm'\nmoment_column = 'y'\nmoment_unit = 'N'\n" + more;
}
std::string strip_fit(const std::string& files, const std::string& more = "") {
  return head + "[[cantilever]]\nname = 'strip'\nfiles = [" + files + "]\nx_column = 'x'\ny_column = 'y'\n" + more;
}

struct Points {
  std::vector<double> x, y;
};

// What a machine would record up to 0.03 1/mm.
Points table(double factor, double noise, std::mt19937& random) {
  Points points;
  const auto readings = test::correlated_noise(random, 150, 0.5);
  for (int i = 0; i < 150; ++i) {
    points.x.push_back(0.03 * i / 149);
    points.y.push_back(factor * truth.moment(points.x.back()) + noise * readings[i]);
  }
  return points;
}

// Every 2 mm along the strip, with noise in both coordinates.
Points digitised(const test::RodShape& shape, double overhang, double noise, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Points points;
  for (int i = 0; i <= static_cast<int>(overhang / 2.0); ++i) {
    const double s = std::min(overhang, 2.0 * i);
    points.x.push_back(shape.x_at(s) + noise * normal(random));
    points.y.push_back(-shape.drop_at(s) + noise * normal(random));
  }
  return points;
}

// A strip of a fabric `factor` times as stiff, digitised every 2 mm with noise in both coordinates.
Points profile(double overhang, double factor, double noise, std::mt19937& random) {
  const test::Rod rod{.length = overhang,
                      .curvature = [factor](double moment) { return truth.curvature(moment / factor); },
                      .weight = base_weight()};
  const auto shape = test::solve_rod(rod, 1000);
  return digitised(shape, overhang, noise, random);
}

// Share of the law's places whose interval holds the truth.
double covered(const BendingFit& fit, double to = 1.0) {
  double inside = 0.0, count = 0.0;
  for (const auto& at : fit.law) {
    if (at.curvature > to * fit.law.back().curvature) continue;
    inside += std::abs(at.moment - truth.moment(at.curvature)) <= at.half_band ? 1.0 : 0.0;
    count += 1.0;
  }
  return inside / count;
}

double worst_error(const BendingFit& fit) {
  double worst = 0.0;
  for (const auto& at : fit.law)
    worst = std::max(worst, std::abs(at.moment - truth.moment(at.curvature)) / truth.moment(fit.law.back().curvature));
  return worst;
}

// The fit's own elastica, from the tip on without shooting, against the tests' one with shooting.
TEST(FitBending, ATipHangsWhereTheRodsDoes) {
  const BendingCurve yielding{{0.0, 0.002, 0.0025, 0.02}, {120.0, 118.0, 12.0, 3.0}};
  constexpr double strip_weight = 1.36e-5;  // N/mm^2
  for (const double overhang : {150.0, 230.0, 300.0}) {
    const test::Rod rod{.length = overhang,
                        .curvature = [&](double moment) { return yielding.curvature(moment); },
                        .weight = strip_weight};
    const auto shape = test::solve_rod(rod);
    const identify::HangingTip tip = identify::hanging_tip(yielding, strip_weight, overhang);
    EXPECT_NEAR(tip.drop, shape.drop.back(), 2e-4 * overhang) << overhang;
    EXPECT_NEAR(tip.x, shape.x.back(), 2e-4 * overhang) << overhang;
  }
}

TEST(FitBending, ATableWithoutNoiseGivesTheLawBackOnTheCard) {
  const test::FitFolder folder;
  std::mt19937 random(1);
  const Points points = table(1.0, 0.0, random);
  folder.write_curve("a.csv", points.x, points.y);
  const auto found = folder.identify(table_fit("'a.csv'"));
  for (const auto& yarn : found.card.yarn)
    for (const double at : {0.001, 0.004, 0.006, 0.01, 0.03})
      EXPECT_NEAR(yarn.bending_out_of_plane.moment(at), yarn.interval * truth.moment(at),
                  0.003 * yarn.interval * truth.moment(0.03));
  EXPECT_FALSE(found.card.bending.rigidity) << "the base's would be taken instead of what was measured";
  EXPECT_EQ(found.card.bending.twist, load_card("twintex-pw").bending.twist);
}

// Means over some seeds of shares of places. Where specimens differ as a whole the share within one seed is nearly all or
// nothing, so that the mean of 20 scatters by some 5 % about 95 %: two deviations below. Over 40 seeds 94 % were measured
// here, 92 % of one table's places, more than 99 % with shapes, 98 % of one shape's.
TEST(FitBending, TablesGiveTheLawBackWithinItsBand) {
  const test::FitFolder folder;
  constexpr int seeds = 20;
  double mean = 0.0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 4; ++k) {
      const Points points = table(1.0 + 0.08 * normal(random), 0.001, random);
      folder.write_curve(fmt::format("{}.csv", k), points.x, points.y);
    }
    const auto found = folder.identify(table_fit("'0.csv', '1.csv', '2.csv', '3.csv'"));
    mean += covered(found.bends.at(0)) / seeds;
  }
  RecordProperty("covered", std::to_string(mean));
  EXPECT_GT(mean, 0.95 - 0.10);
}

// The band of a single table is that of its readings.
TEST(FitBending, OneTableGivesTheLawBackWithinItsOwnBand) {
  const test::FitFolder folder;
  constexpr int seeds = 20;
  double mean = 0.0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(seed);
    const Points points = table(1.0, 0.001, random);
    folder.write_curve("a.csv", points.x, points.y);
    mean += covered(folder.identify(table_fit("'a.csv'")).bends.at(0)) / seeds;
  }
  RecordProperty("covered", std::to_string(mean));
  EXPECT_GT(mean, 0.85);
}

TEST(FitBending, AShapeWithoutNoiseGivesTheLawBack) {
  const test::FitFolder folder;
  std::mt19937 random(1);
  const Points points = profile(160.0, 1.0, 0.0, random);
  folder.write_curve("a.csv", points.x, points.y);
  const auto found = folder.identify(strip_fit("'a.csv'"));
  EXPECT_LT(worst_error(found.bends.at(0)), 0.01);
}

TEST(FitBending, ShapesGiveTheLawBackWithinItsBand) {
  const test::FitFolder folder;
  constexpr int seeds = 10;
  double mean = 0.0, worst = 0.0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 4; ++k) {
      const Points points = profile(150.0 + 10.0 * k, 1.0 + 0.08 * normal(random), 0.2, random);
      folder.write_curve(fmt::format("{}.csv", k), points.x, points.y);
    }
    const auto found =
        folder.identify(strip_fit("'0.csv', '1.csv', '2.csv', '3.csv'", "overhangs = [150, 160, 170, 180]\n"));
    mean += covered(found.bends.at(0)) / seeds;
    worst = std::max(worst, worst_error(found.bends.at(0)));
  }
  RecordProperty("covered", std::to_string(mean));
  RecordProperty("worst", std::to_string(worst));
  EXPECT_GT(mean, 0.95 - 0.10);
  EXPECT_LT(worst, 0.25);
}

TEST(FitBending, OneShapeGivesTheLawBackWithinItsOwnBand) {
  const test::FitFolder folder;
  constexpr int seeds = 20;
  double mean = 0.0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(seed);
    const Points points = profile(160.0, 1.0, 0.2, random);
    folder.write_curve("a.csv", points.x, points.y);
    mean += covered(folder.identify(strip_fit("'a.csv'")).bends.at(0)) / seeds;
  }
  RecordProperty("covered", std::to_string(mean));
  EXPECT_GT(mean, 0.85);
}

// A preform that yields to a fortieth within a fifth of the overhang from the clamp: what happens there is in few points.
TEST(FitBending, ShapesOfASharpYieldGiveItBackWithinItsBand) {
  const BendingCurve sharp{{0.0, 0.0023, 0.0026, 0.0045, 0.02}, {119.2, 119.2, 33.0, 9.0, 3.2}};
  constexpr double preform_weight = 13.6e-6;  // N/mm^2
  const test::FitFolder folder;
  constexpr int seeds = 5;
  double mean = 0.0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (const double overhang : {230.0, 260.0, 290.0}) {
      const double factor = 1.0 + 0.05 * normal(random);
      const test::Rod rod{.length = overhang,
                          .curvature = [&](double moment) { return sharp.curvature(moment / factor); },
                          .weight = preform_weight};
      const Points points = digitised(test::solve_rod(rod, 1000), overhang, 0.2, random);
      folder.write_curve(fmt::format("{}.csv", overhang), points.x, points.y);
    }
    const auto found =
        folder.identify(strip_fit("'230.csv', '260.csv', '290.csv'", "overhangs = [230, 260, 290]\nweight = 13.6\n"));
    double inside = 0.0, count = 0.0;
    for (const auto& at : found.bends.at(0).law) {
      if (at.curvature > 0.02) continue;
      inside += std::abs(at.moment - sharp.moment(at.curvature)) <= at.half_band ? 1.0 : 0.0;
      count += 1.0;
    }
    mean += inside / count / seeds;
  }
  RecordProperty("covered", std::to_string(mean));
  EXPECT_GT(mean, 0.85);
}

TEST(FitBending, PeircesNumbersMakeARigidity) {
  const test::FitFolder folder;
  const std::string peirce = head + "[[peirce]]\nname = 'p'\n";
  const auto lengths = folder.identify(peirce + "bending_lengths = [64.0, 66.0, 65.0]\n");
  const double mean = base_weight() * (std::pow(64.0, 3) + std::pow(65.0, 3) + std::pow(66.0, 3)) / 3.0;
  ASSERT_TRUE(lengths.card.bending.rigidity);
  EXPECT_NEAR((*lengths.card.bending.rigidity)[0], mean, 1e-6 * mean);
  EXPECT_LT(lengths.bends.at(0).rigidity_band[0], mean);
  // twice the bending length at 41.5 deg, and along the weft alone the warp keeps what it had
  const auto overhangs = folder.identify(peirce + "overhangs = [130.0, 130.0]\ndirection = 'weft'\n");
  EXPECT_NEAR((*overhangs.card.bending.rigidity)[1], base_weight() * std::pow(65.0, 3), 0.003 * mean);
  EXPECT_EQ((*overhangs.card.bending.rigidity)[0], 2.0);
}

// One direction measured as a curve: the other keeps its rigidity, as a constant law of the yarn.
TEST(FitBending, ADirectionThatWasNotTestedKeepsItsRigidity) {
  const test::FitFolder folder;
  std::mt19937 random(1);
  const Points points = table(1.0, 0.0, random);
  folder.write_curve("a.csv", points.x, points.y);
  const Card card = folder.identify(table_fit("'a.csv'", "direction = 'weft'\n")).card;
  EXPECT_EQ(card.yarn[0].bending_out_of_plane.first_stiffness(), 2.0 * 4.92);
  EXPECT_NEAR(card.yarn[1].bending_out_of_plane.first_stiffness(), 12.0 * 4.92, 0.6);
  EXPECT_FALSE(card.bending.rigidity);
}

TEST(FitBending, FromChoosesAndTheOthersAreReportedBeside) {
  const test::FitFolder folder;
  std::mt19937 random(1);
  const Points points = table(1.0, 0.0, random);
  folder.write_curve("a.csv", points.x, points.y);
  const std::string both = table_fit("'a.csv'") + "[[peirce]]\nname = 'p'\nbending_lengths = [64.0]\n";
  EXPECT_FALSE(folder.identify(both).card.bending.rigidity);
  const auto other = folder.identify(both + "[bending_law]\nfrom = 'peirce'\n");
  EXPECT_TRUE(other.card.bending.rigidity);
  EXPECT_EQ(other.bends.size(), 2U);
}

// A record to and fro: friction is told from the curve.
TEST(FitBending, ALoopTellsFrictionFromTheCurve) {
  const test::FitFolder folder;
  constexpr double friction = 0.01, rise = 0.0015;
  std::vector<double> x;
  for (int i = 0; i <= 100; ++i) x.push_back(0.025 * i / 100);
  for (int i = 1; i <= 200; ++i) x.push_back(0.025 - 0.05 * i / 200);
  for (int i = 1; i <= 200; ++i) x.push_back(-0.025 + 0.05 * i / 200);
  const auto share = identify::friction_share(x, rise, 0.0);
  std::vector<double> y;
  std::mt19937 random(3);
  const auto noise = test::correlated_noise(random, x.size(), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) y.push_back(truth.moment(x[i]) + friction * share[i] + 0.0005 * noise[i]);
  folder.write_curve("a.csv", x, y);
  const auto found = folder.identify(table_fit("'a.csv'"));
  const BendingFit& fit = found.bends.at(0);
  ASSERT_TRUE(fit.friction);
  EXPECT_NEAR(fit.friction->moment, friction, 0.05 * friction);
  EXPECT_NEAR(fit.friction->rise, rise, 0.15 * rise);
  EXPECT_LT(worst_error(fit), 0.02);
}

// Bent both ways: the odd part, and the zero of the moment taken out.
TEST(FitBending, BothSensesMakeOneLawAndTheZeroIsTakenOut) {
  const test::FitFolder folder;
  std::vector<double> x, y;
  for (int i = -100; i <= 100; ++i) {
    x.push_back(0.03 * i / 100);
    y.push_back(truth.moment(x.back()) * (i > 0 ? 1.05 : 0.95) + 0.004);
  }
  folder.write_curve("a.csv", x, y);
  const auto found = folder.identify(table_fit("'a.csv'"));
  EXPECT_LT(worst_error(found.bends.at(0)), 0.03);
  const auto& notes = found.bends[0].specimens[0].notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(),
                          [](const auto& note) { return note.find("bent both ways") != std::string::npos; }));
}

// Four tables bent with each side outwards, the back's moments `ratio` times the face's; specimens 3 % apart.
std::string both_sides(const test::FitFolder& folder, double ratio, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::string text = head;
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

// Share of the law's places whose interval holds a multiple of the truth.
double covered_times(const BendingFit& fit, double factor) {
  double inside = 0.0;
  for (const auto& at : fit.law)
    inside += std::abs(at.moment - factor * truth.moment(at.curvature)) <= at.half_band ? 1.0 : 0.0;
  return inside / static_cast<double>(fit.law.size());
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
    mean += 0.5 * (covered_times(found.bends[0], 1.0) + covered_times(found.bends[1], ratio)) / seeds;
    for (const auto& yarn : found.card.yarn) {
      const double at = 0.02, m = yarn.interval * truth.moment(at);
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
  EXPECT_LE(two, 2);
}

// One record of both senses, its zero off: positive curvatures have the side outwards that `sense` names.
TEST(FitTwoSenses, ARecordOfBothWaysGivesBothLawsAndItsZeroIsTakenOut) {
  const test::FitFolder folder;
  std::mt19937 random(5);
  const auto noise = test::correlated_noise(random, 301, 0.0);
  std::vector<double> x, y;
  for (int i = -150; i <= 150; ++i) {
    x.push_back((i > 0 ? 0.03 : 0.024) * i / 150);  // not as far one way as the other
    y.push_back(truth.moment(x.back()) * (i > 0 ? 1.2 : 0.8) + 0.002 + 0.0003 * noise[i + 150]);
  }
  folder.write_curve("a.csv", x, y);
  for (const bool face_first : {true, false}) {
    const auto found = folder.identify(table_fit("'a.csv'", face_first ? "sense = 'face'\n" : "sense = 'back'\n"));
    ASSERT_EQ(found.bends.size(), 2U);
    const auto& law = found.card.yarn[0].bending_out_of_plane;
    const double interval = found.card.yarn[0].interval, end = interval * truth.moment(0.03);
    for (const double at : {0.002, 0.005, 0.01, 0.02}) {
      EXPECT_NEAR(law.moment(at), interval * truth.moment(at) * (face_first ? 1.2 : 0.8), 0.02 * end) << at;
      EXPECT_NEAR(law.moment(-at), -interval * truth.moment(at) * (face_first ? 0.8 : 1.2), 0.02 * end) << at;
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
    y.push_back(truth.moment(x[i]) * (x[i] > 0.0 ? 1.3 : 0.7) + friction * share[i] + 0.0005 * noise[i]);
  folder.write_curve("a.csv", x, y);
  const auto found = folder.identify(table_fit("'a.csv'", "sense = 'face'\n"));
  ASSERT_EQ(found.bends.size(), 2U);
  const YarnCard& yarn = found.card.yarn[0];
  EXPECT_NEAR(yarn.bending_friction.moment, yarn.interval * friction, 0.05 * yarn.interval * friction);
  EXPECT_NEAR(yarn.bending_friction.rise, rise, 0.15 * rise);
  for (const double at : {0.005, 0.01, 0.02}) {
    const double m = yarn.interval * truth.moment(at);
    EXPECT_NEAR(yarn.bending_out_of_plane.moment(at), 1.3 * m, 0.03 * m) << at;
    EXPECT_NEAR(yarn.bending_out_of_plane.moment(-at), -0.7 * m, 0.03 * m) << at;
  }
}

// One table a side of so few readings that nothing is known of their errors: no difference is one.
TEST(FitTwoSenses, ReadingsWithoutABandTellNothingApart) {
  const test::FitFolder folder;
  std::string text = head;
  for (const std::string side : {"face", "back"}) {
    Points points;
    for (int i = 0; i < 9; ++i) {
      points.x.push_back(0.03 * i / 8);
      points.y.push_back((side == "face" ? 1.0 : 0.8) * truth.moment(points.x.back()));
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
  std::string text = head;
  for (const bool up : {true, false}) {
    const std::string side = up ? "face" : "back";
    std::string files;
    for (int k = 0; k < 3; ++k) {
      const std::string name = fmt::format("{}{}.csv", side, k);
      const Points points = profile(150.0 + 15.0 * k, (up ? 1.0 : 2.0) * (1.0 + 0.01 * k), 0.1, random);
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
    const double m = interval * truth.moment(at);
    EXPECT_NEAR(law.moment(at), m, 0.2 * m) << at;
    EXPECT_NEAR(law.moment(-at), -2.0 * m, 0.4 * m) << at;
  }
}

// Peirce's numbers of both sides: two constants where they differ, one number of all where they do not, or where one number
// a side says nothing of its scatter.
TEST(FitTwoSenses, PeircesNumbersOfBothSidesAreTwoConstants) {
  const test::FitFolder folder;
  const auto numbers = [](const std::string& face, const std::string& back) {
    return head + "[[peirce]]\nname = 'up'\nsense = 'face'\nrigidities = [" + face +
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

class FitBendingTraps : public testing::Test {
protected:
  void write(const std::string& name, const Points& points) { folder.write_curve(name, points.x, points.y); }
  std::string complaint(const std::string& text) { return folder.complaint(text); }
  test::FitFolder folder;
  std::mt19937 random{1};
};

TEST_F(FitBendingTraps, AClampToeIsTakenOut) {
  Points points = table(1.0, 0.0, random);
  constexpr double toe = 0.002;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double x = points.x[i];
    points.y[i] = x < 2.0 * toe ? truth.moment(toe) * x * x / (4.0 * toe * toe) : truth.moment(x - toe);
  }
  write("a.csv", points);
  const auto found = folder.identify(table_fit("'a.csv'"));
  EXPECT_LT(worst_error(found.bends.at(0)), 0.03);
  EXPECT_NE(found.bends[0].specimens[0].notes.at(0).find("toe"), std::string::npos);
}

// The strip lifts out of the jaws beside the clamp: what hangs beyond is as it was.
TEST_F(FitBendingTraps, AStripThatTiltsInItsClampHasTheSameLaw) {
  Points points = profile(160.0, 1.0, 0.05, random);
  constexpr double tilt = 0.03;  // rad; the whole strip turns with its clamp: not exactly the level one's shape
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double x = points.x[i], y = points.y[i];
    points.x[i] = x + tilt * y;
    points.y[i] = y - tilt * x;
  }
  write("a.csv", points);
  const auto found = folder.identify(strip_fit("'a.csv'"));
  EXPECT_LT(worst_error(found.bends.at(0)), 0.08);
}

TEST_F(FitBendingTraps, ProfilesThatCrossAreComplainedOf) {
  write("short.csv", profile(140.0, 1.0, 0.1, random));
  write("long.csv", profile(160.0, 4.0, 0.1, random));
  const std::string said = complaint(strip_fit("'short.csv', 'long.csv'"));
  EXPECT_NE(said.find("long.csv: the strip of 160"), std::string::npos) << said;
  EXPECT_NE(said.find("hangs lower everywhere"), std::string::npos) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 0) << said;
}

TEST_F(FitBendingTraps, AProfileThatCrossesItselfIsComplainedOf) {
  Points points = profile(160.0, 1.0, 0.0, random);
  std::rotate(points.x.begin() + 20, points.x.begin() + 45, points.x.begin() + 60);
  std::rotate(points.y.begin() + 20, points.y.begin() + 45, points.y.begin() + 60);
  for (std::size_t i = 20; i < 60; ++i) points.y[i] += i % 2 == 0 ? 15.0 : -15.0;
  write("a.csv", points);
  const std::string said = complaint(strip_fit("'a.csv'"));
  EXPECT_NE(said.find("a.csv"), std::string::npos) << said;
  EXPECT_NE(said, "");
}

TEST_F(FitBendingTraps, WrongUnitsAreAskedAboutInOneLine) {
  write("a.csv", table(1.0, 0.0, random));
  const std::string columns =
      head + "[[moment_curvature]]\nname = 'bend'\nfiles = ['a.csv']\ncurvature_column = 'x'\nmoment_column = 'y'\n";
  const std::string curvature = complaint(columns + "curvature_unit = '1/m'\nmoment_unit = 'N'\n");
  EXPECT_NE(curvature.find("is curvature_unit really '1/m' (1/cm or 1/mm"), std::string::npos) << curvature;
  Points in_metres = profile(160.0, 1.0, 0.0, random);
  for (auto* values : {&in_metres.x, &in_metres.y})
    for (double& value : *values) value *= 1e-3;
  write("m.csv", in_metres);
  const std::string length = complaint(strip_fit("'m.csv'", "overhangs = [160]\n"));
  EXPECT_NE(length.find("really 'mm' (m would fit)"), std::string::npos) << length;
  Points stiff = table(1e4, 0.0, random);
  write("k.csv", stiff);
  const std::string moment = complaint(table_fit("'k.csv'"));
  EXPECT_NE(moment.find("is moment_unit really 'N'"), std::string::npos) << moment;
  for (const auto& said : {curvature, length, moment}) EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 0) << said;
}

TEST_F(FitBendingTraps, AHeadingThatNamesAnotherUnitIsAskedAbout) {
  const Points points = table(1.0, 0.0, random);
  std::string text = "curvature (1/m),moment (N mm)\n";
  for (std::size_t i = 0; i < points.x.size(); ++i) text += fmt::format("{},{}\n", points.x[i], points.y[i]);
  folder.write("a.csv", text);
  const std::string columns = head +
                              "[[moment_curvature]]\nname = 'bend'\nfiles = ['a.csv']\ncurvature_column = '1'\n"
                              "moment_column = '2'\n";
  EXPECT_NE(complaint(columns + "curvature_unit = '1/cm'\nmoment_unit = 'N'\n").find("which is right?"),
            std::string::npos);
  const std::string of_whole = complaint(columns + "curvature_unit = '1/m'\nmoment_unit = 'N mm/mm'\n");
  EXPECT_NE(of_whole.find("moment_unit = \"N mm\""), std::string::npos) << of_whole;
}

TEST_F(FitBendingTraps, HeightsThatCountDownwardsAreAskedAbout) {
  Points points = profile(160.0, 1.0, 0.1, random);
  for (double& y : points.y) y = -y;
  write("a.csv", points);
  EXPECT_NE(complaint(strip_fit("'a.csv'")).find("say y_factor = -1"), std::string::npos);
  EXPECT_EQ(complaint(strip_fit("'a.csv'", "y_factor = -1\n")), "");
}

// From the tip to the clamp, towards negative x, with the part in the jaws: as good as the plain one.
TEST_F(FitBendingTraps, AProfileTheOtherWayRoundIsTurned) {
  Points points = profile(160.0, 1.0, 0.0, random);
  for (int i = 0; i < 10; ++i) {
    points.x.insert(points.x.begin(), -2.0 * (i + 1));
    points.y.insert(points.y.begin(), 0.0);
  }
  std::reverse(points.x.begin(), points.x.end());
  std::reverse(points.y.begin(), points.y.end());
  for (double& x : points.x) x = -x;
  write("a.csv", points);
  const auto found = folder.identify(strip_fit("'a.csv'"));
  EXPECT_LT(worst_error(found.bends.at(0)), 0.02);
}

TEST_F(FitBendingTraps, AMomentAgainstTheCurvatureIsAskedAbout) {
  Points points = table(1.0, 0.0, random);
  for (double& y : points.y) y = -y;
  write("a.csv", points);
  EXPECT_NE(complaint(table_fit("'a.csv'")).find("say moment_factor = -1"), std::string::npos);
  EXPECT_EQ(complaint(table_fit("'a.csv'", "moment_factor = -1\n")), "");
}

TEST_F(FitBendingTraps, WholeMomentsNeedAWidth) {
  Points points = table(50.0, 0.0, random);
  write("a.csv", points);
  const std::string whole = head +
                            "[[moment_curvature]]\nname = 'bend'\nfiles = ['a.csv']\ncurvature_column = 'x'\n"
                            "curvature_unit = '1/mm'\nmoment_column = 'y'\nmoment_unit = 'N mm'\n";
  EXPECT_NE(complaint(whole).find("no 'specimen_width' (mm)"), std::string::npos);
  EXPECT_LT(worst_error(folder.identify(whole + "specimen_width = 50\n").bends.at(0)), 0.01);
}

TEST_F(FitBendingTraps, WhatIsTypedAndMeasuredIsComplainedOf) {
  write("a.csv", table(1.0, 0.0, random));
  EXPECT_NE(complaint(table_fit("'a.csv'") + "[bending]\nrigidity = 2\n").find("given beside tests"),
            std::string::npos);
}

}  // namespace
}  // namespace weaveform
