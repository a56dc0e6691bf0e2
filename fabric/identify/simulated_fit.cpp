#include "fabric/identify/simulated_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "fabric/identify/decrimping.hpp"
#include "fabric/identify/statistics.hpp"

namespace weaveform::identify {
namespace {

constexpr double least_way = 1.0 / 16.0;  // of a round's correction: with less of it, no law is better
constexpr double crimp_step = 0.02;       // 1; of the factor, for its derivative
const double log_reach = std::log(1.5);   // of the factor, in one round
constexpr std::array<double, 2> crimp_factors = {0.1, 10.0};

// A law with what was simulated with it.
struct Trial {
  ShearCurve curve;
  double end = 0.0;     // 1; strain beyond which the card's tangent keeps its value
  double factor = 1.0;  // on the crimp
  std::vector<SimulatedCurve> loads;
  double misfit = 0.0;
};

bool same_size(const std::variant<BiasRectangle, ShearFrame>& a, const std::variant<BiasRectangle, ShearFrame>& b) {
  if (a.index() != b.index()) return false;
  if (const auto* one = std::get_if<BiasRectangle>(&a)) {
    const auto& other = std::get<BiasRectangle>(b);
    return one->width == other.width && one->length == other.length;
  }
  const auto &one = std::get<ShearFrame>(a), &other = std::get<ShearFrame>(b);
  return one.frame_length == other.frame_length && one.fabric_length == other.fabric_length;
}

double travel_at(const std::variant<BiasRectangle, ShearFrame>& specimen, double angle) {
  if (const auto* rectangle = std::get_if<BiasRectangle>(&specimen)) return bias_travel(*rectangle, angle);
  return frame_displacement(std::get<ShearFrame>(specimen), angle);
}

ShearCard shear_card(const ShearCurve& curve, double end) {
  ShearCard card;
  card.tangent = TangentLaw({{0.0, end, derivative_of(curve.stress)}});
  if (curve.start.plateau > 0.0) card.start = curve.start;
  card.valid_to_deg = std::asin(std::tanh(end)) / degree;
  return card;
}

double change_between(const ShearCurve& a, const ShearCurve& b, double end) {
  constexpr int points = 50;
  double change = 0.0, greatest = 0.0;
  for (int i = 1; i <= points; ++i) {
    const double strain = end * i / points;
    change = std::max(change, std::abs(stress_of(a, strain) - stress_of(b, strain)));
    greatest = std::max(greatest, stress_of(b, strain));
  }
  return change / greatest;
}

const char* mesh_name(TrialMesh mesh) {
  return mesh == TrialMesh::coarse ? "coarse mesh" : "fine mesh";
}

class Rounds {
public:
  Rounds(const ShearFit& closed, const FitSpec& spec, const Card& card, const Simulation& simulation)
      : specimens_(closed.specimens), spec_(spec), card_(card), simulation_(simulation), form_(spec.shear.form) {
    make_tests();
  }

  // One law after another, each from the best so far, until they come to rest. What is given back is the best.
  Trial come_to_rest(TrialMesh mesh, const ShearCurve& curve, double end, double factor, bool& at_rest) {
    Trial best = simulated(curve, end, factor, mesh);
    double way = 1.0;
    at_rest = false;
    for (int round = 1; round <= spec_.simulation.rounds; ++round) {
      double next_factor = best.factor;
      const ShearFit whole = fitted(best, 1.0, next_factor);
      // one form from the first simulated loads on, so that rounds do not go to and fro between two
      form_ = whole.start_chosen ? FormAsked::polynomial_start : FormAsked::polynomial;
      const double change = change_between(best.curve, whole.chosen().pooled.curve, strain_reached(best)) +
                            std::abs(next_factor / best.factor - 1.0);
      note(mesh, best, change);
      at_rest = 100.0 * change < spec_.simulation.tolerance;
      if (at_rest || way < least_way || round == spec_.simulation.rounds) break;
      double factor_tried = best.factor;
      const ShearFit fit = way < 1.0 ? fitted(best, way, factor_tried) : whole;
      if (way == 1.0) factor_tried = next_factor;
      Trial next = simulated(fit.chosen().pooled.curve, fit.end, factor_tried, mesh);
      way = next.misfit < best.misfit ? std::min(1.0, 2.0 * way) : 0.5 * way;
      if (next.misfit < best.misfit) best = std::move(next);
    }
    return best;
  }

  // The law that follows from a trial, with the factor on the crimp beside it.
  [[nodiscard]] ShearFit fitted(const Trial& trial, double way, double& factor) const {
    double log_ratio = 0.0;
    std::vector<ShearSpecimen> seen = linearised(trial, way, 0.0);
    if (spec_.simulation.decrimping) {
      log_ratio = best_log_ratio(trial, way, everyone());
      seen = linearised(trial, way, log_ratio);
    }
    factor = trial.factor * std::exp(log_ratio);
    return fit_shear(std::move(seen), spec_.shear.degree, form_, spec_.confidence(), law_angles(trial));
  }

  Trial simulated(const ShearCurve& curve, double end, double factor, TrialMesh mesh) {
    Trial trial{curve, end, factor, {}, 0.0};
    TriedFabric fabric{spec_.simulation.decrimping ? with_decrimping(card_, factor) : card_, std::nullopt, 0.0};
    fabric.card.shear = shear_card(curve, end);
    if (spec_.simulation.decrimping) {
      fabric.step = crimp_step * factor;
      fabric.decrimped = std::array<Card, 2>{with_decrimping(card_, factor - fabric.step),
                                             with_decrimping(card_, factor + fabric.step)};
    }
    for (const SimulatedTest& test : tests_) {
      trial.loads.push_back(simulation_.run(test, fabric, mesh));
      runs_ += trial.loads.back().runs;
    }
    double squares = 0.0, count = 0.0;
    for (std::size_t k = 0; k < specimens_.size(); ++k)
      for (std::size_t i = 0; i < specimens_[k].grid.size(); ++i, count += 1.0)
        squares += std::pow(specimens_[k].grid[i].value - value_of(trial, k, i), 2);
    trial.misfit = std::sqrt(squares / count);
    return trial;
  }

  // MPa or N; what the specimen k shows in the trial at point i of the grid.
  [[nodiscard]] double value_of(const Trial& trial, std::size_t k, std::size_t i) const {
    return unit(k, i) * trial.loads[test_of_[k]].at[i].load;
  }
  [[nodiscard]] std::vector<std::vector<double>> values_of(const Trial& trial) const {
    std::vector<std::vector<double>> values(specimens_.size());
    for (std::size_t k = 0; k < specimens_.size(); ++k)
      for (std::size_t i = 0; i < specimens_[k].grid.size(); ++i) values[k].push_back(value_of(trial, k, i));
    return values;
  }
  // 1; of the middle of the specimen that is sheared least.
  [[nodiscard]] static double strain_reached(const Trial& trial) {
    double angle = HUGE_VAL;
    for (const auto& curve : trial.loads) angle = std::min(angle, curve.at.back().angle);
    return log_shear_strain(angle);
  }

  [[nodiscard]] Decrimping decrimping_of(const Trial& trial) const {
    const double middle = std::log(trial.factor) + best_log_ratio(trial, 1.0, everyone());
    double half = 0.0;
    if (specimens_.size() > 1) {
      std::vector<double> logs;
      for (std::size_t k = 0; k < specimens_.size(); ++k) logs.push_back(best_log_ratio(trial, 1.0, {k}));
      const auto count = static_cast<double>(logs.size());
      half = student_t(spec_.confidence(), count - 1.0) * deviation_of(logs) / std::sqrt(count);
    } else {
      half = half_band_of_one(trial);
    }
    return {std::exp(middle),
            {std::max(crimp_factors[0], std::exp(middle - half)), std::min(crimp_factors[1], std::exp(middle + half))}};
  }

  [[nodiscard]] const std::vector<SimulatedTest>& tests() const { return tests_; }
  [[nodiscard]] const std::vector<std::size_t>& test_of() const { return test_of_; }
  [[nodiscard]] const std::vector<SimulationRound>& rounds() const { return rounds_; }
  [[nodiscard]] int runs() const { return runs_; }

private:
  // Specimens of one size share their runs, for they share the grid of angles.
  void make_tests() {
    const double step = spec_.shear.angle_step * degree;
    for (const ShearSpecimen& specimen : specimens_) {
      SimulatedTest test{.number = static_cast<int>(tests_.size()), .specimen = BiasRectangle{}, .window = {}};
      if (specimen.rectangle)
        test.specimen = *specimen.rectangle;
      else
        test.specimen = *specimen.frame;
      const auto known = std::find_if(tests_.begin(), tests_.end(), [&](const SimulatedTest& other) {
        return same_size(other.specimen, test.specimen);
      });
      test_of_.push_back(static_cast<std::size_t>(known - tests_.begin()));
      if (known != tests_.end()) continue;
      for (const ShearObservation& seen : specimen.grid)
        test.window.push_back({travel_at(test.specimen, std::max(0.0, seen.angle - 0.5 * step)),
                               travel_at(test.specimen, seen.angle + 0.5 * step)});
      tests_.push_back(std::move(test));
    }
  }

  // MPa or N of a specimen's value per newton of load.
  [[nodiscard]] double unit(std::size_t k, std::size_t i) const {
    const auto* frame = std::get_if<ShearFrame>(&tests_[test_of_[k]].specimen);
    if (frame == nullptr) return 1.0;
    return normalised_shear_force(*frame, 1.0, specimens_[k].grid[i].angle) / spec_.thickness();
  }

  // The specimens with the loads that a law near the trial's would give, its factor on the crimp changed by
  // exp(log_ratio). `way` < 1: only so far from the simulated values to the measured ones.
  [[nodiscard]] std::vector<ShearSpecimen> linearised(const Trial& trial, double way, double log_ratio) const {
    std::vector<ShearSpecimen> seen = specimens_;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      for (std::size_t i = 0; i < seen[k].grid.size(); ++i) {
        ShearObservation& at = seen[k].grid[i];
        const SimulatedLoad& load = trial.loads[test_of_[k]].at[i];
        const double scale = unit(k, i), value = scale * load.load;
        at.counted = load.weight;
        double borne = 0.0;  // by shear
        for (StressWeight& one : at.counted) {
          one.weight *= scale;
          borne += one.weight * stress_of(trial.curve, one.strain);
        }
        at.shift = value - borne + scale * load.decrimping * trial.factor * (std::exp(log_ratio) - 1.0);
        at.value = value + way * (at.value - value);
      }
    }
    return seen;
  }

  [[nodiscard]] std::vector<double> law_angles(const Trial& trial) const {
    const double step = spec_.shear.angle_step * degree, reached = std::asin(std::tanh(strain_reached(trial)));
    std::vector<double> angles;
    for (int i = 1; i * step <= reached; ++i) angles.push_back(i * step);
    if (angles.empty())
      throw InputError(
          fmt::format("{}: the simulated specimen is sheared by {:.2g} deg only; is its size right, and are its yarns "
                      "stiff enough to shear it?",
                      spec_.file, reached / degree));
    return angles;
  }

  [[nodiscard]] std::vector<std::size_t> everyone() const {
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < specimens_.size(); ++k) all.push_back(k);
    return all;
  }

  // Sum of squared residuals of those specimens at the law that fits them best with that factor.
  [[nodiscard]] double squares_at(const Trial& trial, double way, const std::vector<std::size_t>& who,
                                  double log_ratio) const {
    const auto seen = linearised(trial, way, log_ratio);
    std::vector<ShearObservation> all;
    for (const std::size_t k : who) all.insert(all.end(), seen[k].grid.begin(), seen[k].grid.end());
    return fit_shear_curve(all, {spec_.shear.degree, form_ == FormAsked::polynomial_start}).squares;
  }

  // Least squares over a row of ratios, and the vertex of the parabola through the best and its neighbours.
  [[nodiscard]] double best_log_ratio(const Trial& trial, double way, const std::vector<std::size_t>& who) const {
    constexpr int ratios = 16;
    const double from = std::max(-log_reach, std::log(crimp_factors[0] / trial.factor));
    const double to = std::min(log_reach, std::log(crimp_factors[1] / trial.factor));
    std::vector<double> squares;
    for (int i = 0; i <= ratios; ++i) squares.push_back(squares_at(trial, way, who, from + (to - from) * i / ratios));
    const auto best = std::min_element(squares.begin(), squares.end()) - squares.begin();
    const double step = (to - from) / ratios;
    if (best == 0 || best == ratios) return from + step * static_cast<double>(best);
    const double below = squares[best - 1], above = squares[best + 1];
    const double bend = below - 2.0 * squares[best] + above;
    return from + step * (static_cast<double>(best) + (bend > 0.0 ? 0.5 * (below - above) / bend : 0.0));
  }

  // One specimen has its residuals alone: the factor's variance is that of a value, of which the correlated ones are
  // worth so many, over half the second derivative of the sum of squares.
  [[nodiscard]] double half_band_of_one(const Trial& trial) const {
    constexpr double step = 0.1;
    double factor = 1.0;
    const ShearFit fit = fitted(trial, 1.0, factor);
    std::vector<double> residuals;
    for (const auto& seen : fit.specimens.front().grid)
      residuals.push_back(seen.value - predicted(fit.chosen().pooled.curve, seen));
    const int parameters = fit.chosen().form.parameters() + 1;
    const auto count = static_cast<double>(residuals.size());
    const double worth = effective_count(count, neighbour_correlation(residuals, parameters));
    const double freedom = std::max(1.0, worth - parameters);
    const double at = std::log(factor / trial.factor);
    const auto squares = [&](double log_ratio) { return squares_at(trial, 1.0, {0}, log_ratio); };
    const double bend = (squares(at - step) - 2.0 * squares(at) + squares(at + step)) / (step * step);
    const double variance = squares(at) / count * (worth / freedom);
    if (!(bend > 0.0)) return std::log(crimp_factors[1]);
    return student_t(spec_.confidence(), freedom) * std::sqrt(variance / (0.5 * bend) * (count / worth));
  }

  void note(TrialMesh mesh, const Trial& trial, double change) {
    rounds_.push_back({mesh, trial.misfit, change, trial.factor});
    if (simulation_.tell)
      simulation_.tell(fmt::format(
          "simulation, {}, {} runs so far: loads differ by {:.3g} {} (root mean square), the "
          "law would change by {:.2g} %",
          mesh_name(mesh), runs_, trial.misfit, specimens_.front().rectangle ? "N" : "MPa", 100.0 * change));
  }

  std::vector<ShearSpecimen> specimens_;
  const FitSpec& spec_;
  const Card& card_;
  const Simulation& simulation_;
  FormAsked form_;
  std::vector<SimulatedTest> tests_;
  std::vector<std::size_t> test_of_;
  std::vector<SimulationRound> rounds_;
  int runs_ = 0;
};

void warn_of_simulation(SimulatedFit& found, const FitSpec& spec) {
  const auto warn = [&](std::string text) { found.warnings.push_back(std::move(text)); };
  if (!found.converged)
    warn(
        fmt::format("the law did not come to rest: after {} rounds it would still change by {:.2g} % of its greatest "
                    "stress, {:.3g} % being asked; simulated loads differ from the measured ones by {:.2g} % of the "
                    "greatest (root mean square)",
                    found.round.size(), 100.0 * found.round.back().change, spec.simulation.tolerance,
                    100.0 * found.misfit / found.greatest_value));
  constexpr double poor = 0.05;  // of the greatest value: no measurement scatters as much within a specimen
  if (found.converged && found.misfit > poor * found.greatest_value)
    warn(
        fmt::format("no law of this form gives the measured loads: the best one leaves {:.2g} % of the greatest (root "
                    "mean square)",
                    100.0 * found.misfit / found.greatest_value));
  if (!found.decrimping) return;
  const auto& [factor, band] = *found.decrimping;
  constexpr double told = 2.0;  // widest band, upper over lower end, that is worth the name
  if (band[1] / band[0] > told || factor <= 1.05 * crimp_factors[0] || factor >= 0.95 * crimp_factors[1])
    warn(
        fmt::format("the loads hardly tell decrimping from shear: the factor on the crimp is {:.3g}, between {:.3g} "
                    "and {:.3g}; measured angles, or specimens of other sizes, would tell",
                    factor, band[0], band[1]));
}

}  // namespace

Card with_decrimping(Card card, double factor) {
  for (YarnCard& yarn : card.yarn) {
    const double valid = yarn.tension.stress(yarn.valid_to), tearing = yarn.tension.stress(yarn.tearing_strain);
    yarn.tension = TangentLaw(decrimping_law(yarn.linear_modulus, factor * yarn.crimp));
    yarn.valid_to = strain_at_stress(yarn.tension, valid);
    yarn.tearing_strain = strain_at_stress(yarn.tension, tearing);
  }
  return card;
}

SimulatedFit fit_simulated(const ShearFit& closed, const FitSpec& spec, const Card& card,
                           const Simulation& simulation) {
  Rounds rounds(closed, spec, card, simulation);
  SimulatedFit found;
  found.test = rounds.tests();
  found.test_of = rounds.test_of();
  const ShearCurve begin = closed.chosen().pooled.curve;
  bool rested_coarse = false, rested_fine = false;
  const Trial coarse = rounds.come_to_rest(TrialMesh::coarse, begin, closed.end, 1.0, rested_coarse);
  const Trial fine = rounds.come_to_rest(TrialMesh::fine, coarse.curve, coarse.end, coarse.factor, rested_fine);
  double factor = fine.factor;
  found.fit = rounds.fitted(fine, 1.0, factor);
  const ShearCurve& curve = found.fit.chosen().pooled.curve;
  found.mesh_change = change_between(coarse.curve, curve, Rounds::strain_reached(fine));
  if (spec.simulation.decrimping) found.decrimping = rounds.decrimping_of(fine);
  // what the law of the closed form gives, and the one found, on the same mesh
  const Trial before = rounds.simulated(begin, closed.end, 1.0, TrialMesh::fine);
  const Trial after = rounds.simulated(curve, found.fit.end, factor, TrialMesh::fine);
  found.begun = rounds.values_of(before);
  found.ended = rounds.values_of(after);
  found.last = after.loads;
  found.misfit = after.misfit;
  found.round = rounds.rounds();
  found.runs = rounds.runs();
  found.converged = rested_coarse && rested_fine;
  for (const auto& specimen : closed.specimens)
    for (const auto& seen : specimen.grid) found.greatest_value = std::max(found.greatest_value, seen.value);
  found.warnings.insert(found.warnings.end(), found.fit.warnings.begin(), found.fit.warnings.end());
  warn_of_simulation(found, spec);
  return found;
}

}  // namespace weaveform::identify
