// Contact of nodes whose yarns are chords of a curve: lift and friction from each yarn's own kink.
//
// At a node the chords before and after turn by the kink theta towards the tool. Let t be the unit mean of both chords'
// directions, n the tool's normal and b the unit vector in their plane that is perpendicular to t: the bisector of the
// kink, as far as it lies in that plane (what yarns turn within the fabric's surface is no kink here).
//
// Lift. A polygon of chords of length h inscribed in an arc of radius R is shorter than the arc by h^2/(24 R^2) of its
// length. With its nodes lifted by h theta/24 it is as long: a lift of d lengthens a kinked line by d theta, so that
// sum h theta^2/24 is what sum h^3/(24 R^2) takes off, and it is so also where an arc begins or ends between nodes, where
// the kink is what is left of it. Warp and weft wish for lifts of their own; the node gets their mean, weighted by the
// squares of the kinks: that of the curved one on a cylinder, however the other quivers about straight, none on an even
// saddle.
//   lift = sum_f h_f theta_f^3 / (24 sum_f theta_f^2)
//
// Friction. A belt over the turn theta bears T2 = T1 exp(mu theta); a point force on the bisector within Coulomb's cone
// of coefficient m bears T2/T1 = (1 + m tan(theta/2))/(1 - m tan(theta/2)), so
//   m = tanh(mu theta/2)/tan(theta/2) = mu (1 - theta^2/12 - theta^4/720)(1 - mu^2 theta^2/12) + O(theta^4 mu^3) .
// The sum of all kinks is the whole turn, however nodes lie, so that the tension ratio is exact for every phase. The cone
// stands on the bisector, not on the tool's normal, from which it differs where arcs begin and end: the normal spring
// keeps to n, and the cone's centre in the plane of friction is shifted by N a, a = b/(b.n) - n. With q the trial force
// of spring and damper less N a, and C = 1/sqrt(1 + a.a):
//   |bisector's tangential part| = sqrt(q.q - (q.a)^2 C^2) <= m (N/C + (q.a) C)
//   q -> min(1, (m N/C)/(sqrt(q.q - (q.a)^2 C^2) - m (q.a) C)) q
// Families share the node by their kinks towards the tool: m and a are means weighted with max(theta_f, 0).
//
// A lift that grows does the work N d(lift) on the springs, and the shifted centre gives work to what slides in at the
// beginning of an arc and takes it back at its end. Both are counted with what is lost, so that the balance is whole.
#pragma once

#include "solver/contact/contact_kernel.hpp"

namespace weaveform {

// A ply's chords; arrays of all its packed nodes, `even` of their groups.
struct ChordLattice {
  const double* x[3];               // mm
  const int *before[2], *after[2];  // packed index along warp and weft; the node itself where there is none
  const char* even;                 // neighbours along the warp are those beside, along the weft `stride` off
  int stride;
};

// Of a block's nodes, whatever tool they touch.
struct ChordTurns {
  double turn[2][3][points_at_a_time];  // 1; unit direction after less that before
  double mean[2][3][points_at_a_time];  // 1; of both: along t, shorter where they turn
};
// Of those groups that have their bit in `wanted`, in a block of `count` nodes from the packed node `first` on.
void chord_turns(const ChordLattice& lattice, int first, int count, unsigned wanted, ChordTurns& turns);

// What the kinks of a block's nodes mean at one tool; each group's stand where its distances do.
struct ChordTerms {
  double lift[points_at_a_time];      // mm
  double friction[points_at_a_time];  // 1; m
  double shift[3][points_at_a_time];  // 1; a
};
// `length`: per family and node of the block, of which there are `count`, mm; h_f, 0 where one of both chords is missing.
// The lift is multiplied by `part` and taken off the distances.
void chord_terms(const ChordTurns& turns, const double* const (&length)[2], int count, const ContactGroups& groups,
                 double friction, double part, Distances& distances, ChordTerms& terms);

// Of the step before: lift (mm) and normal force (N), of nodes that touched; then those of now.
struct ChordMemory {
  double *lift, *normal;
};
// As contact_forces, with distances from which the lift is taken off already.
[[nodiscard]] ContactSums chord_forces(const ContactLaw& law, const ContactTool& tool, const Distances& distances,
                                       const ChordTerms& terms, double time, const ContactNodes& nodes,
                                       const ContactGroups& groups, const ChordMemory& memory);

// One compilation of the functions above (core/instructions/choose_loops.hpp).
struct ChordLoops {
  decltype(&weaveform::chord_turns) chord_turns;
  decltype(&weaveform::chord_terms) chord_terms;
  decltype(&weaveform::chord_forces) chord_forces;
};

}  // namespace weaveform
