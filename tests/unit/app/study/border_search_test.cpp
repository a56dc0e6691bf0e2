// Bisection for a border that is known: replayed from its answers, as after an interruption.
#include "app/study/border_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace weaveform::study {
namespace {

BorderSpec between(double holds, double fails, BisectionScale scale = BisectionScale::linear) {
  BorderSpec spec;
  spec.holds = holds;
  spec.fails = fails;
  spec.scale = scale;
  return spec;
}

// Answers what the search wants, one call after the other, as a study does that is stopped after every case.
BorderSearch search_by_steps(const BorderSpec& spec, const std::function<bool(double)>& method) {
  std::map<double, bool> known;
  const HoldsAt holds_at = [&](double value) -> std::optional<bool> {
    return known.contains(value) ? std::optional(known.at(value)) : std::nullopt;
  };
  BorderSearch search = search_border(spec, holds_at);
  for (int i = 0; i < 200 && !search.wanted.empty(); ++i) {
    for (const double value : search.wanted) known[value] = method(value);
    search = search_border(spec, holds_at);
  }
  EXPECT_EQ(search.tried.size(), known.size()) << "no case is run that the search does not tell of";
  return search;
}

TEST(BorderSearch, FindsTheBorderFromEitherSide) {
  for (const double border : {0.9001, 1.0, 1.7, 2.999}) {
    const BorderSearch up = search_by_steps(between(0.9, 3.0), [&](double value) { return value < border; });
    EXPECT_LT(up.holds, border);
    EXPECT_GE(up.fails, border);
    EXPECT_LE(up.fails - up.holds, 0.02 * up.fails) << border;
    const BorderSearch down = search_by_steps(between(3.0, 0.9), [&](double value) { return value > border; });
    EXPECT_GT(down.holds, border);
    EXPECT_LE(down.fails, border);
    EXPECT_LE(down.holds - down.fails, 0.02 * down.holds) << border;
  }
}

TEST(BorderSearch, LogarithmicSpansDecadesInFewSteps) {
  BorderSpec spec = between(1e-3, 1e3, BisectionScale::logarithmic);
  const BorderSearch search = search_by_steps(spec, [](double value) { return value < 0.02; });
  EXPECT_LE(std::log(search.fails / search.holds), 0.02);
  EXPECT_LT(search.holds, 0.02);
  EXPECT_GE(search.fails, 0.02);
  EXPECT_LE(search.tried.size(), 12U) << "ln(10^6) halved to 0.02: ten times";
}

TEST(BorderSearch, ABorderAtZeroEndsTheSearchToo) {
  const BorderSearch search = search_by_steps(between(0.0, 1.0), [](double value) { return value <= 0.0; });
  EXPECT_EQ(search.holds, 0.0);
  EXPECT_LE(search.fails, 1e-6);
}

TEST(BorderSearch, BothEndsAreWantedFirstAndThenOneAtATime) {
  const BorderSpec spec = between(1.0, 2.0);
  EXPECT_EQ(search_border(spec, [](double) { return std::nullopt; }).wanted, (std::vector<double>{1.0, 2.0}));
  const HoldsAt ends = [](double value) -> std::optional<bool> {
    return value == 1.0 || value == 2.0 ? std::optional(value < 1.5) : std::nullopt;
  };
  EXPECT_EQ(search_border(spec, ends).wanted, std::vector<double>{1.5});
}

TEST(BorderSearch, WithoutABorderSaysWhy) {
  const auto complaint = [](const std::function<bool(double)>& method) {
    const BorderSearch search = search_by_steps(between(1.0, 2.0), method);
    EXPECT_EQ(search.tried.size(), 2U);
    return search.complaint;
  };
  EXPECT_NE(complaint([](double) { return true; }).find("it holds on both ends"), std::string::npos);
  EXPECT_NE(complaint([](double) { return false; }).find("it fails on both ends"), std::string::npos);
  EXPECT_NE(complaint([](double value) { return value > 1.5; }).find("exchange them"), std::string::npos);
}

}  // namespace
}  // namespace weaveform::study
