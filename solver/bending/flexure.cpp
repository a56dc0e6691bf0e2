#include "solver/bending/flexure.hpp"

#include <algorithm>
#include <limits>

#include "mesher/base/error.hpp"

namespace weaveform {
namespace {

TangentLaw constant_law(double stiffness) {
  if (stiffness <= 0.0) return {};
  return TangentLaw({{0.0, std::numeric_limits<double>::infinity(), {stiffness}}});
}

TangentLaw sum_of_laws(const TangentLaw& law, double constant) {
  if (law.pieces().empty()) return constant_law(constant);
  auto pieces = law.pieces();
  for (auto& piece : pieces) piece.coefficient[0] += constant;
  return TangentLaw(std::move(pieces));
}

void choose_beams(const Card& card, const ModelSpec& model, Flexure& flexure) {
  for (int f = 0; f < 2; ++f) {
    if (model.yarn_bending) {
      flexure.in_plane[f] = constant_law((*model.yarn_bending)[0]);
      flexure.out_of_plane[f] = constant_law((*model.yarn_bending)[1]);
      continue;
    }
    if (card.yarn[f].bending_out_of_plane.pieces().empty())
      throw InputError("model.yarn = \"beam\": card '" + card.name +
                       "' gives no bending_out_of_plane for its yarns; add it to the card, or set "
                       "model.yarn_bending = [in plane, out of plane] (N mm^2)");
    flexure.in_plane[f] = card.yarn[f].bending_in_plane;
    flexure.out_of_plane[f] = card.yarn[f].bending_out_of_plane;
  }
}

// N mm^2; what a cell adds per yarn, as a constant, or the yarn's own law where nothing else is known.
TangentLaw cell_law(const Card& card, const ModelSpec& model, int f) {
  const YarnCard& yarn = card.yarn[f];
  const bool beams = model.yarn == "beam";
  if (model.cell_bending) return constant_law((*model.cell_bending)[f] * yarn.interval);
  if (card.bending.rigidity) {
    const double borne = !beams               ? 0.0
                         : model.yarn_bending ? (*model.yarn_bending)[1]
                                              : yarn.bending_out_of_plane.tangent(0.0);
    return constant_law((*card.bending.rigidity)[f] * yarn.interval - borne);
  }
  if (beams) return {};
  if (!yarn.bending_out_of_plane.pieces().empty()) return yarn.bending_out_of_plane;
  throw InputError("model.cell = \"" + model.cell + "\": card '" + card.name +
                   "' gives neither bending.rigidity nor bending_out_of_plane; add one to the card, or set "
                   "model.cell_bending = [warp, weft, twist] (N mm)");
}

double needed(const std::optional<double>& value, const Card& card, const char* what, const char* key) {
  if (value) return *value;
  throw InputError(std::string("card '") + card.name + "' gives no " + what + "; add it to the card, or set " + key);
}

}  // namespace

Flexure choose_flexure(const Card& card, const ModelSpec& model) {
  Flexure flexure;
  if (model.yarn == "beam") choose_beams(card, model, flexure);
  flexure.rotation_free = model.cell == "rotation-free";
  flexure.has_shell = model.cell == "shell";
  if (flexure.rotation_free || flexure.has_shell) {
    flexure.twist = model.cell_bending ? (*model.cell_bending)[2]
                                       : needed(card.bending.twist, card, "bending.twist", "model.cell_bending (N mm)");
    for (int f = 0; f < 2; ++f) {
      const TangentLaw law = cell_law(card, model, f);
      if (flexure.has_shell) {
        flexure.shell[f] = law;
      } else if (!law.pieces().empty()) {
        // one of the two is constant: beams beside cells leave cells a constant
        const bool own_law = flexure.out_of_plane[f].pieces().empty();
        flexure.out_of_plane[f] = own_law ? law : sum_of_laws(flexure.out_of_plane[f], law.tangent(0.0));
      }
    }
  }
  if (flexure.has_shell) {
    flexure.transverse_shear =
        model.transverse_shear
            ? *model.transverse_shear
            : needed(card.bending.transverse_shear, card, "bending.transverse_shear", "model.transverse_shear (N/mm)");
    for (int f = 0; f < 2; ++f)
      if (flexure.shell[f].pieces().empty() || !(flexure.shell[f].tangent(0.0) > 0.0))
        throw InputError(
            "model.cell = \"shell\": the cells have no bending stiffness of their own, so their rotations would be "
            "free; set model.cell_bending = [warp, weft, twist] (N mm) above 0, or use cell = \"rotation-free\"");
  }
  for (int f = 0; f < 2; ++f)
    flexure.bends_yarns |= !flexure.in_plane[f].pieces().empty() || !flexure.out_of_plane[f].pieces().empty();
  return flexure;
}

}  // namespace weaveform
