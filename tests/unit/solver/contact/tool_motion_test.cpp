// A tool pushed by a force: its own motion and energies.
#include "solver/contact/tool_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace weaveform {
namespace {

// On a spring, through the rise of the force and beyond: the push's work is what leapfrog keeps of motion and spring and
// what the guide took, to rounding without a guide, and at any step; with one the half step that is still to come is
// missing, and nothing adds up.
TEST(ToolMotion, WorkOfThePushIsEnergyAndLoss) {
  constexpr double mass = 1e-5, stiffness = 100.0, force = 20.0, duration = 0.1;
  const double omega = std::sqrt(stiffness / mass);
  for (const double damping : {0.0, 500.0}) {
    for (const double turn : {0.1, 0.8}) {
      ToolSpec spec;
      spec.force = force;
      spec.damping = damping;
      ToolMotion tool(spec, duration, mass);
      const double step = turn / omega;
      double greatest = 0.0, worst = 0.0;
      for (int n = 1; n < 2000; ++n) {
        tool.advance(n * step, step, stiffness * tool.displacement());
        const double reaction = stiffness * tool.displacement();
        const double spring = 0.5 * stiffness * tool.displacement() * tool.displacement();
        const double kept = tool.kinetic_energy(n * step, reaction) + spring;
        greatest = std::max({greatest, kept, tool.work()});
        worst = std::max(worst, std::abs(kept + tool.damping_work() - tool.work()));
      }
      const double half_step = 0.5 * damping * step;  // of the kinetic energy, which is a part of the greatest
      EXPECT_LT(worst, (half_step + 1e-11) * greatest) << "damping " << damping << ", turn " << turn;
    }
  }
}

}  // namespace
}  // namespace weaveform
