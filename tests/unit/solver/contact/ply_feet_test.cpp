// Where the feet of a ply's nodes on another are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "solver/contact/ply_pass.hpp"
#include "tests/support/stack.hpp"

namespace weaveform {
namespace {

using test::piece;
using test::piece_without_a_corner;
using test::Stack;

// Where it is turned, the outline cuts cells.
TEST(PlySurface, TheNearestFacetIsThatOfAllThereAre) {
  std::mt19937 generator(3);
  for (const double angle : {0.0, 30.0}) {
    Stack stack({piece_without_a_corner(angle)});
    const PlyFace face(stack.ply(0), "ply");
    const PlySurface& surface = face.surface();
    const int stride = stack.ply(0).packed().stride, rows = stack.ply(0).packed().rows;
    std::uniform_real_distribution<double> u(-3.0, stride + 3.0), v(-3.0, rows + 3.0);
    int beside = 0;
    for (int k = 0; k < 4000; ++k) {
      const Vec2 material = {u(generator), v(generator)};
      double least = std::numeric_limits<double>::infinity();
      for (int facet = 0; facet < surface.facets(); ++facet)
        if (surface.exists(facet)) least = std::min(least, surface.away(surface.on_facet(facet, material)));
      const SurfacePlace near = surface.near(material);
      if (least < 2.0) {
        ASSERT_GE(near.facet, 0) << least;
        EXPECT_NEAR(surface.away(near), least, 1e-9);
        if (least > 0.01) ++beside;
      }
    }
    EXPECT_GT(beside, 100);
  }
}

// One ply turned, wavy and larger, drawn over the other and past its edges, by ways that a pair asleep may make between
// two looks.
TEST(PlyFeet, ThoseOfAPairAsleepAreFoundAgainWhereASearchFromNothingFindsThem) {
  Stack stack({piece_without_a_corner(30.0), piece({90.0, 90.0}, 1.0, 45.0, 3.0)});
  PlyFace lower(stack.ply(0), "lower"), upper(stack.ply(1), "upper");
  const double t = stack.thickness(0);
  PlyPassLaw law;
  law.reach = t;
  law.softening = 0.1 * t;
  PlyPassState asleep(upper, lower, law, 1e5, false);
  int on = 0, off = 0, come_back = 0;
  std::vector<double> before;
  for (int step = 0; step <= 400; ++step) {
    const double turn = 0.05 * step, way[2] = {40.0 * std::sin(turn), 30.0 * std::sin(1.7 * turn)};
    stack.place(1, [&](const Vec3& x) -> Vec3 {
      return {x[0] + way[0], x[1] + way[1], x[2] + 0.5 * std::sin(0.1 * x[0] + turn) * std::cos(0.08 * x[1])};
    });
    std::vector<double> again, anew;
    const double gap = asleep.search(&again);
    asleep.forget();
    PlyPassState fresh(upper, lower, law, 1e5, false);
    const double gap_anew = fresh.search(&anew);
    ASSERT_EQ(again.size(), anew.size());
    for (std::size_t n = 0; n < anew.size(); ++n) {
      const bool is_on = anew[n] > no_depth;
      EXPECT_EQ(again[n] > no_depth, is_on) << "step " << step << ", node " << n;
      if (is_on) {
        EXPECT_NEAR(again[n], anew[n], 1e-9);
      }
      ++(is_on ? on : off);
      if (is_on && !before.empty() && before[n] == no_depth) ++come_back;
    }
    EXPECT_NEAR(gap, gap_anew, 1e-9) << step;
    before = anew;
  }
  EXPECT_GT(on, 10000);
  EXPECT_GT(off, 10000);
  EXPECT_GT(come_back, 1000);
}

}  // namespace
}  // namespace weaveform
