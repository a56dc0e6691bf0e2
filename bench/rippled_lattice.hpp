// A square of the plain weave, rippled so that its yarns are in tension and in compression and its cells sheared both
// ways: no branch could be cheap by luck. What the benchmarks step.
#pragma once

#include <cmath>
#include <memory>

#include "fabric/card/card.hpp"
#include "mesher/lattice/build.hpp"
#include "solver/ply/ply.hpp"

namespace weaveform {

struct RippledLattice {
  Scene scene;
  Card card = load_card("twintex-pw");
  Mesh mesh;
  std::unique_ptr<Ply> ply;

  // `cells` along each side; `yarn_angle` in degrees; `height` of the ripples out of the plane (mm): with none of it a
  // flat ply (Ply::seek_plane).
  RippledLattice(int cells, double yarn_angle, const ModelSpec& model, Team& team,
                 Precision precision = Precision::double_precision, double height = 0.3) {
    const double side = cells * card.yarn[0].interval;
    scene.blank.size = {side, side};
    scene.blank.yarn_angle = yarn_angle;
    scene.blank.fit = LineFit::none;
    scene.model = model;
    scene.analysis.precision = precision;
    scene.analysis.step_bound = StepBound::stiffest;  // the step is set once, before strains are known
    mesh = build_mesh(scene, card);
    ply = std::make_unique<Ply>(PlySetup{.whole = mesh, .scene = scene, .card = card, .damping = 1.0, .team = team});
    State& state = ply->state();
    for (const int n : ply->packed().packed_of_mesh) {
      state.position[0][n] += 0.6 * std::sin(0.05 * state.position[1][n]);
      state.position[1][n] += 0.6 * std::sin(0.04 * state.position[0][n]);
      state.position[2][n] += height * std::sin(0.03 * (state.position[0][n] + state.position[1][n]));
    }
    ply->seek_plane();
  }

  // As the analysis makes it.
  void make_step(double step) const {
    if (ply->moves_in_one_pass()) return ply->compute_forces_and_advance(step, step);
    ply->compute_forces(step);
    ply->advance(step, step, false);
  }
};

}  // namespace weaveform
