#include "solver/contact/ply_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>

#include "core/error.hpp"
#include "solver/constraint/ties.hpp"
#include "solver/contact/ply_parts.hpp"

namespace weaveform {
namespace {

constexpr double stack_tolerance = 1e-6;  // mm; a start this deep counts as touching
constexpr double draped_tolerance = 0.1;  // of the thickness; surfaces of chords laid over a tool meet no better
constexpr double wakes_within = 0.25;  // of the thinner ply's thickness: a pair that is nearer is looked at by blocks
constexpr double safe_part_asleep = 0.5;  // of a pair's measured gap
constexpr int lanes_in_chunk = 4000, most_chunks = 4;
constexpr int segments_to_fold = 32;
constexpr int look_at_edges_every = 16;  // steps

std::string name_of_ply(const PlyContactSetup& setup, std::size_t k) {
  return k < setup.names.size() ? setup.names[k] : fmt::format("ply {}", k + 1);
}

}  // namespace

PlyContact::PlyContact(const PlyContactSetup& setup) : parts_(std::make_unique<Parts>(setup.team)) {
  Parts& parts = *parts_;
  const auto sheared = [&](std::size_t k) { return k < setup.sheared.size() ? setup.sheared[k] : nullptr; };
  for (std::size_t k = 0; k < setup.plies.size(); ++k) {
    parts.face.emplace_back(*setup.plies[k], name_of_ply(setup, k), sheared(k));
    parts.swollen = parts.swollen || sheared(k) != nullptr;
    const int blocks = static_cast<int>(parts.face.back().blocks().size()),
              chunks = std::clamp(parts.face.back().lanes() / lanes_in_chunk, 1, most_chunks);
    std::vector<int> first_blocks;
    for (int c = 1; c < chunks; ++c) first_blocks.push_back(static_cast<int>(static_cast<long>(blocks) * c / chunks));
    parts.face.back().set_chunks(first_blocks);
    for (int c = 0; c < chunks; ++c)
      parts.chunk.push_back({.ply = static_cast<int>(k),
                             .first_block = static_cast<int>(static_cast<long>(blocks) * c / chunks),
                             .end_block = static_cast<int>(static_cast<long>(blocks) * (c + 1) / chunks),
                             .pass = {},
                             .back = {}});
  }
  if (parts.swollen)
    for (auto& face : parts.face) face.make_swell();
  std::vector<std::string> complaints;
  const int plies = static_cast<int>(setup.plies.size());
  for (int lower = 0; lower < plies; ++lower)
    for (int upper = lower + 1; upper < plies; ++upper)
      parts.make_pair(lower, upper, setup.law(lower, upper), setup.frequency, complaints);
  if (!complaints.empty()) throw InputError(complaints);
  parts.list_returns();
  for (auto& pair : parts.pair) parts.look_at_start(pair, complaints);
  if (!complaints.empty()) throw InputError(complaints);
}

PlyContact::~PlyContact() = default;

void PlyContact::Parts::make_pair(int lower, int upper, const PairLaw& law, double frequency,
                                  std::vector<std::string>& complaints) {
  PlyFace &below = face[lower], &above = face[upper];
  if (const auto wrong = wrong_law(law); !wrong.empty()) {
    complaints.push_back(fmt::format("between plies '{}' and '{}': {}", below.name(), above.name(), wrong));
    return;
  }
  Pair& made = pair.emplace_back();
  made.reading.lower = lower;
  made.reading.upper = upper;
  made.neighbours = upper == lower + 1;
  make_tables(law, below.touching(), above.touching(), frequency, made.tables);
  made.pass.reserve(2);
  made.pass.emplace_back(below, above, pass_law(law, made.tables, below.touching(), above.touching(), false, frequency),
                         frequency, swollen);
  made.pass.emplace_back(above, below, pass_law(law, made.tables, above.touching(), below.touching(), true, frequency),
                         frequency, swollen);
}

// Whose passes a chunk has, and who gives to which part of which ply.
void PlyContact::Parts::list_returns() {
  const int passes = 2 * static_cast<int>(pair.size());
  for (auto& its : chunk) {
    its.back.resize(passes);
    for (int p = 0; p < passes; ++p)
      if (&pass(p).own() == &face[its.ply]) its.pass.push_back(p);
  }
  for (int k = 0; k < static_cast<int>(face.size()); ++k) {
    Part made = {.ply = k, .first_segment = 0, .end_segment = 0, .from = {}};
    for (int c = 0; c < static_cast<int>(chunk.size()); ++c)
      for (const int p : chunk[c].pass)
        if (&pass(p).other() == &face[k]) made.from.push_back({c, p});
    const int segments = (face[k].nodes() + ply_segment - 1) / ply_segment;
    for (int s = 0; s < segments; s += segments_to_fold) {
      made.first_segment = s;
      made.end_segment = std::min(s + segments_to_fold, segments);
      part.push_back(made);
    }
  }
}

void PlyContact::Parts::look_at_start(Pair& its, std::vector<std::string>& complaints) {
  double gap = std::numeric_limits<double>::infinity(), deepest = 0.0;
  std::string where;
  for (auto& pass : its.pass) {
    std::vector<double> depths;
    gap = std::min(gap, pass.search(&depths));
    const Mesh& mesh = pass.own().ply().mesh();
    const double allowed = mesh.nodes.flat_position.empty() ? stack_tolerance : draped_tolerance * its.thinner(face);
    for (int n = 0; n < pass.own().nodes(); ++n) {
      if (depths[n] <= allowed || depths[n] <= deepest) continue;
      deepest = depths[n];
      const Vec3 x = pass.own().position(n);
      where = fmt::format("node {} of '{}' at ({:.6g}, {:.6g}, {:.6g}) mm", pass.own().shown_node(n), pass.own().name(),
                          x[0], x[1], x[2]);
    }
  }
  if (!where.empty())
    complaints.push_back(fmt::format(
        "plies '{}' and '{}' start {:.4g} mm inside each other (half of each's thickness included, {:.4g} mm), deepest "
        "at {}; move one of them, or set a gap",
        face[its.reading.lower].name(), face[its.reading.upper].name(), deepest, its.pass[0].law().reach, where));
  if (!its.neighbours) sleep_or_wake(its, gap);
}

// Plies with others between them need no arrays until they come near.
void PlyContact::Parts::sleep_or_wake(Pair& its, double gap) {
  its.far = 0.0;
  if (gap <= wakes_within * its.thinner(face)) return;
  its.far = safe_part_asleep * (gap - wakes_within * its.thinner(face)) + face[its.reading.lower].way +
            face[its.reading.upper].way;
  for (auto& pass : its.pass) pass.forget();
}

// Pairs that may have come near since they were last looked at.
void PlyContact::Parts::look_at_sleepers() {
  std::vector<Pair*> due;
  for (auto& its : pair)
    if (!its.awake() && its.far <= face[its.reading.lower].way + face[its.reading.upper].way) due.push_back(&its);
  if (due.empty()) return;
  std::vector<double> gap(2 * due.size());
  team.run(static_cast<int>(gap.size()), [&](int k) { gap[k] = due[k / 2]->pass[k % 2].search(); });
  for (std::size_t k = 0; k < due.size(); ++k) sleep_or_wake(*due[k], std::min(gap[2 * k], gap[2 * k + 1]));
}

void PlyContact::add_forces() {
  const auto begin = std::chrono::steady_clock::now();
  Parts& parts = *parts_;
  const State& first = parts.face.front().state();
  const double step_made = parts.started ? first.time - parts.time : 0.0;
  const bool looks_at_edges = !parts.started || first.step % look_at_edges_every == 0;
  parts.time = first.time;
  parts.started = true;
  parts.count_ways(step_made);
  if (looks_at_edges)
    parts.team.run(static_cast<int>(parts.face.size()),
                   [&](int k) { parts.face[k].edges().look(parts.face[k].state().position); });
  parts.look_at_sleepers();
  parts.look(step_made > 0.0 ? 1.0 / step_made : 0.0);
  parts.fold();
  for (auto& pair : parts.pair) parts.read(pair);
  parts.wall_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Only where something is clear or asleep does anybody ask how far it is.
void PlyContact::Parts::count_ways(double step_made) {
  constexpr double rounding = 1.0 + 1e-9;
  const bool any_asked = std::any_of(pair.begin(), pair.end(), [](const Pair& its) {
    return !its.awake() || its.pass[0].any_clear() || its.pass[1].any_clear();
  });
  if (!any_asked || step_made == 0.0) return;
  std::vector<double> speed(chunk.size(), 0.0);
  team.run(static_cast<int>(chunk.size()), [&](int c) {
    for (int b = chunk[c].first_block; b < chunk[c].end_block; ++b)
      speed[c] = std::max(speed[c], face[chunk[c].ply].speed(b));
  });
  std::vector<double> of_ply(face.size(), 0.0);
  for (std::size_t c = 0; c < chunk.size(); ++c) of_ply[chunk[c].ply] = std::max(of_ply[chunk[c].ply], speed[c]);
  for (std::size_t k = 0; k < face.size(); ++k) {
    face[k].way += of_ply[k] * step_made * rounding;
    if (face[k].thickens()) face[k].way += 0.5 * face[k].touching().thickness * face[k].sheared()->greatest_rise();
  }
}

// A chunk writes forces of its own nodes and its own lists.
void PlyContact::Parts::look(double inverse_time) {
  team.run(static_cast<int>(chunk.size()), [&](int c) {
    Chunk& its = chunk[c];
    std::vector<int> awake;
    for (const int p : its.pass)
      if (pass(p).awake()) awake.push_back(p);
    PlyFace& own = face[its.ply];
    BlockFrame frame;
    PlyPull pull;
    for (int b = its.first_block; b < its.end_block; ++b) {
      bool with_frame = false, pulled = false;
      for (const int p : awake) {
        if (!pass(p).is_near(b)) {
          pass(p).pass_over(b);
          continue;
        }
        if (!with_frame) {
          own.frame(b, frame);
          pull = {};
        }
        with_frame = true;
        pulled = pass(p).look(b, frame, inverse_time, pull, its.back[p]) || pulled;
      }
      if (!pulled) {
        own.take_nothing(b);
        continue;
      }
      own.take(b, frame, pull);
      if (swollen) loops_of_plies().add(own.blocks()[b].count, pull.load, own.load().data() + own.blocks()[b].first);
    }
  });
}

// What the others' nodes gave back, to each ply in the order of the chunks.
void PlyContact::Parts::fold() {
  const PlyLoops& loops = loops_of_plies();
  team.run(static_cast<int>(part.size()), [&](int p) {
    const int ply = part[p].ply;
    double* const force[3] = {face[ply].state().force[0].data(), face[ply].state().force[1].data(),
                              face[ply].state().force[2].data()};
    for (const auto& [c, from] : part[p].from) {
      PlyReturn& back = chunk[c].back[from];
      if (back.force.empty()) continue;
      for (int s = part[p].first_segment; s < part[p].end_segment; ++s) {
        if (back.touched[s] == 0) continue;
        back.touched[s] = 0;
        const int first = s * ply_segment, count = std::min(ply_segment, face[ply].nodes() - first);
        double* const into[3] = {force[0] + first, force[1] + first, force[2] + first};
        if (face[ply].thickens())
          loops.fold_loads(count, back.force.data() + 4 * static_cast<std::size_t>(first),
                           face[ply].load().data() + first);
        loops.fold(count, back.force.data() + 4 * static_cast<std::size_t>(first), into);
      }
    }
    if (face[ply].has_levers())
      face[ply].take_levers(part[p].first_segment * ply_segment,
                            std::min(part[p].end_segment * ply_segment, face[ply].nodes()));
  });
  for (auto& one : face)
    if (one.has_levers()) one.take_irregular_levers();
}

void PlyContact::Parts::read(Pair& its) const {
  PairReading& reading = its.reading;
  const PlyPassSums a = its.awake() ? its.pass[0].sums() : PlyPassSums{},
                    b = its.awake() ? its.pass[1].sums() : PlyPassSums{};
  reading.area = a.area + b.area;
  reading.force = a.normal + b.normal;
  reading.friction_force = a.friction + b.friction;
  reading.stored = a.energy + b.energy;
  reading.friction_work += a.friction_work + b.friction_work;
  reading.damping_work += a.damping_work + b.damping_work;
  reading.depth = std::max({0.0, a.depth, b.depth});
  reading.greatest_depth = std::max(reading.greatest_depth, reading.depth);
  reading.pressure = std::max(a.pressure, b.pressure);
  reading.greatest_pressure = std::max(reading.greatest_pressure, reading.pressure);
  if (reading.force > 0.0 || reading.friction_force > 0.0) its.pressed = true;
  if (reading.depth <= its.thinner(face)) return;
  const PlyPassState& pass = a.depth >= b.depth ? its.pass[0] : its.pass[1];
  const int n = pass.deepest();
  const Vec3 x = pass.own().position(n);
  throw PhysicsError(fmt::format(
      "at t = {:.4g} s, step {}: node {} of ply '{}' at ({:.6g}, {:.6g}, {:.6g}) mm has gone {:.4g} mm into ply '{}', "
      "more than the thinner one's thickness ({:.4g} mm); load more slowly, see whether the tools leave room for the "
      "stack, or make blank.coarsening smaller: a node bears so much",
      time, pass.own().state().step, pass.own().shown_node(n), pass.own().name(), x[0], x[1], x[2], reading.depth,
      pass.other().name(), its.thinner(face)));
}

StoredEnergy PlyContact::stored_energy() const {
  StoredEnergy sum;
  for (const auto& pair : parts_->pair) sum.total += pair.reading.stored;
  return sum;
}

EnergyFlow PlyContact::energy_flow() const {
  EnergyFlow flow;
  for (const auto& pair : parts_->pair) flow.lost += pair.reading.friction_work + pair.reading.damping_work;
  return flow;
}

bool PlyContact::passes_bound() const {
  return std::any_of(parts_->pair.begin(), parts_->pair.end(),
                     [](const auto& pair) { return pair.pressed && !pair.bounded; });
}

void PlyContact::renew_bound() {
  for (auto& pair : parts_->pair) pair.bounded = pair.pressed;
}

void PlyContact::add_stiffness_bound(int ply, double fabric_frequency, std::vector<double>& bound) const {
  const PlyFace& face = parts_->face[ply];
  Doubles sum(face.nodes(), 0.0), others;
  for (const auto& pair : parts_->pair) {
    if (!pair.bounded || !pair.awake() || (pair.reading.lower != ply && pair.reading.upper != ply)) continue;
    for (const auto& pass : pair.pass) {
      const bool is_own = &pass.own() == &face;
      others.assign(is_own ? pass.other().nodes() : pass.own().nodes(), 0.0);
      pass.add_stiffness_bound(fabric_frequency, pair.tables.stiffest, is_own ? sum : others, is_own ? others : sum);
    }
  }
  add_packed_bound(face.ply().mesh(), face.ply().packed(), sum, bound);
}

void PlyContact::archive(Archive& archive) {
  Parts& parts = *parts_;
  archive.flag("whether plies have met", parts.started);
  archive.number("a stack's time", parts.time, not_negative);
  for (auto& face : parts.face) {
    archive.number("a ply's way", face.way, not_negative);
    face.edges().archive(archive);
  }
  for (auto& pair : parts.pair) {
    bool awake = pair.awake();
    archive.flag("whether two plies are near", awake);
    archive.flag("whether two plies have pressed", pair.pressed);
    archive.flag("whether two plies count for the step", pair.bounded);
    archive.number("a gap between plies", pair.far, not_negative);
    PairReading& reading = pair.reading;
    for (double* value : {&reading.area, &reading.force, &reading.friction_force, &reading.depth,
                          &reading.greatest_depth, &reading.pressure, &reading.greatest_pressure, &reading.stored,
                          &reading.friction_work, &reading.damping_work})
      archive.number("a pair of plies' sum", *value);
    for (auto& pass : pair.pass) {
      if (awake && !pass.awake()) pass.wake();
      if (!awake && pass.awake()) pass.forget();
      if (awake)
        pass.archive(archive);
      else
        pass.archive_feet(archive);
    }
  }
}

std::vector<PairReading> PlyContact::pairs() const {
  std::vector<PairReading> all;
  for (const auto& pair : parts_->pair) {
    PairReading reading = pair.reading;
    double area = 0.0, slip = 0.0;
    if (pair.awake())
      for (const auto& pass : pair.pass)
        for (int l = 0; l < pass.own().lanes(); ++l) {
          reading.greatest_slip = std::max(reading.greatest_slip, pass.path(l));
          if (!(pass.press(l).normal > 0.0)) continue;
          const double here = pass.law().share * pass.own().area()[l];
          area += here;
          slip += here * pass.path(l);
        }
    reading.mean_slip = area > 0.0 ? slip / area : 0.0;
    all.push_back(reading);
  }
  return all;
}

namespace {

void look_at_lane(const PlyPassState& pass, int lane, int other, std::size_t node, PlyContactState& state) {
  if (const double path = pass.path(lane); path >= state.slip_path[node]) {
    state.slip_path[node] = path;
    state.slip[node] = pass.slip(lane);
  }
  const auto press = pass.press(lane);
  if (press.friction == FrictionState::none) return;
  if (state.other[node] >= 0 && press.pressure <= state.pressure[node]) return;
  state.pressure[node] = press.pressure;
  state.other[node] = other;
  state.friction[node] = press.friction;
}

}  // namespace

PlyContactState PlyContact::state_of(int ply) const {
  const PlyFace& face = parts_->face[ply];
  const Mesh& mesh = face.ply().mesh();
  const auto count = static_cast<std::size_t>(mesh.node_count());
  PlyContactState state = {.slip = std::vector<Vec3>(count, {0.0, 0.0, 0.0}),
                           .slip_path = std::vector<double>(count, 0.0),
                           .pressure = std::vector<double>(count, 0.0),
                           .other = std::vector<int>(count, -1),
                           .friction = std::vector<FrictionState>(count, FrictionState::none)};
  for (const auto& pair : parts_->pair)
    for (const auto& pass : pair.pass)
      if (&pass.own() == &face && pass.awake())
        for (std::size_t n = 0; n < count; ++n)
          if (const int lane = face.lane_of(face.ply().packed().packed_of_mesh[n]); lane >= 0)
            look_at_lane(pass, lane, pair.reading.lower == ply ? pair.reading.upper : pair.reading.lower, n, state);
  const auto copy = [&](int from, int to) {
    state.slip[to] = state.slip[from];
    state.slip_path[to] = state.slip_path[from];
    state.pressure[to] = state.pressure[from];
    state.other[to] = state.other[from];
    state.friction[to] = state.friction[from];
  };
  // who follows others touches through them
  for (const auto& tie : mesh.tie) copy(tie.share > 0.5 ? tie.to[1] : tie.to[0], tie.node);
  for (const auto& image : mesh.symmetry.image) {
    copy(image.of, image.node);
    state.slip[image.node] = mirrored_vector(state.slip[image.of], mesh.symmetry.plane, image.planes);
  }
  return state;
}

double PlyContact::greatest_depth() const {
  double depth = 0.0;
  for (const auto& pair : parts_->pair) depth = std::max(depth, pair.reading.greatest_depth);
  return depth;
}

double PlyContact::friction_work() const {
  double sum = 0.0;
  for (const auto& pair : parts_->pair) sum += pair.reading.friction_work;
  return sum;
}

double PlyContact::damping_work() const {
  double sum = 0.0;
  for (const auto& pair : parts_->pair) sum += pair.reading.damping_work;
  return sum;
}

double PlyContact::wall_s() const {
  return parts_->wall_s;
}

}  // namespace weaveform
