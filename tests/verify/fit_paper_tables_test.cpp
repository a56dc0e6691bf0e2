// Tables 2 and 3 of the paper come back from raw tests made of them: machine files in, card out.
#include <gtest/gtest.h>

#include "core/vector/angle.hpp"
#include "fabric/trellis/bias_rectangle.hpp"
#include "fabric/trellis/shear_frame.hpp"
#include "tests/support/fit_folder.hpp"

namespace weaveform {
namespace {

constexpr ShearFrame frame{216.0, 120.0};  // mm; the paper's

// Force (N) of a straight yarn of that modulus (MPa) and section (mm^2) at the machine's displacement.
void write_yarn(const test::FitFolder& folder, const std::string& name, double modulus, double section, double gauge) {
  const auto displacement = test::evenly(0.0, 0.02 * gauge, 120);  // mm
  std::vector<double> force;
  for (const double l : displacement) {
    const double strain = std::log1p(l / gauge);
    force.push_back(modulus * strain * section / (1.0 + l / gauge));  // incompressible: A = A0 L0/L
  }
  folder.write_curve(name, displacement, force);
}

void write_frame(const test::FitFolder& folder, const std::string& name, const Card& card, double greatest_deg) {
  std::vector<double> displacement, load;
  for (const double angle : test::evenly(0.0, greatest_deg * degree, 500)) {
    displacement.push_back(frame_displacement(frame, angle));
    load.push_back(frame_load(frame, shear_stress(card.shear, log_shear_strain(angle)) * card.thickness, angle));
  }
  folder.write_curve(name, displacement, load);
}

const std::string columns = "displacement_column = 'x'\nforce_column = 'y'\n";

std::string tensile(const std::string& yarn) {
  return fmt::format("[[tensile]]\nname = '{0}'\nyarn = '{0}'\nfiles = ['{0}.csv']\n{1}gauge_length = 1000\n", yarn,
                     columns);
}

// Table 2 as printed has three figures.
void expect_table_2(const YarnCard& fitted, const YarnCard& printed) {
  ASSERT_EQ(fitted.tension.pieces().size(), 2u);
  const auto &fit = fitted.tension.pieces()[0], &table = printed.tension.pieces()[0];
  EXPECT_NEAR(fit.to / table.to, 1.0, 0.005);
  EXPECT_NEAR(fit.coefficient[3] / table.coefficient[3], 1.0, 0.01);
  EXPECT_NEAR(fitted.linear_modulus / printed.linear_modulus, 1.0, 1e-6);
}

TEST(FitPaperTables, Table2ComesBackFromTensileTestsAndCrimpRatios) {
  const test::FitFolder folder;
  for (const std::string name : {"twintex-pw", "twintex-tw"}) {
    const Card printed = load_card(name);
    const std::array families = {"warp", "weft"};
    for (std::size_t f = 0; f < 2; ++f)
      write_yarn(folder, std::string(families[f]) + ".csv", printed.yarn[f].linear_modulus, printed.yarn[f].section,
                 1000.0);
    const auto found = folder.identify("name = 'again'\nbase = '" + name + "'\n" + tensile("warp") + tensile("weft"));
    for (std::size_t f = 0; f < 2; ++f) expect_table_2(found.card.yarn[f], printed.yarn[f]);
    EXPECT_EQ(found.card.shear.tangent.pieces()[0].coefficient, printed.shear.tangent.pieces()[0].coefficient)
        << "what was not measured is kept";
  }
}

TEST(FitPaperTables, Table3ComesBackFromShearFrameTests) {
  const test::FitFolder folder;
  for (const std::string name : {"twintex-pw", "twintex-tw"}) {
    const Card printed = load_card(name);
    write_frame(folder, "frame.csv", printed, 50.0);
    const auto found = folder.identify("name = 'again'\nbase = '" + name + "'\n[[shear_frame]]\nname = 'frame'\n" +
                                       "files = ['frame.csv']\nframe_length = 216\nfabric_length = 120\n" + columns +
                                       "[shear]\nform = 'polynomial'\n");
    const auto& fitted = found.card.shear.tangent.pieces()[0].coefficient;
    const auto& table = printed.shear.tangent.pieces()[0].coefficient;
    ASSERT_EQ(fitted.size(), 4u) << "a polynomial of degree 4 has a tangent of degree 3";
    // The only errors: parabolas through some ten points of a smooth curve, and 7 figures in the card.
    for (std::size_t n = 0; n < 4; ++n) EXPECT_NEAR(fitted[n], table[n], 1e-4) << name << ", g^" << n;
  }
}

TEST(FitPaperTables, Table3ComesBackFromBiasExtensions) {
  const test::FitFolder folder;
  const Card printed = load_card("twintex-pw");
  for (const double length : {200.0, 230.0, 345.0}) {  // shorter than, equal to and longer than twice the width
    const BiasRectangle rectangle{115.0, length};
    std::vector<double> travel, load;
    for (const double angle : test::evenly(0.0, 46.0 * degree, 460)) {
      const auto weights = bias_load_weights(rectangle, printed.thickness, angle);
      const auto stress = [&](double at) { return shear_stress(printed.shear, log_shear_strain(at)); };
      travel.push_back(bias_travel(rectangle, angle));
      load.push_back(weights.full * stress(angle) + weights.half * stress(0.5 * angle));
    }
    folder.write_curve("bias.csv", travel, load);
    const auto found =
        folder.identify(fmt::format("name = 'again'\nbase = 'twintex-pw'\n[[bias_extension]]\nname = 'b'\n"
                                    "files = ['bias.csv']\nwidth = 115\nlength = {}\n{}[shear]\nform = "
                                    "'polynomial'\n",
                                    length, columns));
    const auto& fitted = found.card.shear.tangent.pieces()[0].coefficient;
    const auto& table = printed.shear.tangent.pieces()[0].coefficient;
    for (std::size_t n = 0; n < 4; ++n) EXPECT_NEAR(fitted[n], table[n], 2e-4) << "length " << length << ", g^" << n;
  }
}

TEST(FitPaperTables, AFittedCardReadsBackToTheSameCard) {
  const test::FitFolder folder;
  const Card printed = load_card("twintex-pw");
  write_frame(folder, "frame.csv", printed, 50.0);
  const auto found = folder.identify(
      "name = 'again'\nbase = 'twintex-pw'\n[[shear_frame]]\nname = 'frame'\nfiles = "
      "['frame.csv']\nframe_length = 216\nfabric_length = 120\n" +
      columns);
  folder.write("card.toml", found.card_text);
  EXPECT_EQ(load_card((folder.path() / "card.toml").string()), found.card);
}

}  // namespace
}  // namespace weaveform
