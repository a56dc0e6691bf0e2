#include "solver/lattice/forces.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "solver/element/sheared_start.hpp"
#include "solver/lattice/row_kernels.hpp"
#include "solver/state/row_blocks.hpp"

namespace weaveform {
namespace {

struct Scratch {
  Scratch(int stride, bool with_history) : along(row_vectors(stride)), across(along), p(along), q(along), carry(along) {
    if (with_history) spare_history.assign(cell_history_size, Doubles(stride));
  }
  RowVectors along, across, p, q, carry;
  std::vector<Doubles> spare_history;  // where the histories of a neighbour's row go
};

// The histories of all cells of one kind, at the last two calls: read from one, written to the other.
class HistoryStore {
public:
  void allocate(int cells) {
    for (auto& side : side_)
      for (auto& array : side) array.assign(cells, 0.0);
  }
  void swap() { std::swap(side_[0], side_[1]); }
  [[nodiscard]] std::array<Doubles, cell_history_size>& current() { return side_[0]; }
  // From entry `offset` on; written to `spare` when given.
  [[nodiscard]] HistoryArrays arrays(std::size_t offset, std::vector<Doubles>* spare = nullptr) {
    HistoryArrays result{};
    for (int k = 0; k < cell_history_size; ++k) {
      result.before[k] = side_[0][k].data() + offset;
      result.after[k] = spare != nullptr ? (*spare)[k].data() : side_[1][k].data() + offset;
    }
    return result;
  }

private:
  std::array<std::array<Doubles, cell_history_size>, 2> side_;
};

// A law in the shape the inner loop wants: the paper's when it fits, the general one otherwise.
struct YarnLawShape {
  PaperLaw paper;
  GeneralLaw general;
  bool is_paper = false;
  [[nodiscard]] const void* pointer() const { return is_paper ? static_cast<const void*>(&paper) : &general; }
};

YarnLawShape shape_yarn_law(const TangentLaw& law, const std::string& what) {
  YarnLawShape shape;
  shape.is_paper = pack_law(law, shape.paper);
  if (!shape.is_paper && !pack_law(law, shape.general))
    throw InputError("material: the tension and compression laws of the " + what +
                     " yarns have more than 8 pieces together (an end of a last piece counts as one more) or a tangent "
                     "above degree 5; simplify them");
  return shape;
}

struct ShearLawShape {
  PaperShear paper;
  StartedShear started;
  GeneralShear general;
  ShearShape shape = ShearShape::general;

  [[nodiscard]] const void* pointer() const {
    if (shape == ShearShape::general) return &general;
    return shape == ShearShape::started ? static_cast<const void*>(&started) : &paper;
  }
  // Cells with a history have no loop for a law without a start.
  [[nodiscard]] const void* with_history() const {
    return shape == ShearShape::general ? static_cast<const void*>(&general) : &started;
  }
};

ShearLawShape shape_shear_law(const ShearCard& card) {
  ShearLawShape shape;
  if (pack_law(card.tangent, shape.paper.law)) {
    shape.shape = card.start.plateau == 0.0 ? ShearShape::paper : ShearShape::started;
    shape.started.law = shape.paper.law;
  } else if (!pack_law(card.tangent, shape.general.law)) {
    throw InputError("material: the shear law has more than 6 pieces or a tangent above degree 5; simplify it");
  }
  shape.started.plateau = shape.general.plateau = card.start.plateau;
  shape.started.rise = shape.general.rise = card.start.plateau != 0.0 ? card.start.rise : 1.0;
  return shape;
}

}  // namespace

struct FabricForces::Kernels {
  const RowLoops& loops = loops_of_rows();
  const PackedMesh& packed;
  Team& team;
  double thickness;
  std::array<YarnLawShape, 2> yarn_law;
  ShearLawShape shear;
  std::array<YarnKernels, 2> yarn;
  std::array<double, 2> viscosity = {0.0, 0.0};  // MPa s
  double look_ahead = 0.0;                       // s
  // per row, so that sums have one order for any number of threads
  std::array<std::vector<YarnSums>, 2> row_sums;  // warp, weft
  std::vector<double> row_sharpest;
  std::array<YarnSums, 2> sums;  // of all yarns in the last call
  double sharpest = 0.0;         // sin^2 gamma, of all cells
  bool has_history;
  CellKernels cell{};
  HistoryCellKernels history_cell{};
  HistoryStore lattice_history, loose_history;
  RowRuns warp_runs, weft_runs, cell_runs;  // padded, but for cells with a history
  std::vector<int> block;
  std::vector<Scratch> scratch;
  std::array<std::array<Doubles, 3>, 2> loose_yarn_force;
  std::array<Doubles, 3> loose_warp_force, loose_weft_force;

  Kernels(const PackedMesh& packed_mesh, const Card& card, const std::array<TangentLaw, 2>& yarn_laws,
          const ModelSpec& model, const State& start, Team& its_team)
      : packed(packed_mesh),
        team(its_team),
        thickness(card.thickness),
        yarn_law{shape_yarn_law(yarn_laws[0], "warp"), shape_yarn_law(yarn_laws[1], "weft")},
        shear(shape_shear_law(card.shear)),
        row_sums{std::vector<YarnSums>(packed_mesh.rows), std::vector<YarnSums>(packed_mesh.rows)},
        row_sharpest(packed_mesh.rows, 0.0),
        has_history(model.formulation == Formulation::incremental || model.formulation == Formulation::side_frame),
        warp_runs(padded_runs(packed_mesh.warp_runs)),
        weft_runs(padded_runs(packed_mesh.weft_runs)),
        cell_runs(has_history ? packed_mesh.cell_runs : padded_runs(packed_mesh.cell_runs)),
        block(balanced_blocks(packed_mesh, its_team.threads())) {
    for (int f = 0; f < 2; ++f) yarn[f] = yarn_kernels(model.section, yarn_law[f].is_paper);
    if (has_history) {
      history_cell =
          history_cell_kernels(model.formulation == Formulation::side_frame ? Frame::side : Frame::green_naghdi,
                               model.thickness, shear.shape);
      start_history(start);
      start_sheared(model);
    } else {
      cell = cell_kernels(model.formulation, model.thickness, shear.shape);
    }
    for (int t = 0; t < team.threads(); ++t) scratch.emplace_back(packed.stride, has_history);
    for (int c = 0; c < 3; ++c) {
      for (int f = 0; f < 2; ++f) loose_yarn_force[f][c].resize(packed.loose_yarns[f].size());
      loose_warp_force[c].resize(packed.loose_cells.size());
      loose_weft_force[c].resize(packed.loose_cells.size());
    }
  }

  // Histories begin with the directions of the start state ...
  void start_history(const State& start) {
    lattice_history.allocate(packed.lattice_nodes());
    loose_history.allocate(packed.loose_cells.size());
    for (int c = 0; c < 3; ++c) {
      const double* x = start.position[c].data();
      for (int j = 0; j + 1 < packed.rows; ++j)
        for (int r = packed.cell_runs.first[j]; r < packed.cell_runs.first[j + 1]; ++r)
          for (int i = packed.cell_runs.run[r].begin; i < packed.cell_runs.run[r].end; ++i) {
            const int n = j * packed.stride + i, up = n + packed.stride;
            lattice_history.current()[c][n] = 0.5 * (x[n + 1] - x[n] + x[up + 1] - x[up]) / packed.spacing[0];
            lattice_history.current()[3 + c][n] = 0.5 * (x[up] - x[n] + x[up + 1] - x[n + 1]) / packed.spacing[1];
          }
      const auto& loose = packed.loose_cells;
      for (int e = 0; e < loose.size(); ++e)
        for (int a = 0; a < LooseCells::width; ++a) {
          loose_history.current()[c][e] += loose.warp_coefficient[e][a] * x[loose.node[e][a]];
          loose_history.current()[3 + c][e] += loose.weft_coefficient[e][a] * x[loose.node[e][a]];
        }
    }
  }

  // ... and the stress of a cell that starts sheared.
  void start_sheared(const ModelSpec& model) {
    if (shear.shape == ShearShape::general) return start_sheared_with(shear.general, model);
    start_sheared_with(shear.started, model);
  }

  template <class Law>
  void start_sheared_with(const Law& law, const ModelSpec& model) {
    const bool side = model.formulation == Formulation::side_frame, constant = model.thickness == Thickness::constant;
    const auto start_cell = [&](std::array<Doubles, cell_history_size>& store, std::size_t n, double volume) {
      const double g1[3] = {store[0][n], store[1][n], store[2][n]}, g2[3] = {store[3][n], store[4][n], store[5][n]};
      CellHistory h{};
      if (side)
        h = constant ? sheared_start<Frame::side, Thickness::constant>(law, g1, g2, volume)
                     : sheared_start<Frame::side, Thickness::constant_volume>(law, g1, g2, volume);
      else
        h = constant ? sheared_start<Frame::green_naghdi, Thickness::constant>(law, g1, g2, volume)
                     : sheared_start<Frame::green_naghdi, Thickness::constant_volume>(law, g1, g2, volume);
      const double value[5] = {h.stress1, h.stress2, h.stress4, h.strain, h.work};
      for (int k = 0; k < 5; ++k) store[6 + k][n] = value[k];
    };
    for (int j = 0; j + 1 < packed.rows; ++j)
      for (int r = packed.cell_runs.first[j]; r < packed.cell_runs.first[j + 1]; ++r)
        for (int i = packed.cell_runs.run[r].begin; i < packed.cell_runs.run[r].end; ++i) {
          const auto n = static_cast<std::size_t>(j) * packed.stride + i;
          start_cell(lattice_history.current(), n, packed.cell_area[n] * thickness);
        }
    for (int e = 0; e < packed.loose_cells.size(); ++e)
      start_cell(loose_history.current(), static_cast<std::size_t>(e), packed.loose_cells.area[e] * thickness);
  }

  [[nodiscard]] RowPair row_pair(const Components& values, int row_a, int shift_b, int row_b) const {
    RowPair rows{};
    for (int c = 0; c < 3; ++c) {
      rows.a[c] = values[c].data() + static_cast<std::size_t>(row_a) * packed.stride;
      rows.b[c] = values[c].data() + static_cast<std::size_t>(row_b) * packed.stride + shift_b;
    }
    return rows;
  }

  static void add(YarnSums& sum, const YarnSums& more) {
    sum.power += more.power;
    sum.shortest = std::min(sum.shortest, more.shortest);
    sum.longest = std::max(sum.longest, more.longest);
  }

  static std::array<double*, 3> pointers(RowVectors& buffers) {
    return {buffers[0].data(), buffers[1].data(), buffers[2].data()};
  }

  void along_row(const State& state, int j, Scratch& s) {
    double* const t[3] = {s.along[0].data(), s.along[1].data(), s.along[2].data()};
    const RowPair rows = row_pair(state.position, j, 1, j), velocity = row_pair(state.velocity, j, 1, j);
    const double* area = packed.warp_section.data() + static_cast<std::size_t>(j) * packed.stride;
    for (int r = warp_runs.first[j]; r < warp_runs.first[j + 1]; ++r)
      add(row_sums[0][j], yarn[0].row(yarn_law[0].pointer(), rows, velocity, packed.spacing[0], viscosity[0],
                                      look_ahead, area, warp_runs.run[r].begin, warp_runs.run[r].end, t));
  }

  // Weft elements and cells between rows j and j+1.
  // `foreign`: the row is a neighbour block's own, which alone keeps its histories and counts its power.
  void between_rows(const State& state, int j, Run range, Scratch& s, bool foreign = false) {
    for (auto* buffers : {&s.across, &s.p, &s.q})
      for (auto& buffer : *buffers) buffer.clear(range);
    if (j + 1 >= packed.rows) return;
    const RowPair rows = row_pair(state.position, j, 0, j + 1), velocity = row_pair(state.velocity, j, 0, j + 1);
    const auto offset = static_cast<std::size_t>(j) * packed.stride;
    double* const t[3] = {s.across[0].data(), s.across[1].data(), s.across[2].data()};
    for (int r = weft_runs.first[j]; r < weft_runs.first[j + 1]; ++r) {
      const YarnSums found =
          yarn[1].row(yarn_law[1].pointer(), rows, velocity, packed.spacing[1], viscosity[1], look_ahead,
                      packed.weft_section.data() + offset, weft_runs.run[r].begin, weft_runs.run[r].end, t);
      if (!foreign) add(row_sums[1][j], found);
    }
    const CellRowOutput out{{s.p[0].data(), s.p[1].data(), s.p[2].data()},
                            {s.q[0].data(), s.q[1].data(), s.q[2].data()}};
    const double inverse1 = 1.0 / packed.spacing[0], inverse2 = 1.0 / packed.spacing[1];
    const double* area = packed.cell_area.data() + offset;
    for (int r = cell_runs.first[j]; r < cell_runs.first[j + 1]; ++r) {
      const auto [begin, end] = cell_runs.run[r];
      double found = 0.0;
      if (has_history)
        found = history_cell.row(shear.with_history(), rows, inverse1, inverse2, area, thickness, begin, end,
                                 lattice_history.arrays(offset, foreign ? &s.spare_history : nullptr), out);
      else
        found = cell.row(shear.pointer(), rows, inverse1, inverse2, area, thickness, begin, end, out);
      if (!foreign) row_sharpest[j] = std::max(row_sharpest[j], found);
    }
  }

  [[nodiscard]] Run reach(int j) const {
    return padded(united(packed.span(j), j + 1 < packed.rows ? packed.span(j + 1) : Run{}));
  }

  void lattice_block(State& state, int first, int last, Scratch& s) {
    if (first == last) return;
    for (auto& buffer : s.carry) buffer.clear({0, packed.stride});
    if (first > 0) {  // the block's first row also carries the elements below it, which its neighbour computes too
      const Run range = reach(first - 1);
      between_rows(state, first - 1, range, s, true);
      for (int c = 0; c < 3; ++c)
        loops.carry_row(s.across[c].data(), s.p[c].data(), s.q[c].data(), s.carry[c].data(), range.begin, range.end);
    }
    for (int j = first; j < last; ++j) {
      const Run range = reach(j);
      for (auto& buffer : s.along) buffer.clear(range);
      for (auto& family : row_sums) family[j] = {};
      row_sharpest[j] = 0.0;
      along_row(state, j, s);
      between_rows(state, j, range, s);
      for (int c = 0; c < 3; ++c)
        loops.assemble_row(s.along[c].data(), s.across[c].data(), s.p[c].data(), s.q[c].data(), s.carry[c].data(),
                           state.force[c].data() + static_cast<std::size_t>(j) * packed.stride, range.begin, range.end);
    }
  }

  void loose_yarn_forces(State& state, int family) {
    const auto& yarns = packed.loose_yarns[family];
    auto& force = loose_yarn_force[family];
    const double* const x[3] = {state.position[0].data(), state.position[1].data(), state.position[2].data()};
    const double* const v[3] = {state.velocity[0].data(), state.velocity[1].data(), state.velocity[2].data()};
    double* const t[3] = {force[0].data(), force[1].data(), force[2].data()};
    add(sums[family], yarn[family].loose(yarn_law[family].pointer(),
                                         {yarns.size(), yarns.node0.data(), yarns.node1.data(), yarns.length.data(),
                                          yarns.jaw.data(), yarns.section.data()},
                                         viscosity[family], look_ahead, x, v, t));
    for (int c = 0; c < 3; ++c) {
      double* f = state.force[c].data();
      for (int e = 0; e < yarns.size(); ++e) {
        f[yarns.node0[e]] += t[c][e];
        f[yarns.node1[e]] -= t[c][e];
      }
    }
  }

  void loose_cell_forces(State& state) {
    const auto& cells = packed.loose_cells;
    if (cells.size() == 0) return;
    const double* const x[3] = {state.position[0].data(), state.position[1].data(), state.position[2].data()};
    double* const warp[3] = {loose_warp_force[0].data(), loose_warp_force[1].data(), loose_warp_force[2].data()};
    double* const weft[3] = {loose_weft_force[0].data(), loose_weft_force[1].data(), loose_weft_force[2].data()};
    const LooseCellView view{cells.size(), cells.node[0].data(), cells.warp_coefficient[0].data(),
                             cells.weft_coefficient[0].data(), cells.area.data()};
    double found = 0.0;
    if (has_history)
      found = history_cell.loose(shear.with_history(), view, thickness, x, loose_history.arrays(0), warp, weft);
    else
      found = cell.loose(shear.pointer(), view, thickness, x, warp, weft);
    sharpest = std::max(sharpest, found);
    for (int c = 0; c < 3; ++c) {
      double* f = state.force[c].data();
      for (int e = 0; e < cells.size(); ++e)
        for (int a = 0; a < LooseCells::width; ++a)
          f[cells.node[e][a]] -= cells.warp_coefficient[e][a] * warp[c][e] + cells.weft_coefficient[e][a] * weft[c][e];
    }
  }
};

FabricForces::FabricForces(const PackedMesh& packed, const Card& card, const std::array<TangentLaw, 2>& yarn_laws,
                           const ModelSpec& model, const State& start, Team& team)
    : kernels_(std::make_unique<Kernels>(packed, card, yarn_laws, model, start, team)) {}

FabricForces::~FabricForces() = default;

void FabricForces::compute(State& state) {
  auto& k = *kernels_;
  k.team.run(static_cast<int>(k.scratch.size()),
             [&](int b) { k.lattice_block(state, k.block[b], k.block[b + 1], k.scratch[b]); });
  for (int c = 0; c < 3; ++c) std::fill(state.force[c].begin() + k.packed.lattice_nodes(), state.force[c].end(), 0.0);
  for (int f = 0; f < 2; ++f) {
    k.sums[f] = {};
    for (const YarnSums& row : k.row_sums[f]) k.add(k.sums[f], row);
  }
  k.sharpest = k.row_sharpest.empty() ? 0.0 : *std::max_element(k.row_sharpest.begin(), k.row_sharpest.end());
  for (int f = 0; f < 2; ++f) k.loose_yarn_forces(state, f);
  k.loose_cell_forces(state);
  if (k.has_history) {
    k.lattice_history.swap();
    k.loose_history.swap();
  }
}

void FabricForces::set_viscosity(const std::array<double, 2>& viscosity) {
  kernels_->viscosity = viscosity;
}

void FabricForces::set_look_ahead(double time) {
  kernels_->look_ahead = time;
}

std::array<StrainRange, 2> FabricForces::strains() const {
  constexpr double least = 1e-6;  // a yarn that would come to nothing, or beyond
  std::array<StrainRange, 2> strains;
  for (int f = 0; f < 2; ++f)
    strains[f] = {0.5 * std::log(std::max(least, kernels_->sums[f].shortest)),
                  0.5 * std::log(kernels_->sums[f].longest)};
  return strains;
}

double FabricForces::sharpest() const {
  return kernels_->sharpest;
}

double FabricForces::viscous_power() const {
  return kernels_->sums[0].power + kernels_->sums[1].power;
}

double FabricForces::cell_work() const {
  if (!kernels_->has_history) return 0.0;
  double work = 0.0;
  for (auto* store : {&kernels_->lattice_history, &kernels_->loose_history})
    for (const double w : store->current().back()) work += w;
  return work;
}

void FabricForces::archive(Archive& archive) {
  for (YarnSums& sums : kernels_->sums) archive.number("the yarns' viscous power", sums.power);
  if (!kernels_->has_history) return;
  for (auto* store : {&kernels_->lattice_history, &kernels_->loose_history})
    for (auto& array : store->current()) archive.numbers("a cell's history", array);
}

}  // namespace weaveform
