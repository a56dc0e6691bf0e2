#include "solver/contact/rigid_tools.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/keys/advice.hpp"

namespace weaveform {
namespace {

// Along the mirror planes that mirror a resting tool onto itself: the force across them is zero.
Vec3 along_planes(Vec3 direction, const std::vector<SymmetryPlane>& planes) {
  for (const auto& plane : planes) {
    const double across = dot(direction, plane.normal);
    for (int c = 0; c < 3; ++c) direction[c] -= across * plane.normal[c];
  }
  return direction;
}

double total_mass(const std::vector<SprungPly>& plies) {
  double mass = 0.0;
  for (const auto& ply : plies) mass += ply.mass;
  return mass;
}

// tonne; the tool's share of k (u - U)^2 must stay below the fabric's greatest omega^2
double least_tool_mass(const std::vector<SprungPly>& plies) {
  double mass = 0.0;
  for (const auto& ply : plies)
    mass += (1.0 + 1.0 / coupling_split) * ply.frequency * ply.frequency * ply.mass /
            (ply.fabric_frequency * ply.fabric_frequency);
  return mass;
}

}  // namespace

void archive_load(Archive& archive, ToolLoad& load) {
  archive.numbers("a tool's force", load.force);
  for (double* value : {&load.area, &load.energy, &load.friction_work, &load.damping_work, &load.deepest})
    archive.number("a tool's load", *value);
}

double MovingTool::reaction() const {
  return dot(load.force, tool.direction);
}

Placement MovingTool::place() const {
  Placement place = tool.start;
  for (int c = 0; c < 3; ++c) place.origin[c] += motion.displacement() * tool.direction[c];
  return place;
}

ContactTool MovingTool::contact_tool() const {
  const double v = motion.velocity();
  return {place().origin, {v * tool.direction[0], v * tool.direction[1], v * tool.direction[2]}};
}

RigidTools::RigidTools(std::vector<Tool> tools, const Scene& scene, const MeshSymmetry& symmetry, double least_spacing,
                       double duration, const std::vector<SprungPly>& plies)
    : plies_(plies), planes_(symmetry.plane), parts_(symmetry.parts()), least_spacing_(least_spacing) {
  const double blank_mass = total_mass(plies), least_mass = least_tool_mass(plies);
  for (std::size_t t = 0; t < tools.size(); ++t) {
    ToolSpec spec = scene.tools[t];
    if (spec.force) *spec.force /= parts_;
    if (spec.mass) *spec.mass /= parts_;
    const double mass = spec.mass.value_or(default_tool_mass(scene.analysis, blank_mass));
    if (spec.force && mass < least_mass)
      throw InputError(fmt::format(
          "[tools.{}] mass {:.4g} tonne is too light for the stable step; give {:.4g} or more (the blank has {:.4g})",
          spec.name, parts_ * mass, rounded_up(parts_ * least_mass, 4), parts_ * blank_mass));
    if (spec.travel == 0.0 && !spec.force) tools[t].direction = along_planes(tools[t].direction, planes_);
    tools_.push_back({.tool = std::move(tools[t]), .motion = ToolMotion(spec, duration, mass), .load = {}});
  }
}

void RigidTools::advance(double time) {
  step_made_ = started_ ? time - time_ : 0.0;
  for (auto& tool : tools_) {
    tool.reaction_before = tool.reaction();
    tool.motion.advance(time, step_made_, tool.reaction_before);
    const double way = std::abs(tool.motion.state().way);
    tool.way += way;
    if (way > least_spacing_)
      throw PhysicsError(fmt::format(
          "at t = {:.4g} s: tool '{}' moved {:.4g} mm in one step, more than a cell ({:.4g} mm); load more slowly "
          "(analysis.duration, analysis.loading_speed)",
          time, tool.tool.name, way, least_spacing_));
  }
  started_ = true;
  time_ = time;
}

void RigidTools::gather(const std::vector<const std::vector<ToolLoad>*>& loads) {
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    MovingTool& tool = tools_[t];
    ToolLoad& sum = tool.load;
    sum = {};
    for (const auto* of_ply : loads) {
      const ToolLoad& load = (*of_ply)[t];
      for (int c = 0; c < 3; ++c) sum.force[c] += load.force[c];
      sum.area += load.area;
      sum.energy += load.energy;
      sum.friction_work += load.friction_work;
      sum.damping_work += load.damping_work;
      sum.deepest = std::max(sum.deepest, load.deepest);
    }
    greatest_depth_ = std::max(greatest_depth_, sum.deepest);
    tool.motion.add_travel_work(tool.reaction_before, tool.reaction());
  }
  read_instruments();
}

void RigidTools::read_instruments() {
  readings_.clear();
  for (const auto& tool : tools_) {
    // what the mirrored parts feel across a plane is the opposite
    Vec3 whole = along_planes(tool.load.force, planes_);
    for (double& component : whole) component *= parts_;
    readings_.push_back({tool.motion.displacement(), parts_ * tool.reaction(), parts_ * tool.load.area, whole});
  }
}

StoredEnergy RigidTools::stored_energy() const {
  StoredEnergy sum;
  for (const auto& tool : tools_) sum.total += tool.load.energy;
  return sum;
}

EnergyFlow RigidTools::energy_flow() const {
  EnergyFlow flow;
  for (const auto& tool : tools_) {
    flow.kinetic += tool.motion.kinetic_energy(time_, tool.reaction());
    flow.put_in += tool.motion.work();
  }
  flow.lost = friction_work() + damping_work();
  return flow;
}

// The tool's part of k (u - U)^2, with the damping of all nodes counted as in Contact::add_stiffness_bound.
double RigidTools::longest_step() const {
  double greatest = 0.0;  // 1/s^2
  for (const auto& tool : tools_) {
    if (!tool.motion.pushed()) continue;
    double rate = 0.0;
    for (const auto& ply : plies_) {
      const double share = (1.0 + 1.0 / coupling_split) * ply.mass / tool.motion.mass();
      rate += share * (ply.frequency * ply.frequency) * (1.0 + 2.0 * contact_damping);
    }
    greatest = std::max(greatest, rate);
  }
  return greatest > 0.0 ? 2.0 / std::sqrt(greatest) : std::numeric_limits<double>::infinity();
}

double RigidTools::friction_work() const {
  double sum = 0.0;
  for (const auto& tool : tools_) sum += tool.load.friction_work;
  return sum;
}

double RigidTools::damping_work() const {
  double sum = 0.0;
  for (const auto& tool : tools_) sum += tool.load.damping_work + tool.motion.damping_work();
  return sum;
}

void RigidTools::archive(Archive& archive) {
  archive.flag("whether tools have moved", started_);
  archive.number("a tool's time", time_, not_negative);
  archive.number("a depth", greatest_depth_, not_negative);
  for (auto& tool : tools_) {
    archive.number("a tool's way", tool.way, not_negative);
    tool.motion.archive(archive);
    archive_load(archive, tool.load);
  }
  read_instruments();
}

}  // namespace weaveform
