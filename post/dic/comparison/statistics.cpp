#include "post/dic/comparison/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/missing.hpp"
#include "core/vector/angle.hpp"
#include "post/measure/zones.hpp"

namespace weaveform::dic {
namespace {

// Linear between the sorted values (the median of an even number is the mean of the middle two).
double percentile_of(const std::vector<double>& sorted, double percent) {
  const double at = percent / 100.0 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

// Standard uncertainty of the mean difference: to first order it is a weighted sum of the displacements of all points,
//   mean = sum_j s_j . u_j,  s_j = (1/n) sum_i sensitivity_i (row of point j in the fit of window i),
// so u(mean)^2 = u^2 sum_j |s_j|^2, with all that overlapping windows have in common.
double uncertainty_of_mean(const StageFields& fields, const std::vector<int>& counted, const YarnDirections& yarns) {
  if (fields.fit.empty() || counted.empty()) return missing;
  const PointSet& points = *fields.points;
  std::vector<Vec3> weight(points.point.size(), Vec3{0.0, 0.0, 0.0});
  for (const int i : counted) {
    const WindowFit& fit = fields.fit[i];
    const auto sensitivity = angle_sensitivity(fit.gradient, yarns);
    for (int k = points.neighbours.offset[i]; k < points.neighbours.offset[i + 1]; ++k) {
      const int j = points.neighbours.point[k];
      if (!fields.valid[j]) continue;
      const Eigen::Vector3d row(1.0, points.point[j][0] - points.point[i][0], points.point[j][1] - points.point[i][1]);
      const Eigen::Vector2d gradient = fit.inverse.bottomRows<2>() * row;
      for (int c = 0; c < fields.components; ++c)
        weight[j][static_cast<std::size_t>(c)] += sensitivity.row(c).dot(gradient);
    }
  }
  double square = 0.0;
  for (const Vec3& w : weight) square += w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
  return fields.displacement_uncertainty * std::sqrt(square) / static_cast<double>(counted.size());
}

}  // namespace

Zones zones_of_points(const Scene& scene, const std::vector<ZoneSpec>& boxes, const std::vector<Vec2>& points) {
  Zones zones;
  if (const auto specimen = find_bias_extension(scene)) {
    zones.name = {"A", "B", "C"};
    zones.point.resize(3);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2& p = points[i];
      const Zone zone = zone_of_point(*specimen, p[static_cast<std::size_t>(1 - specimen->axis)],
                                      p[static_cast<std::size_t>(specimen->axis)]);
      if (zone != Zone::straddling) zones.point[static_cast<std::size_t>(zone)].push_back(static_cast<int>(i));
    }
  }
  for (const ZoneSpec& spec : boxes) {
    zones.name.push_back(spec.name);
    auto& inside = zones.point.emplace_back();
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i][0] >= spec.box[0] && points[i][0] <= spec.box[2] && points[i][1] >= spec.box[1] &&
          points[i][1] <= spec.box[3])
        inside.push_back(static_cast<int>(i));
  }
  return zones;
}

FieldStatistics field_statistics(const std::string& name, const StageFields& fields, const std::vector<int>& points,
                                 double coverage, const YarnDirections& yarns) {
  FieldStatistics s;
  s.name = name;
  std::vector<int> counted;
  for (const int i : points)
    if (std::isfinite(fields.difference[i]) && std::isfinite(fields.raw[i])) counted.push_back(i);
  s.points = static_cast<int>(counted.size());
  if (counted.empty()) {
    s.measured = s.levelled = s.raw = s.mean = s.rms = s.sd = s.greatest = s.noise = s.mean_noise = s.within = missing;
    s.correlation = s.slope = missing;
    s.percentile.fill(missing);
    return s;
  }
  const auto n = static_cast<double>(counted.size());
  std::vector<double> difference;
  bool known = true;
  for (const int i : counted) {
    const double d = fields.difference[i], u = fields.uncertainty[i];
    difference.push_back(d);
    s.measured += fields.measured[i] / n;
    s.levelled += fields.levelled[i] / n;
    s.raw += fields.raw[i] / n;
    s.mean += d / n;
    s.rms += d * d / n;
    s.noise += u * u / n;
    known = known && std::isfinite(u);
    if (std::abs(d) <= coverage * u) s.within += 1.0 / n;
    if (std::abs(d) > std::abs(s.greatest)) {
      s.greatest = d;
      s.greatest_at = fields.points->point[i];
    }
  }
  double product = 0.0, measured_square = 0.0, levelled_square = 0.0;
  for (const int i : counted) {
    const double m = fields.measured[i] - s.measured, l = fields.levelled[i] - s.levelled;
    product += m * l;
    measured_square += m * m;
    levelled_square += l * l;
    s.sd += std::pow(fields.difference[i] - s.mean, 2) / n;
  }
  s.rms = std::sqrt(s.rms);
  s.sd = std::sqrt(s.sd);
  s.noise = std::sqrt(s.noise);
  if (!known) s.within = missing;
  s.correlation = product / std::sqrt(measured_square * levelled_square);
  s.slope = product / levelled_square;
  std::sort(difference.begin(), difference.end());
  for (std::size_t k = 0; k < percentiles.size(); ++k) s.percentile[k] = percentile_of(difference, percentiles[k]);
  s.mean_noise = uncertainty_of_mean(fields, counted, yarns);
  return s;
}

Verdict judge(const FieldStatistics& all, const std::vector<FieldStatistics>& zones) {
  if (!std::isfinite(all.noise)) return {false, "uncertainty unknown"};
  if (all.rms > 1.25 * all.noise)
    return {false, fmt::format("differs: RMS is {:.1f} times the noise", all.rms / all.noise)};
  for (const FieldStatistics& zone : zones)
    if (zone.points > 0 && std::abs(zone.mean) > 4.0 * zone.mean_noise)
      return {false, fmt::format("differs: zone {} by {:+.2f} deg, {:.1f} times its uncertainty", zone.name,
                                 zone.mean * degrees_per_radian, std::abs(zone.mean) / zone.mean_noise)};
  return {true, "agrees within the noise"};
}

}  // namespace weaveform::dic
