#include "mesher/automatic/take.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/keys/advice.hpp"
#include "core/keys/choice_value.hpp"
#include "mesher/automatic/bends.hpp"
#include "mesher/automatic/elements.hpp"
#include "mesher/automatic/mesh_rules.hpp"
#include "mesher/scene/ply_scene.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/taken.hpp"

namespace weaveform {
namespace {

// The longest cell that serves and what bounds it.
struct Bound {
  double side = std::numeric_limits<double>::infinity();  // mm
  std::string why, missed;
};

class Bounds {
public:
  void add(double side, const std::string& why) {
    if (side < bound_.side) bound_ = {side, why, ""};
  }
  // What no bound can promise.
  void doubt(const std::string& missed) { doubt_ = missed; }
  [[nodiscard]] Bound least() const { return {bound_.side, bound_.why, doubt_}; }

private:
  Bound bound_;
  std::string doubt_;
};

std::string wanted_words(const AccuracySpec& wanted) {
  return fmt::format("{:.3g} % of force and {:.3g} deg", 100.0 * wanted.force, wanted.angle);
}

std::string bend_words(const ToolBends& bends) {
  std::string words;
  if (!bends.edge.tool.empty())
    words = fmt::format("tool '{}' bends the fabric over {:.3g} mm", bends.edge.tool, bends.edge.radius);
  if (!bends.form.tool.empty())
    words += fmt::format("{}tool '{}' forms it over {:.3g} mm", words.empty() ? "" : " and ", bends.form.tool,
                         bends.form.radius);
  return words;
}

void bound_by_tools(const Scene& scene, const Card& card, double reach, Bounds& bounds) {
  const AccuracySpec& wanted = *scene.accuracy;
  const ToolBends bends = tool_bends(scene, make_tools(scene, card.thickness), reach);
  if (!bends.edge.tool.empty() || !bends.form.tool.empty())
    bounds.add(
        longest_over_tools(forming_errors(scene.analysis.curved_contact), wanted, bends.form.radius, bends.edge.radius),
        fmt::format("for {} where {}", wanted_words(wanted), bend_words(bends)));
  const bool curved = scene.analysis.curved_contact;
  const double promised = promised_along_yarns(curved);
  if (bends.edge.along_yarns > mostly_along_yarns && wanted.force < promised) {
    const std::string advice = curved ? "compare two meshes"
                                      : fmt::format("set analysis.curved_contact, with which it was {:.2g} %",
                                                    100.0 * promised_along_yarns(true));
    bounds.doubt(
        fmt::format("edges of tool '{}' run along the yarns, which all meet them at the same phase of the mesh: "
                    "the force of such a box scattered by {:.2g} % from mesh to mesh, so that {:.3g} % "
                    "cannot be promised; {}",
                    bends.edge.tool, 100.0 * promised, 100.0 * wanted.force, advice));
  }
  if (!bends.drape.tool.empty())
    bounds.add(longest_of_net(wanted, bends.drape.radius),
               fmt::format("for {:.3g} deg of the net on tool '{}', whose tightest bend is {:.3g} mm", wanted.angle,
                           bends.drape.tool, bends.drape.radius));
}

// mm; along which a strip hangs that one edge holds, else the shorter side.
double overhang_of(const Scene& scene, const std::array<double, 2>& extent) {
  if (scene.grip.size() == 1 && scene.grip.front().edge) {
    const BlankEdge edge = *scene.grip.front().edge;
    return extent[edge == BlankEdge::left || edge == BlankEdge::right ? 0 : 1];
  }
  return std::min(extent[0], extent[1]);
}

void bound_by_loads(const Scene& scene, const std::array<double, 2>& extent, Bounds& bounds) {
  const AccuracySpec& wanted = *scene.accuracy;
  const double across = std::min(extent[0], extent[1]);
  bounds.add(across / cells_across, fmt::format("three cells across a blank of {:.4g} mm", across));
  if (scene.frame) return bounds.add(across / cells_in_frame, "a shear frame's field is uniform: three cells a side");
  if (is_flat(scene) && !scene.grip.empty()) {
    const bool pinned = scene.model.yarn != YarnElement::beam && !hardly_stretches(scene.model);
    bounds.add(longest_pulled(wanted, across, pinned),
               fmt::format("for {} of fabric pulled over a width of {:.4g} mm{}", wanted_words(wanted), across,
                           pinned ? " whose yarns do not bend in the plane" : ""));
  }
  if (is_stretched(scene))
    bounds.add(longest_stretched(wanted, across),
               fmt::format("for {} of fabric held by grips and stretched by tools, {:.4g} mm wide",
                           wanted_words(wanted), across));
  if (scene.tools.empty() && scene.analysis.gravity[2] != 0.0) {
    const double overhang = overhang_of(scene, extent);
    bounds.add(longest_hanging(wanted, overhang),
               fmt::format("for {} of fabric that hangs over {:.4g} mm", wanted_words(wanted), overhang));
  }
}

template <class Box>
double smaller_side(const Box& box) {
  return std::min(box[2] - box[0], box[3] - box[1]);
}

void bound_by_boxes(const Scene& scene, Bounds& bounds) {
  for (const MeasureSpec& measure : scene.measure) {
    const double side = measure.box            ? smaller_side(*measure.box)
                        : measure.relative_box ? smaller_side(*measure.relative_box) * scene.blank.size[0]
                                               : std::numeric_limits<double>::infinity();
    bounds.add(longest_in_box(side), fmt::format("for cells in measure '{}', {:.3g} mm wide", measure.name, side));
  }
  for (const GripSpec& grip : scene.grip)
    if (grip.box)
      bounds.add(longest_in_box(smaller_side(*grip.box)),
                 fmt::format("for nodes in grip '{}', {:.3g} mm wide", grip.name, smaller_side(*grip.box)));
}

Bound longest_cell(const Scene& scene, const Card& card, const std::array<double, 2>& extent) {
  Bounds bounds;
  bound_by_loads(scene, extent, bounds);
  bound_by_boxes(scene, bounds);
  if (!scene.tools.empty()) bound_by_tools(scene, card, 0.5 * std::hypot(extent[0], extent[1]), bounds);
  Bound bound = bounds.least();
  const double finest = finest_coarsening * std::sqrt(card.yarn[0].interval * card.yarn[1].interval);
  if (bound.side < finest) {
    bound.missed = fmt::format("cells of {:.2g} mm are wanted ({}), finer than any that were measured{}{}", bound.side,
                               bound.why, bound.missed.empty() ? "" : "; ", bound.missed);
    bound.side = finest;
    bound.why = "half a yarn's interval, the finest that was measured";
  }
  return bound;
}

// Not above `value`, and written with three digits.
double three_digits(double value) {
  return std::stod(fmt::format("{:.3g}", rounded_down(value, 3)));
}

// Cells about as long as wide, of warp and weft.
TakenElement take_coarsening(Scene& scene, const Card& card, const std::array<double, 2>& extent) {
  constexpr double least = 0.05, greatest = 100.0;  // as the key allows
  const Bound bound = longest_cell(scene, card, extent);
  for (std::size_t f = 0; f < 2; ++f)
    scene.blank.coarsening[f] = std::clamp(three_digits(bound.side / card.yarn[f].interval), least, greatest);
  scene.blank.coarsening_open = false;
  return {fmt::format("cells of {:.3g} mm, {}", bound.side, bound.why), bound.missed};
}

}  // namespace

void take_what_is_open(Scene& scene, const Card& card, const BlankOutline& outline) {
  if (!leaves_open(scene.blank, scene.model)) return;
  scene.accuracy = scene.accuracy.value_or(AccuracySpec{});
  const auto record = [&](const char* key, const TomlText& value, const TakenElement& taken) {
    scene.taken.push_back({key, value.value_or(""), taken.why, taken.missed});
  };
  // yarns first: a friction in bending is the beams' where there are any; the mesh last: it asks what bends
  if (scene.model.yarn_open) {
    const TakenElement taken = take_yarn(scene, card);
    record("model.yarn", toml_text(scene.model.yarn), taken);
  }
  if (scene.model.cell_open) {
    const TakenElement taken = take_cell(scene, card);
    record("model.cell", toml_text(scene.model.cell), taken);
  }
  if (scene.blank.coarsening_open) {
    const TakenElement taken = take_coarsening(scene, card, blank_extent(scene.blank, outline));
    record("blank.coarsening", toml_text(scene.blank.coarsening), taken);
  }
}

void take_what_is_open(Scene& stack, std::size_t number, Scene& own, const Card& card, const BlankOutline& outline) {
  PlySpec& ply = stack.ply[number];
  if (!leaves_open(own.blank, own.model)) return;
  const std::size_t before = own.taken.size();
  take_what_is_open(own, card, outline);
  stack.accuracy = own.accuracy;
  ply.blank.coarsening = own.blank.coarsening;
  ply.model.yarn = own.model.yarn;
  ply.model.cell = own.model.cell;
  ply.blank.coarsening_open = ply.model.yarn_open = ply.model.cell_open = false;
  for (std::size_t t = before; t < own.taken.size(); ++t) stack.taken.push_back(of_stack(own.taken[t], ply.name));
}

Scene read_taken_scene(const std::filesystem::path& scene_file, const std::vector<std::string>& overrides) {
  Scene scene = read_scene(scene_file, overrides);
  if (!leaves_open(scene)) return scene;
  if (scene.ply.empty())
    take_what_is_open(scene, load_card(scene.fabric.material, scene.file), read_blank_outline(scene));
  for (std::size_t k = 0; k < scene.ply.size(); ++k) {
    Scene own = scene_of_ply(scene, k);
    take_what_is_open(scene, k, own, load_card(own.fabric.material, own.file), read_blank_outline(own));
  }
  return scene;
}

}  // namespace weaveform
