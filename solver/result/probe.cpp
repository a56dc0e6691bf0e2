#include "solver/result/probe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/vector/append.hpp"
#include "mesher/mesh/stack.hpp"

namespace weaveform {
namespace {

std::array<double, 4> box_of(const MeasureSpec& measure, double width) {
  if (measure.box) return *measure.box;
  std::array<double, 4> box = measure.relative_box.value_or(std::array<double, 4>{-1e9, -1e9, 1e9, 1e9});
  for (auto& side : box) side *= width;
  return box;
}

// A box that lies between the centres of a coarse mesh takes the cells nearest to its own centre, all that are equally
// near, so that a coarsening study does not stop at a small box.
void take_nearest(const std::vector<std::array<double, 2>>& centre, const std::array<double, 4>& box, const Mesh& mesh,
                  Probe& probe) {
  const double x = 0.5 * (box[0] + box[2]), y = 0.5 * (box[1] + box[3]);
  const double reach = std::hypot(mesh.spacing[0], mesh.spacing[1]);
  double nearest = reach;
  for (const auto& c : centre) nearest = std::min(nearest, std::hypot(c[0] - x, c[1] - y));
  if (nearest >= reach)
    throw InputError(fmt::format("measure '{}': its box [{}, {}, {}, {}] mm lies off the blank; move it", probe.name,
                                 box[0], box[1], box[2], box[3]));
  for (std::size_t c = 0; c < centre.size(); ++c)
    if (std::hypot(centre[c][0] - x, centre[c][1] - y) <= nearest + 1e-6 * reach) {
      probe.cell.push_back(static_cast<int>(c));
      probe.weight.push_back(mesh.cells.area[c]);
    }
}

}  // namespace

std::array<double, 2> blank_coordinates(const BlankSpec& blank, const Vec3& world) {
  const double angle = blank.orientation * std::numbers::pi / 180.0;
  const double x = world[0] - blank.position[0], y = world[1] - blank.position[1];
  return {std::cos(angle) * x + std::sin(angle) * y, -std::sin(angle) * x + std::cos(angle) * y};
}

std::vector<Probe> make_probes(const Scene& scene, const Mesh& mesh, double width) {
  std::vector<std::array<double, 2>> centre(mesh.cells.size());
  for (int c = 0; c < mesh.cells.size(); ++c) {
    Vec3 sum{};
    const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
    for (int a = begin; a < end; ++a)
      for (int k = 0; k < 3; ++k) sum[k] += mesh.flat_positions()[mesh.cells.node[a]][k] / (end - begin);
    centre[c] = blank_coordinates(scene.blank, sum);
  }
  std::vector<Probe> probes;
  for (const auto& measure : scene.measure) {
    const auto box = box_of(measure, width);
    Probe probe{.name = measure.name, .cell = {}, .weight = {}};
    for (int c = 0; c < mesh.cells.size(); ++c) {
      const auto [x, y] = centre[c];
      if (x < box[0] || x > box[2] || y < box[1] || y > box[3]) continue;
      probe.cell.push_back(c);
      probe.weight.push_back(mesh.cells.area[c]);
    }
    if (probe.cell.empty()) take_nearest(centre, box, mesh, probe);
    probes.push_back(std::move(probe));
  }
  return probes;
}

std::vector<Probe> make_probes(const Resolved& model) {
  if (model.ply.empty()) return make_probes(model.scene, model.mesh, model.extent()[0]);
  std::vector<Probe> probes;
  for (const auto& measure : model.scene.measure) probes.push_back({.name = measure.name, .cell = {}, .weight = {}});
  for (std::size_t k = 0; k < model.ply.size(); ++k) {
    const Resolved& ply = model.ply[k];
    const int first = cells_of_ply(model.mesh, k).first;
    for (const Probe& own : make_probes(ply.scene, ply.mesh, ply.extent()[0])) {
      Probe& probe = *std::find_if(probes.begin(), probes.end(), [&](const Probe& p) { return p.name == own.name; });
      for (const int cell : own.cell) probe.cell.push_back(first + cell);
      append(probe.weight, own.weight);
    }
  }
  for (const Probe& probe : probes)
    if (probe.cell.empty())
      throw InputError(fmt::format("measure '{}': its box lies off every ply; move it", probe.name));
  return probes;
}

ShearStatistics shear_statistics(const Probe& probe, const Fields& fields) {
  double weight = 0.0, sum = 0.0;
  ShearStatistics result;
  result.least = 1e9;
  result.greatest = -1e9;
  for (std::size_t k = 0; k < probe.cell.size(); ++k) {
    const double angle = fields.shear_angle[probe.cell[k]] * 180.0 / std::numbers::pi;
    weight += probe.weight[k];
    sum += probe.weight[k] * angle;
    result.least = std::min(result.least, angle);
    result.greatest = std::max(result.greatest, angle);
  }
  result.mean = sum / weight;
  double square = 0.0;
  for (std::size_t k = 0; k < probe.cell.size(); ++k) {
    const double off = fields.shear_angle[probe.cell[k]] * 180.0 / std::numbers::pi - result.mean;
    square += probe.weight[k] * off * off;
  }
  result.deviation = std::sqrt(square / weight);
  return result;
}

}  // namespace weaveform
