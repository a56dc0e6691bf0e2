#include "solver/bending/lattice_bending.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "solver/bending/bend_kernels.hpp"
#include "solver/bending/bending_energy.hpp"
#include "solver/bending/friction_state.hpp"
#include "solver/bending/moment_law.hpp"
#include "solver/state/row_blocks.hpp"

namespace weaveform {
namespace {

// Moment laws in the shape the inner loop wants: one for all of them, the least simple that any needs.
struct FlexureShape {
  MomentShape shape = MomentShape::constant;
  std::array<ConstantFlexure, 2> constant;
  std::array<CurvedFlexure, 2> curved;
  std::array<LongFlexure, 2> looked_up{};
  std::array<SidedFlexure, 2> sided{};
  std::vector<std::shared_ptr<const LongLaw>> pieces;         // of looked_up, and of sided in the plane
  std::vector<std::shared_ptr<const SidedLaw>> sided_pieces;  // of sided
  [[nodiscard]] const void* pointer(int f) const {
    switch (shape) {
      case MomentShape::constant:
        return &constant[f];
      case MomentShape::short_law:
        return &curved[f];
      case MomentShape::long_law:
        return &looked_up[f];
      case MomentShape::sided_law:
        break;
    }
    return &sided[f];
  }
  // Only constants that are alike spare the normal: a curved law depends on each part of the curvature by itself.
  [[nodiscard]] bool isotropic() const {
    return shape == MomentShape::constant && constant[0].in == constant[0].out && constant[1].in == constant[1].out;
  }
};

FlexureShape shape_flexure(const Flexure& flexure) {
  FlexureShape shape;
  for (int f = 0; f < 2; ++f) {
    shape.shape = std::max({shape.shape, moment_shape(flexure.in_plane[f]), moment_shape(flexure.out_of_plane[f])});
    shape.constant[f] = {flexure.in_plane[f].tangent(0.0), flexure.out_of_plane[f].face().tangent(0.0)};
  }
  for (int f = 0; f < 2; ++f) {
    const TangentLaw& in = flexure.in_plane[f];
    const BendingLaw& out = flexure.out_of_plane[f];
    switch (shape.shape) {
      case MomentShape::constant:
        break;
      case MomentShape::short_law:
        shape.curved[f] = {packed_moment(in), packed_moment(out.face())};
        break;
      case MomentShape::long_law:
        shape.pieces.push_back(long_moment(in));
        shape.pieces.push_back(long_moment(out.face()));
        shape.looked_up[f] = {shape.pieces[2 * f].get(), shape.pieces[2 * f + 1].get()};
        break;
      case MomentShape::sided_law:
        shape.pieces.push_back(long_moment(in));
        shape.sided_pieces.push_back(sided_moment(out));
        shape.sided[f] = {shape.pieces[f].get(), shape.sided_pieces[f].get()};
        break;
    }
  }
  return shape;
}

// The bends that are not in rows, as the inner loop's columns.
struct LooseBends {
  std::vector<int> node, neighbour[2][2];  // [family][before, after]
  std::vector<double> yarns[2], inverse_spread[2];
  std::vector<double> own[2][2], fixed[2][2][3];
  std::vector<double> force[2][2][3];  // N
  [[nodiscard]] int size() const { return static_cast<int>(node.size()); }

  void add(const Bend& bend, const PackedMesh& packed, double impulse) {
    const auto at = [&](int n) { return packed.packed_of_mesh[n]; };
    node.push_back(at(bend.node));
    for (int f = 0; f < 2; ++f) {
      const YarnBend& yarn = bend.yarn[f];
      yarns[f].push_back(impulse * yarn.yarns);
      inverse_spread[f].push_back(yarn.yarns > 0.0 ? 1.0 / yarn.spread : 1.0);
      const std::array<int, 2> beside = {yarn.before, yarn.after};
      const std::array<bool, 2> is_fixed = {yarn.fixed_before, yarn.fixed_after};
      for (int side = 0; side < 2; ++side) {
        neighbour[f][side].push_back(at(beside[side]));
        own[f][side].push_back(is_fixed[side] || beside[side] == bend.node ? 0.0 : 1.0);
        for (int c = 0; c < 3; ++c) fixed[f][side][c].push_back(is_fixed[side] ? yarn.fixed[c] : 0.0);
      }
    }
    for (auto& family : force)
      for (auto& side : family)
        for (auto& component : side) component.push_back(0.0);
  }

  [[nodiscard]] LooseBendView view() const {
    LooseBendView v{};
    v.count = size();
    v.node = node.data();
    for (int f = 0; f < 2; ++f) {
      v.before[f] = neighbour[f][0].data();
      v.after[f] = neighbour[f][1].data();
      v.yarns[f] = yarns[f].data();
      v.inverse_spread[f] = inverse_spread[f].data();
      v.own_before[f] = own[f][0].data();
      v.own_after[f] = own[f][1].data();
      for (int c = 0; c < 3; ++c) {
        v.fixed_before[f][c] = fixed[f][0][c].data();
        v.fixed_after[f][c] = fixed[f][1][c].data();
      }
    }
    return v;
  }
};

// Forces of the bends of one row, and of the cells above it.
struct BendRowBuffers {
  explicit BendRowBuffers(int stride)
      : warp_after(row_vectors(stride)),
        warp_before(warp_after),
        weft_after(warp_after),
        weft_before(warp_after),
        centre(warp_after),
        a(warp_after),
        d(warp_after),
        e(warp_after) {}
  RowVectors warp_after, warp_before, weft_after, weft_before, centre;
  RowVectors a, d, e;
};

// Three rows at a time: a crossing feels the bends of the rows below and above it.
struct Ring {
  explicit Ring(int stride) : rows{BendRowBuffers(stride), BendRowBuffers(stride), BendRowBuffers(stride)} {}
  BendRowBuffers& operator[](int row) { return rows[(row + 3) % 3]; }
  std::array<BendRowBuffers, 3> rows;
};

std::array<double*, 3> pointers(RowVectors& buffers) {
  return {buffers[0].data(), buffers[1].data(), buffers[2].data()};
}

void copy(const std::array<double*, 3>& from, double* (&to)[3]) {
  std::copy(from.begin(), from.end(), to);
}

}  // namespace

struct LatticeBending::Parts {
  const Mesh& mesh;
  const PackedMesh& packed;
  Team& team;
  const State& state;
  Flexure flexure;
  int every;  // steps; forces are that many times as large, each time they act
  FlexureShape shape;
  BendKernels kernels;
  std::vector<Bend> bends;
  std::vector<std::array<double, 2>> stiffest;  // N mm; of each bend's yarns, at whatever curvature
  std::vector<TwistCell> twist_cells;
  std::unique_ptr<FrictionOfBends> friction;  // none: no yarn has any
  RowRuns bend_runs, twist_runs;
  std::vector<double> warp_yarns, weft_yarns, twist_stiffness;
  LooseBends loose;
  std::vector<int> block;
  std::vector<Ring> ring;

  Parts(const Mesh& m, const PackedMesh& p, const Flexure& chosen, const std::vector<char>& held, const State& s,
        Team& its_team, int steps)
      : mesh(m),
        packed(p),
        team(its_team),
        state(s),
        flexure(chosen),
        every(steps),
        shape(shape_flexure(chosen)),
        kernels(bend_kernels(shape.shape, shape.isotropic())),
        block(balanced_blocks(p, its_team.threads())) {
    if (flexure.bends_yarns) bends = find_bends(mesh, held);
    if (flexure.rotation_free && flexure.twist > 0.0) twist_cells = find_twist_cells(mesh);
    for (const Bend& bend : bends) stiffest.push_back({stiffest_of(bend, 0), stiffest_of(bend, 1)});
    place_bends();
    place_twist();
    refuse_friction_in_impulses(flexure, every);
    const FrictionLaws laws = friction_laws(flexure);
    if (laws.any())
      friction = std::make_unique<FrictionOfBends>(laws, packed.lattice_nodes(), packed.rows, loose.size());
    for (int t = 0; t < team.threads(); ++t) ring.emplace_back(packed.stride);
  }

  // In rows: crossings all of whose neighbours are crossings at the regular distance.
  [[nodiscard]] bool is_lattice_bend(const Bend& bend) const {
    const auto& at = mesh.nodes.crossing;
    const auto [i, j] = at[bend.node];
    if (i < 0) return false;
    for (int f = 0; f < 2; ++f) {
      const YarnBend& yarn = bend.yarn[f];
      const std::array<int, 2> step = {f == 0 ? 1 : 0, f == 0 ? 0 : 1};
      if (yarn.fixed_before || yarn.fixed_after || yarn.yarns == 0.0 ||
          at[yarn.before] != std::array<int, 2>{i - step[0], j - step[1]} ||
          at[yarn.after] != std::array<int, 2>{i + step[0], j + step[1]} ||
          std::abs(yarn.spread - mesh.spacing[f]) > 1e-9 * mesh.spacing[f])
        return false;
    }
    return true;
  }

  [[nodiscard]] double stiffest_of(const Bend& bend, int f) const {
    const YarnBend& yarn = bend.yarn[f];
    if (yarn.yarns == 0.0) return 0.0;
    const double greatest = greatest_turn / yarn.spread;
    return yarn.yarns / yarn.spread *
           std::max(flexure.in_plane[f].stiffest(0.0, greatest) + stiffest_friction(flexure.friction_in_plane[f]),
                    flexure.out_of_plane[f].stiffest(greatest) + stiffest_friction(flexure.friction_out_of_plane[f]));
  }

  void place_bends() {
    std::vector<char> marked(packed.lattice_nodes(), 0);
    warp_yarns.assign(packed.lattice_nodes(), 0.0);
    weft_yarns.assign(packed.lattice_nodes(), 0.0);
    for (const auto& bend : bends) {
      if (!is_lattice_bend(bend)) {
        loose.add(bend, packed, every);
        continue;
      }
      const int n = packed.packed_of_mesh[bend.node];
      marked[n] = 1;
      warp_yarns[n] = every * bend.yarn[0].yarns;
      weft_yarns[n] = every * bend.yarn[1].yarns;
    }
    bend_runs = padded_runs(runs_of(marked, packed.stride, packed.rows));
  }

  void place_twist() {
    std::vector<char> marked(packed.lattice_nodes(), 0);
    twist_stiffness.assign(packed.lattice_nodes(), 0.0);
    const double unit_area = mesh.spacing[0] * mesh.spacing[1];
    for (const auto& cell : twist_cells) {
      const int n = packed.packed_of_mesh[cell.node[0]];
      marked[n] = 1;
      twist_stiffness[n] = every * 4.0 * flexure.twist * cell.area / (unit_area * unit_area);
    }
    twist_runs = padded_runs(runs_of(marked, packed.stride, packed.rows));
  }

  // Rows outside the lattice stand in for themselves; no run reads them.
  [[nodiscard]] BendRows rows_around(int j) const {
    BendRows rows{};
    const auto row = [&](int k) { return static_cast<std::size_t>(std::clamp(k, 0, packed.rows - 1)) * packed.stride; };
    for (int c = 0; c < 3; ++c) {
      rows.below[c] = state.position[c].data() + row(j - 1);
      rows.here[c] = state.position[c].data() + row(j);
      rows.above[c] = state.position[c].data() + row(j + 1);
    }
    return rows;
  }

  void compute_row(int j, BendRowBuffers& buffers) {
    for (auto* vectors :
         {&buffers.warp_after, &buffers.warp_before, &buffers.weft_after, &buffers.weft_before, &buffers.centre})
      clear_gaps(*vectors, bend_runs, j, packed.stride);
    for (auto* vectors : {&buffers.a, &buffers.d, &buffers.e}) clear_gaps(*vectors, twist_runs, j, packed.stride);
    if (j < 0 || j >= packed.rows) return;
    const BendRows rows = rows_around(j);
    const auto offset = static_cast<std::size_t>(j) * packed.stride;
    BendRowOutput out{};
    copy(pointers(buffers.warp_after), out.warp_after);
    copy(pointers(buffers.warp_before), out.warp_before);
    copy(pointers(buffers.weft_after), out.weft_after);
    copy(pointers(buffers.weft_before), out.weft_before);
    copy(pointers(buffers.centre), out.centre);
    for (int r = bend_runs.first[j]; r < bend_runs.first[j + 1]; ++r)
      kernels.row(shape.pointer(0), shape.pointer(1), rows, 1.0 / packed.spacing[0], 1.0 / packed.spacing[1],
                  warp_yarns.data() + offset, weft_yarns.data() + offset, bend_runs.run[r].begin, bend_runs.run[r].end,
                  out);
    for (int r = bend_runs.first[j]; friction && r < bend_runs.first[j + 1]; ++r)
      friction_loops().row_forces(friction->laws.yarn.data(), rows, warp_yarns.data() + offset,
                                  weft_yarns.data() + offset, bend_runs.run[r].begin, bend_runs.run[r].end,
                                  friction->rows.at(offset), out);
    TwistRowOutput twist{};
    copy(pointers(buffers.a), twist.a);
    copy(pointers(buffers.d), twist.d);
    copy(pointers(buffers.e), twist.e);
    for (int r = twist_runs.first[j]; r < twist_runs.first[j + 1]; ++r)
      twist_row(rows, twist_stiffness.data() + offset, twist_runs.run[r].begin, twist_runs.run[r].end, twist);
  }

  // f(i,j) gets its own bend's, the warp neighbours' of its row, the weft neighbours' of the rows beside it, and the
  // twist of the four cells around it.
  void assemble_row(int j, BendRowBuffers& below, BendRowBuffers& here, BendRowBuffers& above, State& target) const {
    const Run span = packed.span(j);
    const bool twists = !twist_cells.empty();
    for (int c = 0; c < 3; ++c) {
      double* f = target.force[c].data() + static_cast<std::size_t>(j) * packed.stride;
      if (flexure.bends_yarns)
        bend_assemble(here.centre[c].data(), here.warp_after[c].data(), here.warp_before[c].data(),
                      below.weft_after[c].data(), above.weft_before[c].data(), f, span.begin, span.end);
      if (twists)
        twist_assemble(here.a[c].data(), here.d[c].data(), here.e[c].data(), below.a[c].data(), below.d[c].data(),
                       below.e[c].data(), f, span.begin, span.end);
    }
  }

  // Every row by the block it belongs to, before any forces: blocks compute the forces of the rows beside them as well.
  void step_friction(int first, int last) {
    for (int j = first; j < last; ++j) {
      const BendRows rows = rows_around(j);
      const auto offset = static_cast<std::size_t>(j) * packed.stride;
      for (int r = bend_runs.first[j]; r < bend_runs.first[j + 1]; ++r) {
        const Run run = bend_runs.run[r];
        friction_loops().row_step(friction->laws.yarn.data(), rows, 1.0 / packed.spacing[0], 1.0 / packed.spacing[1],
                                  warp_yarns.data() + offset, weft_yarns.data() + offset, run.begin, run.end,
                                  !friction->begun, friction->rows.at(offset), friction->lost.data() + offset);
        for (int i = run.begin; i < run.end; ++i) friction->lost_of_row[j] += friction->lost[offset + i] / every;
      }
    }
  }

  void step_loose_friction() {
    const double* const x[3] = {state.position[0].data(), state.position[1].data(), state.position[2].data()};
    friction_loops().loose_step(friction->laws.yarn.data(), loose.view(), x, !friction->begun, friction->loose.at(0),
                                friction->lost_loose.data());
    for (const double lost : friction->lost_loose) friction->lost_by_loose += lost / every;
    friction->begun = true;
  }

  // mJ; of the springs that friction is before it slides.
  [[nodiscard]] double friction_energy() const {
    if (!friction) return 0.0;
    const auto of_rows = friction->laws.stored({&warp_yarns, &weft_yarns}, friction->rows);
    const auto of_loose = friction->laws.stored({&loose.yarns[0], &loose.yarns[1]}, friction->loose);
    double energy = 0.0;
    for (int f = 0; f < 2; ++f) {
      for (const double per_length : of_rows[f]) energy += packed.spacing[f] * per_length / every;
      for (int e = 0; e < loose.size(); ++e) energy += of_loose[f][e] / loose.inverse_spread[f][e] / every;
    }
    return energy;
  }

  void block_of_rows(State& target, int first, int last, Ring& rows) {
    if (first == last) return;
    compute_row(first - 1, rows[first - 1]);
    compute_row(first, rows[first]);
    for (int j = first; j < last; ++j) {
      compute_row(j + 1, rows[j + 1]);
      assemble_row(j, rows[j - 1], rows[j], rows[j + 1], target);
    }
  }

  void add_loose(State& target) {
    if (loose.size() == 0) return;
    const double* const x[3] = {target.position[0].data(), target.position[1].data(), target.position[2].data()};
    double* force[2][2][3];
    for (int f = 0; f < 2; ++f)
      for (int side = 0; side < 2; ++side)
        for (int c = 0; c < 3; ++c) force[f][side][c] = loose.force[f][side][c].data();
    kernels.loose(shape.pointer(0), shape.pointer(1), loose.view(), x, force);
    if (friction)
      friction_loops().loose_forces(friction->laws.yarn.data(), loose.view(), x, friction->loose.at(0), force);
    for (int c = 0; c < 3; ++c) {
      double* f = target.force[c].data();
      for (int family = 0; family < 2; ++family)
        for (int side = 0; side < 2; ++side) {
          const double* from = force[family][side][c];
          for (int e = 0; e < loose.size(); ++e) {
            f[loose.neighbour[family][side][e]] += from[e];
            f[loose.node[e]] -= from[e];
          }
        }
    }
  }
};

LatticeBending::LatticeBending(const Mesh& mesh, const PackedMesh& packed, const Flexure& flexure,
                               const std::vector<char>& held, const State& state, Team& team, int every)
    : parts_(std::make_unique<Parts>(mesh, packed, flexure, held, state, team, every)) {}

LatticeBending::~LatticeBending() = default;

void LatticeBending::add_forces(State& state, double /*step*/) {
  auto& p = *parts_;
  if (state.step % p.every != 0) return;
  if (p.friction) {
    p.team.run(static_cast<int>(p.ring.size()), [&](int b) { p.step_friction(p.block[b], p.block[b + 1]); });
    p.step_loose_friction();
  }
  p.team.run(static_cast<int>(p.ring.size()),
             [&](int b) { p.block_of_rows(state, p.block[b], p.block[b + 1], p.ring[b]); });
  p.add_loose(state);
}

StoredEnergy LatticeBending::stored_energy() const {
  const auto& p = *parts_;
  const auto position = mesh_positions(p.packed, p.state);
  const double energy = bending_energy(p.bends, p.flexure, position) +
                        twist_energy(p.twist_cells, p.flexure.twist, p.mesh.spacing, position) + p.friction_energy();
  return {.total = energy, .bending = energy};
}

EnergyFlow LatticeBending::energy_flow() const {
  const double friction = parts_->friction ? parts_->friction->lost_so_far() : 0.0;
  return {.lost = friction, .bending_friction = friction};
}

void LatticeBending::archive(Archive& archive) {
  if (parts_->friction) parts_->friction->archive(archive);
}

void LatticeBending::add_stiffness_bound(const std::vector<Vec3>& position, double /*fabric_frequency*/,
                                         std::vector<double>& bound) const {
  const auto& p = *parts_;
  const auto distance = [&](int a, int b) {
    return std::hypot(position[b][0] - position[a][0], position[b][1] - position[a][1],
                      position[b][2] - position[a][2]);
  };
  // the turn of the fabric's normal and the moment's own turn add less than once more; impulses count squared
  const double of_large_turns = 2.0 * p.every * p.every;
  for (std::size_t b = 0; b < p.bends.size(); ++b)
    for (int f = 0; f < 2; ++f) {
      const Bend& bend = p.bends[b];
      const YarnBend& yarn = bend.yarn[f];
      if (yarn.yarns == 0.0) continue;
      const double stiffness = of_large_turns * p.stiffest[b][f];
      const double before = yarn.fixed_before ? 0.0 : 1.0 / distance(yarn.before, bend.node);
      const double after = yarn.fixed_after ? 0.0 : 1.0 / distance(bend.node, yarn.after);
      const double sum = 2.0 * (before + after);
      if (before > 0.0) bound[yarn.before] += stiffness * before * sum;
      if (after > 0.0) bound[yarn.after] += stiffness * after * sum;
      bound[bend.node] += stiffness * (before + after) * sum;
    }
  // E = 1/2 k (q.n)^2, each corner +-1 in q: row sums 4 k
  for (const auto& cell : p.twist_cells) {
    const double unit_area = p.mesh.spacing[0] * p.mesh.spacing[1];
    for (const int n : cell.node)
      bound[n] += of_large_turns * 16.0 * p.flexure.twist * cell.area / (unit_area * unit_area);
  }
}

}  // namespace weaveform
