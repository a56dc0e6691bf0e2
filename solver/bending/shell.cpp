#include "solver/bending/shell.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>

#include "solver/bending/friction_state.hpp"
#include "solver/bending/moment_law.hpp"
#include "solver/bending/shell_energy.hpp"
#include "solver/bending/shell_kernels.hpp"
#include "solver/state/row_blocks.hpp"

namespace weaveform {
namespace {

constexpr double inertia_margin = 1.5;  // on the rotary inertia that the step needs

// A family's law in the shape the inner loop wants.
struct ShellMoment {
  MomentShape shape = MomentShape::constant;
  ConstantMoment constant;
  CurvedMoment curved;
  LongMoment looked_up{};
  SidedMoment sided{};
  std::shared_ptr<const LongLaw> pieces;         // of looked_up
  std::shared_ptr<const SidedLaw> sided_pieces;  // of sided
  [[nodiscard]] const void* pointer() const {
    switch (shape) {
      case MomentShape::constant:
        return &constant;
      case MomentShape::short_law:
        return &curved;
      case MomentShape::long_law:
        return &looked_up;
      case MomentShape::sided_law:
        break;
    }
    return &sided;
  }
};

ShellMoment shell_moment(const BendingLaw& law) {
  ShellMoment moment;
  moment.shape = moment_shape(law);
  switch (moment.shape) {
    case MomentShape::constant:
      moment.constant = {law.face().tangent(0.0)};
      break;
    case MomentShape::short_law:
      moment.curved.law = packed_moment(law.face());
      break;
    case MomentShape::long_law:
      moment.pieces = long_moment(law.face());
      moment.looked_up.law = moment.pieces.get();
      break;
    case MomentShape::sided_law:
      moment.sided_pieces = sided_moment(law);
      moment.sided.law = moment.sided_pieces.get();
      break;
  }
  return moment;
}

// Edges that are not in rows.
struct LooseEdges {
  std::vector<int> node0, node1;
  std::vector<double> yarns, inverse_rest, shear_stiffness;
  std::array<std::vector<double>, 9> result;  // force, bend, shear
  [[nodiscard]] int size() const { return static_cast<int>(node0.size()); }
  [[nodiscard]] LooseEdgeView view() const {
    return {size(), node0.data(), node1.data(), yarns.data(), inverse_rest.data(), shear_stiffness.data()};
  }
  EdgeOutput output() {
    EdgeOutput out{};
    for (int c = 0; c < 3; ++c) {
      out.force[c] = result[c].data();
      out.bend[c] = result[3 + c].data();
      out.shear[c] = result[6 + c].data();
    }
    return out;
  }
};

// Friction at the edges of one family, in rows (by first node) and loose.
struct EdgeFriction {
  BendingFriction law;
  std::vector<double> phi, curvature, lost, phi_loose, curvature_loose, lost_loose;
  void resize(const BendingFriction& of_yarn, int lattice_nodes, int loose_edges) {
    law = of_yarn;
    if (!(law.moment > 0.0)) return;
    for (auto* column : {&phi, &curvature, &lost}) column->assign(lattice_nodes, 0.0);
    for (auto* column : {&phi_loose, &curvature_loose, &lost_loose}) column->assign(loose_edges, 0.0);
  }
  [[nodiscard]] bool acts() const { return law.moment > 0.0; }
  void archive(Archive& archive) {
    for (auto* column : {&phi, &phi_loose})
      archive.numbers("a share of friction in bending", *column, {.least = -1.001, .greatest = 1.001});
    for (auto* column : {&curvature, &curvature_loose}) archive.numbers("a curvature", *column);
  }
};

struct EdgeBuffers {
  explicit EdgeBuffers(int stride) : force(row_vectors(stride)), bend(force), shear(force) {}
  RowVectors force, bend, shear;
  EdgeOutput output() {
    EdgeOutput out{};
    for (int c = 0; c < 3; ++c) {
      out.force[c] = force[c].data();
      out.bend[c] = bend[c].data();
      out.shear[c] = shear[c].data();
    }
    return out;
  }
};

// Elements of one row: warp edges in it, weft edges and cells between it and the next.
struct ShellRowBuffers {
  explicit ShellRowBuffers(int stride)
      : along(stride), across(stride), xp(row_vectors(stride)), xq(xp), dp(xp), dq(xp) {}
  EdgeBuffers along, across;
  RowVectors xp, xq, dp, dq;
};

std::array<double*, 3> pointers(Components& components, std::size_t offset) {
  return {components[0].data() + offset, components[1].data() + offset, components[2].data() + offset};
}

// Normals of the start: the mean of the cells around each node, or the direction of z where there is none.
std::vector<Vec3> start_normals(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> sum(mesh.node_count(), Eigen::Vector3d::Zero());
  const auto at = [&](int n) {
    const auto& x = mesh.nodes.position[n];
    return Eigen::Vector3d(x[0], x[1], x[2]);
  };
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (int a = begin + 1; a + 1 < end; ++a)
      normal += (at(mesh.cells.node[a]) - at(mesh.cells.node[begin]))
                    .cross(at(mesh.cells.node[a + 1]) - at(mesh.cells.node[begin]));
    for (int a = begin; a < end; ++a) sum[mesh.cells.node[a]] += normal;
  }
  std::vector<Vec3> result;
  for (const auto& s : sum) {
    const Eigen::Vector3d n = s.norm() > 0.0 ? Eigen::Vector3d(s.normalized()) : Eigen::Vector3d::UnitZ();
    result.push_back({n[0], n[1], n[2]});
  }
  return result;
}

}  // namespace

struct Shell::Parts {
  const Mesh& mesh;
  const PackedMesh& packed;
  Team& team;
  const Card& card;
  const State& state;
  Flexure flexure;
  double damping;
  std::array<ShellMoment, 2> moment;
  std::array<EdgeKernels, 2> kernels{};
  std::vector<ShellEdge> edges;
  std::vector<double> stiffest;  // N mm; of each edge, yarns B/L at whatever curvature
  RowRuns warp_runs, weft_runs;  // padded, like twist_runs
  std::vector<TwistCell> cells;
  std::array<std::vector<double>, 2> yarns;  // per first node
  std::vector<double> twist_stiffness;
  RowRuns twist_runs;
  std::array<LooseEdges, 2> loose;
  std::array<EdgeFriction, 2> friction;
  std::vector<double> friction_of_row;  // mJ; lost so far: one sum a row, so that no number of threads changes it
  double friction_of_loose = 0.0;       // mJ; lost so far
  bool friction_begun = false;          // curvatures have been taken note of
  std::vector<int> block;
  std::vector<std::array<ShellRowBuffers, 2>> scratch;

  Components director, velocity, force;
  Doubles inertia, inverse_inertia;  // tonne mm^2; inverse 0 where clamped
  std::vector<std::array<double, 8>> sums;
  double scale = 1.0;
  double longest_step = 0.0;  // s; what the inertia was made for
  double step_before = 0.0, kinetic = 0.0, damping_work = 0.0, power_before = 0.0;

  Parts(const Mesh& m, const PackedMesh& p, const Card& fabric, const Flexure& chosen, const State& s,
        const Setup& setup)
      : mesh(m),
        packed(p),
        team(setup.team),
        card(fabric),
        state(s),
        flexure(chosen),
        damping(setup.damping),
        edges(find_shell_edges(m, fabric, chosen.transverse_shear)),
        warp_runs(padded_runs(p.warp_runs)),
        weft_runs(padded_runs(p.weft_runs)),
        cells(flexure.twist > 0.0 ? find_twist_cells(m) : std::vector<TwistCell>{}),
        block(balanced_blocks(p, setup.team.threads())) {
    for (int f = 0; f < 2; ++f) {
      moment[f] = shell_moment(flexure.shell[f]);
      kernels[f] = edge_kernels(moment[f].shape);
    }
    for (const ShellEdge& edge : edges) stiffest.push_back(stiffest_of(edge));
    place_edges();
    for (int f = 0; f < 2; ++f) friction[f].resize(flexure.friction_shell[f], packed.lattice_nodes(), loose[f].size());
    friction_of_row.assign(packed.rows, 0.0);
    place_twist();
    for (int t = 0; t < team.threads(); ++t)
      scratch.push_back({ShellRowBuffers(packed.stride), ShellRowBuffers(packed.stride)});
    for (auto* field : {&director, &velocity, &force})
      for (auto& component : *field) component.assign(packed.nodes, 0.0);
    director[2].assign(packed.nodes, 1.0);
    inertia.assign(packed.nodes, 0.0);
    inverse_inertia.assign(packed.nodes, 0.0);
    sums.resize(packed.rows + 1);
  }

  [[nodiscard]] double stiffest_of(const ShellEdge& edge) const {
    const double rigidity = flexure.shell[edge.family].stiffest(greatest_turn / edge.rest_length) +
                            stiffest_friction(flexure.friction_shell[edge.family]);
    return edge.yarns * rigidity / edge.rest_length;
  }

  void place_edges() {
    for (auto& of_family : yarns) of_family.assign(packed.lattice_nodes(), 0.0);
    for (const auto& edge : edges) {
      const int a = packed.packed_of_mesh[edge.node[0]], b = packed.packed_of_mesh[edge.node[1]];
      if (packed.is_lattice_yarn(edge.family, a, b)) {
        yarns[edge.family][a] = edge.yarns;
        continue;
      }
      auto& list = loose[edge.family];
      list.node0.push_back(a);
      list.node1.push_back(b);
      list.yarns.push_back(edge.yarns);
      list.inverse_rest.push_back(1.0 / edge.rest_length);
      list.shear_stiffness.push_back(edge.shear_stiffness);
    }
    for (auto& list : loose)
      for (auto& column : list.result) column.assign(list.size(), 0.0);
  }

  void place_twist() {
    std::vector<char> marked(packed.lattice_nodes(), 0);
    twist_stiffness.assign(packed.lattice_nodes(), 0.0);
    for (const auto& cell : cells) {
      const int n = packed.packed_of_mesh[cell.node[0]];
      marked[n] = 1;
      twist_stiffness[n] = flexure.twist * cell.area;
    }
    twist_runs = padded_runs(runs_of(marked, packed.stride, packed.rows));
  }

  // Rotational row sums (N mm): of an edge's shear G w L (1/4 + 1/4) and bending 2 yarns B/L, each with as much again
  // for what couples them to the positions, and of the twist.
  [[nodiscard]] std::vector<double> rotational_bound() const {
    std::vector<double> bound(mesh.node_count(), 0.0);
    for (std::size_t e = 0; e < edges.size(); ++e)
      for (const int n : edges[e].node) bound[n] += edges[e].shear_stiffness + 4.0 * stiffest[e];
    const double slope = 1.0 / mesh.spacing[0] + 1.0 / mesh.spacing[1];
    for (const auto& cell : cells)
      for (const int n : cell.node) bound[n] += 2.0 * flexure.twist * cell.area * slope * slope;
    return bound;
  }

  void set_inertia(const std::vector<char>& clamped, double fabric_step) {
    longest_step = fabric_step;
    std::vector<double> area(mesh.node_count(), 0.0);  // both families cover it once
    for (const auto& edge : edges)
      for (const int n : edge.node) area[n] += 0.25 * edge.yarns * card.yarn[edge.family].interval * edge.rest_length;
    const auto bound = rotational_bound();
    for (int n = 0; n < mesh.node_count(); ++n) {
      if (area[n] == 0.0) continue;  // tied free ends have no rotation
      const double real = card.area_density() * area[n] * card.thickness * card.thickness / 12.0;
      const double needed = inertia_margin * bound[n] * fabric_step * fabric_step / 4.0;
      const double given = std::max(real, needed);
      scale = std::max(scale, given / real);
      const int p = packed.packed_of_mesh[n];
      inertia[p] = given;
      inverse_inertia[p] = clamped[n] != 0 ? 0.0 : 1.0 / given;
    }
  }

  [[nodiscard]] ShellRows shell_rows(int row_a, int shift_b, int row_b) const {
    ShellRows rows{};
    const auto a = static_cast<std::size_t>(row_a) * packed.stride;
    const auto b = static_cast<std::size_t>(row_b) * packed.stride + shift_b;
    for (int c = 0; c < 3; ++c) {
      rows.xa[c] = state.position[c].data() + a;
      rows.xb[c] = state.position[c].data() + b;
      rows.da[c] = director[c].data() + a;
      rows.db[c] = director[c].data() + b;
    }
    return rows;
  }

  void edges_of_row(int f, int j, const RowRuns& runs, const ShellRows& rows, EdgeBuffers& buffers) {
    const double shear = flexure.transverse_shear * card.yarn[f].interval * packed.spacing[f];
    for (int r = runs.first[j]; r < runs.first[j + 1]; ++r)
      kernels[f].row(moment[f].pointer(), rows, 1.0 / packed.spacing[f],
                     yarns[f].data() + static_cast<std::size_t>(j) * packed.stride, shear, runs.run[r].begin,
                     runs.run[r].end, buffers.output());
    const auto offset = static_cast<std::size_t>(j) * packed.stride;
    for (int r = runs.first[j]; friction[f].acts() && r < runs.first[j + 1]; ++r)
      friction_loops().edge_row_forces(friction[f].law.moment, rows, yarns[f].data() + offset, runs.run[r].begin,
                                       runs.run[r].end, friction[f].phi.data() + offset, buffers.output());
  }

  void step_friction_of_row(int f, int j, const RowRuns& runs, const ShellRows& rows) {
    EdgeFriction& own = friction[f];
    const auto offset = static_cast<std::size_t>(j) * packed.stride;
    for (int r = runs.first[j]; r < runs.first[j + 1]; ++r) {
      const Run run = runs.run[r];
      friction_loops().edge_row_step(own.law.moment, own.law.rise, rows, 1.0 / packed.spacing[f],
                                     yarns[f].data() + offset, run.begin, run.end, !friction_begun,
                                     own.phi.data() + offset, own.curvature.data() + offset, own.lost.data() + offset);
      for (int i = run.begin; i < run.end; ++i) friction_of_row[j] += own.lost[offset + i];
    }
  }

  // Every row by the block it belongs to, before any forces: blocks compute the forces of the row below them as well.
  void step_friction(int first, int last) {
    for (int j = first; j < last; ++j) {
      if (friction[0].acts()) step_friction_of_row(0, j, warp_runs, shell_rows(j, 1, j));
      if (friction[1].acts() && j + 1 < packed.rows) step_friction_of_row(1, j, weft_runs, shell_rows(j, 0, j + 1));
    }
  }

  void step_loose_friction() {
    const double* const x[3] = {state.position[0].data(), state.position[1].data(), state.position[2].data()};
    const double* const d[3] = {director[0].data(), director[1].data(), director[2].data()};
    for (int f = 0; f < 2; ++f) {
      EdgeFriction& own = friction[f];
      if (!own.acts()) continue;
      friction_loops().loose_edge_step(own.law.moment, own.law.rise, loose[f].view(), x, d, !friction_begun,
                                       own.phi_loose.data(), own.curvature_loose.data(), own.lost_loose.data());
      for (const double lost : own.lost_loose) friction_of_loose += lost;
    }
    friction_begun = true;
  }

  [[nodiscard]] bool has_friction() const { return friction[0].acts() || friction[1].acts(); }
  [[nodiscard]] double friction_lost() const {
    double sum = friction_of_loose;
    for (const double row : friction_of_row) sum += row;
    return sum;
  }
  // mJ; of the springs that friction is before it slides: M rise phi^2/2 over the edge's length.
  [[nodiscard]] double friction_energy() const {
    double energy = 0.0;
    for (int f = 0; f < 2; ++f) {
      const EdgeFriction& own = friction[f];
      const double half = 0.5 * own.law.moment * own.law.rise;
      for (std::size_t i = 0; i < own.phi.size(); ++i)
        energy += half * yarns[f][i] * packed.spacing[f] * own.phi[i] * own.phi[i];
      for (std::size_t k = 0; k < own.phi_loose.size(); ++k)
        energy += half * loose[f].yarns[k] / loose[f].inverse_rest[k] * own.phi_loose[k] * own.phi_loose[k];
    }
    return energy;
  }

  void compute_row(int j, ShellRowBuffers& buffers) {
    for (auto* vectors : {&buffers.along.force, &buffers.along.bend, &buffers.along.shear})
      clear_gaps(*vectors, warp_runs, j, packed.stride);
    for (auto* vectors : {&buffers.across.force, &buffers.across.bend, &buffers.across.shear})
      clear_gaps(*vectors, weft_runs, j, packed.stride);
    for (auto* vectors : {&buffers.xp, &buffers.xq, &buffers.dp, &buffers.dq})
      clear_gaps(*vectors, twist_runs, j, packed.stride);
    if (j < 0) return;
    edges_of_row(0, j, warp_runs, shell_rows(j, 1, j), buffers.along);
    if (j + 1 >= packed.rows) return;
    const ShellRows rows = shell_rows(j, 0, j + 1);
    edges_of_row(1, j, weft_runs, rows, buffers.across);
    ShellTwistOutput out{};
    for (int c = 0; c < 3; ++c) {
      out.xp[c] = buffers.xp[c].data();
      out.xq[c] = buffers.xq[c].data();
      out.dp[c] = buffers.dp[c].data();
      out.dq[c] = buffers.dq[c].data();
    }
    for (int r = twist_runs.first[j]; r < twist_runs.first[j + 1]; ++r)
      shell_twist_row(rows, 1.0 / packed.spacing[0], 1.0 / packed.spacing[1],
                      twist_stiffness.data() + static_cast<std::size_t>(j) * packed.stride, twist_runs.run[r].begin,
                      twist_runs.run[r].end, out);
  }

  void assemble_row(int j, ShellRowBuffers& below, ShellRowBuffers& here, State& target) {
    const Run span = packed.span(j);
    const auto offset = static_cast<std::size_t>(j) * packed.stride;
    for (int c = 0; c < 3; ++c) {
      shell_position_assemble(here.along.force[c].data(), here.across.force[c].data(), below.across.force[c].data(),
                              here.xp[c].data(), here.xq[c].data(), below.xp[c].data(), below.xq[c].data(),
                              target.force[c].data() + offset, span.begin, span.end);
      shell_director_assemble({here.along.bend[c].data(), here.along.shear[c].data(), here.across.bend[c].data(),
                               here.across.shear[c].data(), below.across.bend[c].data(), below.across.shear[c].data(),
                               here.dp[c].data(), here.dq[c].data(), below.dp[c].data(), below.dq[c].data()},
                              force[c].data() + offset, span.begin, span.end);
    }
  }

  void block_of_rows(State& target, int first, int last, std::array<ShellRowBuffers, 2>& rows) {
    if (first == last) return;
    compute_row(first - 1, rows[(first + 1) % 2]);
    for (int j = first; j < last; ++j) {
      compute_row(j, rows[j % 2]);
      assemble_row(j, rows[(j + 1) % 2], rows[j % 2], target);
    }
  }

  void add_loose(State& target) {
    const double* const x[3] = {target.position[0].data(), target.position[1].data(), target.position[2].data()};
    const double* const d[3] = {director[0].data(), director[1].data(), director[2].data()};
    for (int f = 0; f < 2; ++f) {
      auto& list = loose[f];
      const EdgeOutput out = list.output();
      kernels[f].loose(moment[f].pointer(), list.view(), x, d, out);
      if (friction[f].acts())
        friction_loops().loose_edge_forces(friction[f].law.moment, list.view(), x, d, friction[f].phi_loose.data(),
                                           out);
      for (int c = 0; c < 3; ++c)
        for (int e = 0; e < list.size(); ++e) {
          const int a = list.node0[e], b = list.node1[e];
          target.force[c][a] -= out.force[c][e];
          target.force[c][b] += out.force[c][e];
          force[c][a] += out.bend[c][e] - out.shear[c][e];
          force[c][b] -= out.bend[c][e] + out.shear[c][e];
        }
    }
  }

  // Packed ranges of nodes, one per row and one for what is behind the rows.
  [[nodiscard]] Run range(int r) const {
    if (r == packed.rows) return {packed.lattice_nodes(), packed.nodes};
    const Run span = packed.span(r);
    return {r * packed.stride + span.begin, r * packed.stride + span.end};
  }

  void drift(double time) {
    const auto d = pointers(director, 0), v = pointers(velocity, 0);
    double* const to_d[3] = {d[0], d[1], d[2]};
    double* const to_v[3] = {v[0], v[1], v[2]};
    for (int r = 0; r <= packed.rows; ++r) drift_directors(to_d, to_v, time, range(r).begin, range(r).end);
  }

  void kick(double step) {
    const double kick_time = 0.5 * (step_before + step);
    const double half = 0.5 * damping * kick_time;
    const auto d = pointers(director, 0), v = pointers(velocity, 0), f = pointers(force, 0);
    const double* const from_d[3] = {d[0], d[1], d[2]};
    const double* const from_f[3] = {f[0], f[1], f[2]};
    double* const to_v[3] = {v[0], v[1], v[2]};
    double sum = 0.0;
    for (int r = 0; r <= packed.rows; ++r) {
      sums[r].fill(0.0);
      kick_directors(from_d, to_v, from_f, inertia.data(), inverse_inertia.data(), (1.0 - half) / (1.0 + half),
                     kick_time / (1.0 + half), range(r).begin, range(r).end, sums[r].data());
      for (const double lane : sums[r]) sum += lane;
    }
    kinetic = 0.5 * sum;
    const double power = 2.0 * damping * kinetic;
    damping_work += 0.5 * (power_before + power) * step_before;
    power_before = power;
    step_before = step;
  }

  [[nodiscard]] std::vector<Vec3> of_mesh_nodes(const Components& field) const {
    std::vector<Vec3> result;
    for (const int p : packed.packed_of_mesh) result.push_back({field[0][p], field[1][p], field[2][p]});
    return result;
  }
  void set_mesh_nodes(const std::vector<Vec3>& from, Components& field) const {
    for (int n = 0; n < mesh.node_count(); ++n)
      for (int c = 0; c < 3; ++c) field[c][packed.packed_of_mesh[n]] = from[n][c];
  }
};

Shell::Shell(const Mesh& mesh, const PackedMesh& packed, const Card& card, const Flexure& flexure,
             const std::vector<char>& clamped, const State& state, const Setup& setup)
    : parts_(std::make_unique<Parts>(mesh, packed, card, flexure, state, setup)) {
  parts_->set_inertia(clamped, setup.fabric_step);
  set_directors(start_normals(mesh));
}

Shell::~Shell() = default;

// Directors stay at the time of the forces until the next call, which moves them there first.
void Shell::add_forces(State& state, double step) {
  auto& p = *parts_;
  if (p.step_before > 0.0) p.drift(p.step_before);
  if (p.has_friction()) {
    p.team.run(static_cast<int>(p.scratch.size()), [&](int b) { p.step_friction(p.block[b], p.block[b + 1]); });
    p.step_loose_friction();
  }
  p.team.run(static_cast<int>(p.scratch.size()),
             [&](int b) { p.block_of_rows(state, p.block[b], p.block[b + 1], p.scratch[b]); });
  for (auto& component : p.force) std::fill(component.begin() + p.packed.lattice_nodes(), component.end(), 0.0);
  p.add_loose(state);
  p.kick(step);
}

StoredEnergy Shell::stored_energy() const {
  const auto& p = *parts_;
  const auto position = mesh_positions(p.packed, p.state);
  const auto normal = directors();
  const double energy =
      shell_energy(p.edges, p.cells, p.flexure, p.mesh.spacing, position, normal) + p.friction_energy();
  return {.total = energy,
          .bending = energy,
          .hourglass =
              shell_hourglass_energy(find_twist_cells(p.mesh), p.flexure, p.card, p.mesh.spacing, position, normal)};
}

EnergyFlow Shell::energy_flow() const {
  const double friction = parts_->friction_lost();
  return {.kinetic = parts_->kinetic, .lost = parts_->damping_work + friction, .bending_friction = friction};
}

double Shell::inertia_scale() const {
  return parts_->scale;
}

// gamma = slope - rotation: both sides count twice. |slope| <= |u|/L each.
double Shell::longest_step() const {
  return parts_->longest_step;
}

void Shell::add_stiffness_bound(const std::vector<Vec3>& position, double /*fabric_frequency*/,
                                std::vector<double>& bound) const {
  const auto& p = *parts_;
  for (std::size_t e = 0; e < p.edges.size(); ++e) {
    const ShellEdge& edge = p.edges[e];
    const auto &a = position[edge.node[0]], &b = position[edge.node[1]];
    const double square = std::pow(b[0] - a[0], 2) + std::pow(b[1] - a[1], 2) + std::pow(b[2] - a[2], 2);
    // bending feels the edge's turn once its ends' directors differ, at most by 2
    const double stiffness = (4.0 * edge.shear_stiffness + 16.0 * p.stiffest[e]) / square;
    for (const int n : edge.node) bound[n] += stiffness;
  }
}

void Shell::archive(Archive& archive) {
  auto& p = *parts_;
  archive.number("a shell's step", p.step_before, not_negative);
  archive.number("a shell's energy", p.kinetic, not_negative);
  archive.number("a shell's damping work", p.damping_work);
  archive.number("a shell's damping power", p.power_before);
  for (auto& component : p.director) archive.numbers("a director", component);
  for (auto& component : p.velocity) archive.numbers("a director's velocity", component);
  if (!p.has_friction()) return;
  archive.flag("whether friction in bending began", p.friction_begun);
  for (auto& friction : p.friction) friction.archive(archive);
  archive.numbers("a row's friction in bending", p.friction_of_row);
  archive.number("the loose edges' friction", p.friction_of_loose);
}

std::vector<Vec3> Shell::directors() const {
  return parts_->of_mesh_nodes(parts_->director);
}

void Shell::set_directors(const std::vector<Vec3>& director) {
  parts_->set_mesh_nodes(director, parts_->director);
}

void Shell::set_director_velocities(const std::vector<Vec3>& velocity) {
  parts_->set_mesh_nodes(velocity, parts_->velocity);
}

std::vector<Vec3> Shell::director_forces() const {
  return parts_->of_mesh_nodes(parts_->force);
}

}  // namespace weaveform
