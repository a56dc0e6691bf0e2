// The mesh: yarn elements merged with shear cells, as plain arrays. Units mm, tonne, MPa.
// Crossings carry their lattice indices so that the solver can lay them out in rows; yarn ends on the outline do not.
// Each part has add(), which keeps its arrays of one length, and check(): "" for a sound one, else the first thing
// wrong with it in one line.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/vector/vector.hpp"
#include "mesher/mesh/symmetry.hpp"

namespace weaveform {

enum class Family : std::uint8_t { warp = 0, weft = 1 };

struct NodeSet {
  std::string name;
  std::vector<int> node;  // rising
};

struct MeshNodes {
  std::vector<std::array<double, 3>> position;  // mm; initial
  // mm; of the flat blank, where the start is another (a drape); else empty. All rest lengths, cell coefficients and
  // areas are those of the flat blank, so a blank that starts draped starts sheared.
  std::vector<std::array<double, 3>> flat_position;
  // tonne; lumped from the yarns' linear density, near the edges shifted between neighbours so that the step holds
  std::vector<double> mass;
  // (i, j): i counts along the warp direction, j along the weft; {-1, -1} for a yarn end
  std::vector<std::array<int, 2>> crossing;
  // Gives the node's number.
  int add(const Vec3& at, double its_mass, const std::array<int, 2>& its_crossing = {-1, -1});
  [[nodiscard]] std::string check() const;
};

// One yarn element, as MeshYarns says of each.
struct MeshYarn {
  std::array<int, 2> node = {-1, -1};
  Family family = Family::warp;
  double rest_length = 0.0;  // mm
  double section = 0.0;      // mm^2
  double yarns = 1.0;
  double jaw = 0.0;  // mm
  double softening = 1.0;
};

// Straight yarn elements. True strain e = ln((L + jaw) / (L0 + jaw)); axial force
//   N = s(e) * section * softening * (L0 + jaw) / (L + jaw)          (incompressible section)
struct MeshYarns {
  std::vector<std::array<int, 2>> node;  // warp elements point along +i, weft elements along +j
  std::vector<Family> family;
  std::vector<double> rest_length;  // mm; L0
  std::vector<double> section;      // mm^2; of all yarns this element stands for
  // yarns this element stands for (coarsening times the share of its strip inside the outline)
  std::vector<double> yarns;
  std::vector<double> jaw;  // mm; > 0: a short end that reaches this far into a grip's jaws (keeps the step)
  std::vector<double>
      softening;  // 1; < 1: an end that must not set the step; 0: a tied free end, which carries nothing
  void add(const MeshYarn& yarn);
  [[nodiscard]] MeshYarn at(int element) const;
  [[nodiscard]] std::string check(int nodes) const;
};

// Shear cells: convex polygons of 3 to 6 nodes, counter-clockwise. The yarn directions at the centre are linear in the
// nodal positions, g_f = sum_a coefficient[f][a] * x_a, with |g_f| = 1 on the flat, unstretched fabric.
struct MeshCells {
  std::vector<int> offset = {0};  // cell c owns entries offset[c] .. offset[c+1]-1 of the two arrays below
  std::vector<int> node;
  std::vector<std::array<double, 2>> coefficient;  // 1/mm; [0] warp, [1] weft
  std::vector<double> area;                        // mm^2; flat area inside the outline (with that of merged slivers)
  // (i, j) of its lowest corner, -1 possible on cut cells; full quads have all four corners as nodes
  std::vector<std::array<int, 2>> lattice;
  [[nodiscard]] int size() const { return static_cast<int>(area.size()); }
  // `its_coefficient` of each of its nodes.
  void add(const std::vector<int>& its_node, const std::vector<Vec2>& its_coefficient, double its_area,
           const std::array<int, 2>& its_lattice);
  [[nodiscard]] std::string check(int nodes) const;
};

// The mean of a cell's corners.
[[nodiscard]] Vec3 cell_centre(const MeshCells& cells, int cell, const std::vector<Vec3>& position);

// Nodes that follow two others: x = (1 - share) x_a + share x_b. The solver gives their forces and mass to those two.
//   0 <= share <= 1  the end of an arm on a frame member between two corners
//   share < 0        a free yarn end, which stays in line with its yarn: a is its crossing, b the crossing before
// Why the latter: a pinned end would turn about its crossing until the cells it belongs to are unsheared, and the
// fabric's edge would carry no shear (measured: 8 % of the load of the twill's bias extension at coarsening 4, 4 % at
// 2).
struct MeshTie {
  int node = 0;
  std::array<int, 2> to = {0, 0};
  double share = 0.0;
};

// A shear frame: four pinned members around the fabric, whose arms' ends are tied to them.
struct MeshFrame {
  std::array<int, 4> corner = {-1, -1, -1, -1};  // nodes in order around: base, side, pulled, side; -1: no frame
  [[nodiscard]] bool present() const { return corner[0] >= 0; }
  bool operator==(const MeshFrame&) const = default;
};

// One ply of a stack whose plies' meshes stand one after another in one (mesher/mesh/stack.hpp): where its own begins.
struct MeshPly {
  std::string name;
  int first_node = 0, first_yarn = 0, first_cell = 0, first_tie = 0;
  int first_row = 0;                           // of the lattice: the plies' lie side by side along j
  std::array<double, 2> spacing = {0.0, 0.0};  // mm; as Mesh's, of this ply
  std::array<int, 2> lattice_size = {0, 0};
  double thickness = 0.0;  // mm
  MeshFrame frame;         // its corners, as nodes of the stack
  bool operator==(const MeshPly&) const = default;
};

struct Mesh {
  MeshNodes nodes;
  MeshYarns yarns;
  MeshCells cells;
  std::vector<MeshTie> tie;
  MeshFrame frame;
  std::vector<NodeSet> sets;                   // grips by name, and "outline"
  std::array<double, 2> spacing = {0.0, 0.0};  // mm; element length along the warp (i) and along the weft (j)
  std::array<int, 2> lattice_size = {0, 0};    // crossings span 0 <= i < lattice_size[0], 0 <= j < lattice_size[1]
  double thickness = 0.0;                      // mm
  std::vector<MeshPly> ply;  // of a stack, bottom to top; spacing and thickness above then are the least of all
  MeshSymmetry symmetry;     // of a half or quarter; mesh.vtu always holds the whole
  int first_shown = 0;       // of a ply: the number of its first node in the stack
  // What messages call a node: its number in mesh.vtu.
  [[nodiscard]] int shown_node(int node) const {
    return first_shown + (symmetry.whole_node.empty() ? node : symmetry.whole_node[static_cast<std::size_t>(node)]);
  }
  [[nodiscard]] const std::vector<std::array<double, 3>>& flat_positions() const {
    return nodes.flat_position.empty() ? nodes.position : nodes.flat_position;
  }
  [[nodiscard]] int node_count() const { return static_cast<int>(nodes.mass.size()); }
  [[nodiscard]] int yarn_count() const { return static_cast<int>(yarns.section.size()); }
  // All parts, ties and sets, and the lattice: no crossing outside it, none taken twice. Whoever reads or builds a mesh
  // asks before the solver relies on it.
  [[nodiscard]] std::string check() const;
};

}  // namespace weaveform
