#include "solver/bending/flexure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace weaveform {
namespace {

TangentLaw constant_law(double stiffness) {
  if (stiffness <= 0.0) return {};
  return TangentLaw({{0.0, std::numeric_limits<double>::infinity(), {stiffness}}});
}

// The card's law of a yarn, seen from the mesh's normal.
BendingLaw law_as_laid(const YarnCard& yarn, FabricFace face) {
  return face == FabricFace::up ? yarn.bending_out_of_plane : yarn.bending_out_of_plane.turned_over();
}

using Missing = std::vector<std::string>;

void choose_beams(const Card& card, const Scene& scene, Flexure& flexure, Missing& missing) {
  const ModelSpec& model = scene.model;
  if (!model.yarn_bending && (card.yarn[0].bending_out_of_plane.empty() || card.yarn[1].bending_out_of_plane.empty())) {
    missing.push_back("model.yarn = \"beam\": card '" + card.name +
                      "' gives no bending_out_of_plane for its yarns; add it to the card, or set "
                      "model.yarn_bending = [in plane, out of plane] (N mm^2)");
    return;
  }
  for (int f = 0; f < 2; ++f) {
    flexure.in_plane[f] = model.yarn_bending ? constant_law((*model.yarn_bending)[0]) : card.yarn[f].bending_in_plane;
    flexure.out_of_plane[f] =
        model.yarn_bending ? constant_law((*model.yarn_bending)[1]) : law_as_laid(card.yarn[f], scene.fabric.face);
  }
}

// N mm^2; what a cell adds per yarn, as a constant, or the yarn's own law where nothing else is known.
BendingLaw cell_law(const Card& card, const Scene& scene, int f, Missing& missing) {
  const ModelSpec& model = scene.model;
  const YarnCard& yarn = card.yarn[f];
  const bool beams = model.yarn == YarnElement::beam;
  if (model.cell_bending) return constant_law((*model.cell_bending)[f] * yarn.interval);
  if (card.bending.rigidity) {
    const double borne = !beams                              ? 0.0
                         : model.yarn_bending                ? (*model.yarn_bending)[1]
                         : yarn.bending_out_of_plane.empty() ? 0.0  // complained about
                                                             : yarn.bending_out_of_plane.first_stiffness();
    return constant_law((*card.bending.rigidity)[f] * yarn.interval - borne);
  }
  if (beams) return {};
  if (!yarn.bending_out_of_plane.empty()) return law_as_laid(yarn, scene.fabric.face);
  if (f == 0)
    missing.push_back("model.cell = \"" + name_of(model.cell) + "\": card '" + card.name +
                      "' gives neither bending.rigidity nor bending_out_of_plane; add one to the card, or set "
                      "model.cell_bending = [warp, weft, twist] (N mm)");
  return {};
}

double needed(const std::optional<double>& value, const Card& card, const char* what, const char* key,
              Missing& missing) {
  if (!value)
    missing.push_back(std::string("card '") + card.name + "' gives no " + what + "; add it to the card, or set " + key);
  return value.value_or(0.0);
}

void choose_cells(const Card& card, const Scene& scene, Flexure& flexure, Missing& missing) {
  const ModelSpec& model = scene.model;
  flexure.twist = model.cell_bending
                      ? (*model.cell_bending)[2]
                      : needed(card.bending.twist, card, "bending.twist", "model.cell_bending (N mm)", missing);
  for (int f = 0; f < 2; ++f) {
    const BendingLaw law = cell_law(card, scene, f, missing);
    if (flexure.has_shell) {
      flexure.shell[f] = law;
    } else if (!law.empty()) {
      // one of the two is constant: beams beside cells leave cells a constant
      const bool own_law = flexure.out_of_plane[f].empty();
      flexure.out_of_plane[f] = own_law ? law : with_constant(flexure.out_of_plane[f], law.first_stiffness());
    }
  }
  if (!flexure.has_shell) return;
  flexure.transverse_shear = model.transverse_shear
                                 ? *model.transverse_shear
                                 : needed(card.bending.transverse_shear, card, "bending.transverse_shear",
                                          "model.transverse_shear (N/mm)", missing);
  const auto is_free = [](const BendingLaw& law) {
    return law.empty() || !(law.face().tangent(0.0) > 0.0) || !(law.back().tangent(0.0) > 0.0);
  };
  if (missing.empty() && (is_free(flexure.shell[0]) || is_free(flexure.shell[1])))
    missing.emplace_back(
        "model.cell = \"shell\": the cells have no bending stiffness of their own, so their rotations would be free; "
        "set model.cell_bending = [warp, weft, twist] (N mm) above 0, or use cell = \"rotation-free\"");
}

void choose_friction(const Card& card, const ModelSpec& model, Flexure& flexure) {
  const bool beams = model.yarn == YarnElement::beam;
  for (int f = 0; f < 2; ++f) {
    BendingFriction friction = card.yarn[f].bending_friction;
    if (model.bending_friction) friction = {(*model.bending_friction)[0], (*model.bending_friction)[1]};
    if (!(friction.moment > 0.0)) continue;
    if (beams) flexure.friction_in_plane[f] = friction;
    if (beams || flexure.rotation_free) flexure.friction_out_of_plane[f] = friction;
    if (!beams && flexure.has_shell) flexure.friction_shell[f] = friction;
    flexure.bends_yarns |= beams || flexure.rotation_free;
  }
}

bool any_friction(const std::array<BendingFriction, 2>& friction) {
  return friction[0].moment > 0.0 || friction[1].moment > 0.0;
}

}  // namespace

Flexure choose_flexure(const Card& card, const Scene& scene) {
  const ModelSpec& model = scene.model;
  Flexure flexure;
  Missing missing;
  flexure.rotation_free = model.cell == CellElement::rotation_free;
  flexure.has_shell = model.cell == CellElement::shell;
  if (model.yarn == YarnElement::beam) choose_beams(card, scene, flexure, missing);
  if (flexure.rotation_free || flexure.has_shell) choose_cells(card, scene, flexure, missing);
  if (!missing.empty()) throw InputError(missing);
  choose_friction(card, model, flexure);
  for (int f = 0; f < 2; ++f)
    flexure.bends_yarns |= !flexure.in_plane[f].pieces().empty() || !flexure.out_of_plane[f].empty();
  return flexure;
}

bool has_friction(const Flexure& flexure) {
  return any_friction(flexure.friction_in_plane) || any_friction(flexure.friction_out_of_plane) ||
         any_friction(flexure.friction_shell);
}

void refuse_friction_in_impulses(const Flexure& flexure, int every) {
  if (every <= 1 || !(any_friction(flexure.friction_in_plane) || any_friction(flexure.friction_out_of_plane))) return;
  throw InputError(
      fmt::format("analysis.bending_every = {}: impulses keep the energy of elastic bending, not the work of friction "
                  "(bending_friction); set analysis.bending_every = 1, or model.bending_friction = [0, 1] for none",
                  every));
}

}  // namespace weaveform
