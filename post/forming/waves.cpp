#include "post/forming/waves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "post/forming/yarn_path.hpp"
#include "solver/bending/bending_energy.hpp"

namespace weaveform {
namespace {

// 1; of a wrinkle's least amplitude: lower lobes are noise, and part no waves.
constexpr double noise_height = 0.1;
// 1; of the shorter of two lobes: with no more between them (on a tool, noise) they are neighbours.
constexpr double widest_gap = 0.5;

struct Station {
  int node = -1;
  double at = 0.0;         // mm; along the flat yarn
  double curvature = 0.0;  // 1/mm
  double length = 0.0;     // mm; half of both elements
};
using Yarn = std::vector<Station>;

struct Lobe {
  std::size_t first = 0, last = 0;  // stations
  double begin = 0.0, end = 0.0;    // mm; where the curvature vanishes
  bool upward = false;
  double peak = 0.0;       // 1/mm; greatest |curvature|
  double amplitude = 0.0;  // mm
  [[nodiscard]] double length() const { return end - begin; }
};

struct HalfWave {
  double wavelength = 0.0, amplitude = 0.0;  // mm
  double cells = 0.0, weight = 0.0;
};

std::vector<Yarn> yarns_along(const Mesh& mesh, Family family, const std::vector<double>& curvature) {
  const YarnPath path = yarn_path(mesh, family);
  std::vector<Yarn> yarns;
  for (int first = 0; first < mesh.node_count(); ++first) {
    if (path.after[first] < 0 || path.before[first] >= 0) continue;
    Yarn yarn;
    double at = 0.0, before = 0.0;
    for (int n = first;;) {
      const int element = path.after[n];
      const double after = element < 0 ? 0.0 : mesh.yarns.rest_length[element];
      yarn.push_back({n, at, curvature[n], 0.5 * (before + after)});
      if (element < 0) break;
      at += after;
      before = after;
      n = mesh.yarns.node[element][1];
    }
    yarns.push_back(std::move(yarn));
  }
  return yarns;
}

// Where the curvature vanishes on the way from `inside` to its neighbour, which has the other sign or none.
double inflection(const Station& inside, const Station& outside) {
  const double here = std::abs(inside.curvature), there = std::abs(outside.curvature);
  return inside.at + (outside.at - inside.at) * here / (here + there);
}

// The sum of the header's formula, walked along: the first chord leaves its end by the slope that reaches the other end.
double deflection(const Yarn& yarn, const Lobe& lobe) {
  const auto turn = [&](std::size_t k) { return yarn[k].curvature * yarn[k].length; };
  double slope = 0.0;
  for (std::size_t k = lobe.first; k <= lobe.last; ++k) slope += turn(k) * (lobe.end - yarn[k].at) / lobe.length();
  double height = 0.0, at = lobe.begin, greatest = 0.0;
  for (std::size_t k = lobe.first; k <= lobe.last; ++k) {
    height += slope * (yarn[k].at - at);
    at = yarn[k].at;
    slope -= turn(k);
    greatest = std::max(greatest, std::abs(height));
  }
  return greatest;
}

// No yarn runs on at a yarn's two ends, so that every lobe has a station before and after it.
std::vector<Lobe> lobes_of(const Yarn& yarn) {
  std::vector<Lobe> lobes;
  for (std::size_t k = 1; k + 1 < yarn.size();) {
    const double c = yarn[k].curvature;
    if (c == 0.0) {
      ++k;
      continue;
    }
    Lobe lobe{.first = k, .last = k, .upward = c > 0.0};
    for (; k + 1 < yarn.size() && yarn[k].curvature * c > 0.0; ++k) {
      lobe.last = k;
      lobe.peak = std::max(lobe.peak, std::abs(yarn[k].curvature));
    }
    lobe.begin = inflection(yarn[lobe.first], yarn[lobe.first - 1]);
    lobe.end = inflection(yarn[lobe.last], yarn[lobe.last + 1]);
    lobe.amplitude = deflection(yarn, lobe);
    lobes.push_back(lobe);
  }
  return lobes;
}

bool are_neighbours(const Lobe& before, const Lobe& after) {
  return after.begin - before.end <= widest_gap * std::min(before.length(), after.length());
}

// Without those that are noise; two of one sign that only noise parts are one.
std::vector<Lobe> joined_lobes(const Yarn& yarn, double noise) {
  std::vector<Lobe> joined;
  for (const Lobe& lobe : lobes_of(yarn)) {
    if (lobe.amplitude <= noise) continue;
    if (joined.empty() || joined.back().upward != lobe.upward || !are_neighbours(joined.back(), lobe)) {
      joined.push_back(lobe);
      continue;
    }
    Lobe& whole = joined.back();
    whole.last = lobe.last;
    whole.end = lobe.end;
    whole.peak = std::max(whole.peak, lobe.peak);
    whole.amplitude = deflection(yarn, whole);
  }
  return joined;
}

// The first value whose weight and that of all lower ones is `part` of the whole.
double weighted_quantile(std::vector<std::pair<double, double>> value_and_weight, double part) {
  std::sort(value_and_weight.begin(), value_and_weight.end());
  double whole = 0.0, sum = 0.0;
  for (const auto& one : value_and_weight) whole += one.second;
  for (const auto& [value, weight] : value_and_weight) {
    sum += weight;
    if (sum >= part * whole) return value;
  }
  return value_and_weight.back().first;
}

WaveMeasure measure_of(const std::vector<HalfWave>& waves) {
  WaveMeasure measure;
  measure.half_waves = static_cast<int>(waves.size());
  if (waves.empty()) return measure;
  const auto quantile = [&](double HalfWave::*member, double part) {
    std::vector<std::pair<double, double>> values;
    for (const HalfWave& wave : waves) values.emplace_back(wave.*member, wave.weight);
    return weighted_quantile(std::move(values), part);
  };
  measure.wavelength = quantile(&HalfWave::wavelength, 0.5);
  measure.quartiles = {quantile(&HalfWave::wavelength, 0.25), quantile(&HalfWave::wavelength, 0.75)};
  measure.cells = quantile(&HalfWave::cells, 0.5);
  measure.amplitude = quantile(&HalfWave::amplitude, 0.5);
  for (const HalfWave& wave : waves) measure.greatest_amplitude = std::max(measure.greatest_amplitude, wave.amplitude);
  return measure;
}

// What one yarn adds: its half waves, and its nodes in waves.
void look_along(const Yarn& yarn, const std::array<double, 2>& spacing, double thickness, const WrinkleLimits& limits,
                std::vector<HalfWave>& waves, std::vector<bool>& in_wave) {
  const double least = 0.5 * limits.relief(thickness), least_curvature = limits.curvature(thickness);
  const std::vector<Lobe> lobes = joined_lobes(yarn, noise_height * least);
  for (std::size_t k = 0; k < lobes.size(); ++k) {
    const Lobe& lobe = lobes[k];
    if (lobe.amplitude <= least || lobe.peak <= least_curvature) continue;
    const bool after_one = k > 0 && are_neighbours(lobes[k - 1], lobe);
    const bool before_one = k + 1 < lobes.size() && are_neighbours(lobe, lobes[k + 1]);
    if (!after_one && !before_one) continue;
    for (std::size_t i = lobe.first; i <= lobe.last; ++i) in_wave[yarn[i].node] = true;
    if (!after_one || !before_one) continue;
    const double length = 0.5 * (lobe.end + lobes[k + 1].begin) - 0.5 * (lobes[k - 1].end + lobe.begin);
    waves.push_back({2.0 * length, lobe.amplitude, 2.0 * length / spacing[0], lobe.amplitude * length * spacing[1]});
  }
}

}  // namespace

YarnCurvatures out_of_plane_curvatures(const Mesh& mesh, const std::vector<Vec3>& position) {
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  YarnCurvatures curvature = {std::vector<double>(nodes, 0.0), std::vector<double>(nodes, 0.0)};
  const std::vector<Bend> bends = find_bends(mesh, std::vector<char>(nodes, 0));
  const auto found = curvatures(bends, position);
  for (std::size_t b = 0; b < bends.size(); ++b)
    for (std::size_t f = 0; f < 2; ++f)
      if (bends[b].yarn[f].yarns != 0.0) curvature[f][bends[b].node] = found[b][2 * f + 1];
  return curvature;
}

Waves find_waves(const Mesh& mesh, const YarnCurvatures& curvature, const WrinkleLimits& limits) {
  Waves waves;
  std::vector<bool> in_wave(static_cast<std::size_t>(mesh.node_count()), false);
  std::vector<HalfWave> all;
  for (const Family family : {Family::warp, Family::weft}) {
    const std::size_t f = family == Family::warp ? 0 : 1;
    std::vector<HalfWave> along;
    for (const Yarn& yarn : yarns_along(mesh, family, curvature[f]))
      look_along(yarn, {mesh.spacing[f], mesh.spacing[1 - f]}, mesh.thickness, limits, along, in_wave);
    waves.yarn[f] = measure_of(along);
    all.insert(all.end(), along.begin(), along.end());
  }
  waves.all = measure_of(all);
  double weight = 0.0, unresolved = 0.0;
  for (const HalfWave& wave : all) {
    weight += wave.weight;
    unresolved += wave.cells < least_cells_per_wave ? wave.weight : 0.0;
  }
  waves.unresolved_share = weight > 0.0 ? unresolved / weight : 0.0;
  waves.area_share = area_share(mesh, in_wave);
  return waves;
}

double compressed_fibre_share(const Mesh& mesh, const std::vector<double>& yarn_strain) {
  double compressed = 0.0, whole = 0.0;
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    if (mesh.yarns.softening[e] == 0.0) continue;  // a tied end
    const double fibre = mesh.yarns.rest_length[e] * mesh.yarns.yarns[e];
    whole += fibre;
    compressed += yarn_strain[static_cast<std::size_t>(e)] < -compressed_from ? fibre : 0.0;
  }
  return whole > 0.0 ? compressed / whole : 0.0;
}

Waves evaluate_waves(const ModelSpec& model, const Mesh& mesh, const Fields& fields, const Wrinkles* wrinkles) {
  Waves waves =
      find_waves(mesh, wrinkles != nullptr ? wrinkles->excess : out_of_plane_curvatures(mesh, fields.position));
  waves.compressed_share = compressed_fibre_share(mesh, fields.yarn_strain);
  waves.bends = has_bending(model);
  return waves;
}

}  // namespace weaveform
