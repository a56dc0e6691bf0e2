#include "post/convergence/convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/missing.hpp"

namespace weaveform {

namespace {

constexpr double safety = 1.25;          // Roache 1998, three levels
constexpr double cautious_safety = 3.0;  // Oberkampf & Roy 2010
constexpr double least_order = 0.5;

void check(const std::vector<Level>& levels) {
  for (const Level& level : levels) {
    if (!(level.size > 0.0) || !std::isfinite(level.size) || !std::isfinite(level.result))
      throw InputError(
          fmt::format("a level of size {} with result {} says nothing of convergence; sizes must be > 0, "
                      "results finite",
                      level.size, level.result));
  }
  for (std::size_t i = 1; i < levels.size(); ++i) {
    if (!(levels[i].size > levels[i - 1].size * (1.0 + 1e-9)))
      throw InputError(fmt::format("two levels have the size {}; each needs its own", levels[i].size));
  }
}

// (h3^p − h2^p)/(h2^p − h1^p) with both over h2^p; its limit for p → 0 is ln(h3/h2)/ln(h2/h1). Rises with p.
double ratio_of(double order, double log_fine, double log_coarse) {
  if (std::abs(order) < 1e-9) return log_coarse / log_fine;
  return std::expm1(order * log_coarse) / -std::expm1(-order * log_fine);
}

// The order with the given ratio of differences, sought from below zero up to where nothing finite differs any more.
double order_of(double ratio, double log_fine, double log_coarse) {
  double low = -20.0, high = 60.0 / log_coarse;
  if (ratio <= ratio_of(low, log_fine, log_coarse)) return low;
  if (ratio >= ratio_of(high, log_fine, log_coarse)) return high;
  for (int halving = 0; halving < 200 && high - low > 1e-13; ++halving) {
    const double middle = 0.5 * (low + high);
    (ratio_of(middle, log_fine, log_coarse) < ratio ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double relative(double distance, double scale) {
  return distance == 0.0 ? 0.0 : distance / scale;
}

// Uncertainty of levels that are not asymptotic, from what changed between them.
double without_order(double change, double log_fine) {
  return cautious_safety * change / std::expm1(least_order * log_fine);
}

Convergence without_limit(Trend trend, double order, double finest, double change, double log_fine) {
  const double uncertainty = without_order(change, log_fine);
  return {trend, order, finest, uncertainty, uncertainty / std::abs(finest)};
}

}  // namespace

std::string trend_words(Trend trend) {
  constexpr std::array words = {
      "monotone", "oscillating", "diverging", "slower than order 1/2", "faster than the scheme", "unchanging"};
  return words.at(static_cast<std::size_t>(trend));
}

Convergence converge(std::vector<Level> three, double greatest_order) {
  if (three.size() != 3) throw InputError(fmt::format("{} levels; an observed order needs three", three.size()));
  std::sort(three.begin(), three.end(), [](const Level& a, const Level& b) { return a.size < b.size; });
  check(three);
  const double f1 = three[0].result, f2 = three[1].result, f3 = three[2].result;
  const double log_fine = std::log(three[1].size / three[0].size), log_coarse = std::log(three[2].size / three[1].size);
  const double fine = f2 - f1, coarse = f3 - f2;
  const double spread = std::max({f1, f2, f3}) - std::min({f1, f2, f3});
  const double rounding = 1e-12 * std::max({std::abs(f1), std::abs(f2), std::abs(f3)});
  if (spread <= rounding) return {Trend::unchanging, missing, f1, rounding, f1 == 0.0 ? 0.0 : rounding / std::abs(f1)};
  if (std::abs(fine) <= rounding || coarse / fine <= 0.0)
    return without_limit(Trend::oscillating, missing, f1, spread, log_fine);
  const double order = order_of(coarse / fine, log_fine, log_coarse);
  if (order <= 0.0) return without_limit(Trend::diverging, missing, f1, std::abs(fine), log_fine);
  if (order < least_order) return without_limit(Trend::slow, order, f1, std::abs(fine), log_fine);
  const bool too_fast = order > greatest_order * (1.0 + 1e-6);
  const double correction = -fine / std::expm1(std::min(order, greatest_order) * log_fine);
  const double factor = too_fast ? cautious_safety : safety;
  return {too_fast ? Trend::fast : Trend::monotone, order, f1 + correction, (factor - 1.0) * std::abs(correction),
          factor * std::abs(correction) / std::abs(f1)};
}

Refinement refine(std::vector<Level> levels, double greatest_order, double scale) {
  if (levels.size() < 3) throw InputError(fmt::format("{} levels; an observed order needs three", levels.size()));
  std::sort(levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.size < b.size; });
  check(levels);
  Refinement refinement;
  std::vector<Convergence> neighbours;
  for (auto first = levels.begin(); levels.end() - first >= 3; ++first)
    neighbours.push_back(converge({first, first + 3}, greatest_order));
  for (const Convergence& each : neighbours) refinement.order.push_back(each.order);
  refinement.finest = neighbours.front();
  if (neighbours.size() > 1) {
    const Convergence &fine = neighbours[0], &coarse = neighbours[1];
    refinement.checked = true;
    const auto asymptotic = [](Trend trend) { return trend == Trend::monotone || trend == Trend::unchanging; };
    refinement.agreed =
        asymptotic(fine.trend) && asymptotic(coarse.trend) &&
        std::abs(fine.limit - coarse.limit) <= fine.uncertainty + coarse.uncertainty + 1e-12 * std::abs(fine.limit);
  }
  refinement.limit = refinement.finest.limit;
  refinement.uncertainty = refinement.finest.uncertainty;
  if (!refinement.agreed) {
    const double f1 = levels[0].result, log_fine = std::log(levels[1].size / levels[0].size);
    refinement.uncertainty =
        std::max({refinement.uncertainty, (cautious_safety - 1.0) * std::abs(f1 - refinement.limit),
                  without_order(std::abs(levels[1].result - f1), log_fine)});
    if (refinement.checked) refinement.limit = f1;
  }
  const double unit = scale > 0.0 ? scale : std::abs(refinement.limit);
  for (const Level& level : levels)
    refinement.error_bound.push_back(
        relative(std::abs(level.result - refinement.limit) + refinement.uncertainty, unit));
  refinement.level = std::move(levels);
  return refinement;
}

int coarsest_within(const Refinement& refinement, double tolerance) {
  int coarsest = -1;
  for (std::size_t i = 0; i < refinement.level.size() && refinement.error_bound[i] <= tolerance; ++i)
    coarsest = static_cast<int>(i);
  return coarsest;
}

std::vector<std::size_t> pareto_front(const std::vector<double>& time, const std::vector<double>& error) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < std::min(time.size(), error.size()); ++i)
    if (std::isfinite(time[i]) && std::isfinite(error[i])) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return time[a] != time[b] ? time[a] < time[b] : error[a] < error[b];
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || error[i] < error[front.back()]) front.push_back(i);
  return front;
}

}  // namespace weaveform
