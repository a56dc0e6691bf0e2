// The contact law between nodes of one ply and the surface of another, for the nodes of one block.
//
// A node's foot is y = S(xi, eta) on a cell with corners x_0 (0, 0), x_1 (1, 0), x_2 (0, 1), x_3 (1, 1),
//   N_3 = xi eta, N_1 = xi - N_3, N_2 = eta - N_3, N_0 = 1 - xi - eta + N_3        (a triangle x_0 x_1 x_2: N_3 = 0)
// where the line from x along the node's own unit normal n meets it (none where the two surfaces part by 60 degrees and
// more, all from 45 down): x - S(xi, eta) = s n, by one Newton step from the
// foot of the step before. n is that of a x b, with a and b from the node's neighbours: it turns smoothly where cells
// meet at an edge. r = x - y, and the depth is p = reach - |r|, |r| counted negative beyond the surface. Where cells meet
// at an angle, S is that of rounded_edges.hpp, and its shape functions and slopes take the place of these.
//
// With the share's stiffness k of the node (ply_law.hpp) and the softening depth d:
//   normal    N = k p^2/(2d) for p < d, k (p - d/2) beyond; or A P(p) of a measured compaction. Plus damping
//             c min(p/d, 1) dp/dt, never pulling
//   friction  t = S_xi (xi - xi_a) + S_eta (eta - eta_a), from the anchor in the cell's own coordinates to the foot;
//             spring k_t t and damper c_t dt/dt together, cut to mu N + A tau(slip) as a whole, whereupon the anchor
//             follows (return mapping). slip = path so far + |t|, so that under growing slip tau is that of the table.
// What is lost is counted as in contact_kernel.hpp: each force over half the way before and half the way after.
//
// Forces are those of a potential of s and (xi, eta), whatever has a part in these. From x - S = s n, with m the cell's
// normal S_xi x S_eta:
//   ds      = m.(dx - sum N_a dx_a - s dn)/(m.n)
//   T.dS    = T'.(dx - sum N_a dx_a - s dn),  T' = T - (T.n) m/(m.n)                   (dS: the foot's way on the cell)
// so that the node takes F = (N - T.n) m/(m.n) + T (N with the sign of its side, T along the cell), corner a takes
// -N_a F, and n takes -s F, which is a couple on the node's neighbours: the forces +-G_a at the ends of a, +-G_b at those
// of b, with a x G_a + b x G_b = C = -r x F, G_a = b x f + w n x a, G_b = f x a + w n x b. C of all surfaces that a node
// meets is added up first. Forces and moments sum to zero to rounding. With the couple elsewhere, say on the corners,
// friction would be a force without a potential, and plies flutter on it.
//
// Plies that thicken as they shear (sheared_thickness.hpp; w per node, interpolated over a cell) have
//   reach = h_own w + h_other sum N_a w_a,     h the flat half thicknesses
// so that N acts on thickness as well, dE/dw = N h_own and N h_other N_a, and along the slope of the other's face:
//   q = -N G^-1 (reach_xi, reach_eta),   G the metric of S_xi, S_eta
#pragma once

namespace weaveform {

inline constexpr int ply_nodes_at_a_time = 64;
inline constexpr int ply_nodes_padded_to = 8;  // loops go over so many at once, and leave none for a slower end

// A curve of values at i / per_unit, i = 0 .. intervals; beyond it goes on with `last_slope`.
struct EvenTable {
  const double* value = nullptr;
  double per_unit = 0.0;  // 1/mm
  int intervals = 0;
  double last_slope = 0.0;  // per interval
};

struct PlyPassLaw {
  double reach = 0.0;         // mm; |r| at which the two touch
  double side = 1.0;          // +1 where the nodes lie above the surface, -1 below
  double softening = 0.0;     // mm; d
  double damping_time = 0.0;  // s; c over k
  double tangential = 1.0;    // 1; k_t over k
  double friction = 0.0;      // 1; mu
  double share = 1.0;         // 1; of the pressure, the shear stress and the area that these nodes carry
  EvenTable shear;            // MPa; tau of the slip path; none: nothing
  double adhesion = 0.0;      // mm; tau acts down to this depth (negative: across a gap)
  EvenTable pressure;         // MPa; P of the depth; none: springs
  EvenTable pressure_energy;  // mJ/mm^2; its integral
  double half_own = 0.0;      // mm; flat half thickness of the nodes' ply
  double half_other = 0.0;    // mm; of the surface's
};

// What all passes of a block have in common: what lies between its nodes' neighbours along warp and weft, and their
// normals. Anything finite in lanes without a node.
struct PlyNormals {
  alignas(64) double a[3][ply_nodes_at_a_time], b[3][ply_nodes_at_a_time];  // mm
  alignas(64) double n[3][ply_nodes_at_a_time];  // mm^2; a x b, which points upwards; there is no foot where it is 0
  alignas(64) double size[ply_nodes_at_a_time];  // mm^2; of n
};

// What the nodes of a block take of all passes together.
struct PlyPull {
  alignas(64) double force[3][ply_nodes_at_a_time];   // N; F
  alignas(64) double couple[3][ply_nodes_at_a_time];  // N mm; C
  alignas(64) double load[ply_nodes_at_a_time];       // N mm; dE/dw, of swollen loops only
};

// Arrays of `count` entries, but for those of the surface.
struct PlyPassNodes {
  int count;
  const double* x[3];  // mm
  const PlyNormals* normals;
  const double* stiffness;      // N/mm; k; 0 where nothing acts: what is kept of such a node stays as it is
  const double* area;           // mm^2; of the fabric around the node
  const long* corner;           // first corner of the foot's cell; as wide as doubles, so that loops do not mix widths
  int beside[3];                // from it to the other three; the last is 0 for triangles
  const double* surface[3];     // mm; positions of the other ply's nodes
  double* place[2];             // xi, eta
  double* anchor[2];            // likewise
  double* depth;                // mm; p at the step before, then now
  double* drag[3];              // N; of the dampers at the step before, then now: normal, and the components q of T
  double* path;                 // mm; slip so far
  const double* swell;          // 1; w of the nodes; of no use to loops that are not swollen
  const double* surface_swell;  // 1; of the other ply's nodes
};

// What one pass gives to the corners.
struct PlyPassForces {
  alignas(64) double force[4 * ply_nodes_at_a_time];  // N and N mm; F, x y z, and less what acts on the other's w
  alignas(64) double weight[4][ply_nodes_at_a_time];  // 1; N_a
  alignas(64) double acts[ply_nodes_at_a_time];       // N; above 0 where something acts
};

// Sums over a block.
struct PlyPassSums {
  double area = 0.0;           // mm^2; share of what touches
  double normal = 0.0;         // N
  double friction = 0.0;       // N
  double energy = 0.0;         // mJ; stored
  double friction_work = 0.0;  // mJ; lost along the surface, over the step just made
  double damping_work = 0.0;   // mJ; lost across it
  double depth = -1e300;       // mm; greatest
  double pressure = 0.0;       // MPa; greatest
};

// A node's law is one long chain of results: short loops over a block keep several nodes in flight, one long loop would
// one at a time. Between the loops:
struct PlyFeet {
  alignas(64) double dxi[ply_nodes_at_a_time], deta[ply_nodes_at_a_time];  // way since the step before
  alignas(64) double s1[3][ply_nodes_at_a_time], s2[3][ply_nodes_at_a_time], r[3][ply_nodes_at_a_time];  // mm
  alignas(64) double square[ply_nodes_at_a_time], along[ply_nodes_at_a_time];  // r.r, r.(a x b)
  alignas(64) double meets[ply_nodes_at_a_time];  // 1 where the normals part by less than 45 degrees, 0 from 60 on
  alignas(64) double normal[ply_nodes_at_a_time], q1[ply_nodes_at_a_time], q2[ply_nodes_at_a_time];  // N; N, T's q
  // mm; reach, and what it rises along xi and eta; of swollen loops only
  alignas(64) double reach[ply_nodes_at_a_time], rise1[ply_nodes_at_a_time], rise2[ply_nodes_at_a_time];
};

// For the nodes first .. end - 1 of a block.
// Moves their feet (`place`) to where they are now. The greatest way of a foot out of its cell, in the cell's
// coordinates: -1 where nothing acts, 1e300 where one has none.
using PlyFindFeet = double(const PlyPassNodes& nodes, PlyFeet& feet, int first, int end);
// N and T there. `inverse_time` is 1/s over the step just made, 0 for a first look, which loses and damps nothing.
using PlyPress = PlyPassSums(const PlyPassLaw& law, double inverse_time, const PlyPassNodes& nodes, PlyFeet& feet,
                             PlyPassForces& forces, int first, int end);
// F of them: added to what the nodes take, and as the corners will.
using PlyShare = void(const PlyPassLaw& law, const PlyPassNodes& nodes, const PlyFeet& feet, PlyPull& pull,
                      PlyPassForces& forces, int first, int end);

// Nodes whose forces lie together, x, y, z and dE/dw or nothing, so that one is added with one instruction; `touched` has
// a flag for each so many of them.
inline constexpr int ply_segment = 64;
// Adds what the corners take of the nodes first .. end - 1.
using PlyGiveBack = void(int first, int end, const long* corner, const int (&beside)[3], const PlyPassForces& forces,
                         double* into, char* touched);

// into[i] += more[i].
using PlyAdd = void(int count, const double* more, double* into);

// a and b of nodes in a row, whose neighbours lie beside them in `x`, those along the weft `stride` away.
using PlyWays = void(int lanes, int stride, const double* const (&x)[3], PlyNormals& normals);
// n of what is there of a and b.
using PlyTurn = void(int lanes, PlyNormals& normals);

// F added to `force`, and the forces that make C: G_a in the first three, G_b in the others.
using PlyTake = void(int count, const PlyNormals& normals, const PlyPull& pull, double* const (&force)[3],
                     double* const (&lever)[6]);

// force[i] += G_a[i - 1] - G_a[i + 1] + G_b[i - stride] - G_b[i + stride].
using PlyLever = void(int count, int stride, const double* const (&lever)[6], double* const (&force)[3]);

// into[i] += from[4 i + 3].
using PlyFoldLoads = void(int count, const double* from, double* into);

// Adds such forces to one array for each component, and leaves zeros.
using PlyFold = void(int count, double* from, double* const (&into)[3]);

// mm/s; greatest speed.
using PlySpeed = double(int count, const double* const (&v)[3]);

// What a pair's law has beside springs and Coulomb. Each has a loop of its own: a choice within one leaves it scalar.
struct PlyLawKind {
  bool sheared = false, measured = false;  // by tables, of shear stress and of pressure
  bool swollen = false;                    // plies thicken
  static constexpr int kinds = 8;
  static constexpr PlyLawKind of(int number) { return {(number & 1) != 0, (number & 2) != 0, (number & 4) != 0}; }
  [[nodiscard]] constexpr int number() const { return (sheared ? 1 : 0) + (measured ? 2 : 0) + (swollen ? 4 : 0); }
};

struct PlyLoops {
  PlyFindFeet* feet;
  PlyPress* press[PlyLawKind::kinds];
  PlyShare* share;
  PlyShare* share_swollen;
  PlyAdd* add;
  PlyWays* ways;
  PlyTurn* turn;
  PlyTake* take;
  PlyLever* lever;
  PlyGiveBack* give_back;
  PlyFoldLoads* fold_loads;
  PlyFold* fold;
  PlySpeed* speed;
};

[[nodiscard]] const PlyLoops& loops_of_plies();

}  // namespace weaveform
