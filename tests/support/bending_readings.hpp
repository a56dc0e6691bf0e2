// Synthetic tests of bending, made from a known law: tables of a machine and shapes of hanging strips (by the tests' own
// integration of the elastica), the fits that read them, and how near a fit comes.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/support/elastica.hpp"
#include "tests/support/fit_folder.hpp"

namespace weaveform::test {

// Per width, N mm and 1/mm: a fabric that yields, with the weight of the base card (7.455e-6 N/mm^2).
inline const identify::BendingCurve bending_truth{{0.0, 0.004, 0.006, 0.03}, {12.0, 11.0, 3.0, 1.0}};
inline double base_weight() {
  static const double weight = load_card("twintex-pw").area_density() * 9806.65;
  return weight;
}

inline const std::string head_of_fit = "name = 'a'\nbase = 'twintex-pw'\n";
inline std::string table_fit(const std::string& files, const std::string& more = "") {
  return head_of_fit + "[[moment_curvature]]\nname = 'bend'\nfiles = [" + files +
         "]\ncurvature_column = 'x'\ncurvature_unit = '1/mm'\nmoment_column = 'y'\nmoment_unit = 'N'\n" + more;
}
inline std::string strip_fit(const std::string& files, const std::string& more = "") {
  return head_of_fit + "[[cantilever]]\nname = 'strip'\nfiles = [" + files + "]\nx_column = 'x'\ny_column = 'y'\n" +
         more;
}

struct Points {
  std::vector<double> x, y;
};

// What a machine would record up to 0.03 1/mm.
inline Points table(double factor, double noise, std::mt19937& random) {
  Points points;
  const auto readings = correlated_noise(random, 150, 0.5);
  for (int i = 0; i < 150; ++i) {
    points.x.push_back(0.03 * i / 149);
    points.y.push_back(factor * bending_truth.moment(points.x.back()) + noise * readings[i]);
  }
  return points;
}

// Every 2 mm along the strip, with noise in both coordinates.
inline Points digitised(const RodShape& shape, double overhang, double noise, std::mt19937& random) {
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
inline Points profile(double overhang, double factor, double noise, std::mt19937& random) {
  const Rod rod{.length = overhang,
                .curvature = [factor](double moment) { return bending_truth.curvature(moment / factor); },
                .weight = base_weight()};
  const auto shape = solve_rod(rod, 1000);
  return digitised(shape, overhang, noise, random);
}

// Share of the law's places whose interval holds the bending_truth.
inline double covered(const identify::BendingFit& fit, double to = 1.0, double factor = 1.0) {
  double inside = 0.0, count = 0.0;
  for (const auto& at : fit.law) {
    if (at.curvature > to * fit.law.back().curvature) continue;
    inside += std::abs(at.moment - factor * bending_truth.moment(at.curvature)) <= at.half_band ? 1.0 : 0.0;
    count += 1.0;
  }
  return inside / count;
}

inline double worst_error(const identify::BendingFit& fit) {
  double worst = 0.0;
  for (const auto& at : fit.law)
    worst = std::max(worst, std::abs(at.moment - bending_truth.moment(at.curvature)) /
                                bending_truth.moment(fit.law.back().curvature));
  return worst;
}

}  // namespace weaveform::test
