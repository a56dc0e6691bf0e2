// Keys of the tools, and of the blank that starts draped over one.
#include <fmt/format.h>

#include <utility>

#include "mesher/scene/scene_keys.hpp"

namespace weaveform {
namespace {

constexpr const char* gentle = "gentle";

// A table, or the word for the one that serves without trials where a tool draws fabric: within 0.3 % of slow runs' forces
// on six of seven scenes, where the smooth step is up to 5 % short (docs/stability.md).
Key<ToolSpec> speed_key(KeyRule rule) {
  auto row = key<&ToolSpec::speed>(std::move(rule));
  row.type += fmt::format(" or \"{}\"", gentle);
  row.read = [read = row.read, type = row.type](const toml::node& node, const KeyRule& about, ToolSpec& tool,
                                                Complaints& complaints) {
    if (node.value<std::string>() == gentle)
      tool.speed = {{0, 0}, {0.2, 1}, {0.4, 1}, {0.7, 0.3}, {1, 0.1}};
    else if (node.is_array())
      read(node, about, tool, complaints);
    else
      complain_type(node, about, type, complaints);
  };
  return row;
}

}  // namespace

const std::vector<Key<ToolSpec>>& tool_keys() {
  static const std::vector<Key<ToolSpec>> keys = {
      key<&ToolSpec::shape>(
          {.name = "shape",
           .advice = "a CAD file (STEP, IGES, BREP, .geo) or an STL file is shape 'triangles'",
           .required = true,
           .doc =
               "`plane`; `sphere` with a shank of its radius up the axis; endless `cylinder`; `ring`: a plate with a "
               "rounded opening; `revolved`: a profile turned about the axis; `triangles`: a surface from an STL or "
               "CAD file"}),
      key<&ToolSpec::position>(
          {.name = "position",
           .unit = "mm",
           .limits = any_length,
           .doc =
               "of the shape's origin: a point of the plane, the centre of the sphere, a point of the cylinder's axis, "
               "the centre of the ring's face, r = z = 0 of the profile, the origin of the STL file. Left out for a "
               "plane, sphere or ring with its axis along z: touching the flat blank at its centre, a sphere tip "
               "first, a plane or ring by its face"}),
      key<&ToolSpec::axis>({.name = "axis",
                            .unit = "1",
                            .limits = between(-1e9, 1e9),
                            .doc =
                                "outward normal of a plane or of a ring's face; from a sphere's centre into its shank; "
                                "axis of a cylinder or profile; any length but zero. Triangles do not use it"}),
      key<&ToolSpec::radius>({.name = "radius",
                              .unit = "mm",
                              .limits = above(0, greatest_length),
                              .doc = "of a sphere or cylinder, which need it"}),
      key<&ToolSpec::opening_radius>({.name = "opening_radius",
                                      .unit = "mm",
                                      .limits = above(0, greatest_length),
                                      .doc = "of a ring, which needs it"}),
      key<&ToolSpec::fillet_radius>({.name = "fillet_radius",
                                     .unit = "mm",
                                     .limits = between(0, greatest_length),
                                     .doc = "of the rim of a ring's opening"}),
      key<&ToolSpec::profile>(
          {.name = "profile",
           .unit = "mm",
           .limits = any_length,
           .doc = "of a revolved tool: corners in the half-plane (r, z) with the material on the left: [r, z] a line "
                  "leads here, [r, z, radius] a rounded corner, [r, z, cr, cz] an arc about (cr, cz) leads here; the "
                  "first "
                  "and last line go on for ever beyond an end off the axis"}),
      key<&ToolSpec::file>(
          {.name = "file",
           .doc =
               "surface of a tool of triangles, relative to the scene file: STL (outside counter-clockwise), CAD "
               "(STEP, IGES, BREP, Gmsh's .geo), Gmsh's .msh or the shells of an Abaqus .inp (these are made to face "
               "outward, open ones to the blank)"}),
      key<&ToolSpec::chord_tolerance>(
          {.name = "chord_tolerance",
           .unit = "mm",
           .limits = between(1e-4, 1e3),
           .doc = "of triangles made from CAD: greatest distance from the true surface. Left out: a "
                  "hundredth of a cell's shorter edge"}),
      key<&ToolSpec::unit>({.name = "unit",
                            .doc = "of an STL, BREP, .geo, .msh or .inp file, which name none; left out: mm, and "
                                   "refused when the tool is then "
                                   "out of all proportion to the blank. STEP and IGES bring their own"}),
      key<&ToolSpec::flip>({.name = "flip", .doc = "turns a surface of triangles over, its inside out"}),
      key<&ToolSpec::travel>({.name = "travel",
                              .unit = "mm",
                              .limits = any_length,
                              .doc = "way along `direction` over the duration; 0 stays, or follows `force`"}),
      key<&ToolSpec::direction>(
          {.name = "direction",
           .unit = "1",
           .limits = between(-1e9, 1e9),
           .doc = "of travel, force and of the force recorded in history.csv; any length but zero. Left out: the axis "
                  "of a "
                  "plane or ring (the way it faces), against the axis of a sphere, [0, 0, -1] for the others"}),
      speed_key({.name = "speed",
                 .unit = "1",
                 .limits = between(0, 1e9),
                 .doc = "points [part of the duration, relative speed], joined by straight lines and scaled so "
                        "that the way is `travel`; `gentle`: fast while the fabric is slack, ever slower to the end, "
                        "where loads are read; left out: smooth step, or, where `analysis.inertia` chooses the "
                        "duration, a course told from trials (docs/stability.md)"}),
      key<&ToolSpec::force>({.name = "force",
                             .unit = "N",
                             .limits = between(0, 1e9),
                             .doc = "pushes the tool along `direction`, all of it after the first 3 % of the duration; "
                                    "it moves as the fabric lets it, along "
                                    "`direction` only"}),
      key<&ToolSpec::mass>(
          {.name = "mass",
           .unit = "tonne",
           .limits = above(0, 1e6),
           .doc =
               "of a tool pushed by a force; auto: four times that of the blank, which neither sets the step nor lags "
               "behind it; with `step_bound = \"stiffest\"` that of the blank"}),
      key<&ToolSpec::damping>(
          {.name = "damping",
           .unit = "1/s",
           .limits = between(0, 1e9),
           .doc = "of a tool pushed by a force: viscous force on it over its mass and speed; its work is reported"}),
      key<&ToolSpec::friction>(
          {.name = "friction", .unit = "1", .limits = between(0, 10), .doc = "Coulomb coefficient of tool and fabric"}),
      key<&ToolSpec::offset>({.name = "offset",
                              .unit = "mm",
                              .limits = between(0, greatest_length),
                              .doc = "from the fabric's middle plane to its face; auto: half the fabric's thickness"}),
  };
  return keys;
}

const std::vector<Key<DrapeSpec>>& drape_keys() {
  static const std::vector<Key<DrapeSpec>> keys = {
      key<&DrapeSpec::tool>({.name = "tool",
                             .required = true,
                             .identifier = true,
                             .doc = "name of the tool it lies on, [tools.NAME], where that stands at the start"}),
      key<&DrapeSpec::anchor>({.name = "anchor",
                               .unit = "mm",
                               .limits = any_length,
                               .doc = "point of the flat blank, blank frame; the crossing nearest to it is laid on the "
                                      "seed"}),
      key<&DrapeSpec::seed>({.name = "seed",
                             .unit = "mm",
                             .limits = any_length,
                             .doc = "point of the tool's surface, world; left out: the anchor, projected on the tool "
                                    "along `projection`"}),
      key<&DrapeSpec::projection>(
          {.name = "projection",
           .unit = "1",
           .limits = between(-1e9, 1e9),
           .doc = "way of that projection, any length but zero; the first surface met from outside "
                  "counts"}),
      key<&DrapeSpec::warp_direction>(
          {.name = "warp_direction",
           .unit = "1",
           .limits = between(-1e9, 1e9),
           .doc = "of the warp at the seed; its part along the surface counts; left out: as in the flat blank"}),
      key<&DrapeSpec::warp_curve>({.name = "warp_curve",
                                   .unit = "mm",
                                   .limits = any_length,
                                   .doc =
                                       "points [x, y, z] of a line through the seed that the warp yarn follows, in the "
                                       "warp's sense; they are moved to the surface; left out: a geodesic, which also "
                                       "goes on beyond the line's ends"}),
      key<&DrapeSpec::weft_curve>(
          {.name = "weft_curve", .unit = "mm", .limits = any_length, .doc = "the same for the weft yarn"}),
  };
  return keys;
}

}  // namespace weaveform
