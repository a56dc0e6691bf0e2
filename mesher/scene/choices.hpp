// The choices of a scene: one enum for each, its names beside it. docs/scene.md says what each of them means.
#pragma once

#include "core/keys/choice.hpp"
#include "core/keys/length_unit.hpp"

namespace weaveform {

// blank.shape
enum class BlankShape { rectangle, disc, cross, polygon, file };
constexpr auto choices_of(BlankShape) {
  return std::to_array<Choice<BlankShape>>({{BlankShape::rectangle, "rectangle"},
                                            {BlankShape::disc, "disc"},
                                            {BlankShape::cross, "cross"},
                                            {BlankShape::polygon, "polygon"},
                                            {BlankShape::file, "file"}});
}

// fabric.face: the side to which the fabric's face looks. up: that of the mesh's normal, from where warp turns
// counter-clockwise to weft, which is the flat blank's upper side (+z).
enum class FabricFace { up, down };
constexpr auto choices_of(FabricFace) {
  return std::to_array<Choice<FabricFace>>({{FabricFace::up, "up"}, {FabricFace::down, "down"}});
}

// blank.fit
enum class LineFit { grips, none };
constexpr auto choices_of(LineFit) {
  return std::to_array<Choice<LineFit>>({{LineFit::grips, "grips"}, {LineFit::none, "none"}});
}

// model.yarn
enum class YarnElement { truss, beam, seatbelt };
constexpr auto choices_of(YarnElement) {
  return std::to_array<Choice<YarnElement>>(
      {{YarnElement::truss, "truss"}, {YarnElement::beam, "beam"}, {YarnElement::seatbelt, "seatbelt"}});
}

// model.partner
enum class SeatbeltPartner { none, compression };
constexpr auto choices_of(SeatbeltPartner) {
  return std::to_array<Choice<SeatbeltPartner>>(
      {{SeatbeltPartner::none, "none"}, {SeatbeltPartner::compression, "compression"}});
}

// model.cell
enum class CellElement { membrane, rotation_free, shell };
constexpr auto choices_of(CellElement) {
  return std::to_array<Choice<CellElement>>({{CellElement::membrane, "membrane"},
                                             {CellElement::rotation_free, "rotation-free"},
                                             {CellElement::shell, "shell"}});
}

// model.formulation
enum class Formulation { energy, contravariant, incremental, side_frame };
constexpr auto choices_of(Formulation) {
  return std::to_array<Choice<Formulation>>({{Formulation::energy, "energy"},
                                             {Formulation::contravariant, "contravariant"},
                                             {Formulation::incremental, "incremental"},
                                             {Formulation::side_frame, "side-frame"}});
}
// Whether a cell's stress is the sum of what steps brought.
constexpr bool has_cell_history(Formulation formulation) {
  return formulation == Formulation::incremental || formulation == Formulation::side_frame;
}

// model.thickness
enum class Thickness { constant_volume, constant };
constexpr auto choices_of(Thickness) {
  return std::to_array<Choice<Thickness>>(
      {{Thickness::constant_volume, "constant-volume"}, {Thickness::constant, "constant"}});
}

// model.contact_thickness: how thick the fabric is where tools and other plies touch it.
enum class ContactThickness { card, sheared };
constexpr auto choices_of(ContactThickness) {
  return std::to_array<Choice<ContactThickness>>(
      {{ContactThickness::card, "card"}, {ContactThickness::sheared, "sheared"}});
}

// model.section
enum class Section { incompressible, constant };
constexpr auto choices_of(Section) {
  return std::to_array<Choice<Section>>({{Section::incompressible, "incompressible"}, {Section::constant, "constant"}});
}

// model.yarn_law
enum class YarnLaw { card, linear, slack };
constexpr auto choices_of(YarnLaw) {
  return std::to_array<Choice<YarnLaw>>(
      {{YarnLaw::card, "card"}, {YarnLaw::linear, "linear"}, {YarnLaw::slack, "slack"}});
}

// model.symmetry: how little of a symmetric blank is solved.
enum class SymmetryUse { automatic, quarter, half, none };
constexpr auto choices_of(SymmetryUse) {
  return std::to_array<Choice<SymmetryUse>>({{SymmetryUse::automatic, "auto"},
                                             {SymmetryUse::quarter, "quarter"},
                                             {SymmetryUse::half, "half"},
                                             {SymmetryUse::none, "none"}});
}

// grip.edge: of the blank.
enum class BlankEdge { bottom, top, left, right };
constexpr auto choices_of(BlankEdge) {
  return std::to_array<Choice<BlankEdge>>(
      {{BlankEdge::bottom, "bottom"}, {BlankEdge::top, "top"}, {BlankEdge::left, "left"}, {BlankEdge::right, "right"}});
}

// grip.free: components in the blank's frame.
enum class Component { x, y, z };
constexpr auto choices_of(Component) {
  return std::to_array<Choice<Component>>({{Component::x, "x"}, {Component::y, "y"}, {Component::z, "z"}});
}

// tools.NAME.shape
enum class ToolShape { plane, sphere, cylinder, ring, revolved, triangles };
constexpr auto choices_of(ToolShape) {
  return std::to_array<Choice<ToolShape>>({{ToolShape::plane, "plane"},
                                           {ToolShape::sphere, "sphere"},
                                           {ToolShape::cylinder, "cylinder"},
                                           {ToolShape::ring, "ring"},
                                           {ToolShape::revolved, "revolved"},
                                           {ToolShape::triangles, "triangles"}});
}

// analysis.step_bound: "reached": the stable step is that of the stiffest tangent that yarns have reached
// (solver/ply/reach.hpp); "stiffest": of their law's stiffest.
// analysis.precision: of what yarns and cells compute.
enum class Precision { double_precision, single_precision };
constexpr auto choices_of(Precision) {
  return std::to_array<Choice<Precision>>(
      {{Precision::double_precision, "double"}, {Precision::single_precision, "single"}});
}

enum class StepBound { stiffest, reached };
constexpr auto choices_of(StepBound) {
  return std::to_array<Choice<StepBound>>({{StepBound::stiffest, "stiffest"}, {StepBound::reached, "reached"}});
}

}  // namespace weaveform
