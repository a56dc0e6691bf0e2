// Stacks of 1, 2, 4 and 8 plies with contact everywhere: the whole explicit step, in ply-cell-steps per second (one cell
// of one ply, its two yarns, one node, one step), double precision. Plies alternate between 0/90 and another angle, lie
// pressed on each other on a common rippled surface and rub; by Coulomb and springs, or with tables of shear stress over
// slip and of pressure beside. `threads` are those of the team.
#include <benchmark/benchmark.h>

#include <cmath>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "bench/rippled_lattice.hpp"
#include "solver/contact/contact.hpp"
#include "solver/contact/ply_contact.hpp"

namespace {

using namespace weaveform;

constexpr double stack_step = 1e-10;  // s; so short that the plies stay as they are pressed
constexpr double sunk = 0.02;         // mm; of each ply into the next

struct RippledStack {
  Team team;
  std::deque<RippledLattice> lattice;
  std::unique_ptr<PlyContact> contact;
  int cells = 0;

  RippledStack(int plies, int cells_along, double yarn_angle, bool tables, int threads) : team(threads) {
    std::vector<Ply*> all;
    for (int k = 0; k < plies; ++k) {
      lattice.emplace_back(cells_along, k % 2 == 0 ? 0.0 : yarn_angle, ModelSpec{}, team);
      cells += lattice.back().mesh.cells.size();
      all.push_back(lattice.back().ply.get());
    }
    for (int k = 0; k < plies; ++k)
      place(k, k * all[k]->mesh().thickness, 0.0);  // chords of ripples would lie in each other
    if (plies == 1) return;
    PairLaw law;
    law.friction = 0.2;
    if (tables) {
      law.shear_law = {{0.0, 0.002}, {0.5, 0.004}, {2.0, 0.003}};
      law.compaction = {{0.0, 0.0}, {0.05, 0.1}, {0.1, 0.5}};
    }
    contact = std::make_unique<PlyContact>(
        PlyContactSetup{.plies = all,
                        .names = {},
                        .law = [law](int, int) { return law; },
                        .frequency = contact_frequency(AnalysisSpec{}, all.front()->fabric_step()),
                        .team = team});
    for (int k = 0; k < plies; ++k) place(k, k * (all[k]->mesh().thickness - sunk), 0.3);
  }

  // On the common surface z = f(x, y), with ripples of its own in the plane.
  void place(int k, double height, double ripple) {
    State& state = lattice[k].ply->state();
    const auto& mesh = lattice[k].mesh;
    for (int n = 0; n < mesh.node_count(); ++n) {
      const int p = lattice[k].ply->packed().packed_of_mesh[n];
      const auto& x = mesh.nodes.position[n];
      state.position[0][p] = x[0] + 0.6 * std::sin(0.05 * x[1] + k);
      state.position[1][p] = x[1] + 0.6 * std::sin(0.04 * x[0] + k);
      state.position[2][p] = height + ripple * std::sin(0.03 * (x[0] + x[1]));
      state.velocity[0][p] = k % 2 == 0 ? 500.0 : -500.0;
    }
  }

  void make_step() {
    for (auto& one : lattice) one.ply->compute_own_forces(stack_step);
    if (contact) contact->add_forces();
    for (auto& one : lattice) one.ply->give_on_forces();
    for (auto& one : lattice) {
      one.ply->advance(stack_step, stack_step, false);
      one.ply->state().time += stack_step;
      ++one.ply->state().step;
    }
  }
};

void stack(benchmark::State& bench, double yarn_angle, bool tables) {
  RippledStack plies(static_cast<int>(bench.range(0)), static_cast<int>(bench.range(1)), yarn_angle, tables,
                     static_cast<int>(bench.range(2)));
  for (int n = 0; n < 10; ++n) plies.make_step();
  for ([[maybe_unused]] auto _ : bench) plies.make_step();
  bench.counters["ply-cell-steps/s"] = benchmark::Counter(plies.cells, benchmark::Counter::kIsIterationInvariantRate);
  if (!plies.contact) return;
  double touching = 0.0, whole = 0.0;
  for (const auto& pair : plies.contact->pairs())
    if (pair.upper == pair.lower + 1) touching += pair.area;
  for (std::size_t k = 1; k < plies.lattice.size(); ++k)
    whole += std::pow(static_cast<double>(bench.range(1)) * plies.lattice[0].mesh.spacing[0], 2);
  bench.counters["touching"] = touching / whole;
}

void sizes(benchmark::internal::Benchmark* bench) {
  for (const auto& [plies, cells] : {std::pair{1, 100}, {2, 100}, {4, 100}, {8, 100}, {1, 300}, {2, 300}, {4, 300}})
    for (const int threads : {1, 2}) bench->Args({plies, cells, threads});
  bench->ArgNames({"plies", "cells", "threads"})->Unit(benchmark::kMicrosecond)->UseRealTime();
}

void few_sizes(benchmark::internal::Benchmark* bench) {
  for (const int plies : {2, 4, 8}) bench->Args({plies, 100, 1});
  bench->ArgNames({"plies", "cells", "threads"})->Unit(benchmark::kMicrosecond)->UseRealTime();
}

}  // namespace

BENCHMARK_CAPTURE(stack, quasi_isotropic, 45.0, false)->Apply(sizes);
BENCHMARK_CAPTURE(stack, cross_ply, 0.0, false)->Apply(sizes);
BENCHMARK_CAPTURE(stack, cross_ply_tables, 0.0, true)->Apply(few_sizes);
