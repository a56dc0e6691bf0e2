#include "mesher/automatic/elements.hpp"

#include <algorithm>

#include "mesher/scene/grip_direction.hpp"

namespace weaveform {
namespace {

bool bends_out_of_plane(const Card& card) {
  return !card.yarn[0].bending_out_of_plane.empty() && !card.yarn[1].bending_out_of_plane.empty();
}

// What rotation-free cells need of a card (solver/bending/flexure.hpp).
bool card_bends_cells(const Card& card) {
  return card.bending.twist && (card.bending.rigidity || bends_out_of_plane(card));
}

bool card_bends_yarns_in_plane(const Card& card) {
  return !card.yarn[0].bending_in_plane.pieces().empty() && !card.yarn[1].bending_in_plane.pieces().empty() &&
         bends_out_of_plane(card);
}

TakenElement set_cell(Scene& scene, CellElement cell, const std::string& why, const std::string& missed = "") {
  scene.model.cell = cell;
  scene.model.cell_open = false;
  return {why, missed};
}

TakenElement set_yarn(Scene& scene, YarnElement yarn, const std::string& why) {
  scene.model.yarn = yarn;
  scene.model.yarn_open = false;
  return {why, ""};
}

}  // namespace

bool is_flat(const Scene& scene) {
  const bool lifted = std::any_of(scene.grip.begin(), scene.grip.end(), [](const GripSpec& grip) {
    return grip.travel != 0.0 && grip_direction(grip)[2] != 0.0;
  });
  return scene.tools.empty() && scene.analysis.gravity[2] == 0.0 && !lifted;
}

TakenElement take_cell(Scene& scene, const Card& card) {
  const ModelSpec& model = scene.model;
  if (model.transverse_shear)
    return set_cell(scene, CellElement::shell, "model.transverse_shear asks for cells that have it");
  if (model.cell_bending)
    return set_cell(scene, CellElement::rotation_free, "model.cell_bending asks for cells that bend");
  if (model.bending_friction && model.yarn != YarnElement::beam)
    return set_cell(scene, CellElement::rotation_free, "model.bending_friction asks for cells that bend");
  if (is_flat(scene)) return set_cell(scene, CellElement::membrane, "nothing moves the fabric out of its plane");
  const std::string what = scene.tools.empty() ? "fabric that leaves its plane without a tool is borne by its bending"
                                               : "between tools fabric is pressed without support, where without "
                                                 "bending its wrinkles are as short as cells";
  if (card_bends_cells(card)) return set_cell(scene, CellElement::rotation_free, what);
  return set_cell(scene, CellElement::membrane, "card '" + card.name + "' has no bending stiffness",
                  what + ", and card '" + card.name +
                      "' has no bending.twist, or neither bending.rigidity nor bending_out_of_plane; add them to the "
                      "card, or set model.cell_bending");
}

TakenElement take_yarn(Scene& scene, const Card& card) {
  const ModelSpec& model = scene.model;
  if (model.partner != SeatbeltPartner::none)
    return set_yarn(scene, YarnElement::seatbelt, "model.partner asks for seatbelts");
  if (model.yarn_bending) return set_yarn(scene, YarnElement::beam, "model.yarn_bending asks for yarns that bend");
  if (!is_flat(scene) && !is_stretched(scene))
    return set_yarn(scene, YarnElement::truss, "beams change nothing where tools or weight bend cells");
  if (scene.frame) return set_yarn(scene, YarnElement::truss, "a shear frame shears its fabric alike everywhere");
  if (scene.grip.empty()) return set_yarn(scene, YarnElement::truss, "nothing pulls the fabric");
  if (hardly_stretches(model))
    return set_yarn(scene, YarnElement::truss, "yarns that hardly stretch let zones end in a jump on any mesh");
  if (card_bends_yarns_in_plane(card))
    return set_yarn(scene, YarnElement::beam,
                    "zones of pulled fabric end in layers that bending in the plane makes wider than a coarse cell");
  return set_yarn(scene, YarnElement::truss, "card '" + card.name + "' has no bending of its yarns");
}

}  // namespace weaveform
