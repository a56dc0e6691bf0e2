#include "mesher/scene/check_tools.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/vector/vector.hpp"

namespace weaveform {
namespace {

bool is_zero(const Vec3& a) {
  return a == Vec3{0.0, 0.0, 0.0};
}

// Whether the file names a shape that there is.
bool has_shape(const toml::table& table) {
  return choice_named<ToolShape>(table["shape"].value_or(std::string_view())).has_value();
}

// What a shape is made of: keys that one shape needs and the others must not have.
struct ShapeKey {
  const char* key;
  bool given;
  std::vector<ToolShape> needed_by;
  std::vector<ToolShape> taken_by = {};
};

void check_shape_keys(const ToolSpec& tool, const toml::table& table, Complaints& complaints) {
  const ShapeKey keys[] = {
      {"radius", tool.radius.has_value(), {ToolShape::sphere, ToolShape::cylinder}},
      {"opening_radius", tool.opening_radius.has_value(), {ToolShape::ring}},
      {"fillet_radius", tool.fillet_radius != 0.0, {}, {ToolShape::ring}},
      {"profile", !tool.profile.empty(), {ToolShape::revolved}},
      {"file", !tool.file.empty(), {ToolShape::triangles}},
      {"chord_tolerance", tool.chord_tolerance.has_value(), {}, {ToolShape::triangles}},
      {"unit", tool.unit.has_value(), {}, {ToolShape::triangles}},
      {"flip", tool.flip, {}, {ToolShape::triangles}},
      {"position",
       tool.position.has_value(),
       {ToolShape::cylinder, ToolShape::revolved},
       {ToolShape::plane, ToolShape::sphere, ToolShape::ring, ToolShape::triangles}},
  };
  const auto has = [&](const std::vector<ToolShape>& shapes) {
    return std::find(shapes.begin(), shapes.end(), tool.shape) != shapes.end();
  };
  for (const ShapeKey& row : keys) {
    // judged by the file too, so that a key with a bad value is not called missing
    if (has(row.needed_by) && !row.given && !table.contains(row.key))
      complaints.add(table, fmt::format("[tools.{}] lacks '{}', which the shape '{}' needs", tool.name, row.key,
                                        name_of(tool.shape)));
    if (row.given && !has(row.needed_by) && !has(row.taken_by))
      complaints.add(place_of(table, row.key),
                     fmt::format("'{}' means nothing to the shape '{}'; it belongs to {}", row.key, name_of(tool.shape),
                                 fmt::join(names_of(row.needed_by.empty() ? row.taken_by : row.needed_by), ", ")));
  }
}

void check_place(const ToolSpec& tool, const toml::table& table, Complaints& complaints) {
  if (is_zero(tool.axis)) complaints.add(place_of(table, "axis"), "'axis' is zero; give it a length");
  if (tool.direction && is_zero(*tool.direction))
    complaints.add(place_of(table, "direction"), "'direction' is zero; give it a length");
  const bool can_touch =
      tool.shape == ToolShape::plane || tool.shape == ToolShape::sphere || tool.shape == ToolShape::ring;
  const bool upright = tool.axis[0] == 0.0 && tool.axis[1] == 0.0;
  if (can_touch && !upright && !table.contains("position"))
    complaints.add(table, fmt::format("[tools.{}] lacks 'position'; only with its axis along z does a {} find its own "
                                      "place on the blank",
                                      tool.name, name_of(tool.shape)));
}

void check_speed(const ToolSpec& tool, const toml::table& table, Complaints& complaints) {
  if (tool.speed.empty()) return;
  const auto complain = [&](const std::string& what) { complaints.add(place_of(table, "speed"), what); };
  double area = 0.0;
  for (std::size_t n = 0; n < tool.speed.size(); ++n) {
    if (tool.speed[n].size() != 2)
      return complain("'speed' holds points of two numbers, [part of the duration, speed]");
    if (n == 0) continue;
    const auto &a = tool.speed[n - 1], &b = tool.speed[n];
    if (!(b[0] > a[0])) return complain("'speed': the parts of the duration must rise from point to point");
    area += 0.5 * (b[0] - a[0]) * (a[1] + b[1]);
  }
  if (tool.speed.front()[0] != 0.0 || tool.speed.back()[0] != 1.0)
    return complain("'speed' must begin at part 0 and end at part 1 of the duration");
  if (!(area > 0.0)) complain("'speed' is zero at all times; leave it out and set travel = 0 for a tool at rest");
}

void check_motion(const ToolSpec& tool, const toml::table& table, Complaints& complaints) {
  if (tool.force && tool.travel != 0.0)
    complaints.add(place_of(table, "force"),
                   fmt::format("[tools.{}] has both 'travel' and 'force'; keep one", tool.name));
  if (tool.mass && !tool.force)
    complaints.add(place_of(table, "mass"), "'mass' is that of a tool pushed by a 'force'; there is none");
  check_speed(tool, table, complaints);
}

void check_name(const ToolSpec& tool, const Scene& scene, const toml::table& table, Complaints& complaints) {
  const auto same = [&](const auto& other) { return other.name == tool.name; };
  if (std::any_of(scene.grip.begin(), scene.grip.end(), same))
    complaints.add(table, fmt::format("a tool and a grip are both called '{}'; give each its own name", tool.name));
}

}  // namespace

const toml::node& place_of(const toml::table& table, const char* key) {
  const toml::node* node = table.get(key);
  return node == nullptr ? table : *node;
}

void check_tools(const Scene& scene, const toml::table& root, Complaints& complaints) {
  const toml::table* group = root["tools"].as_table();
  if (group == nullptr) return;
  for (const ToolSpec& tool : scene.tools) {
    const toml::node* node = group->get(tool.name);
    const toml::table* table = node == nullptr ? nullptr : node->as_table();
    if (table == nullptr || !has_shape(*table)) continue;  // complained about already
    check_shape_keys(tool, *table, complaints);
    check_place(tool, *table, complaints);
    check_motion(tool, *table, complaints);
    check_name(tool, scene, *table, complaints);
  }
}

}  // namespace weaveform
