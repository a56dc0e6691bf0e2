#include "solver/coupling/tension_shear.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "solver/element/shear_cell.hpp"
#include "solver/state/shear_levers.hpp"

namespace weaveform {
namespace {

struct Directions {
  double warp[3] = {}, weft[3] = {};
};

template <int width, class Cells>
[[gnu::always_inline]] inline Directions directions_of(const Components& x, const Cells& cells, int c) {
  Directions g;
  for (int a = 0; a < width; ++a) {
    const int n = cells.node[a][c];
    for (int k = 0; k < 3; ++k) {
      g.warp[k] += cells.warp[a][c] * x[k][n];
      g.weft[k] += cells.weft[a][c] * x[k][n];
    }
  }
  return g;
}

// mJ/mm^3; of pull alone.
double pulled_energy(const TangentLaw& law, double strain) {
  return strain > 0.0 ? law.energy(strain) : 0.0;
}

}  // namespace

TensionShear::TensionShear(const Mesh& mesh, const PackedMesh& packed, const Card& card,
                           const std::array<TangentLaw, 2>& yarn_laws)
    : mesh_(mesh), laws_(yarn_laws), lattice_(couple_lattice(mesh, card)), shear_(card.shear), table_(card.shear) {
  for (std::size_t f = 0; f < 2; ++f)
    if (!pack_law(laws_[f], packed_law_[f]))
      throw InputError("the yarns' tension law has too many pieces for a card that couples tension and shear");
  // yarn elements, warp first
  std::vector<int> own(mesh.yarn_count(), -1);
  for (const Family family : {Family::warp, Family::weft}) {
    for (const CoupledPair& pair : lattice_.pair) {
      if (mesh.yarns.family[pair.yarn] != family || own[pair.yarn] >= 0) continue;
      own[pair.yarn] = yarns_.size();
      yarns_.mesh_number.push_back(pair.yarn);
      yarns_.node0.push_back(packed.packed_of_mesh[mesh.yarns.node[pair.yarn][0]]);
      yarns_.node1.push_back(packed.packed_of_mesh[mesh.yarns.node[pair.yarn][1]]);
      yarns_.length.push_back(mesh.yarns.rest_length[pair.yarn]);
      yarns_.section.push_back(mesh.yarns.section[pair.yarn]);
    }
    if (family == Family::warp) yarns_.warps = yarns_.size();
  }
  for (std::size_t side = 0; side < 2; ++side) {
    yarns_.cell[side].assign(yarns_.size(), mesh.cells.size());
    yarns_.share[side].assign(yarns_.size(), 0.0);
  }
  for (auto* values : {&yarns_.strain, &yarns_.shortening, &yarns_.tension}) values->assign(yarns_.size() + 1, 0.0);
  // cells in the order of their kinds
  std::vector<std::vector<CoupledPair>> pairs(mesh.cells.size());
  for (CoupledPair pair : lattice_.pair) {
    pair.yarn = own[pair.yarn];
    pairs[pair.cell].push_back(pair);
  }
  const auto nodes_of = [&](int c) { return mesh.cells.offset[c + 1] - mesh.cells.offset[c]; };
  for (int c = 0; c < mesh.cells.size(); ++c)
    if (nodes_of(c) <= 4) add_cell(mesh, packed, c, pairs[c], quads_);
  others_.first = quads_.size();
  for (int c = 0; c < mesh.cells.size(); ++c)
    if (nodes_of(c) > 4) add_cell(mesh, packed, c, pairs[c], others_);
  for (auto* values : {&energy_, &stress_, &sine_}) values->assign(mesh.cells.size() + 1, 0.0);
}

template <int width>
void TensionShear::add_cell(const Mesh& mesh, const PackedMesh& packed, int cell, const std::vector<CoupledPair>& pairs,
                            Cells<width>& cells) {
  const int number = cells.first + cells.size(), begin = mesh.cells.offset[cell];
  const int count = mesh.cells.offset[cell + 1] - begin;
  for (int a = 0; a < width; ++a) {
    const int entry = a < count ? begin + a : begin;
    cells.node[a].push_back(packed.packed_of_mesh[mesh.cells.node[entry]]);
    cells.warp[a].push_back(a < count ? mesh.cells.coefficient[entry][0] : 0.0);
    cells.weft[a].push_back(a < count ? mesh.cells.coefficient[entry][1] : 0.0);
    const bool paired = a < static_cast<int>(pairs.size());
    cells.yarn[a].push_back(paired ? pairs[a].yarn : yarns_.size());
    cells.part[a].push_back(paired ? pairs[a].part : 0.0);
  }
  cells.volume.push_back(mesh.cells.area[cell] * mesh.thickness);
  for (const CoupledPair& pair : pairs) {
    const std::size_t side = yarns_.cell[0][pair.yarn] == mesh.cells.size() ? 0 : 1;
    yarns_.cell[side][pair.yarn] = number;
    yarns_.share[side][pair.yarn] = pair.share;
  }
}

template <int width>
void TensionShear::look_at_cells(const State& state, const Cells<width>& cells) {
  for (int c = 0; c < cells.size(); ++c) {
    const Directions g = directions_of<width>(state.position, cells, c);
    const double sine = cell_shear(g.warp, g.weft).sine;
    const auto entry = table_.at(std::abs(sine));
    energy_[cells.first + c] = entry.energy;
    stress_[cells.first + c] = std::copysign(entry.stress, sine);
    sine_[cells.first + c] = sine;
  }
}

void TensionShear::pull_yarns(State& state) {
  for (std::size_t f = 0; f < 2; ++f) {
    const int begin = f == 0 ? 0 : yarns_.warps, end = f == 0 ? yarns_.warps : yarns_.size();
    const GeneralLaw& law = packed_law_[f];
    StrainRange range;
    for (int y = begin; y < end; ++y) {
      const int a = yarns_.node0[y], b = yarns_.node1[y];
      double along[3], square = 0.0;
      for (int k = 0; k < 3; ++k) {
        along[k] = state.position[k][b] - state.position[k][a];
        square += along[k] * along[k];
      }
      const double strain = half_log<double>(square, yarns_.length[y] * yarns_.length[y]);
      const double shortening =
          yarns_.share[0][y] * energy_[yarns_.cell[0][y]] + yarns_.share[1][y] * energy_[yarns_.cell[1][y]];
      const double before = std::max(0.0, law.stress(strain)), after = std::max(0.0, law.stress(strain + shortening));
      yarns_.strain[y] = strain;
      yarns_.shortening[y] = shortening;
      yarns_.tension[y] = lattice_.section_width[f] * after;
      range.hold({0.0, strain + shortening});
      const double pull = yarns_.section[y] * yarns_.length[y] * (after - before) / square;
      for (int k = 0; k < 3; ++k) {
        state.force[k][a] += pull * along[k];
        state.force[k][b] -= pull * along[k];
      }
    }
    strains_[f] = range;
  }
}

template <int width>
void TensionShear::shear_cells(State& state, const Cells<width>& cells) const {
  for (int c = 0; c < cells.size(); ++c) {
    double tension = 0.0;
    for (int a = 0; a < width; ++a) tension += cells.part[a][c] * yarns_.tension[cells.yarn[a][c]];
    const double force = cells.volume[c] * lattice_.coupling * tension * stress_[cells.first + c];
    if (force == 0.0) continue;
    const Directions g = directions_of<width>(state.position, cells, c);
    const CellForce<double> f =
        sheared_cell_force<Formulation::energy>(cell_shear(g.warp, g.weft), g.warp, g.weft, force);
    for (int a = 0; a < width; ++a) {
      const int n = cells.node[a][c];
      for (int k = 0; k < 3; ++k) state.force[k][n] -= cells.warp[a][c] * f.warp[k] + cells.weft[a][c] * f.weft[k];
    }
  }
}

void TensionShear::add_forces(State& state, double /*step*/) {
  look_at_cells(state, quads_);
  look_at_cells(state, others_);
  pull_yarns(state);
  shear_cells(state, quads_);
  shear_cells(state, others_);
}

StoredEnergy TensionShear::stored_energy() const {
  StoredEnergy stored;
  for (int y = 0; y < yarns_.size(); ++y) {
    const TangentLaw& law = laws_[y < yarns_.warps ? 0 : 1];
    stored.total +=
        yarns_.section[y] * yarns_.length[y] *
        (pulled_energy(law, yarns_.strain[y] + yarns_.shortening[y]) - pulled_energy(law, yarns_.strain[y]));
  }
  return stored;
}

void TensionShear::archive(Archive& archive) {
  archive.numbers("a coupled yarn's strain", yarns_.strain);
  archive.numbers("a coupled yarn's shortening", yarns_.shortening, not_negative);
}

// The Hessian beyond A L0 C (de)^2, which is the net's: A L0 C (de dd + dd de + dd dd), and sum_c V_c a T_c d2w. With r_a =
// |c1_a|/|g1| + |c2_a|/|g2| a cell has |dd/dx_a| <= share |dw/ds| r_a and |d2w/dx_a dx_b| <= (C_sh + 3 sigma) r_a r_b
// (critical_step.hpp), and a yarn |de/dx| = 1/L at both ends. A yarn that is pressed and pulled by its shortening has both
// stiffnesses; that of pressing is added.
void TensionShear::add_stiffness_bound(const std::vector<Vec3>& position, double /*fabric_frequency*/,
                                       std::vector<double>& bound) const {
  const MeshCells& cells = mesh_.cells;
  std::vector<ShearLevers> lever;
  std::vector<double> slope(cells.size(), 0.0), energy(cells.size(), 0.0);
  for (int c = 0; c < cells.size(); ++c) {
    lever.push_back(shear_levers(cells, c, position));
    const auto at = table_.at(std::abs(lever[c].sine));
    slope[c] = at.stress;
    energy[c] = at.energy;
  }
  const auto shortening = shortenings(lattice_, energy, static_cast<std::size_t>(mesh_.yarn_count()));
  std::vector<double> turn(mesh_.yarn_count(), 0.0);  // 1/mm; sum of |dd/dx| of a yarn
  for (const CoupledPair& pair : lattice_.pair) turn[pair.yarn] += pair.share * slope[pair.cell] * lever[pair.cell].sum;
  constexpr double margin = 1.25;  // of strains, until the bound is renewed
  std::vector<double> stiffness(mesh_.yarn_count(), 0.0), tension(mesh_.yarn_count(), 0.0);  // N mm, N/mm
  for (int y = 0; y < mesh_.yarn_count(); ++y) {
    if (!(turn[y] > 0.0) && shortening[y] == 0.0) continue;
    const auto f = static_cast<std::size_t>(mesh_.yarns.family[y]);
    const auto [a, b] = mesh_.yarns.node[y];
    const double length = std::sqrt(dot(minus(position[b], position[a]), minus(position[b], position[a])));
    const double strain = std::log(length / mesh_.yarns.rest_length[y]), reached = margin * (strain + shortening[y]);
    if (reached <= 0.0) continue;
    const double volume = mesh_.yarns.section[y] * mesh_.yarns.rest_length[y];
    stiffness[y] = volume * laws_[f].stiffest(0.0, reached);
    tension[y] = lattice_.section_width[f] * std::max(0.0, laws_[f].stress(reached));
    const double pressed = strain < 0.0 ? 2.0 * volume * laws_[f].tangent(strain) / (length * length) : 0.0;
    for (const int end : {a, b}) bound[end] += stiffness[y] / length * turn[y] + pressed;
    // what the cells' nodes get of it, below, per lever
    turn[y] += 2.0 / length;
  }
  for (const CoupledPair& pair : lattice_.pair) {
    const int c = pair.cell, begin = cells.offset[c];
    const double volume = cells.area[c] * mesh_.thickness, log_strain = std::atanh(std::abs(lever[c].sine));
    const double curved = volume * lattice_.coupling * pair.part * tension[pair.yarn] *
                          (std::abs(shear_tangent(shear_, log_strain)) + 3.0 * std::abs(slope[c])) * lever[c].sum;
    const double whole = stiffness[pair.yarn] * pair.share * slope[c] * turn[pair.yarn] + curved;
    for (int a = 0; a < cells.offset[c + 1] - begin; ++a) bound[cells.node[begin + a]] += whole * lever[c].of_node[a];
  }
}

}  // namespace weaveform
