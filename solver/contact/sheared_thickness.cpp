#include "solver/contact/sheared_thickness.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace weaveform {
namespace {

constexpr double most_sine = 0.96592582628906829;  // of 75 deg
constexpr int nodes_of_a_look = 2048, looked_at_together = 64;

struct ShearOfArms {
  double sine = 0.0, a = 0.0, b = 0.0;  // 1, mm, mm; lengths 0 where a node has no cell
};

ShearOfArms shear_of(const std::array<Vec3, 2>& arms) {
  const double a = plain_length(arms[0]), b = plain_length(arms[1]);
  if (!(a > 0.0) || !(b > 0.0)) return {};
  return {dot(arms[0], arms[1]) / (a * b), a, b};
}

}  // namespace

double thickening(double sine) {
  const double held = std::min(std::abs(sine), most_sine);
  return 1.0 / std::sqrt(1.0 - held * held);
}

ShearedThickness::ShearedThickness(const Mesh& mesh, const PackedMesh& packed, const State& start)
    : arms_(mesh, packed, start.position, whole_arms(mesh, packed)),
      nodes_(packed.nodes),
      swell_(static_cast<std::size_t>(packed.nodes) + looked_at_together, 1.0),
      load_(swell_.size(), 0.0) {
  look(start, alone());
  greatest_rise_ = 0.0;
}

void ShearedThickness::look(const State& state, Team& team) {
  const int parts = (nodes_ + nodes_of_a_look - 1) / nodes_of_a_look;
  std::vector<double> rise(parts, 0.0);
  team.run(parts, [&](int part) {
    const int first = part * nodes_of_a_look, end = std::min(first + nodes_of_a_look, nodes_);
    for (int n = first; n < end; ++n) {
      const double now = thickening(shear_of(arms_.between(n, state.position)).sine);
      rise[part] = std::max(rise[part], now - swell_[n]);
      swell_[n] = now;
      load_[n] = 0.0;
    }
  });
  greatest_rise_ = rise.empty() ? 0.0 : *std::max_element(rise.begin(), rise.end());
}

void ShearedThickness::add_forces(State& state) const {
  for (int n = 0; n < nodes_; ++n) {
    if (load_[n] == 0.0) continue;
    const auto arms = arms_.between(n, state.position);
    const auto [s, a, b] = shear_of(arms);
    if (a == 0.0 || std::abs(s) >= most_sine) continue;
    const double pull = -load_[n] * s * swell_[n] * swell_[n] * swell_[n];
    const Vec3 along_a = scaled(arms[0], 1.0 / a), along_b = scaled(arms[1], 1.0 / b);
    arms_.add_levers(
        n, {scaled(minus(along_b, scaled(along_a, s)), pull / a), scaled(minus(along_a, scaled(along_b, s)), pull / b)},
        state.force);
  }
}

// |dw/dx| = |s| w^3 |db/dx|, and the part of b/|b| across a is cos(gamma) = 1/w.
std::array<double, 2> ShearedThickness::slopes(int node, const Components& position) const {
  const auto [s, a, b] = shear_of(arms_.between(node, position));
  if (a == 0.0 || std::abs(s) >= most_sine) return {0.0, 0.0};
  const double slope = std::abs(s) * swell_[node] * swell_[node];
  return {slope / a, slope / b};
}

double ShearedThickness::lever(int node, const Components& position) const {
  const auto [a, b] = slopes(node, position);
  return 2.0 * (a + b);
}

void ShearedThickness::spread(int node, const Components& position, double scale, double whole, Doubles& bound) const {
  const auto slope = slopes(node, position);
  const auto& arm = arms_.of(node).arm;
  for (std::size_t k = 0; k < 4; ++k) bound[arm[k]] += scale * slope[k / 2] * whole;
}

void ShearedThickness::archive(Archive& archive) {
  archive.numbers("a ply's thickening", swell_, {.least = 1.0});
  archive.number("a ply's thickening", greatest_rise_, not_negative);
}

}  // namespace weaveform
