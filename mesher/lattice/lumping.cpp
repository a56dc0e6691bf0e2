#include "mesher/lattice/lumping.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace weaveform::lattice {

namespace {

// A crossing of the endless lattice with this spacing.
struct Lattice {
  std::array<double, 2> modulus{};  // MPa
  std::array<double, 2> row_sum{};  // N/mm; 4 K of each family: two elements, each counted twice
  double mass = 0.0;                // tonne
  [[nodiscard]] double stiffest() const { return std::max(row_sum[0], row_sum[1]); }
  // Mass that keeps a node with row sums `own` at a share of the lattice's step, both flat (families at right angles:
  // the greater sum counts) and sheared flat (families in line: both count).
  [[nodiscard]] double mass_for(const std::array<double, 2>& own, double share) const {
    const double flat = std::max(own[0], own[1]) / stiffest();
    const double sheared = (own[0] + own[1]) / (row_sum[0] + row_sum[1]);
    return share * share * mass * std::max(flat, sheared);
  }
};

Lattice endless_lattice(const Mesh& mesh, const Card& card, const std::array<double, 2>& coarsening) {
  Lattice lattice;
  for (std::size_t f = 0; f < 2; ++f) {
    const YarnCard& yarn = card.yarn[f];
    // A card without a modulus has no step to keep; the families then count alike.
    lattice.modulus[f] = yarn.linear_modulus > 0.0 ? yarn.linear_modulus : 1.0;
    lattice.row_sum[f] = 4.0 * lattice.modulus[f] * yarn.section * coarsening[f] / mesh.spacing[f];
    lattice.mass += yarn.linear_density * coarsening[f] * mesh.spacing[f];
  }
  return lattice;
}

double times_counted(Hold neighbour) {
  return neighbour == Hold::rigid ? 1.0 : 2.0;
}

std::size_t family_of(const Mesh& mesh, int element) {
  return static_cast<std::size_t>(mesh.yarns.family[element]);
}

// A stub: an element whose one node no other element holds. That is a yarn end on the outline, or the last crossing of
// a yarn whose other yarn is too short for elements. Elements between crossings have end = -1.
struct Stub {
  int end = -1;
  int crossing = -1;
};

std::vector<Stub> find_stubs(const Mesh& mesh) {
  std::vector<int> elements(mesh.node_count(), 0);
  for (const auto& ends : mesh.yarns.node)
    for (const int n : ends) ++elements[n];
  std::vector<Stub> stubs(mesh.yarn_count());
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto& [a, b] = mesh.yarns.node[e];
    if (elements[a] == 1) stubs[e] = {a, b};
    if (elements[b] == 1) stubs[e] = {b, a};
  }
  return stubs;
}

double element_mass(const Mesh& mesh, const Card& card, int element) {
  return card.yarn[family_of(mesh, element)].linear_density * mesh.yarns.yarns[element] *
         mesh.yarns.rest_length[element];
}

double element_stiffness(const Mesh& mesh, const Lattice& lattice, int element) {
  return lattice.modulus[family_of(mesh, element)] * mesh.yarns.section[element] * mesh.yarns.softening[element] /
         (mesh.yarns.rest_length[element] + mesh.yarns.jaw[element]);
}

double end_mass(const Mesh& mesh, const Stub& stub, Hold end, int element, double mass) {
  if (end == Hold::rigid) return held_end_share * mass;
  const double whole = mass * mesh.spacing[family_of(mesh, element)] / mesh.yarns.rest_length[element];
  const bool on_outline = mesh.nodes.crossing[stub.end][0] < 0;
  return on_outline ? std::max(0.5 * mass, free_end_share * whole) : 0.5 * mass;
}

void lump_masses(Mesh& mesh, const Card& card, const std::vector<Stub>& stubs, const std::vector<Hold>& hold) {
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const double mass = element_mass(mesh, card, e);
    const Stub& stub = stubs[e];
    const int first = stub.end >= 0 ? stub.end : mesh.yarns.node[e][0];
    const int second = stub.end >= 0 ? stub.crossing : mesh.yarns.node[e][1];
    const double share = stub.end >= 0 ? end_mass(mesh, stub, hold[stub.end], e, mass) : 0.5 * mass;
    mesh.nodes.mass[first] += share;
    mesh.nodes.mass[second] += mass - share;
  }
}

// 2 softening E A / L = (c/m of the lattice) * mass of the end.
void soften(Mesh& mesh, const Lattice& lattice, const Stub& stub, Hold crossing, int element) {
  const double bearable = lattice.stiffest() * mesh.nodes.mass[stub.end] / lattice.mass;
  const double stiffness = times_counted(crossing) * element_stiffness(mesh, lattice, element);
  mesh.yarns.softening[element] = std::min(1.0, bearable / stiffness);
}

using RowSums = std::vector<std::array<double, 2>>;

RowSums row_sums(const Mesh& mesh, const Lattice& lattice, const std::vector<Hold>& hold) {
  RowSums sum(mesh.node_count(), {0.0, 0.0});
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto& [a, b] = mesh.yarns.node[e];
    const double stiffness = element_stiffness(mesh, lattice, e);
    sum[a][family_of(mesh, e)] += times_counted(hold[b]) * stiffness;
    sum[b][family_of(mesh, e)] += times_counted(hold[a]) * stiffness;
  }
  return sum;
}

// The jaw that brings E A / (L0 + jaw) of a held stub down to what its crossing can bear beside its other elements of
// the family, at the wanted step and with the mass it may count on.
void reach_into_jaws(Mesh& mesh, const Lattice& lattice, const Stub& stub, Hold end, double row_sum, int element) {
  const double own = times_counted(end) * element_stiffness(mesh, lattice, element);
  const double mass = (1.0 + lendable_share) * mesh.nodes.mass[stub.crossing];
  const double bearable = mass * lattice.stiffest() / (step_share * step_share * lattice.mass) - (row_sum - own);
  // Never longer than to a whole element: the crossing's other neighbours then weigh as much as the jaws.
  const double length = mesh.yarns.rest_length[element];
  const double longest = std::max(length, mesh.spacing[family_of(mesh, element)]);
  const double wanted = bearable > 0.0 ? length * own / bearable : longest;
  mesh.yarns.jaw[element] = std::clamp(wanted, length, longest) - length;
}

// Softening and jaws, by the masses before any shift.
void ease_stubs(Mesh& mesh, const Lattice& lattice, const std::vector<Stub>& stubs, const std::vector<Hold>& hold) {
  for (int e = 0; e < mesh.yarn_count(); ++e)
    if (stubs[e].end >= 0 && hold[stubs[e].end] == Hold::free)
      soften(mesh, lattice, stubs[e], hold[stubs[e].crossing], e);
  const RowSums sum = row_sums(mesh, lattice, hold);
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const Stub& stub = stubs[e];
    if (stub.end < 0 || hold[stub.end] == Hold::free || hold[stub.crossing] == Hold::rigid) continue;
    reach_into_jaws(mesh, lattice, stub, hold[stub.end], sum[stub.crossing][family_of(mesh, e)], e);
  }
}

// Crossings by their lattice indices.
struct CrossingMap {
  const Mesh& mesh;
  std::vector<int> node;
  explicit CrossingMap(const Mesh& of)
      : mesh(of), node(static_cast<std::size_t>(of.lattice_size[0]) * of.lattice_size[1], -1) {
    for (int n = 0; n < mesh.node_count(); ++n)
      if (mesh.nodes.crossing[n][0] >= 0) node[index(mesh.nodes.crossing[n][0], mesh.nodes.crossing[n][1])] = n;
  }
  [[nodiscard]] std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * mesh.lattice_size[0] + i; }
  [[nodiscard]] int at(int i, int j) const {
    if (i < 0 || j < 0 || i >= mesh.lattice_size[0] || j >= mesh.lattice_size[1]) return -1;
    return node[index(i, j)];
  }
};

// Fills a node's want of mass from the crossings within `reach` steps of (i, j) along the yarns, in proportion to what
// each can spare.
void draw_mass(Mesh& mesh, const CrossingMap& map, const std::vector<double>& needed, int node, int reach,
               const std::array<int, 2>& around) {
  auto& mass = mesh.nodes.mass;
  const auto& [i, j] = around;
  std::vector<int> donor;
  double spare = 0.0;
  for (int dj = -reach; dj <= reach; ++dj) {
    const int width = reach - std::abs(dj);
    for (int di = -width; di <= width; ++di) {
      const int d = map.at(i + di, j + dj);
      if (d < 0 || mass[d] <= needed[d]) continue;
      donor.push_back(d);
      spare += mass[d] - needed[d];
    }
  }
  if (spare <= 0.0) return;
  const double share = std::min(1.0, (needed[node] - mass[node]) / spare);
  for (const int d : donor) {
    const double moved = share * (mass[d] - needed[d]);
    mass[d] -= moved;
    mass[node] += moved;
  }
}

// Moves mass until every node has what it needs for a share of the lattice's step. False when some still want.
bool shift_mass(Mesh& mesh, const CrossingMap& map, const std::vector<double>& needed,
                const std::vector<std::array<int, 2>>& around) {
  // A node counts as served a rounding error below its need.
  const auto wants = [&](int n) { return mesh.nodes.mass[n] < (1.0 - 1e-9) * needed[n]; };
  std::vector<int> light;
  for (int n = 0; n < mesh.node_count(); ++n)
    if (wants(n)) light.push_back(n);
  // Nearest first for all, so that no crossing empties what its neighbour needs more.
  for (int reach = 1; reach <= farthest_shift; ++reach)
    for (const int n : light)
      if (wants(n)) draw_mass(mesh, map, needed, n, reach, around[n]);
  return std::none_of(light.begin(), light.end(), wants);
}

}  // namespace

void lump(Mesh& mesh, const Card& card, const std::array<double, 2>& coarsening, const std::vector<Hold>& hold) {
  const Lattice lattice = endless_lattice(mesh, card, coarsening);
  const std::vector<Stub> stubs = find_stubs(mesh);
  mesh.yarns.jaw.assign(mesh.yarn_count(), 0.0);
  mesh.yarns.softening.assign(mesh.yarn_count(), 1.0);
  mesh.nodes.mass.assign(mesh.node_count(), 0.0);
  lump_masses(mesh, card, stubs, hold);
  ease_stubs(mesh, lattice, stubs, hold);

  // Yarn ends draw mass from around their crossing.
  std::vector<std::array<int, 2>> around = mesh.nodes.crossing;
  for (const auto& stub : stubs)
    if (stub.end >= 0) around[stub.end] = mesh.nodes.crossing[stub.crossing];
  const RowSums sum = row_sums(mesh, lattice, hold);
  const CrossingMap map(mesh);
  const std::vector<double> lumped = mesh.nodes.mass;
  bool served = false;
  for (double share = step_share; !served && share >= least_step_share; share -= 0.005) {
    std::vector<double> needed(mesh.node_count());
    for (int n = 0; n < mesh.node_count(); ++n)
      needed[n] = hold[n] == Hold::rigid ? held_crossing_keeps * lumped[n] : lattice.mass_for(sum[n], share);
    mesh.nodes.mass = lumped;
    served = shift_mass(mesh, map, needed, around);
  }
}

}  // namespace weaveform::lattice
