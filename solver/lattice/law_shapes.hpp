// A card's laws in the shapes that the inner loop is compiled for: the paper's where they have it, which takes half the
// time, a general one otherwise.
#pragma once

#include <string>

#include "fabric/card/card.hpp"
#include "solver/lattice/element_loops.hpp"

namespace weaveform {

struct YarnLawShape {
  PaperLaw paper;
  GeneralLaw general;
  bool is_paper = false;
  [[nodiscard]] const void* pointer() const { return is_paper ? static_cast<const void*>(&paper) : &general; }
};

// `what`: "warp" or "weft". Throws InputError when the law has more pieces or a higher degree than any shape.
[[nodiscard]] YarnLawShape shape_yarn_law(const TangentLaw& law, const std::string& what);

struct ShearLawShape {
  PaperShear paper;
  StartedShear started;
  GeneralShear general;
  ShearShape shape = ShearShape::general;

  [[nodiscard]] const void* pointer() const {
    if (shape == ShearShape::general) return &general;
    return shape == ShearShape::started ? static_cast<const void*>(&started) : &paper;
  }
  // Cells with a history have no loop for a law without a start.
  [[nodiscard]] const void* with_history() const {
    return shape == ShearShape::general ? static_cast<const void*>(&general) : &started;
  }
};

// Throws likewise.
[[nodiscard]] ShearLawShape shape_shear_law(const ShearCard& card);

}  // namespace weaveform
