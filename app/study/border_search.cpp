#include "app/study/border_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace weaveform::study {

namespace {

constexpr double least_share = 1e-6;  // of the first bracket

double six_digits(double value) {
  return std::stod(fmt::format("{:.6g}", value));
}

bool is_narrow(const BorderSpec& spec, double holds, double fails) {
  if (spec.scale == BisectionScale::logarithmic) return std::abs(std::log(fails / holds)) <= spec.tolerance;
  const double gap = std::abs(fails - holds);
  return gap <= spec.tolerance * std::max(std::abs(holds), std::abs(fails)) ||
         gap <= least_share * std::abs(spec.fails - spec.holds);
}

std::string no_border(const BorderSpec& spec, bool holds, bool fails) {
  const std::string between = fmt::format("no border between {:g} and {:g}: ", spec.holds, spec.fails);
  if (holds && !fails) return between + fmt::format("it holds on both ends; move 'fails' on from {:g}", spec.fails);
  if (!holds && fails) return between + fmt::format("it fails on both ends; move 'holds' on from {:g}", spec.holds);
  return between + "it fails at the 'holds' end and holds at the 'fails' end; exchange them";
}

}  // namespace

double border_between(const BorderSpec& spec, double holds, double fails) {
  if (spec.scale == BisectionScale::logarithmic) return std::sqrt(holds) * std::sqrt(fails);
  return 0.5 * (holds + fails);
}

BorderSearch search_border(const BorderSpec& spec, const HoldsAt& holds_at) {
  BorderSearch search{spec.holds, spec.fails, {spec.holds, spec.fails}, {}, ""};
  const auto at_holds = holds_at(spec.holds), at_fails = holds_at(spec.fails);
  if (!at_holds) search.wanted.push_back(spec.holds);
  if (!at_fails) search.wanted.push_back(spec.fails);
  if (!search.wanted.empty()) return search;
  if (!*at_holds || *at_fails) {
    search.complaint = no_border(spec, *at_holds, !*at_fails);
    return search;
  }
  while (!is_narrow(spec, search.holds, search.fails)) {
    const double middle = six_digits(border_between(spec, search.holds, search.fails));
    if (middle == search.holds || middle == search.fails) return search;
    search.tried.push_back(middle);
    const auto answer = holds_at(middle);
    if (!answer) {
      search.wanted.push_back(middle);
      return search;
    }
    (*answer ? search.holds : search.fails) = middle;
  }
  return search;
}

}  // namespace weaveform::study
