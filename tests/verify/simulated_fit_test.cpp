// Identification through simulation: what one run says of the law is what runs with other laws do, and the law behind
// simulated tests comes back from their loads, of a fabric and of specimens that no example has.
#include <gtest/gtest.h>

#include <cmath>

#include "app/stages/specimen_trials.hpp"
#include "core/vector/angle.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/scene/reader.hpp"
#include "solver/solve.hpp"
#include "tests/support/fit_folder.hpp"

namespace weaveform::identify {
namespace {

// An open fabric with unequal yarns; its shear law has a start and a locking end.
const char* const truth_card = R"(
name = "open-fabric"
thickness = 0.6
[yarn]
linear_density = 900
section = 0.7
crimp = 1.2
[yarn.warp]
interval = 3.3
tension = [{ from = 0.0, to = 0.0159, coefficients = [0, 0, 0, 6.2e9] }, { from = 0.0159, coefficients = [25000] }]
[yarn.weft]
interval = 4.1
tension = [{ from = 0.0, to = 0.0159, coefficients = [0, 0, 0, 6.2e9] }, { from = 0.0159, coefficients = [25000] }]
[shear]
tangent = [{ from = 0.0, coefficients = [0.03, 0.02, -0.05, 0.6] }]
start = { plateau = 0.02, rise = 0.03 }
valid_to = 60
)";

// The same with another shear law, which the fit must not fall back on.
std::string base_card() {
  std::string text = truth_card;
  const auto shear = text.find("[shear]");
  return text.substr(0, shear) + "[shear]\ntangent = [{ from = 0.0, coefficients = [0.5] }]\nvalid_to = 60\n";
}

SimulatedTest bias_test(double width, double length) {
  SimulatedTest test{.number = 0, .specimen = BiasRectangle{width, length}, .window = {}};
  for (int i = 2; i <= 40; i += 2)
    test.window.push_back(
        {bias_travel({width, length}, (i - 1) * degree), bias_travel({width, length}, (i + 1) * degree)});
  return test;
}

FitSpec simulated_spec(const std::string& extra = "") {
  return read_fit_text(
      "name = \"t\"\nbase = \"twintex-pw\"\n[shear]\nmethod = \"simulation\"\n[simulation]\n" + extra +
          "\n[[bias_extension]]\nname = \"b\"\nfiles = [\"b.csv\"]\ndisplacement_column = \"x\"\nforce_column = "
          "\"y\"\nwidth = 100\nlength = 200\n",
      "fit.toml");
}

// Two runs with laws apart by `change` differ by what the weights of either say; taken from the mean of both, to second
// order. What is left is the runs' own noise.
TEST(SimulatedTests, TheWeightsAreTheLoadsDerivativeByTheLaw) {
  const Card card = read_card_text(truth_card, "card");
  Card stiffer = card;
  const TangentLaw more({{0.0, 2.0, {0.036, 0.024, -0.05, 0.66}}});
  stiffer.shear.tangent = more;
  SpecimenTrials trials(simulated_spec("coarsening = 2\nsettings = [\"analysis.duration=0.3\"]"));
  const auto test = bias_test(80.0, 180.0);
  const auto one = trials.run(test, {card, std::nullopt, 0.0}, TrialMesh::fine);
  const auto other = trials.run(test, {stiffer, std::nullopt, 0.0}, TrialMesh::fine);
  const auto change = [&](const std::vector<StressWeight>& weights) {
    double sum = 0.0;
    for (const auto& at : weights)
      sum += at.weight * (shear_stress(stiffer.shear, at.strain) - shear_stress(card.shear, at.strain));
    return sum;
  };
  double squares = 0.0, greatest = 0.0;
  for (std::size_t i = 0; i < one.at.size(); ++i) {
    const double said = 0.5 * (change(one.at[i].weight) + change(other.at[i].weight));
    const double done = other.at[i].load - one.at[i].load;
    squares += std::pow(said - done, 2);
    greatest = std::max(greatest, done);
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(one.at.size())), 0.03 * greatest);
}

TEST(SimulatedTests, TheYarnsEnergyIsTheLoadsDerivativeByTheirDecrimping) {
  const Card card = read_card_text(truth_card, "card");
  SpecimenTrials trials(simulated_spec("coarsening = 2\nsettings = [\"analysis.duration=0.3\"]"));
  const auto test = bias_test(80.0, 180.0);
  const auto fabric = [&](double factor) {
    return TriedFabric{with_decrimping(card, factor),
                       std::array<Card, 2>{with_decrimping(card, factor - 0.02), with_decrimping(card, factor + 0.02)},
                       0.02};
  };
  const auto less = trials.run(test, fabric(0.9), TrialMesh::fine);
  const auto more = trials.run(test, fabric(1.1), TrialMesh::fine);
  double squares = 0.0, greatest = 0.0;
  for (std::size_t i = 0; i < less.at.size(); ++i) {
    const double said = 0.2 * 0.5 * (less.at[i].decrimping + more.at[i].decrimping);
    const double done = more.at[i].load - less.at[i].load;
    squares += std::pow(said - done, 2);
    greatest = std::max(greatest, std::abs(done));
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(less.at.size())), 0.1 * greatest);
}

// The machine of these tests: a run of the scene that a user would write, its load with noise.
class Machine {
public:
  Machine() : card_(read_card_text(truth_card, "card")) {}
  // Travel and load of a specimen to 45 deg of a trellis.
  void pull(double width, double length, double coarsening) {
    const double travel = bias_travel({width, length}, 46.0 * degree);
    const Scene scene = read_scene_text(
        fmt::format(
            "[blank]\nsize = [{}, {}]\nyarn_angle = 45.0\ncoarsening = {}\n[[grip]]\nname = \"bottom\"\nedge = "
            "\"bottom\"\n[[grip]]\nname = \"top\"\nedge = \"top\"\ntravel = {}\n[output]\nframes = 1\nhistory = "
            "300\n[analysis]\nduration = 0.3\n",
            width, length, coarsening, travel),
        "scene");
    const History history = solve(build_mesh(scene, card_), scene, card_, {}, {.threads = 1, .quiet = true}).history;
    travel_.push_back(history.values("top.displacement_mm"));
    load_.push_back(history.values("top.force_N"));
  }
  struct Scatter {
    double between = 0.03;  // of the load, from specimen to specimen
    double reading = 0.01;  // of the greatest load
  };
  // `number` specimens like the one pulled as the `kind`-th; each has a factor of its own and readings that are alike.
  std::string record(const test::FitFolder& folder, std::size_t kind, int number, std::mt19937& random,
                     const Scatter& scatter) const {
    std::normal_distribution<double> normal;
    std::string files;
    for (int k = 0; k < number; ++k) {
      const double factor = 1.0 + scatter.between * normal(random);
      const auto noise = test::correlated_noise(random, load_[kind].size(), 0.8);
      std::vector<double> x, y;
      for (std::size_t i = 0; i < load_[kind].size(); ++i) {
        if (!x.empty() && travel_[kind][i] <= x.back() + 0.02) continue;
        x.push_back(travel_[kind][i]);
        y.push_back(factor * load_[kind][i] + scatter.reading * load_[kind].back() * noise[i]);
      }
      const std::string name = fmt::format("{}_{}.csv", kind, k);
      folder.write_curve(name, x, y);
      files += fmt::format("{}\"{}\"", k == 0 ? "" : ", ", name);
    }
    return files;
  }
  [[nodiscard]] const Card& card() const { return card_; }

private:
  Card card_;
  std::vector<std::vector<double>> travel_, load_;
};

std::string bias_table(const std::string& name, const std::string& files, double width, double length) {
  return fmt::format(
      "[[bias_extension]]\nname = \"{}\"\nfiles = [{}]\ndisplacement_column = \"x\"\nforce_column = \"y\"\nwidth = "
      "{}\nlength = {}\n",
      name, files, width, length);
}

Identification identified(const test::FitFolder& folder, const std::string& text) {
  const FitSpec spec = read_fit_text(text, (folder.path() / "fit.toml").string());
  SpecimenTrials trials(spec);
  return identify(spec, "", "card.toml", {.run = [&](const auto& test, const auto& fabric, auto mesh) {
                    return trials.run(test, fabric, mesh);
                  }});
}

// The form that the truth has: of itself a noisy fit may take the polynomial, whose band says nothing of what it cannot be.
const char* const fit_head =
    "name = \"found\"\nbase = \"base.toml\"\n[shear]\nmethod = \"simulation\"\nform = "
    "\"polynomial+start\"\n[simulation]\ncoarsening = 2\n";

// Greatest and root mean square distance of the law found from the truth between 3 deg and its end, of the stress at its
// end; the share of angles at which the truth lies in the band.
struct Distance {
  double greatest = 0.0, mean = 0.0, covered = 0.0;
};
Distance distance_of(const ShearFit& fit, const Card& truth) {
  Distance distance;
  double count = 0.0;
  const double end = shear_stress(truth.shear, fit.law.back().strain);
  for (const LawPoint& at : fit.law) {
    if (at.angle < 3.0 * degree) continue;
    const double away = std::abs(at.stress - shear_stress(truth.shear, at.strain));
    distance.greatest = std::max(distance.greatest, away / end);
    distance.mean += std::pow(away / end, 2);
    distance.covered += away <= at.half_band ? 1.0 : 0.0;
    count += 1.0;
  }
  distance.mean = std::sqrt(distance.mean / count);
  distance.covered /= count;
  return distance;
}

// Two sizes at once, two specimens each. The closed form, of inextensible yarns, is far off; the simulated law is as near
// as four specimens that differ by 3 % allow: 1.5 % their mean, twice that in one case out of twenty, and the readings'
// noise at single angles.
TEST(SimulatedFit, TheLawOfTwoSizesComesBackOverSeeds) {
  Machine machine;
  machine.pull(80.0, 180.0, 2.0);
  machine.pull(110.0, 200.0, 2.0);
  double covered = 0.0;
  constexpr int seeds = 3;
  for (int seed = 1; seed <= seeds; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    const test::FitFolder folder;
    folder.write("base.toml", base_card());
    const auto found =
        identified(folder, fit_head + bias_table("long", machine.record(folder, 0, 2, random, {}), 80.0, 180.0) +
                               bias_table("wide", machine.record(folder, 1, 2, random, {}), 110.0, 200.0));
    ASSERT_TRUE(found.simulated.has_value());
    EXPECT_TRUE(found.simulated->converged) << "seed " << seed;
    const Distance far = distance_of(*found.closed_form(), machine.card());
    const Distance near = distance_of(*found.shear(), machine.card());
    EXPECT_LT(near.mean, 0.03) << "seed " << seed;
    EXPECT_LT(near.greatest, 0.06) << "seed " << seed;
    EXPECT_GT(far.greatest, 2.0 * near.greatest) << "seed " << seed;
    covered += near.covered / seeds;
  }
  // stated at 95 %; neighbouring angles are alike, so that few seeds may miss several at once
  EXPECT_GT(covered, 0.85);
}

// Without scatter what is left is the difference between the user's run and the trials': the load of one end for the mean
// of both, another duration, windows of a degree.
TEST(SimulatedFit, WithoutScatterTheLawOfOneSpecimenComesBack) {
  Machine machine;
  machine.pull(80.0, 180.0, 2.0);
  const test::FitFolder folder;
  folder.write("base.toml", base_card());
  std::mt19937 random(1);
  const std::string files = machine.record(folder, 0, 1, random, {.between = 0.0, .reading = 0.0});
  const auto found = identified(folder, fit_head + bias_table("one", files, 80.0, 180.0));
  ASSERT_TRUE(found.simulated.has_value());
  EXPECT_TRUE(found.simulated->converged);
  EXPECT_LT(distance_of(*found.shear(), machine.card()).greatest, 0.03);
  EXPECT_LT(found.simulated->misfit, 0.01 * found.simulated->greatest_value);
  EXPECT_LE(found.simulated->runs, 16);
}

// One round is not enough from the closed form's law, and a user hears it.
TEST(SimulatedFit, ALawThatDoesNotComeToRestIsSaid) {
  Machine machine;
  machine.pull(80.0, 180.0, 2.0);
  const test::FitFolder folder;
  folder.write("base.toml", base_card());
  std::mt19937 random(1);
  const std::string files = machine.record(folder, 0, 1, random, {.between = 0.0, .reading = 0.0});
  const auto found = identified(folder, fit_head + std::string("rounds = 1\n") + bias_table("one", files, 80.0, 180.0));
  EXPECT_FALSE(found.simulated->converged);
  bool said = false;
  for (const auto& warning : found.warnings) said = said || warning.find("did not come to rest") != std::string::npos;
  EXPECT_TRUE(said);
}

// A rigid frame with stiff yarns is the closed form: nothing changes but for inertia.
TEST(SimulatedFit, OfAShearFrameTheClosedFormsLawStays) {
  const Card truth = read_card_text(truth_card, "card");
  const ShearFrame frame{170.0, 120.0};
  const test::FitFolder folder;
  folder.write("base.toml", base_card());
  std::vector<double> x, y;
  for (double angle = 0.5; angle <= 50.0; angle += 0.5) {
    x.push_back(frame_displacement(frame, angle * degree));
    y.push_back(frame_load(frame, truth.thickness * shear_stress(truth.shear, log_shear_strain(angle * degree)),
                           angle * degree));
  }
  folder.write_curve("frame.csv", x, y);
  const auto found =
      identified(folder, std::string("name = \"found\"\nbase = \"base.toml\"\n[shear]\nmethod = \"simulation\"\n") +
                             "[[shear_frame]]\nname = \"frame\"\nfiles = [\"frame.csv\"]\ndisplacement_column = \"x\"\n"
                             "force_column = \"y\"\nframe_length = 170\nfabric_length = 120\n");
  ASSERT_TRUE(found.simulated.has_value());
  EXPECT_TRUE(found.simulated->converged);
  EXPECT_LT(distance_of(*found.shear(), truth).greatest, 0.02);
}

}  // namespace
}  // namespace weaveform::identify
