#include "mesher/scene/idle.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/vector/vector.hpp"
#include "mesher/scene/grip_direction.hpp"
#include "mesher/scene/taken.hpp"

namespace weaveform {
namespace {

constexpr double earth = 9810.0;        // mm/s^2
constexpr double most_earths = 100.0;   // a centrifuge has more, a press and a table do not
constexpr double least_earths = 0.005;  // written in m/s^2 it is a thousandth; beside other loads it may be a trick

double weight_of(const Scene& scene) {
  return length(scene.analysis.gravity);
}

bool leaves_free(const GripSpec& grip, std::size_t axis) {
  return std::find(grip.free.begin(), grip.free.end(), Component{static_cast<int>(axis)}) != grip.free.end();
}

bool holds_nothing(const GripSpec& grip) {
  return leaves_free(grip, 0) && leaves_free(grip, 1) && leaves_free(grip, 2);
}

// Whether any part of its travel is prescribed.
bool moves_something(const GripSpec& grip) {
  if (grip.travel == 0.0) return false;
  const auto direction = grip_direction(grip);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (direction[axis] != 0.0 && !leaves_free(grip, axis)) return true;
  return false;
}

bool is_pushed(const ToolSpec& tool) {
  return tool.force.value_or(0.0) > 0.0;
}

void look_at_grips(const Scene& scene, std::vector<std::string>& found) {
  for (const GripSpec& grip : scene.grip) {
    if (holds_nothing(grip))
      found.push_back(fmt::format(
          "grip '{}' holds nothing: it leaves x, y and z free; leave out of 'free' what it is to hold", grip.name));
    else if (grip.travel != 0.0 && !moves_something(grip))
      found.push_back(fmt::format(
          "grip '{}' moves nothing: its travel of {:g} mm is along {}, which it leaves free; take that out of 'free', "
          "or set travel = 0",
          grip.name, grip.travel, fmt::join(names_of(grip.free), " and ")));
  }
}

// What pulls or pushes the fabric without anything against it only carries it along; "" where something is.
std::string alone(const Scene& scene) {
  if (scene.frame) return "";
  std::vector<std::string> holders;
  for (const GripSpec& grip : scene.grip)
    if (!holds_nothing(grip)) holders.push_back(fmt::format("grip '{}'", grip.name));
  for (const ToolSpec& tool : scene.tools) holders.push_back(fmt::format("tool '{}'", tool.name));
  return holders.size() == 1 ? holders.front() : "";
}

void look_at_loads(const Scene& scene, std::vector<std::string>& found) {
  const double weight = weight_of(scene);
  const bool moved = std::any_of(scene.grip.begin(), scene.grip.end(), moves_something) ||
                     (scene.frame && scene.frame->travel != 0.0) ||
                     std::any_of(scene.tools.begin(), scene.tools.end(),
                                 [](const ToolSpec& tool) { return tool.travel != 0.0 || is_pushed(tool); });
  if (!moved && weight == 0.0 && scene.analysis.perturbation == 0.0)
    found.emplace_back(
        "nothing acts on the fabric: no grip, tool or frame moves it, no force pushes and no gravity pulls; the run "
        "will show it at rest");
  const bool held =
      scene.frame || !scene.tools.empty() ||
      std::any_of(scene.grip.begin(), scene.grip.end(), [](const GripSpec& grip) { return !holds_nothing(grip); });
  if (const std::string mover = alone(scene); moved && weight == 0.0 && !mover.empty())
    found.push_back(
        fmt::format("nothing holds the fabric against {}, which only carries it along; add a grip or a tool", mover));
  if (weight > 0.0 && !held)
    found.emplace_back("nothing holds the fabric: it falls freely; add a grip, or a tool beneath it");
  if (weight > most_earths * earth || (!moved && weight > 0.0 && weight < least_earths * earth))
    found.push_back(fmt::format("analysis.gravity is {:.4g} mm/s2, {:.3g} times Earth's 9810; it is in mm/s2", weight,
                                weight / earth));
}

}  // namespace

std::vector<std::string> idle_parts(const Scene& scene) {
  std::vector<std::string> found;
  look_at_grips(scene, found);
  look_at_loads(scene, found);
  if (scene.accuracy && scene.taken.empty() && !leaves_open(scene))
    found.emplace_back(
        "[accuracy] decides nothing: mesh and elements are given; set blank.coarsening, model.yarn or model.cell to "
        "\"auto\", or leave it out");
  return found;
}

}  // namespace weaveform
