#include "mesher/scene/ply_scene.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/scene/taken.hpp"

namespace weaveform {

namespace {

// All plies are in one frame: its corners are those of the lowest ply, however the yarns of this one lie between them,
// and its mass is there once.
void share_frame(const Scene& scene, const PlySpec& ply, FrameSpec& frame) {
  const long turns = std::lround((ply.blank.yarn_angle - scene.ply.front().blank.yarn_angle) / 90.0);
  frame.turn = static_cast<int>((turns % 4 + 4) % 4);
  frame.mass_scale /= static_cast<double>(scene.ply.size());
}

}  // namespace

Scene scene_of_ply(const Scene& scene, std::size_t number) {
  const PlySpec& ply = scene.ply[number];
  Scene own = scene;
  own.ply.clear();
  own.stack = {};
  own.fabric = ply.fabric;
  own.blank = ply.blank;
  own.blank.position = ply.position.value_or(scene.blank.position);
  own.model = ply.model;
  own.model.symmetry = scene.model.symmetry;
  own.taken = taken_of_ply(scene.taken, ply.name);
  if (own.frame) share_frame(scene, ply, *own.frame);
  std::erase_if(own.grip, [&](const GripSpec& grip) {
    return !grip.plies.empty() && std::find(grip.plies.begin(), grip.plies.end(), ply.name) == grip.plies.end();
  });
  std::erase_if(own.measure,
                [&](const MeasureSpec& measure) { return !measure.ply.empty() && measure.ply != ply.name; });
  return own;
}

bool lies_off(const std::array<double, 4>& box, const std::array<double, 2>& extent) {
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (box[axis] > 0.5 * extent[axis] || box[axis + 2] < -0.5 * extent[axis]) return true;
  return false;
}

PairSpec pair_of(const StackSpec& stack, const std::string& one, const std::string& other) {
  PairSpec pair{.plies = {one, other},
                .friction = stack.friction,
                .friction_law = stack.friction_law,
                .gap = stack.gap,
                .compaction = stack.compaction};
  const auto names_both = [&](const PairSpec& own) {
    return own.plies == std::vector{one, other} || own.plies == std::vector{other, one};
  };
  const auto own = std::find_if(stack.pair.begin(), stack.pair.end(), names_both);
  if (own == stack.pair.end()) return pair;
  if (own->friction) pair.friction = own->friction;
  if (!own->friction_law.empty()) pair.friction_law = own->friction_law;
  if (own->gap) pair.gap = own->gap;
  if (!own->compaction.empty()) pair.compaction = own->compaction;
  return pair;
}

}  // namespace weaveform
