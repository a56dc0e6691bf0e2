// Synthetic tests for identification: a folder of test files with known laws behind them, and noise as machines make
// it.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "fabric/identify/identify.hpp"
#include "tests/support/temporary_folder.hpp"

namespace weaveform::test {

class FitFolder {
public:
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_.path() / name) << text; }
  // Two columns "x,y" under a heading.
  void write_curve(const std::string& name, const std::vector<double>& x, const std::vector<double>& y) const {
    std::string text = "x,y\n";
    for (std::size_t i = 0; i < x.size(); ++i) text += fmt::format("{:.12g},{:.12g}\n", x[i], y[i]);
    write(name, text);
  }
  // The fit file's text, with paths beside it, to its answer.
  [[nodiscard]] identify::Identification identify(const std::string& fit_text) const {
    return identify::identify(identify::read_fit_text(fit_text, (folder_.path() / "fit.toml").string()));
  }
  // What it complains about, lines joined; "" when it does not.
  [[nodiscard]] std::string complaint(const std::string& fit_text) const {
    try {
      (void)identify(fit_text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }

private:
  TemporaryFolder folder_;
};

inline std::vector<double> evenly(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(from + (to - from) * i / (count - 1));
  return values;
}

// First-order autoregressive noise of unit deviation: neighbouring readings of one specimen are alike.
inline std::vector<double> correlated_noise(std::mt19937& random, std::size_t count, double correlation) {
  std::normal_distribution<double> normal;
  std::vector<double> noise;
  double last = normal(random);
  for (std::size_t i = 0; i < count; ++i) {
    noise.push_back(last);
    last = correlation * last + std::sqrt(1.0 - correlation * correlation) * normal(random);
  }
  return noise;
}

}  // namespace weaveform::test
