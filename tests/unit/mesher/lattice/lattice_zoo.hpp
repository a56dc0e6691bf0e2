// Blanks for the lattice's property tests: every angle, size and coarsening that has its own way of going wrong.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "mesher/lattice/build.hpp"

namespace weaveform::lattice_zoo {

// Built in code, so that these tests do not hang on the card reader. Numbers: Table 1 of the paper; moduli of Table 2.
inline Card plain_weave() {
  Card card;
  card.name = "plain";
  card.thickness = 0.5;  // mm
  for (auto& yarn : card.yarn) {
    yarn.linear_density = 1870e-12;  // tonne/mm
    yarn.section = 1.25;             // mm^2
    yarn.interval = 4.92;            // mm
    yarn.linear_modulus = 19800.0;   // MPa
  }
  return card;
}

inline Card twill() {
  Card card = plain_weave();
  card.name = "twill";
  card.thickness = 1.0;          // mm
  card.yarn[0].interval = 2.44;  // mm
  card.yarn[1].interval = 5.1;   // mm
  card.yarn[1].linear_density = 2.0 * 1870e-12;
  card.yarn[1].section = 2.0 * 1.25;
  return card;
}

struct Animal {
  std::string name;
  Card card;
  Scene scene;
};

inline GripSpec grip_on(const std::string& edge) {
  GripSpec grip;
  grip.name = edge;
  grip.edge = choice_named<BlankEdge>(edge);  // none of other names, which get a box
  return grip;
}

// Size in cells as the mesher counts them: along each of the blank's axes, of the family that it meets most often;
// never less than three lines of either family across, so that every member is legal.
inline Animal animal(const Card& card, double angle, const std::array<double, 2>& cells,
                     const std::array<double, 2>& coarsening, const std::array<double, 2>& phase, bool gripped) {
  Animal a;
  a.card = card;
  auto& blank = a.scene.blank;
  blank.yarn_angle = angle;
  blank.coarsening = coarsening;
  blank.phase = phase;
  const double along_warp = coarsening[1] * card.yarn[1].interval;
  const double along_weft = coarsening[0] * card.yarn[0].interval;
  const double c = std::abs(std::cos(angle * std::numbers::pi / 180.0));
  const double s = std::abs(std::sin(angle * std::numbers::pi / 180.0));
  blank.size = {cells[0] / std::max(c / along_warp, s / along_weft),
                cells[1] / std::max(s / along_warp, c / along_weft)};
  const double warp_extent = (blank.size[0] * c + blank.size[1] * s) / along_warp;
  const double weft_extent = (blank.size[0] * s + blank.size[1] * c) / along_weft;
  const double grow = std::max(1.0, 3.0 / std::min(warp_extent, weft_extent));
  for (double& side : blank.size) side *= grow;
  if (gripped) a.scene.grip = {grip_on("bottom"), grip_on("top")};
  a.name =
      fmt::format("{} {} deg, {:.5g} x {:.5g} mm, coarsening {} {}, phase {} {}{}", card.name, angle, blank.size[0],
                  blank.size[1], coarsening[0], coarsening[1], phase[0], phase[1], gripped ? ", gripped" : "");
  return a;
}

// A bias extension: yarns at 45 degrees to the pull unless said otherwise, both ends held, lattice fitted to them.
inline Animal bias_extension(const Card& card, double width, double length, double coarsening, double angle = 45.0) {
  Animal a;
  a.card = card;
  a.scene.blank.size = {width, length};
  a.scene.blank.yarn_angle = angle;
  a.scene.blank.coarsening = {coarsening, coarsening};
  a.scene.grip = {grip_on("bottom"), grip_on("top")};
  a.name = fmt::format("{} bias extension {:.5g} x {:.5g} mm, {} deg, coarsening {}", card.name, width, length, angle,
                       coarsening);
  return a;
}

// 2 cards x 10 angles x 7 shapes; coarsening, phase and grips take turns so that they meet every angle and shape. Then
// the bias extensions, whose lattices are fitted to their grips.
inline std::vector<Animal> zoo() {
  const std::array<double, 10> angle = {0.0, 45.0, 90.0, 30.0, -60.0, 15.0, 77.3, 1.0, 0.001, 135.0};
  const std::vector<std::array<double, 2>> cells = {{3.0, 3.0},  {4.5, 9.0},   {6.25, 5.5},  {16.0, 32.0},
                                                    {23.4, 3.3}, {40.1, 20.0}, {100.0, 12.0}};
  const std::vector<std::array<double, 2>> coarsening = {{1.0, 1.0}, {0.5, 0.5}, {2.0, 1.0}, {3.0, 4.0}, {0.7, 0.9}};
  const std::vector<std::array<double, 2>> phase = {{0.0, 0.0}, {0.5, 0.5}, {0.13, 0.77}};
  std::vector<Animal> all;
  std::size_t turn = 0;
  for (const auto& card : {plain_weave(), twill()}) {
    for (const double a : angle) {
      for (const auto& c : cells) {
        all.push_back(
            animal(card, a, c, coarsening[turn % coarsening.size()], phase[turn % phase.size()], turn % 4 > 1));
        ++turn;
      }
    }
  }
  for (const auto& card : {plain_weave(), twill()})
    for (const double k : {4.0, 2.0, 1.0, 0.5})
      for (const double ratio : {1.5, 1.6, 2.0, 3.0}) all.push_back(bias_extension(card, 115.0, ratio * 115.0, k));
  for (const double turned : {20.0, 30.0, 60.0})
    for (const double k : {4.0, 1.0}) all.push_back(bias_extension(plain_weave(), 115.0, 230.0, k, turned));
  return all;
}

// What the coarsening comes to at the spacing the lattice has; a fit to the grips moves it off the scene's.
inline std::array<double, 2> yarns_per_line(const Mesh& mesh, const Card& card) {
  return {mesh.spacing[1] / card.yarn[0].interval, mesh.spacing[0] / card.yarn[1].interval};
}

// The place of a node in the blank's frame, before orientation and position (which the zoo leaves at zero).
inline std::array<double, 2> in_blank(const Mesh& mesh, int node) {
  return {mesh.nodes.position[node][0], mesh.nodes.position[node][1]};
}

inline std::array<double, 2> direction(const Scene& scene, Family family) {
  const double angle = scene.blank.yarn_angle * std::numbers::pi / 180.0;
  if (family == Family::warp) return {std::cos(angle), std::sin(angle)};
  return {-std::sin(angle), std::cos(angle)};
}

}  // namespace weaveform::lattice_zoo
