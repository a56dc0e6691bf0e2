#include "bench/step_costs.hpp"

#include "fabric/card/card.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/element/shear_cell.hpp"
#include "solver/element/yarn.hpp"
#include "solver/element/yarn_law.hpp"
#include "solver/lattice/law_shapes.hpp"

namespace weaveform {
namespace {

// As yarn_pass() of solver/lattice/element_loops.cpp, near the length at rest.
void make_yarn(const PaperLaw& law) {
  const double rest = 4.92;
  Counted way[3], change[3];
  for (int c = 0; c < 3; ++c) {
    way[c] = Counted(1.0) - Counted(0.3 * c);
    change[c] = Counted(0.1) - Counted(0.2);
  }
  const Counted rate = way[0] * change[0] + way[1] * change[1] + way[2] * change[2];
  const Counted square = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
  const Counted area = 1.25;
  Counted inverse;
  const Counted elastic = yarn_force_per_length<Section::incompressible, true>(law, square, square - rest * rest,
                                                                               Counted(rest), area, inverse);
  const Counted viscous = viscous_force_per_length<Counted>(inverse, rate, area, 1.0);
  const Counted coming = square + 2.0 * rate;
  [[maybe_unused]] const Counted power = viscous * rate + 0.0;
  [[maybe_unused]] const Counted least = lesser(square, coming), greatest = greater(square, coming);
  for (const Counted& along : way) [[maybe_unused]] const Counted force = (elastic + viscous) * along;
}

// As cell_pass() there.
void make_cell(const PaperShear& law) {
  Counted warp[3], weft[3], square;
  for (int c = 0; c < 3; ++c) {
    const Counted d = Counted(1.0) - Counted(0.2 * c), e = Counted(0.5) - Counted(0.1 * c);
    warp[c] = d + e;
    weft[c] = d - e;
  }
  const auto force = shear_cell_force<Formulation::energy, Thickness::constant_volume, PaperShear, Counted>(
      law, warp, weft, Counted(24.0) * 0.4, square);
  for (int c = 0; c < 3; ++c) {
    [[maybe_unused]] const Counted p = force.warp[c] + force.weft[c], q = force.warp[c] - force.weft[c];
  }
}

// As assembled() and move_nodes() of solver/lattice/node_loops.cpp.
void make_node() {
  Operations& done = Counted::done();
  done.sums += 3 * 7;              // assembling eight element forces
  done.products += 1 + 3 * 5 + 1;  // impulse; keep, impulse, middle, drift, square; mass
  done.sums += 3 * 4 + 1;          // velocity, middle, position, square; the sum
}

}  // namespace

Operations operations_of_a_cell_step() {
  const Card card = load_card("twintex-pw");
  const YarnLawShape yarn = shape_yarn_law(yarn_laws(card, ModelSpec{})[0], "warp");
  const ShearLawShape shear = shape_shear_law(card.shear);
  Counted::done() = {};
  for (int family = 0; family < 2; ++family) make_yarn(yarn.paper);
  make_cell(shear.paper);
  make_node();
  return Counted::done();
}

}  // namespace weaveform
