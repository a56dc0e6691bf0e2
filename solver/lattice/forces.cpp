#include "solver/lattice/forces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "solver/element/sheared_start.hpp"
#include "solver/lattice/bands.hpp"
#include "solver/lattice/element_loops.hpp"

namespace weaveform {
namespace {

// The element forces of one band, N: on a slot's node by the warp element that starts there, by the weft element, and
// the two of the cell (element_loops.hpp). Slot n stands at n - origin, readable from one slot before the band to one
// behind it.
class BandForces {
public:
  explicit BandForces(int slots) {
    for (auto& array : array_) array.assign(slots + 2 * guard, 0.0);
  }
  void place(int origin) { origin_ = origin; }
  [[nodiscard]] int origin() const { return origin_; }
  // Component c.
  double* along(int c) { return array_[c].data() + guard; }
  double* across(int c) { return array_[3 + c].data() + guard; }
  double* p(int c) { return array_[6 + c].data() + guard; }
  double* q(int c) { return array_[9 + c].data() + guard; }

  static constexpr int along_arrays = 3, between_arrays = 9;
  [[nodiscard]] std::array<double*, along_arrays> along_array() { return {along(0), along(1), along(2)}; }
  [[nodiscard]] std::array<double*, between_arrays> between_array() {
    return {across(0), across(1), across(2), p(0), p(1), p(2), q(0), q(1), q(2)};
  }
  [[nodiscard]] RowForces row() {
    return {{along(0), along(1), along(2)},
            {across(0), across(1), across(2)},
            {p(0), p(1), p(2)},
            {q(0), q(1), q(2)},
            origin_};
  }

private:
  static constexpr int guard = 8;  // a cache line, so that slots stay aligned; a block that clears ends in it
  std::array<Doubles, 12> array_;
  int origin_ = 0;
};

// What one thread works on: two bands in turn, of which the one before holds the row below this one's first.
struct Scratch {
  Scratch(int slots, int stride, bool with_history) : bands{BandForces(slots), BandForces(slots)} {
    if (with_history) spare_history.assign(cell_history_size, Doubles(stride));
  }
  std::array<BandForces, 2> bands;
  std::vector<Doubles> spare_history;  // where the histories of a neighbour's row go
};

// Over the elements of one band: the same lanes for any number of threads.
struct BandSums {
  std::array<YarnLanes, 2> yarns;  // warp, weft
  CellLanes cells;
  BandSums() {
    for (YarnLanes& family : yarns)
      for (int l = 0; l < lane_count; ++l) {
        family.power[l] = 0.0;
        family.shortest[l] = family.longest[l] = 1.0;
      }
    for (double& sharpest : cells.sharpest) sharpest = 0.0;
  }
};

struct YarnSums {
  double power = 0.0;                    // mJ/s; of the yarns' viscosity
  double shortest = 1.0, longest = 1.0;  // 1; least and greatest (L/L0)^2

  void add(const YarnLanes& more) {
    for (int l = 0; l < lane_count; ++l) {
      power += more.power[l];
      shortest = std::min(shortest, more.shortest[l]);
      longest = std::max(longest, more.longest[l]);
    }
  }
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
  [[nodiscard]] HistoryArrays arrays() {
    HistoryArrays result{};
    for (int k = 0; k < cell_history_size; ++k) {
      result.before[k] = side_[0][k].data();
      result.after[k] = side_[1][k].data();
    }
    return result;
  }
  // Those of the row at `offset` are written to `spare`.
  [[nodiscard]] HistoryArrays arrays_beside(int offset, std::vector<Doubles>& spare) {
    HistoryArrays result = arrays();
    for (int k = 0; k < cell_history_size; ++k) result.after[k] = spare[k].data();
    result.after_origin = offset;
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
  const ElementLoops& loops = element_loops();
  const PackedMesh& packed;
  Team& team;
  double thickness;
  std::array<YarnLawShape, 2> yarn_law;
  ShearLawShape shear;
  std::array<YarnLoops, 2> yarn;
  std::array<double, 2> viscosity = {0.0, 0.0};  // MPa s
  double look_ahead = 0.0;                       // s
  Bands bands;
  std::vector<int> share;           // of each thread: its first band
  std::vector<BandSums> band_sums;  // one per band
  std::array<YarnSums, 2> sums;     // of all yarns in the last call
  double sharpest = 0.0;            // sin^2 gamma, of all cells
  bool has_history;
  CellLoops cell{};
  HistoryCellLoops history_cell{};
  HistoryStore lattice_history, loose_history;
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
        bands(make_bands(packed_mesh)),
        share(balanced_bands(bands, its_team.threads())),
        band_sums(bands.size()),
        has_history(model.formulation == Formulation::incremental || model.formulation == Formulation::side_frame) {
    for (int f = 0; f < 2; ++f) yarn[f] = loops.yarns(model.section, yarn_law[f].is_paper);
    if (has_history) {
      history_cell =
          loops.history_cells(model.formulation == Formulation::side_frame ? Frame::side : Frame::green_naghdi,
                              model.thickness, shear.shape);
      start_history(start);
      start_sheared(model);
    } else {
      cell = loops.cells(model.formulation, model.thickness, shear.shape);
    }
    for (int t = 0; t < team.threads(); ++t) scratch.emplace_back(bands.most_slots, packed.stride, has_history);
    for (int c = 0; c < 3; ++c) {
      for (int f = 0; f < 2; ++f) loose_yarn_force[f][c].resize(packed.loose_yarns[f].length.size());
      loose_warp_force[c].resize(packed.loose_cells.area.size());
      loose_weft_force[c].resize(packed.loose_cells.area.size());
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

  static NodeArrays node_arrays(const State& state) {
    NodeArrays nodes{};
    for (int c = 0; c < 3; ++c) {
      nodes.position[c] = state.position[c].data();
      nodes.velocity[c] = state.velocity[c].data();
    }
    return nodes;
  }

  // The blocks of rows first <= j < last.
  static SlotBlocks blocks_of(const PerRow<int>& blocks, int first, int last, int origin) {
    return {blocks.item.data() + blocks.first[first], blocks.first[last] - blocks.first[first], origin};
  }

  void warp_of_rows(const NodeArrays& nodes, int first, int last, BandForces& forces, YarnLanes& lanes) {
    double* const t[3] = {forces.along(0), forces.along(1), forces.along(2)};
    const RowYarns yarns = {blocks_of(bands.warp, first, last, forces.origin()), 1, packed.spacing[0],
                            packed.warp_section.data()};
    loops.clear(blocks_of(bands.warp_gaps, first, last, forces.origin()), t, BandForces::along_arrays);
    yarn[0].row(yarn_law[0].pointer(), yarns, nodes, {viscosity[0], look_ahead}, t, lanes);
  }

  // Weft elements and cells between each of the rows and the next. `foreign`: the one row is a neighbour's own, which
  // alone keeps its histories and counts its sums.
  void between_rows(const NodeArrays& nodes, int first, int last, Scratch& own, BandForces& forces, BandSums& found,
                    bool foreign = false) {
    const auto arrays_between = forces.between_array();
    loops.clear(blocks_of(bands.between_gaps, first, last, forces.origin()), arrays_between.data(),
                BandForces::between_arrays);
    const SlotBlocks slots = blocks_of(bands.between, first, last, forces.origin());
    double* const t[3] = {forces.across(0), forces.across(1), forces.across(2)};
    yarn[1].row(yarn_law[1].pointer(), {slots, packed.stride, packed.spacing[1], packed.weft_section.data()}, nodes,
                {viscosity[1], look_ahead}, t, found.yarns[1]);
    const RowCells cells = {
        slots, packed.stride, {1.0 / packed.spacing[0], 1.0 / packed.spacing[1]}, packed.cell_area.data()};
    const RowCellForces out{{forces.p(0), forces.p(1), forces.p(2)}, {forces.q(0), forces.q(1), forces.q(2)}};
    if (!has_history) return cell.row(shear.pointer(), cells, thickness, nodes, out, found.cells);
    loops.clear(slots, arrays_between.data() + 3, BandForces::between_arrays - 3);  // runs of cells leave the rest
    const auto arrays =
        foreign ? lattice_history.arrays_beside(first * packed.stride, own.spare_history) : lattice_history.arrays();
    for (int j = first; j < last && j + 1 < packed.rows; ++j)
      for (int r = packed.cell_runs.first[j]; r < packed.cell_runs.first[j + 1]; ++r) {
        const Run run = packed.cell_runs.run[r];
        history_cell.row(shear.with_history(), cells, thickness, j * packed.stride + run.begin,
                         j * packed.stride + run.end, nodes, arrays, out, found.cells);
      }
  }

  // The row below row `first`, for the thread that begins there: its neighbour computes it too, and counts it.
  void row_below(const NodeArrays& nodes, int first, Scratch& own, BandForces& below) {
    below.place((first - 1) * packed.stride);
    if (first == 0) {
      for (double* array : below.between_array()) std::fill(array - 1, array + packed.stride, 0.0);
      return;
    }
    BandSums uncounted;
    between_rows(nodes, first - 1, first, own, below, uncounted, true);
  }

  void bands_of_thread(State& state, int first_band, int last_band, Scratch& own) {
    if (first_band == last_band) return;
    const NodeArrays nodes = node_arrays(state);
    double* const force[3] = {state.force[0].data(), state.force[1].data(), state.force[2].data()};
    row_below(nodes, bands.first_row[first_band], own, own.bands[1]);
    for (int b = first_band; b < last_band; ++b) {
      BandForces &here = own.bands[0], &below = own.bands[1];
      const int first = bands.first_row[b], last = bands.first_row[b + 1];
      BandSums& found = band_sums[b];
      found = {};
      here.place(first * packed.stride);
      warp_of_rows(nodes, first, last, here, found.yarns[0]);
      between_rows(nodes, first, last, own, here, found);
      const SlotBlocks first_row = blocks_of(bands.nodes, first, first + 1, 0),
                       others = blocks_of(bands.nodes, first + 1, last, 0);
      loops.assemble(first_row.block, first_row.count, packed.stride, here.row(), below.row(), force);
      loops.assemble(others.block, others.count, packed.stride, here.row(), here.row(), force);
      std::swap(own.bands[0], own.bands[1]);
    }
  }

  void loose_yarn_forces(State& state, int family) {
    const auto& yarns = packed.loose_yarns[family];
    if (yarns.size() == 0) return;
    auto& force = loose_yarn_force[family];
    double* const t[3] = {force[0].data(), force[1].data(), force[2].data()};
    BandSums found;
    const ListedYarns listed = {static_cast<int>(yarns.length.size()) / lane_count,
                                yarns.node0.data(),
                                yarns.node1.data(),
                                yarns.length.data(),
                                yarns.jaw.data(),
                                yarns.section.data()};
    yarn[family].listed(yarn_law[family].pointer(), listed, node_arrays(state), {viscosity[family], look_ahead}, t,
                        found.yarns[family]);
    sums[family].add(found.yarns[family]);
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
    const ListedCellForces out{{loose_warp_force[0].data(), loose_warp_force[1].data(), loose_warp_force[2].data()},
                               {loose_weft_force[0].data(), loose_weft_force[1].data(), loose_weft_force[2].data()}};
    const ListedCells listed = {static_cast<int>(cells.area.size()) / lane_count, cells.node[0].data(),
                                cells.warp_coefficient[0].data(), cells.weft_coefficient[0].data(), cells.area.data()};
    CellLanes found = BandSums().cells;
    if (has_history)
      history_cell.listed(shear.with_history(), listed, thickness, 0, cells.size(), node_arrays(state),
                          loose_history.arrays(), out, found);
    else
      cell.listed(shear.pointer(), listed, thickness, node_arrays(state), out, found);
    hold_sharpest(found);
    for (int c = 0; c < 3; ++c) {
      double* f = state.force[c].data();
      for (int e = 0; e < cells.size(); ++e)
        for (int a = 0; a < LooseCells::width; ++a)
          f[cells.node[e][a]] -=
              cells.warp_coefficient[e][a] * out.warp[c][e] + cells.weft_coefficient[e][a] * out.weft[c][e];
    }
  }

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

FabricForces::FabricForces(const PackedMesh& packed, const Card& card, const std::array<TangentLaw, 2>& yarn_laws,
                           const ModelSpec& model, const State& start, Team& team)
    : kernels_(std::make_unique<Kernels>(packed, card, yarn_laws, model, start, team)) {}

FabricForces::~FabricForces() = default;

void FabricForces::compute(State& state) {
  auto& k = *kernels_;
  k.team.run(static_cast<int>(k.scratch.size()),
             [&](int t) { k.bands_of_thread(state, k.share[t], k.share[t + 1], k.scratch[t]); });
  for (int c = 0; c < 3; ++c) std::fill(state.force[c].begin() + k.packed.lattice_nodes(), state.force[c].end(), 0.0);
  k.sum_up();
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
