// What real test files do wrong: each trap gives the right answer, or a complaint that says what to do.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/vector/angle.hpp"
#include "fabric/trellis/shear_frame.hpp"
#include "tests/support/fit_folder.hpp"

namespace weaveform {
namespace {

constexpr double modulus = 20000.0;  // MPa
constexpr double section = 1.25;     // mm^2
constexpr double gauge = 1000.0;     // mm

struct Rows {
  std::vector<double> x, y;
};

Rows yarn_rows() {
  Rows rows{test::evenly(0.0, 20.0, 101), {}};
  for (const double l : rows.x) rows.y.push_back(modulus * std::log1p(l / gauge) * section / (1.0 + l / gauge));
  return rows;
}

const std::string yarn_fit =
    "name = 'a'\nbase = 'twintex-pw'\n[[tensile]]\nname = 'yarn'\nfiles = ['yarn.csv']\ndisplacement_column = "
    "'x'\nforce_column = 'y'\ngauge_length = 1000\n";

double fitted_modulus(const test::FitFolder& folder, const std::string& more = "") {
  return folder.identify(yarn_fit + more).card.yarn[0].linear_modulus;
}

TEST(FitTraps, TheCardHoldsAsFarAsItsTestsWent) {
  const test::FitFolder folder;
  Rows rows = yarn_rows();
  folder.write_curve("yarn.csv", rows.x, rows.y);
  const auto whole = folder.identify(yarn_fit);
  const YarnCard& yarn = whole.card.yarn[0];
  EXPECT_NEAR(yarn.tension.stress(yarn.valid_to), whole.yarns[0].greatest_stress(), 1e-4 * modulus);
  rows.x.resize(rows.x.size() / 2);
  rows.y.resize(rows.x.size());
  folder.write_curve("yarn.csv", rows.x, rows.y);
  EXPECT_LT(folder.identify(yarn_fit).card.yarn[0].valid_to, yarn.valid_to);
}

TEST(FitTraps, UnsortedRowsAreSorted) {
  const test::FitFolder folder;
  Rows rows = yarn_rows();
  std::reverse(rows.x.begin() + 20, rows.x.begin() + 60);
  std::reverse(rows.y.begin() + 20, rows.y.begin() + 60);
  folder.write_curve("yarn.csv", rows.x, rows.y);
  const auto found = folder.identify(yarn_fit);
  EXPECT_NEAR(found.card.yarn[0].linear_modulus, modulus, 1e-3);
  EXPECT_NE(found.yarns[0].specimens[0].notes.at(0).find("sorted"), std::string::npos);
}

TEST(FitTraps, DecimalCommasAreRead) {
  const test::FitFolder folder;
  const Rows rows = yarn_rows();
  std::string text = "x;y\n";
  for (std::size_t i = 0; i < rows.x.size(); ++i) text += fmt::format("{:.6f};{:.6f}\n", rows.x[i], rows.y[i]);
  std::replace(text.begin(), text.end(), '.', ',');
  folder.write("yarn.csv", text);
  EXPECT_NEAR(fitted_modulus(folder), modulus, 0.1);
}

TEST(FitTraps, ASlackToeIsTakenOut) {
  const test::FitFolder folder;
  Rows rows = yarn_rows();
  // 6 mm of slack, straightened on a parabola: the line it joins is the elastic one.
  constexpr double slack = 6.0, stiffness = modulus * section / gauge;  // mm, N/mm
  for (std::size_t i = 0; i < rows.x.size(); ++i) {
    const double l = rows.x[i];
    rows.y[i] = l < 2.0 * slack ? stiffness * l * l / (4.0 * slack) : stiffness * (l - slack);
  }
  folder.write_curve("yarn.csv", rows.x, rows.y);
  const auto found = folder.identify(yarn_fit);
  const auto& yarn = found.yarns[0].specimens[0];
  // The straight part may still hold 1 % of bow, and true stress and strain bend it by as much.
  EXPECT_NEAR(yarn.modulus, modulus, 0.04 * modulus);
  EXPECT_NEAR(yarn.toe, std::log1p(slack / gauge), 0.0005);
  EXPECT_NE(yarn.notes.at(0).find("slack toe"), std::string::npos);
}

TEST(FitTraps, ABrokenSpecimenIsCutAtItsGreatestLoad) {
  const test::FitFolder folder;
  Rows rows = yarn_rows();
  for (std::size_t i = 81; i < rows.y.size(); ++i) rows.y[i] = 30.0;
  folder.write_curve("yarn.csv", rows.x, rows.y);
  const auto found = folder.identify(yarn_fit);
  EXPECT_NEAR(found.card.yarn[0].linear_modulus, modulus, 1e-3);
  EXPECT_NE(found.yarns[0].specimens[0].notes.at(0).find("20 rows after the greatest force cut off"),
            std::string::npos);
}

// A rod of 20 GPa to 1.6 %, then it breaks and the extensometer jumps: those rows, sorted, would lie before the first.
TEST(FitTraps, RowsAfterABreakAreCutInTheOrderOfRecording) {
  const std::string fit =
      "name = 'a'\nbase = 'twintex-pw'\n[[tensile]]\nname = 'rod'\nfiles = ['yarn.csv']\nstrain_column = 'x'\n"
      "strain_unit = '%'\nstrain = 'engineering'\nstress_column = 'y'\n";
  for (const double jump : {-3.0, 0.4, 9.0}) {
    const test::FitFolder folder;
    Rows rows;
    for (int k = 0; k < 80; ++k) rows.x.push_back(0.02 * k), rows.y.push_back(4.0 * k);
    const Rows whole = rows;
    for (int k = 0; k < 15; ++k) rows.x.push_back(jump - 0.1 * k), rows.y.push_back(40.0);
    folder.write_curve("yarn.csv", rows.x, rows.y);
    const auto found = folder.identify(fit);
    EXPECT_NEAR(found.card.yarn[0].linear_modulus, 20458.0, 1.0) << jump;
    EXPECT_NE(found.yarns[0].specimens[0].notes.at(0).find("the 15 rows after the greatest stress cut off"),
              std::string::npos);
    folder.write_curve("yarn.csv", whole.x, whole.y);
    EXPECT_EQ(folder.identify(fit).card.yarn[0].linear_modulus, found.card.yarn[0].linear_modulus);
  }
}

TEST(FitTraps, NegativeStrainsAreAskedAboutByAKeyThatIsThere) {
  const test::FitFolder folder;
  const std::string fit =
      "name = 'a'\nbase = 'twintex-pw'\n[[tensile]]\nname = 'rod'\nfiles = ['yarn.csv']\nstrain_column = 'x'\n"
      "stress_column = 'y'\n";
  folder.write_curve("yarn.csv", test::evenly(0.0, -0.02, 50), test::evenly(0.0, 400.0, 50));
  EXPECT_NE(folder.complaint(fit).find("say strain_factor = -1"), std::string::npos) << folder.complaint(fit);
  EXPECT_GT(folder.identify(fit + "strain_factor = -1\n").card.yarn[0].linear_modulus, 19000.0);
}

TEST(FitTraps, TheNotesSayWhichLinesOfAMachinesFileWereSkipped) {
  const test::FitFolder folder;
  std::string text = "Specimen properties : Width,\"4.00000\",mm\nSpecimen label,\"Y1\"\n\nTime,x,y\n(s),(mm),(N)\n";
  for (int k = 0; k < 60; ++k) text += fmt::format("\"{}\",\"{}\",\"{}\"\n", 0.1 * k, 0.05 * k, 1.25 * k);
  folder.write("yarn.csv", text);
  std::string fit = yarn_fit;
  fit.replace(fit.find("1000"), 4, "100");
  const auto found = folder.identify(fit);
  EXPECT_NEAR(found.card.yarn[0].linear_modulus, 2050.0, 50.0);  // 2000 engineering
  EXPECT_EQ(found.yarns[0].specimens[0].notes.at(0), "lines 1 to 2 before the heading in line 4 skipped");
}

TEST(FitTraps, BendingAndADryYarnsSectionReachTheCard) {
  const test::FitFolder folder;
  const Rows rows = yarn_rows();
  folder.write_curve("yarn.csv", rows.x, rows.y);
  // of the base card
  EXPECT_EQ(folder.identify(yarn_fit).card.bending, load_card("twintex-pw").bending);
  // of the fit file, over the base card's
  const auto typed = folder.identify(yarn_fit + "[bending]\nrigidity = 3.5\n[yarn]\nsection = 1.25\n");
  EXPECT_EQ(typed.card.bending.rigidity, (std::array<double, 2>{3.5, 3.5}));
  EXPECT_EQ(typed.card.bending.twist, load_card("twintex-pw").bending.twist);
  // a dry yarn: Eq. 11 without a matrix
  const auto dry = folder.identify(yarn_fit +
                                   "[yarn]\nlinear_density = 600\nfibre_volume_fraction = 0.6\nfibre_density = 2.5\n"
                                   "matrix_density = 0\n");
  EXPECT_NEAR(dry.card.yarn[0].section, 600e-6 / (0.6 * 2.5e-3), 1e-12);
  // a section needs no densities beside it: whoever corrects it in the card has one number to correct
  EXPECT_EQ(folder.identify(yarn_fit).card_text.find("fibre_density"), std::string::npos);
  // another yarn has another section: by the base card's Eq. 11
  const auto other = folder.identify(yarn_fit + "[yarn]\nlinear_density = 935\n");
  EXPECT_NEAR(other.card.yarn[0].section, 0.5 * 1.2598, 1e-3);
}

TEST(FitTraps, NothingTypedIntoACardIsLostAtTheNextFit) {
  const test::FitFolder folder;
  const Rows rows = yarn_rows();
  folder.write_curve("yarn.csv", rows.x, rows.y);
  const std::string fit = yarn_fit.substr(0, yarn_fit.find("base")) + yarn_fit.substr(yarn_fit.find("[[tensile]]")) +
                          "[yarn]\nlinear_density = 1870\ninterval = 4.92\nsection = 1.25\ncrimp = 2\n";
  const std::string rest =
      "[[shear_frame]]\nname = 'f'\nfiles = ['frame.csv']\nangle_column = 'x'\n"
      "normalised_force_column = 'y'\n";
  std::vector<double> angles = test::evenly(0.0, 40.0, 60), forces;
  for (const double angle : angles) forces.push_back(0.01 * angle);
  folder.write_curve("frame.csv", angles, forces);
  const std::string text = "thickness = 0.5\n" + fit + rest;
  const auto first = folder.identify(text);
  EXPECT_FALSE(first.card.bending.rigidity.has_value());
  std::string edited = first.card_text + "\n[bending]\nrigidity = [2.0, 3.0]\ntwist = 0.25\n";
  edited.insert(edited.find("[yarn.weft]"), "bending_out_of_plane = [{ from = 0.0, coefficients = [5.0] }]\n");
  const auto spec = identify::read_fit_text(text, (folder.path() / "fit.toml").string());
  const auto again = identify::identify(spec, edited);
  EXPECT_EQ(again.card.bending.rigidity, (std::array<double, 2>{2.0, 3.0}));
  EXPECT_EQ(again.card.bending.twist, 0.25);
  EXPECT_FALSE(again.card.yarn[0].bending_out_of_plane.empty());
  const auto says = [&](const identify::Identification& found, const std::string& words) {
    return std::any_of(found.warnings.begin(), found.warnings.end(),
                       [&](const auto& warning) { return warning.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(says(again, "carried over from the card that is replaced: rigidity, twist of [bending]"));
  // a card that cannot be read is not replaced
  try {
    (void)identify::identify(spec, edited + "[bending]\n", "out/card.toml");
    ADD_FAILURE() << "a damaged card was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("out/card.toml:"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("would be replaced"), std::string::npos) << error.what();
  }
  // what the fit gives otherwise is told
  edited.replace(edited.find("section = 1.25"), 14, "section = 0.80");
  const auto other = identify::identify(spec, edited);
  EXPECT_EQ(other.card.yarn[0].section, 1.25);
  EXPECT_TRUE(other.replaces_other);
  EXPECT_FALSE(identify::identify(spec, first.card_text).replaces_other);
  EXPECT_TRUE(says(other, "section = 0.8 in [yarn.warp], this fit gives 1.25"));
}

TEST(FitTraps, LoadsInKilonewtonsCalledNewtonsAreAskedAbout) {
  const test::FitFolder folder;
  Rows rows = yarn_rows();
  for (double& force : rows.y) force *= 1e-3;
  folder.write_curve("yarn.csv", rows.x, rows.y);
  const std::string complaint = folder.complaint(yarn_fit);
  EXPECT_NE(complaint.find("force_unit really 'N'"), std::string::npos) << complaint;
  EXPECT_NE(complaint.find("kN"), std::string::npos) << complaint;
  EXPECT_NEAR(fitted_modulus(folder, "force_unit = 'kN'\n"), modulus, 1e-3);
}

TEST(FitTraps, AHeadingThatNamesAnotherUnitIsAskedAbout) {
  const test::FitFolder folder;
  const Rows rows = yarn_rows();
  std::string text = "x,Load (kN)\n";
  for (std::size_t i = 0; i < rows.x.size(); ++i) text += fmt::format("{},{}\n", rows.x[i], rows.y[i]);
  folder.write("yarn.csv", text);
  std::string fit = yarn_fit;
  fit.replace(fit.find("'y'"), 3, "'Load (kN)'");
  const std::string complaint = folder.complaint(fit);
  EXPECT_NE(complaint.find("the file calls the force 'Load (kN)', but force_unit is 'N'"), std::string::npos)
      << complaint;
}

TEST(FitTraps, MissingCellsAreLeftOutAndCounted) {
  const test::FitFolder folder;
  const Rows rows = yarn_rows();
  std::string text = "x,y\n";
  for (std::size_t i = 0; i < rows.x.size(); ++i)
    text += i % 10 == 3 ? fmt::format("{},NaN\n", rows.x[i]) : fmt::format("{:.12g},{:.12g}\n", rows.x[i], rows.y[i]);
  folder.write("yarn.csv", text);
  const auto found = folder.identify(yarn_fit);
  EXPECT_NEAR(found.card.yarn[0].linear_modulus, modulus, 1e-3);
  EXPECT_EQ(found.yarns[0].specimens[0].notes.at(0), "10 rows without a value left out");
}

TEST(FitTraps, NegativeLoadsAreAskedAbout) {
  const test::FitFolder folder;
  Rows rows = yarn_rows();
  for (double& force : rows.y) force = -force;
  folder.write_curve("yarn.csv", rows.x, rows.y);
  EXPECT_NE(folder.complaint(yarn_fit).find("say force_factor = -1"), std::string::npos);
  EXPECT_NEAR(fitted_modulus(folder, "force_factor = -1\n"), modulus, 1e-3);
}

TEST(FitTraps, TooFewPointsAreRefused) {
  const test::FitFolder folder;
  folder.write_curve("yarn.csv", {0.0, 10.0, 20.0}, {0.0, 250.0, 500.0});
  EXPECT_NE(folder.complaint(yarn_fit).find("only 3 usable points"), std::string::npos);
}

TEST(FitTraps, EveryBadFileIsNamedAtOnce) {
  const test::FitFolder folder;
  folder.write("one.csv", "x,y\n1,2\n3;4\n5,6\n");
  folder.write("two.csv", "x,y\n1,2\n3,four\n5,6\n");
  std::string fit = yarn_fit;
  fit.replace(fit.find("'yarn.csv'"), 10, "'one.csv', 'two.csv'");
  const std::string complaint = folder.complaint(fit);
  EXPECT_NE(complaint.find("one.csv:3: the row has 1 cell(s)"), std::string::npos) << complaint;
  EXPECT_NE(complaint.find("two.csv:3: 'four' is not a number"), std::string::npos) << complaint;
}

// A shear frame driven to 40 deg, loads of a plain weave.
Rows frame_rows() {
  const Card card = load_card("twintex-pw");
  const ShearFrame frame{216.0, 120.0};
  Rows rows;
  for (const double angle : test::evenly(0.0, 40.0 * degree, 120)) {
    rows.x.push_back(frame_displacement(frame, angle));
    rows.y.push_back(frame_load(frame, shear_stress(card.shear, log_shear_strain(angle)) * card.thickness, angle));
  }
  return rows;
}

const std::string frame_fit =
    "name = 'a'\nbase = 'twintex-pw'\n[[shear_frame]]\nname = 'frame'\nfiles = ['frame.csv']\ndisplacement_column = "
    "'x'\nforce_column = 'y'\nframe_length = 216\nfabric_length = 120\n";

TEST(FitTraps, AFrameDisplacementInMetresCalledMillimetresIsAskedAbout) {
  const test::FitFolder folder;
  Rows rows = frame_rows();
  for (double& displacement : rows.x) displacement *= 1e-3;
  folder.write_curve("frame.csv", rows.x, rows.y);
  const std::string complaint = folder.complaint(frame_fit);
  EXPECT_NE(complaint.find("displacement_unit really 'mm' (m would fit)"), std::string::npos) << complaint;
}

TEST(FitTraps, AFramePast90DegreesIsRefused) {
  const test::FitFolder folder;
  Rows rows = frame_rows();
  for (double& displacement : rows.x) displacement *= 2.0;
  folder.write_curve("frame.csv", rows.x, rows.y);
  EXPECT_NE(folder.complaint(frame_fit).find("sheared past 90 deg"), std::string::npos);
}

TEST(FitTraps, ACyclicTestIsAskedAbout) {
  const test::FitFolder folder;
  Rows rows = frame_rows();
  const Rows loading = rows;
  for (std::size_t i = loading.x.size(); i-- > 0;) {
    rows.x.push_back(loading.x[i] + 0.01);
    rows.y.push_back(0.05 * loading.y[i]);
  }
  folder.write_curve("frame.csv", rows.x, rows.y);
  EXPECT_NE(folder.complaint(frame_fit).find("cyclic test"), std::string::npos) << folder.complaint(frame_fit);
}

TEST(FitTraps, SpecimensOfOneFileAreToldApart) {
  const test::FitFolder folder;
  const Rows rows = frame_rows();
  std::string text = "specimen,x,y\n";
  for (std::size_t i = 0; i < rows.x.size(); ++i)
    for (const int k : {1, 2, 3})
      text += fmt::format("S{},{:.10g},{:.10g}\n", k, rows.x[i], (0.8 + 0.1 * k) * rows.y[i]);
  folder.write("frame.csv", text);
  const auto found = folder.identify(frame_fit + "specimen_column = 'specimen'\n");
  ASSERT_EQ(found.frame->specimens.size(), 3u);
  const Card card = load_card("twintex-pw");
  const auto& last = found.frame->law.back();
  EXPECT_NEAR(last.stress / shear_stress(card.shear, last.strain), 1.0, 1e-3) << "the mean of 0.9, 1 and 1.1";
}

}  // namespace
}  // namespace weaveform
