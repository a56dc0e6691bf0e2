#include "solver/lattice/law_shapes.hpp"

#include "core/error.hpp"

namespace weaveform {

YarnLawShape shape_yarn_law(const TangentLaw& law, const std::string& what) {
  YarnLawShape shape;
  shape.is_paper = pack_law(law, shape.paper);
  if (!shape.is_paper && !pack_law(law, shape.general))
    throw InputError("material: the tension and compression laws of the " + what +
                     " yarns have more than 8 pieces together (an end of a last piece counts as one more) or a tangent "
                     "above degree 5; simplify them");
  return shape;
}

ShearLawShape shape_shear_law(const ShearCard& card) {
  ShearLawShape shape;
  if (pack_law(card.tangent, shape.paper.law)) {
    shape.shape = card.start.plateau == 0.0 ? ShearShape::paper : ShearShape::started;
    shape.started.law = shape.paper.law;
  } else if (!pack_law(card.tangent, shape.general.law)) {
    throw InputError("material: the shear law has more than 6 pieces or a tangent above degree 5; simplify it");
  }
  shape.started.plateau = shape.general.plateau = card.start.plateau;
  shape.started.rise = shape.general.rise = card.start.plateau != 0.0 ? card.start.rise : 1.0;
  return shape;
}

}  // namespace weaveform
