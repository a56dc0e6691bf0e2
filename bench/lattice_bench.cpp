// Rates of the explicit step on flat, sheared and rippled lattices, in cell-steps per second on one core (a cell-step:
// one cell, its two yarns, one node, one step, double precision), and where the time goes: rows of yarns and cells, or
// moving the nodes. `elements/...` compares every choice of model.yarn and model.cell on one mesh: time per step and
// stable step, both also relative to truss + membrane (docs/elements.md).
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>

#include "fabric/card/card.hpp"
#include "mesher/lattice/build.hpp"
#include "solver/bending/lattice_bending.hpp"
#include "solver/bending/shell.hpp"
#include "solver/lattice/forces.hpp"
#include "solver/ply/critical_step.hpp"
#include "solver/ply/motion.hpp"
#include "solver/result/fields.hpp"

namespace {

using namespace weaveform;

struct Lattice {
  Scene scene;
  Card card = load_card("twintex-pw");
  Mesh mesh;
  PackedMesh packed;
  State state;

  Lattice(int cells, Formulation formulation, double yarn_angle) {
    const double side = cells * card.yarn[0].interval;
    scene.blank.size = {side, side};
    scene.blank.yarn_angle = yarn_angle;
    scene.blank.fit = LineFit::none;
    scene.model.formulation = formulation;
    mesh = build_mesh(scene, card);
    packed = pack_mesh(mesh);
    state = initial_state(packed, mesh);
    // yarns in tension and in compression, cells sheared both ways, so that no branch could be cheap by luck
    for (const int n : packed.packed_of_mesh) {
      state.position[0][n] += 0.6 * std::sin(0.05 * state.position[1][n]);
      state.position[1][n] += 0.6 * std::sin(0.04 * state.position[0][n]);
      state.position[2][n] += 0.3 * std::sin(0.03 * (state.position[0][n] + state.position[1][n]));
    }
  }
};

enum Part { whole_step, forces_only, motion_only };

void run(benchmark::State& bench, Formulation formulation, double yarn_angle, Part part) {
  Lattice lattice(static_cast<int>(bench.range(0)), formulation, yarn_angle);
  FabricForces forces(lattice.packed, lattice.card, yarn_laws(lattice.card, lattice.scene.model), lattice.scene.model,
                      lattice.state, alone());
  Motion motion(lattice.packed, 1.0, alone());
  std::vector<Grip> no_grips;
  const std::vector<double> none;
  constexpr double step = 1e-7;  // s; well below the stable step
  forces.compute(lattice.state);
  for ([[maybe_unused]] auto _ : bench) {
    if (part != motion_only) forces.compute(lattice.state);
    if (part != forces_only) motion.advance(lattice.state, no_grips, none, none, step, step);
  }
  bench.counters["cell-steps/s"] =
      benchmark::Counter(static_cast<double>(lattice.mesh.cells.size()), benchmark::Counter::kIsIterationInvariantRate);
  bench.counters["cells"] = lattice.mesh.cells.size();
  bench.counters["loose cells"] = lattice.packed.loose_cells.size();
}

// One whole step with everything that the scene's model adds, on the crumpled lattice.
void elements(benchmark::State& bench, YarnElement yarn, CellElement cell) {
  Lattice lattice(static_cast<int>(bench.range(0)), Formulation::energy, 0.0);
  auto& model = lattice.scene.model;
  model.yarn = yarn;
  model.cell = cell;
  const auto laws = yarn_laws(lattice.card, model);
  const std::vector<char> free(lattice.mesh.node_count(), 0);
  const CriticalStep critical(lattice.mesh, lattice.card, laws, model, free);
  const auto position = mesh_positions(lattice.packed, lattice.state);
  const auto stiffest = critical.stiffest(every_strain);
  const double fabric_step = critical(position, stiffest).step;
  FabricForces forces(lattice.packed, lattice.card, laws, model, lattice.state, alone());
  const Flexure flexure = choose_flexure(lattice.card, model);
  std::vector<std::unique_ptr<ForceTerm>> terms;
  if (flexure.bends_yarns || flexure.rotation_free)
    terms.push_back(
        std::make_unique<LatticeBending>(lattice.mesh, lattice.packed, flexure, free, lattice.state, alone()));
  if (flexure.has_shell)
    terms.push_back(std::make_unique<Shell>(lattice.mesh, lattice.packed, lattice.card, flexure, free, lattice.state,
                                            Shell::Setup{fabric_step, 1.0, alone()}));
  std::vector<double> further(lattice.mesh.node_count(), 0.0);
  for (const auto& term : terms) term->add_stiffness_bound(position, 0.0, further);
  Motion motion(lattice.packed, 1.0, alone());
  std::vector<Grip> no_grips;
  const std::vector<double> none;
  constexpr double step = 1e-7;  // s; well below the stable step
  for ([[maybe_unused]] auto _ : bench) {
    forces.compute(lattice.state);
    for (const auto& term : terms) term->add_forces(lattice.state, step);
    motion.advance(lattice.state, no_grips, none, none, step, step);
  }
  bench.counters["cell-steps/s"] =
      benchmark::Counter(static_cast<double>(lattice.mesh.cells.size()), benchmark::Counter::kIsIterationInvariantRate);
  bench.counters["stable step us"] = 1e6 * critical(position, stiffest, further).step;
}

}  // namespace

BENCHMARK_CAPTURE(run, step, Formulation::energy, 0.0, whole_step)
    ->Arg(100)
    ->Arg(400)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, forces, Formulation::energy, 0.0, forces_only)
    ->Arg(100)
    ->Arg(400)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, motion, Formulation::energy, 0.0, motion_only)
    ->Arg(100)
    ->Arg(400)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, contravariant_step, Formulation::contravariant, 0.0, whole_step)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, incremental_step, Formulation::incremental, 0.0, whole_step)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, cut_at_45_deg_step, Formulation::energy, 45.0, whole_step)
    ->Arg(30)
    ->Arg(100)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond);

BENCHMARK_CAPTURE(elements, truss_membrane, YarnElement::truss, CellElement::membrane)
    ->Arg(50)
    ->Arg(200)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(elements, seatbelt_membrane, YarnElement::seatbelt, CellElement::membrane)
    ->Arg(50)
    ->Arg(200)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(elements, beam_membrane, YarnElement::beam, CellElement::membrane)
    ->Arg(50)
    ->Arg(200)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(elements, truss_rotation_free, YarnElement::truss, CellElement::rotation_free)
    ->Arg(50)
    ->Arg(200)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(elements, beam_rotation_free, YarnElement::beam, CellElement::rotation_free)
    ->Arg(50)
    ->Arg(200)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(elements, truss_shell, YarnElement::truss, CellElement::shell)
    ->Arg(50)
    ->Arg(200)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(elements, beam_shell, YarnElement::beam, CellElement::shell)
    ->Arg(50)
    ->Arg(200)
    ->Unit(benchmark::kMicrosecond);

BENCHMARK_MAIN();
