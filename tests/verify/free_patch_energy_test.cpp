// No zero-energy mode grows: a free patch, crumpled and thrown about, keeps its energy for 100,000 steps, whatever it
// is made of.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "solver/ply/ply.hpp"
#include "tests/support/chosen.hpp"
#include "tests/support/fabric_patch.hpp"

namespace weaveform {
namespace {

using test::FabricPatch;

// A ply alone in the time loop, without grips and damping.
class FreePatch {
public:
  FreePatch(const std::string& yarn, const std::string& cell, double step_factor, double viscosity)
      : scene_(with_elements(yarn, cell)),
        card_(load_card(scene_.fabric.material)),
        mesh_(build_mesh(scene_, card_)),
        ply_({.whole = mesh_, .scene = scene_, .card = card_, .team = alone()}) {
    throw_about();
    const double stable = ply_.renew_stable_step().step;
    step_ = step_factor * stable * (std::sqrt(1.0 + viscosity * viscosity) - viscosity);
    ply_.set_step(viscosity * stable, step_);
  }

  struct Energies {
    double kinetic = 0.0, stored = 0.0, lost = 0.0;
    [[nodiscard]] double total() const { return kinetic + stored + lost; }
  };

  // Takes steps; the mean energies at every `every`-th.
  Energies mean_over(int steps, int every) {
    Energies mean;
    int count = 0;
    for (int n = 0; n < steps; ++n) {
      ply_.compute_forces(step_);
      const bool look = n % every == 0;
      const double stored = look ? ply_.stored_energy().total : 0.0;
      ply_.advance(step_before_, step_, false);
      step_before_ = step_;
      if (!look) continue;
      ++count;
      const EnergyFlow flow = ply_.energy_flow();
      mean.kinetic += flow.kinetic;
      mean.stored += stored;
      mean.lost += flow.lost;
    }
    for (double* value : {&mean.kinetic, &mean.stored, &mean.lost}) *value /= count;
    return mean;
  }

private:
  static Scene with_elements(const std::string& yarn, const std::string& cell) {
    Scene scene = FabricPatch::make_scene("twintex-pw", 30.0, {40.0, 45.0}, Formulation::energy,
                                          Thickness::constant_volume, Section::incompressible);
    scene.analysis.step_bound = StepBound::stiffest;  // the step is set once, before strains are known
    scene.model.yarn = test::chosen(yarn);
    scene.model.cell = test::chosen(cell);
    return scene;
  }

  // Ripples of a tenth of a cell out of the plane, and speeds of the order that a forming makes.
  void throw_about() {
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> ripple(-0.5, 0.5), speed(-300.0, 300.0);
    for (const int n : ply_.packed().packed_of_mesh)
      for (int c = 0; c < 3; ++c) {
        ply_.state().position[c][n] += (c == 2 ? 1.0 : 0.02) * ripple(generator);
        ply_.state().velocity[c][n] = speed(generator);
      }
    ply_.follow();
  }

  Scene scene_;
  Card card_;
  Mesh mesh_;
  Ply ply_;
  double step_ = 0.0, step_before_ = 0.0;  // s
};

class EveryCombination : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

// Half the stable step, no viscosity: leapfrog is symplectic, but where a yarn goes slack or taut its stiffness jumps,
// and each jump leaves a little energy of either sign. The drift is stated on the console; docs/elements.md has it.
TEST_P(EveryCombination, AFreeCrumpledPatchKeepsItsEnergyFor100000Steps) {
  const auto [yarn, cell] = GetParam();
  FreePatch patch(yarn, cell, 0.5, 0.0);
  const auto start = patch.mean_over(2000, 10);
  patch.mean_over(96000, 96000);
  const auto end = patch.mean_over(2000, 10);
  const double drift = end.total() / start.total() - 1.0;
  std::printf("%s + %s: %.4g mJ (kinetic %.3g, stored %.3g), drift %.2e\n", yarn.c_str(), cell.c_str(), start.total(),
              start.kinetic, start.stored, drift);
  EXPECT_GT(start.stored, 0.2 * start.kinetic);  // it does move and deform
  // measured: at most 0.5 %; a mode that grows by 1e-4 a step would be at exp(10)
  EXPECT_LT(std::abs(drift), 0.01);
}

// The program's own step factor and viscosity: what the viscosity takes is counted, and nothing is made.
TEST_P(EveryCombination, TheDefaultStepAndViscosityKeepTheBalance) {
  const auto [yarn, cell] = GetParam();
  const AnalysisSpec defaults;
  FreePatch patch(yarn, cell, defaults.step_factor, defaults.yarn_viscosity);
  const auto start = patch.mean_over(2000, 10);
  patch.mean_over(16000, 16000);
  const auto end = patch.mean_over(2000, 10);
  const double drift = end.total() / start.total() - 1.0;
  std::printf("%s + %s: lost %.3g of %.4g mJ, balance %.2e\n", yarn.c_str(), cell.c_str(), end.lost, start.total(),
              drift);
  EXPECT_LT(end.kinetic + end.stored, start.kinetic + start.stored);
  EXPECT_LT(std::abs(drift), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Elements, EveryCombination,
                         testing::Combine(testing::Values("truss", "beam", "seatbelt"),
                                          testing::Values("membrane", "rotation-free", "shell")));

}  // namespace
}  // namespace weaveform
