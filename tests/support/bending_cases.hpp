// Closed forms of bending, each with its mesh at a chosen fineness, solved to equilibrium: one place for the tests that
// require the orders and for the program that draws the charts (bench/element_study.cpp).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fabric/law/bending_law.hpp"
#include "mesher/mesh/mesh.hpp"

namespace weaveform::test {

// A single yarn (a chain of beams), or a strip of fabric of a kind of element.
enum class Bender { yarn, beam, rotation_free, shell };
[[nodiscard]] std::string name_of(Bender bender);

struct Measured {
  double error = 0.0;     // 1; |measured - exact| over the size of the exact answer
  double residual = 0.0;  // N or N mm; greatest force out of balance
  double measured = 0.0, exact = 0.0;
};

// `cells` along the length; a strip is half as wide as long and has half as many across.
struct BendingCase {
  std::string name;
  std::vector<Bender> benders;
  Measured (*run)(Bender, int cells);
};

// The rows of the table in docs/elements.md.
[[nodiscard]] const std::vector<BendingCase>& bending_cases();

Measured sag(Bender bender, int cells);                  // w L^4/8B (+ w L^2/2G); drop of the tip
Measured heavy_elastica(Bender bender, int cells);       // w L^3/B = 20; place of the tip over L
Measured peirce_overhang(Bender bender, int cells);      // angle of the chord at the load that makes it 41.5 deg
Measured end_loaded_elastica(Bender bender, int cells);  // P L^2/B = 12, the tip turns by more than 80 deg; over L
Measured euler_pinned(Bender bender, int cells);         // pi^2 B/L^2
Measured euler_clamped(Bender bender, int cells);        // pi^2 B/4L^2
Measured full_circle(Bender bender, int cells);          // M = 2 pi B/L; gap over L
Measured short_thick_strip(Bender bender, int cells);    // P L^3/3D + P L/G
Measured plate_twist(Bender bender, int cells);          // P a b/4 D_66 (+ 2 P a/(G h)); a square plate
Measured plate_twist_sheared(Bender bender, int cells);  // the same with the card's G, against P a b/4 D_66
Measured yielding_strip(Bender bender, int cells);       // heavy, with a law that yields; place of the tip over L

// The heavy strip with a length that is no whole number of cells: `cells` and 0.4 of one more.
Measured cut_strip(Bender bender, int cells);

// A strip of any law (per width), overhang (mm) and weight (N/mm^2), four cells wide, whose upper side is bent outwards: drop
// of its tip against the rod whose curvature of a moment per width is `curvature`. The law's face is the upper side.
Measured strip_of_law(Bender bender, int cells, const BendingLaw& law, const std::function<double(double)>& curvature,
                      double overhang, double weight);

// w L^3/B at which a heavy rod's chord is inclined by 41.5 deg, found by bisection.
[[nodiscard]] double peirce_load();

}  // namespace weaveform::test
