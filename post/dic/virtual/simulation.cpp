#include "post/dic/virtual/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/keys/nearest_name.hpp"

namespace weaveform::dic {
namespace {

namespace fs = std::filesystem;

constexpr const char* travel_ending = ".displacement_mm";

// Those whose travel changes during the run.
std::string moving_grip(const History& history, const std::string& asked, const fs::path& directory) {
  std::vector<std::string> all, moving;
  for (const std::string& column : history.column) {
    if (!column.ends_with(travel_ending)) continue;
    const std::string name = column.substr(0, column.size() - std::string(travel_ending).size());
    all.push_back(name);
    const auto travel = history.values(column);
    const auto [least, greatest] = std::minmax_element(travel.begin(), travel.end());
    if (*greatest - *least > 1e-9) moving.push_back(name);
  }
  if (!asked.empty()) {
    if (std::find(all.begin(), all.end(), asked) != all.end()) return asked;
    throw InputError(fmt::format("{}: the simulation has no grip '{}' (grip of [stages]){}", directory.string(), asked,
                                 did_you_mean(asked, all)));
  }
  if (moving.size() == 1) return moving.front();
  std::string names;
  for (const auto& name : moving) names += (names.empty() ? "" : ", ") + name;
  throw InputError(fmt::format("{}: {}; whose travel is the crosshead's? set grip of [stages] (--set stages.grip=NAME)",
                               directory.string(),
                               moving.empty() ? "nothing moves in this simulation" : "several move (" + names + ")"));
}

}  // namespace

double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (at <= x.front()) return y.front();
  if (at >= x.back()) return y.back();
  const auto above = std::upper_bound(x.begin(), x.end(), at) - x.begin();
  const auto k = static_cast<std::size_t>(above);
  const double share = x[k] > x[k - 1] ? (at - x[k - 1]) / (x[k] - x[k - 1]) : 1.0;
  return y[k - 1] + share * (y[k] - y[k - 1]);
}

std::vector<double> made_monotonic(const std::vector<double>& y) {
  struct Block {
    double sum;
    std::size_t count;
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Block> blocks;
  for (const double value : y) {
    blocks.push_back({value, 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() > blocks.back().mean()) {
      blocks[blocks.size() - 2].sum += blocks.back().sum;
      blocks[blocks.size() - 2].count += blocks.back().count;
      blocks.pop_back();
    }
  }
  std::vector<double> result;
  for (const Block& block : blocks) result.insert(result.end(), block.count, block.mean());
  return result;
}

Simulation::Seen Simulation::seen_of(ResultFolder& folder, const std::string& ply) {
  const std::vector<PlySpec>& plies = folder.scene().ply;
  std::vector<std::string> names;
  for (const PlySpec& each : plies) names.push_back(each.name);
  const auto found = std::find(names.begin(), names.end(), ply);
  if (!ply.empty() && found == names.end())
    throw InputError(fmt::format("{}: the simulation has no ply '{}' (ply of [instrument]){}",
                                 folder.directory().string(), ply,
                                 names.empty() ? "; it has one fabric, leave it out" : did_you_mean(ply, names)));
  if (plies.empty()) return {folder.scene(), folder.card(), folder.mesh(), {0, folder.mesh().node_count()}, ""};
  const auto number = static_cast<std::size_t>(ply.empty() ? plies.size() - 1 : found - names.begin());
  const Resolved& seen = folder.model().ply[number];
  return {seen.scene, seen.card, seen.mesh, nodes_of_ply(folder.model().mesh, number), names[number]};
}

Simulation::Simulation(const fs::path& directory, const std::string& grip, const std::string& ply)
    : folder_(directory),
      seen_(seen_of(folder_, ply)),
      scene_(seen_.scene),
      card_(seen_.card),
      mesh_(seen_.mesh),
      history_(folder_.history()),
      frame_(folder_.frames()),
      grip_(moving_grip(history_, grip, directory)),
      flat_(mesh_, scene_.blank),
      whole_nodes_(folder_.mesh().nodes.position.size()) {
  if (frame_.size() < 2 || history_.row.empty())
    throw InputError(fmt::format("{}: has fewer than two frames; solve again", directory.string()));
  time_ = history_.values("time_s");
  travel_ = history_.values(grip_ + travel_ending);
  force_ = history_.values(grip_ + ".force_N");
  for (const FrameFile& frame : frame_) frame_travel_.push_back(interpolated(time_, travel_, frame.time));
}

SimulatedState Simulation::state(const std::vector<Vec3>& world, double time, double travel) const {
  SimulatedState result;
  result.time = time;
  result.travel = travel;
  result.force = force_at(travel);
  result.displacement = flat_.in_blank_frame(world);
  for (std::size_t n = 0; n < world.size(); ++n) {
    result.displacement[n][0] -= flat_.nodes()[n][0];
    result.displacement[n][1] -= flat_.nodes()[n][1];
    result.displacement[n][2] -= mesh_.nodes.position[n][2] - scene_.blank.position[2];
  }
  result.shear_angle = compute_fields(mesh_, card_, scene_.model, time, world).shear_angle;
  return result;
}

// Of the nodes that are seen.
std::vector<Vec3> Simulation::positions(std::size_t frame) const {
  std::vector<Vec3> all = read_frame_positions(frame_[frame].file);
  if (all.size() != whole_nodes_)
    throw InputError(
        fmt::format("{}: a frame has {} nodes, but mesh.vtu has {}; the folder mixes two runs, solve again",
                    folder_.directory().string(), all.size(), whole_nodes_));
  return {all.begin() + seen_.nodes.first, all.begin() + seen_.nodes.last};
}

SimulatedState Simulation::at_frame(std::size_t frame) const {
  return state(positions(frame), frame_[frame].time, frame_travel_[frame]);
}

SimulatedState Simulation::at_travel(double travel, const std::string& asked_by) const {
  const auto [least, greatest] = std::minmax_element(frame_travel_.begin(), frame_travel_.end());
  const double slack = 1e-6 * (*greatest - *least);
  if (travel < *least - slack || travel > *greatest + slack)
    throw InputError(
        fmt::format("{}: at {} mm of travel, but '{}' moves from {} to {} mm in the simulation; simulate "
                    "further, or correct the stage's displacement, its factor or its offset",
                    asked_by, travel, grip_, *least, *greatest));
  for (std::size_t k = 0; k + 1 < frame_.size(); ++k) {
    const double from = frame_travel_[k], to = frame_travel_[k + 1];
    if ((travel - from) * (travel - to) > 0.0 && !(std::abs(travel - to) <= slack)) continue;
    const double share = to == from ? 0.0 : std::clamp((travel - from) / (to - from), 0.0, 1.0);
    if (share < 1e-9) return at_frame(k);
    if (share > 1.0 - 1e-9) return at_frame(k + 1);
    std::vector<Vec3> position = positions(k);
    const std::vector<Vec3> next = positions(k + 1);
    for (std::size_t n = 0; n < position.size(); ++n)
      for (std::size_t c = 0; c < 3; ++c) position[n][c] += share * (next[n][c] - position[n][c]);
    return state(position, frame_[k].time + share * (frame_[k + 1].time - frame_[k].time), travel);
  }
  return at_frame(frame_.size() - 1);
}

SimulatedState Simulation::at_force(double force, const std::string& asked_by) const {
  const std::vector<double> rising = made_monotonic(force_);
  if (force < rising.front() || force > rising.back())
    throw InputError(
        fmt::format("{}: at {} N, but the load of '{}' goes from {} to {} N in the simulation; simulate "
                    "further, or correct the stage's force or its factor",
                    asked_by, force, grip_, rising.front(), rising.back()));
  return at_travel(interpolated(rising, travel_, force), asked_by);
}

double Simulation::force_at(double travel) const {
  for (std::size_t k = 0; k + 1 < travel_.size(); ++k) {
    const double from = travel_[k], to = travel_[k + 1];
    if ((travel - from) * (travel - to) > 0.0 || from == to) continue;
    return force_[k] + (travel - from) / (to - from) * (force_[k + 1] - force_[k]);
  }
  return std::abs(travel - travel_.front()) < std::abs(travel - travel_.back()) ? force_.front() : force_.back();
}

}  // namespace weaveform::dic
