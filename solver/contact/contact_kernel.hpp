// The contact law between a fabric node and a tool, for groups of nodes.
//
// With the penetration p = offset - distance, the node's contact stiffness k = omega^2 m and the softening depth d:
//   normal    N = k p^2/(2d) for p < d, k (p - d/2) beyond: smooth at touch; plus damping c min(p/d, 1) of the approach
//             speed, c = 2 xi omega m; never pulling
//   friction  a tangential spring of stiffness k from an anchor that moves with the tool, and damping c of the
//             tangential speed. Where their sum passes mu N, both are scaled down to it and the anchor follows
//             (return mapping; Simo and Hughes 1998, "Computational Inelasticity", 1.2), so a node that sticks keeps
//             its place for ever, one that slides feels exactly mu N, and damping never adds to Coulomb's limit.
// What is lost is work of its own: what the spring loses to the cut, and the dampers'. A leapfrog step's force acts over
// half the way made before it and half the way after, so that over a way d between two steps every force does the work
// (F_before + F_now)/2 . d; counted so, losses leave the energy balance no error of the step's first order (where
// a dome lets a fabric go it was 1.3 % of the energy).
//
// A node's spring begins where it touches: one that did not touch at the step before has no anchor and no drag.
//
// Where the fabric thickens as it shears (sheared_thickness.hpp) its face is w times as far from the middle plane, and
// the springs' force times that offset is what the thickness takes: dE/dw. Dampers act on the approach of the tool alone.
#pragma once

#include "mesher/tools/distance.hpp"

namespace weaveform {

inline constexpr double contact_damping = 0.1;  // of critical, of a node on its contact spring
// Of the thickness: the depth over which the normal force sets in. A node that hits a tool passes it in a step or two;
// with 0.02 a fabric let go on a dome lost 1.2 % of its energy unseen, with 0.05 0.5 % (step_bound "reached"), and a drawn
// hemisphere's force changes by 0.04 %.
inline constexpr double contact_softening = 0.05;

struct ContactLaw {
  double offset = 0.0;        // mm; from the fabric's middle plane to its face
  double softening = 0.0;     // mm; d
  double frequency2 = 0.0;    // 1/s^2; omega^2
  double damping_rate = 0.0;  // 1/s; 2 xi omega
  double friction = 0.0;      // 1; mu
};

// How the tool stands and moves.
struct ContactTool {
  std::array<double, 3> origin;    // mm
  std::array<double, 3> velocity;  // mm/s; over the step just made
};

inline constexpr double no_anchor = 1e30;  // mm; anchor[0] of a node that does not touch

// The nodes of a block; arrays of `count` entries.
struct ContactNodes {
  int count;
  const double* mass;             // tonne; 0 where no node is
  const double* area;             // mm^2; of the fabric around the node
  const double* x[3];             // mm
  const double* v[3];             // mm/s; half a step behind
  double* force[3];               // N; added to
  double* anchor[3];              // mm; in the tool's frame (world axes, tool's origin); or no_anchor
  double* drag[3];                // N; of both dampers on the node: at the step before, and then now
  const double* swell = nullptr;  // 1; w; none: 1
  double* load = nullptr;         // N mm; with `swell`: dE/dw, added to
};

// Some of a block's nodes, a vector of them at a time (fewer where the block ends): group g has the nodes from node[g]
// on, and its distances stand from at[g] on. `upright`: there are as many as a vector has, and the tool's normals there are
// (0, 0, n2).
inline constexpr int group_nodes = 8, groups_in_block = points_at_a_time / group_nodes;
struct ContactGroups {
  int count = 0;
  int node[groups_in_block], at[groups_in_block];
  bool upright[groups_in_block];
  void add(int first_node, int first_distance, bool stands_upright = false) {
    node[count] = first_node;
    at[count] = first_distance;
    upright[count++] = stands_upright;
  }
};

inline constexpr ContactGroups single_node = {.count = 1, .node = {0}, .at = {0}, .upright = {false}};

// Sums over groups.
struct ContactSums {
  double force[3] = {0.0, 0.0, 0.0};  // N; of the tool on the fabric
  double area = 0.0;                  // mm^2; of the nodes that touch
  double energy = 0.0;                // mJ; stored in the springs
  double friction_work = 0.0;         // mJ; lost along the surface, over the step just made
  double damping_work = 0.0;          // mJ; lost in the normal dampers, over the step just made
};

// `time` is the length of the step just made (s).
[[nodiscard]] ContactSums contact_forces(const ContactLaw& law, const ContactTool& tool, const Distances& distances,
                                         double time, const ContactNodes& nodes, const ContactGroups& groups);

// mm; of each group the least distance - offset w of the nodes that exist.
void least_gaps(const Distances& distances, double offset, const ContactNodes& nodes, const ContactGroups& groups,
                double (&gap)[groups_in_block]);

// Fills in `upright` of the groups of a block of `count` nodes.
void find_upright(const Distances& distances, int count, ContactGroups& groups);

// mm/s; greatest |v - reference| of the nodes that exist.
[[nodiscard]] double greatest_speed(const std::array<double, 3>& reference, const ContactNodes& nodes);

// One compilation of the functions above (core/instructions/choose_loops.hpp).
struct ContactLoops {
  decltype(&weaveform::contact_forces) contact_forces, swollen_contact_forces;
  decltype(&weaveform::least_gaps) least_gaps, swollen_least_gaps;
  decltype(&weaveform::find_upright) find_upright;
  decltype(&weaveform::greatest_speed) greatest_speed;
};

}  // namespace weaveform
