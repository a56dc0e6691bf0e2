// Rates of the explicit step on flat, sheared and rippled lattices, in cell-steps per second on one core (a cell-step:
// one cell, its two yarns, one node, one step, double precision), and where the time goes: rows of yarns and cells, or
// moving the nodes. `elements/...` compares every choice of model.yarn and model.cell on one mesh: time per step and
// stable step, both also relative to truss + membrane (docs/elements.md).
#include <benchmark/benchmark.h>

#include "bench/rippled_lattice.hpp"

namespace {

using namespace weaveform;

enum Part { whole_step, forces_only, motion_only };
constexpr double step = 1e-7;  // s; well below the stable step

void count(benchmark::State& bench, const RippledLattice& lattice) {
  bench.counters["cell-steps/s"] =
      benchmark::Counter(static_cast<double>(lattice.mesh.cells.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void run(benchmark::State& bench, Formulation formulation, double yarn_angle, Part part) {
  ModelSpec model;
  model.formulation = formulation;
  RippledLattice lattice(static_cast<int>(bench.range(0)), yarn_angle, model, alone());
  lattice.ply->compute_forces(step);
  for ([[maybe_unused]] auto _ : bench) {
    if (part != motion_only) lattice.ply->compute_forces(step);
    if (part != forces_only) lattice.ply->advance(step, step, false);
  }
  count(bench, lattice);
  bench.counters["cells"] = lattice.mesh.cells.size();
  bench.counters["loose cells"] = lattice.ply->packed().loose_cells.size();
}

// One whole step with everything that the scene's model adds, on the crumpled lattice.
void elements(benchmark::State& bench, YarnElement yarn, CellElement cell) {
  ModelSpec model;
  model.yarn = yarn;
  model.cell = cell;
  RippledLattice lattice(static_cast<int>(bench.range(0)), 0.0, model, alone());
  const double stable_step = lattice.ply->renew_stable_step().step;
  for ([[maybe_unused]] auto _ : bench) {
    lattice.ply->compute_forces(step);
    lattice.ply->advance(step, step, false);
  }
  count(bench, lattice);
  bench.counters["stable step us"] = 1e6 * stable_step;
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
