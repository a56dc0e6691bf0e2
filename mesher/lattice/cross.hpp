// A cross: a square of fabric with yarns along its sides, whose yarns run on to the ends of four arms, from which the
// cross yarns have been removed (the paper's Fig. 4).
#pragma once

#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/lattice/fit.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform::lattice {

// Where a yarn line stops: its last element there, the node, and whether that is the line's low or high end.
struct YarnEnd {
  int element = 0;
  int node = 0;
  int side = 0;  // 0 low, 1 high, along the family's axis
};
[[nodiscard]] std::vector<YarnEnd> yarn_ends(const Mesh& mesh, int family);

// Lines of a square of `side` (mm) whose outermost lie on its sides: the spacing nearest to the asked one that divides
// it.
[[nodiscard]] LineLayout lines_on_sides(const std::array<double, 2>& side, const Vec2& asked);

// Runs the yarn that ends at `end` on as one straight element to yarn coordinate `to` (mm) along its own axis, with its
// mass half to either node; returns the new node.
int add_arm(const YarnEnd& end, int family, double to, const BlankSpec& blank, const Card& card, Mesh& mesh);

// Adds a node that is no crossing at yarn coordinates `place`.
int add_node(Mesh& mesh, const BlankSpec& blank, const Vec2& place, double mass);

void check_cross(const Scene& scene, std::vector<std::string>& complaints);

// Attaches the arms up to the outline of blank.size and lets the grips take their ends: those on the edge that a grip
// names, or inside its box.
void attach_cross(const Scene& scene, const Card& card, Mesh& mesh);

}  // namespace weaveform::lattice
