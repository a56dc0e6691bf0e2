#include "solver/lattice/forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "solver/lattice/band_forces.hpp"
#include "solver/lattice/bands.hpp"
#include "solver/lattice/cell_histories.hpp"
#include "solver/lattice/element_loops.hpp"
#include "solver/lattice/law_shapes.hpp"
#include "solver/lattice/node_loops.hpp"

namespace weaveform {
namespace {

// What one thread works on: two bands in turn, of which the one before holds the row below this one's first.
template <class Real>
struct Scratch {
  Scratch(int slots, int stride, bool with_history) : bands{BandForces<Real>(slots), BandForces<Real>(slots)} {
    if (with_history) spare_history.assign(cell_history_size, Doubles(stride));
  }
  std::array<BandForces<Real>, 2> bands;
  std::vector<Doubles> spare_history;  // where the histories of a neighbour's row go
};

template <class Real>
using Reals = std::vector<Real, CacheLineAllocator<Real>>;

}  // namespace

// What is the same in either precision.
struct FabricForces::Kernels {
  const PackedMesh& packed;
  Team& team;
  double thickness;
  std::array<YarnLawShape, 2> yarn_law;
  ShearLawShape shear;
  std::array<double, 2> viscosity = {0.0, 0.0};  // MPa s
  double look_ahead = 0.0;                       // s
  Bands bands;
  std::vector<int> share;           // of each thread: its first band
  std::vector<BandSums> band_sums;  // one per band
  std::array<YarnSums, 2> sums;     // of all yarns in the last call
  double sharpest = 0.0;            // sin^2 gamma, of all cells
  bool has_history;
  CellHistories histories;  // where cells have one

  Kernels(const PackedMesh& packed_mesh, const Card& card, const std::array<TangentLaw, 2>& yarn_laws,
          const ModelSpec& model, const State& start, Team& its_team)
      : packed(packed_mesh),
        team(its_team),
        thickness(card.thickness),
        yarn_law{shape_yarn_law(yarn_laws[0], "warp"), shape_yarn_law(yarn_laws[1], "weft")},
        shear(shape_shear_law(card.shear)),
        bands(make_bands(packed_mesh)),
        share(balanced_bands(bands, its_team.threads())),
        band_sums(bands.size()),
        has_history(has_cell_history(model.formulation)) {
    if (has_history) histories = start_histories(packed, shear, model, thickness, start);
  }
  virtual ~Kernels() = default;
  // With `move`, free nodes move at once.
  virtual void compute(State& state, const BandMove* move) = 0;
  // As those of FabricForces.
  [[nodiscard]] virtual bool has_flat_loops() const = 0;
  virtual void set_flat(bool flat) = 0;

  void hold_sharpest(const CellLanes& cells) {
    for (const double square : cells.sharpest) sharpest = std::max(sharpest, square);
  }

  void sum_up() {
    sums = {};
    sharpest = 0.0;
    for (const BandSums& band : band_sums) {
      for (int f = 0; f < 2; ++f) sums[f].add(band.yarns[f]);
      hold_sharpest(band.cells);
    }
  }
};

namespace {

NodeArrays node_arrays(const State& state) {
  NodeArrays nodes{};
  for (int c = 0; c < 3; ++c) {
    nodes.position[c] = state.position[c].data();
    nodes.velocity[c] = state.velocity[c].data();
  }
  return nodes;
}

bool all_near(const YarnLanes& lanes) {
  return *std::min_element(std::begin(lanes.shortest), std::end(lanes.shortest)) > least_near_ratio &&
         *std::max_element(std::begin(lanes.longest), std::end(lanes.longest)) < greatest_near_ratio;
}

// The blocks of rows first <= j < last.
SlotBlocks blocks_of(const PerRow<int>& blocks, int first, int last, int origin) {
  return {blocks.item.data() + blocks.first[first], blocks.first[last] - blocks.first[first], origin};
}

}  // namespace

// Element forces in one precision.
template <class Real>
struct FabricForces::KernelsOf : FabricForces::Kernels {
  using Forces = BandForces<Real>;

  // All of these together are for so many components.
  struct Loops {
    int components = 3;
    ForceLoops<Real> for_nodes;
    std::array<YarnLoops<Real>, 2> yarn;
    CellLoops<Real> cell;
  };
  Loops in_space, flat;  // `flat` without an element's loop where there is none
  Loops loops;           // at work
  HistoryCellLoops history_cell{};
  std::vector<Scratch<Real>> scratch;
  std::array<std::array<Reals<Real>, 3>, 2> loose_yarn_force;
  std::array<Reals<Real>, 3> loose_warp_force, loose_weft_force;

  KernelsOf(const PackedMesh& packed_mesh, const Card& card, const std::array<TangentLaw, 2>& yarn_laws,
            const ModelSpec& model, const State& start, Team& its_team)
      : Kernels(packed_mesh, card, yarn_laws, model, start, its_team) {
    in_space = chosen(3, node_loops().of<Real>(), element_loops().of<Real>(), model);
    if constexpr (std::is_same_v<Real, double>) flat = chosen(2, node_loops().flat, element_loops().flat, model);
    loops = in_space;
    if (has_history)
      history_cell = element_loops().history_cells(
          model.formulation == Formulation::side_frame ? Frame::side : Frame::green_naghdi, model.thickness,
          shear.shape);
    for (int t = 0; t < team.threads(); ++t) scratch.emplace_back(bands.most_slots, packed.stride, has_history);
    for (int c = 0; c < 3; ++c) {
      for (int f = 0; f < 2; ++f) loose_yarn_force[f][c].resize(packed.loose_yarns[f].length.size());
      loose_warp_force[c].resize(packed.loose_cells.area.size());
      loose_weft_force[c].resize(packed.loose_cells.area.size());
    }
  }

  Loops chosen(int components, const ForceLoops<Real>& for_nodes, const LoopsOf<Real>& of, const ModelSpec& model) {
    Loops one = {.components = components, .for_nodes = for_nodes, .yarn = {}, .cell = {}};
    for (int f = 0; f < 2; ++f) one.yarn[f] = of.yarns(model.section, yarn_law[f].is_paper);
    if (!has_history) one.cell = of.cells(model.formulation, model.thickness, shear.shape);
    return one;
  }
  [[nodiscard]] bool has_flat_loops() const override {
    return flat.yarn[0].row.near != nullptr && flat.yarn[1].row.near != nullptr && flat.cell.row != nullptr;
  }
  void set_flat(bool is_flat) override { loops = is_flat ? flat : in_space; }

  void compute(State& state, const BandMove* move) override {
    team.run(static_cast<int>(scratch.size()),
             [&](int t) { bands_of_thread(state, share[t], share[t + 1], scratch[t], move); });
    if (move != nullptr) move_outer_bands(*move);
    for (int c = 0; c < 3; ++c) std::fill(state.force[c].begin() + packed.lattice_nodes(), state.force[c].end(), 0.0);
    sum_up();
    for (int f = 0; f < 2; ++f) loose_yarn_forces(state, f);
    loose_cell_forces(state);
    if (!has_history) return;
    histories.lattice.swap();
    histories.listed.swap();
  }

  // The bands whose nodes the elements of another thread's bands read.
  void move_outer_bands(const BandMove& move) {
    for (int t = 0; t < team.threads(); ++t)
      for (int b = share[t]; b < share[t + 1]; ++b)
        if (is_outer(b, share[t], share[t + 1])) move_free_nodes(move, b, bands.first_row[b], bands.first_row[b + 1]);
  }
  [[nodiscard]] bool is_outer(int band, int first_band, int last_band) const {
    return (band == first_band && band > 0) || (band + 1 == last_band && last_band < bands.size());
  }

  // Where a yarn turns out not to be near its length at rest once more, with the loop for any.
  template <class Yarns>
  void yarn_forces(int family, const YarnLoopsOver<Yarns, Real>& loop, const Yarns& yarns, const NodeArrays& nodes,
                   Real* const (&t)[3], YarnLanes& lanes) const {
    const YarnStep step = {viscosity[family], look_ahead};
    const YarnLanes before = lanes;
    loop.near(yarn_law[family].pointer(), yarns, nodes, step, t, lanes);
    if (all_near(lanes)) return;
    lanes = before;
    loop.any(yarn_law[family].pointer(), yarns, nodes, step, t, lanes);
  }

  void warp_of_rows(const NodeArrays& nodes, int first, int last, Forces& forces, YarnLanes& lanes) {
    Real* const t[3] = {forces.along(0), forces.along(1), forces.along(2)};
    const RowYarns yarns = {blocks_of(bands.warp, first, last, forces.origin()), 1, packed.spacing[0],
                            packed.warp_section.data()};
    loops.for_nodes.clear(blocks_of(bands.warp_gaps, first, last, forces.origin()), t, Forces::along_arrays);
    yarn_forces(0, loops.yarn[0].row, yarns, nodes, t, lanes);
  }

  // Weft elements and cells between each of the rows and the next. `foreign`: the one row is a neighbour's own, which
  // alone keeps its histories and counts its sums.
  void between_rows(const NodeArrays& nodes, int first, int last, Scratch<Real>& own, Forces& forces, BandSums& found,
                    bool foreign = false) {
    const auto arrays_between = forces.between_array();
    loops.for_nodes.clear(blocks_of(bands.between_gaps, first, last, forces.origin()), arrays_between.data(),
                          Forces::between_arrays);
    const SlotBlocks slots = blocks_of(bands.between, first, last, forces.origin());
    Real* const t[3] = {forces.across(0), forces.across(1), forces.across(2)};
    const RowYarns yarns = {slots, packed.stride, packed.spacing[1], packed.weft_section.data()};
    yarn_forces(1, loops.yarn[1].row, yarns, nodes, t, found.yarns[1]);
    const RowCells cells = {
        slots, packed.stride, {1.0 / packed.spacing[0], 1.0 / packed.spacing[1]}, packed.cell_area.data()};
    const RowCellForces<Real> out{{forces.p(0), forces.p(1), forces.p(2)}, {forces.q(0), forces.q(1), forces.q(2)}};
    if (!has_history) return loops.cell.row(shear.pointer(), cells, thickness, nodes, out, found.cells);
    if constexpr (std::is_same_v<Real, double>) {
      loops.for_nodes.clear(slots, arrays_between.data() + 3,
                            Forces::between_arrays - 3);  // runs of cells leave the rest
      cells_with_history(nodes, first, last, cells, out, own, found, foreign);
    }
  }

  void cells_with_history(const NodeArrays& nodes, int first, int last, const RowCells& cells,
                          const RowCellForces<double>& out, Scratch<Real>& own, BandSums& found, bool foreign) {
    const auto arrays = foreign ? histories.lattice.arrays_beside(first * packed.stride, own.spare_history)
                                : histories.lattice.arrays();
    for (int j = first; j < last && j + 1 < packed.rows; ++j)
      for (int r = packed.cell_runs.first[j]; r < packed.cell_runs.first[j + 1]; ++r) {
        const Run run = packed.cell_runs.run[r];
        history_cell.row(shear.with_history(), cells, thickness, j * packed.stride + run.begin,
                         j * packed.stride + run.end, nodes, arrays, out, found.cells);
      }
  }

  // The row below row `first`, for the thread that begins there: its neighbour computes it too, and counts it.
  void row_below(const NodeArrays& nodes, int first, Scratch<Real>& own, Forces& below) {
    below.place((first - 1) * packed.stride);
    if (first == 0) {
      for (Real* array : below.between_array()) std::fill(array - 1, array + packed.stride, Real{0});
      return;
    }
    BandSums uncounted;
    between_rows(nodes, first - 1, first, own, below, uncounted, true);
  }

  void bands_of_thread(State& state, int first_band, int last_band, Scratch<Real>& own, const BandMove* move) {
    if (first_band == last_band) return;
    const NodeArrays nodes = node_arrays(state);
    row_below(nodes, bands.first_row[first_band], own, own.bands[1]);
    for (int b = first_band; b < last_band; ++b) {
      Forces &here = own.bands[0], &below = own.bands[1];
      const int first = bands.first_row[b], last = bands.first_row[b + 1];
      BandSums& found = band_sums[b];
      found = {};
      here.place(first * packed.stride);
      warp_of_rows(nodes, first, last, here, found.yarns[0]);
      between_rows(nodes, first, last, own, here, found);
      if (move == nullptr || is_outer(b, first_band, last_band)) {
        assemble(bands.nodes, b, here, below, state);
      } else {
        assemble(move->blocks.waiting, b, here, below, state);
        move_band(*move, b, here, below);
      }
      std::swap(own.bands[0], own.bands[1]);
    }
  }

  // Calls what(blocks, forces of the row below) for a band's first row and for all others.
  template <class What>
  void rows_of_band(const PerRow<int>& blocks, int b, Forces& here, Forces& below, const What& what) const {
    const int first = bands.first_row[b], last = bands.first_row[b + 1];
    what(blocks_of(blocks, first, first + 1, 0), below.row());
    what(blocks_of(blocks, first + 1, last, 0), here.row());
  }

  void assemble(const PerRow<int>& blocks, int b, Forces& here, Forces& below, State& state) const {
    double* const force[3] = {state.force[0].data(), state.force[1].data(), state.force[2].data()};
    rows_of_band(blocks, b, here, below, [&](const SlotBlocks& rows, const RowForces<Real>& under) {
      loops.for_nodes.assemble(rows.block, rows.count, packed.stride, here.row(), under, force);
    });
  }

  void move_band(const BandMove& move, int b, Forces& here, Forces& below) const {
    LaneSums& moved = move.sums[b];
    moved = {};
    rows_of_band(move.blocks.free, b, here, below, [&](const SlotBlocks& rows, const RowForces<Real>& under) {
      loops.for_nodes.move(rows.block, rows.count, packed.stride, here.row(), under, move.nodes, move.step, moved.lane);
    });
  }

  void loose_yarn_forces(State& state, int family) {
    const auto& yarns = packed.loose_yarns[family];
    if (yarns.size() == 0) return;
    auto& force = loose_yarn_force[family];
    Real* const t[3] = {force[0].data(), force[1].data(), force[2].data()};
    BandSums found;
    const ListedYarns listed = {static_cast<int>(yarns.length.size()) / lane_count,
                                yarns.node0.data(),
                                yarns.node1.data(),
                                yarns.length.data(),
                                yarns.jaw.data(),
                                yarns.section.data()};
    yarn_forces(family, loops.yarn[family].listed, listed, node_arrays(state), t, found.yarns[family]);
    sums[family].add(found.yarns[family]);
    for (int c = 0; c < loops.components; ++c) {
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
    const ListedCellForces<Real> out{
        {loose_warp_force[0].data(), loose_warp_force[1].data(), loose_warp_force[2].data()},
        {loose_weft_force[0].data(), loose_weft_force[1].data(), loose_weft_force[2].data()}};
    const ListedCells listed = {static_cast<int>(cells.area.size()) / lane_count, cells.node[0].data(),
                                cells.warp_coefficient[0].data(), cells.weft_coefficient[0].data(), cells.area.data()};
    CellLanes found = BandSums().cells;
    if (!has_history) loops.cell.listed(shear.pointer(), listed, thickness, node_arrays(state), out, found);
    if constexpr (std::is_same_v<Real, double>)
      if (has_history)
        history_cell.listed(shear.with_history(), listed, thickness, 0, cells.size(), node_arrays(state),
                            histories.listed.arrays(), out, found);
    hold_sharpest(found);
    for (int c = 0; c < loops.components; ++c) {
      double* f = state.force[c].data();
      for (int e = 0; e < cells.size(); ++e)
        for (int a = 0; a < LooseCells::width; ++a)
          f[cells.node[e][a]] -=
              cells.warp_coefficient[e][a] * out.warp[c][e] + cells.weft_coefficient[e][a] * out.weft[c][e];
    }
  }
};

FabricForces::FabricForces(const PackedMesh& packed, const Card& card, const std::array<TangentLaw, 2>& yarn_laws,
                           const ModelSpec& model, const State& start, Team& team, Precision precision) {
  if (precision == Precision::single_precision && has_cell_history(model.formulation))
    throw InputError(fmt::format(
        "analysis.precision is single, but formulation \"{}\" adds up what every step brings, which needs double",
        name_of(model.formulation)));
  if (precision == Precision::single_precision)
    kernels_ = std::make_unique<KernelsOf<float>>(packed, card, yarn_laws, model, start, team);
  else
    kernels_ = std::make_unique<KernelsOf<double>>(packed, card, yarn_laws, model, start, team);
}

FabricForces::~FabricForces() = default;

void FabricForces::compute(State& state) {
  kernels_->compute(state, nullptr);
}

void FabricForces::compute_and_move(State& state, const BandMove& move) {
  kernels_->compute(state, &move);
}

const Bands& FabricForces::bands() const {
  return kernels_->bands;
}

bool FabricForces::has_flat_loops() const {
  return kernels_->has_flat_loops();
}

void FabricForces::set_flat(bool flat) {
  kernels_->set_flat(flat);
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
  for (auto* store : {&kernels_->histories.lattice, &kernels_->histories.listed})
    for (const double w : store->current().back()) work += w;
  return work;
}

void FabricForces::archive(Archive& archive) {
  for (YarnSums& sums : kernels_->sums) archive.number("the yarns' viscous power", sums.power);
  if (!kernels_->has_history) return;
  for (auto* store : {&kernels_->histories.lattice, &kernels_->histories.listed})
    for (auto& array : store->current()) archive.numbers("a cell's history", array);
}

}  // namespace weaveform
