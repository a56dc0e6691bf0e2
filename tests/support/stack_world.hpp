// Stacks of plies that touch each other, in one world, run with the balance watched.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "tests/support/small_world.hpp"

namespace weaveform::test {

// One ply for each scene, from bottom to top, in the world of the first: its analysis, output and tools.
class StackWorld {
public:
  StackWorld(const std::vector<Scene>& scenes, PairLaw law, int threads = 1, const SmallWorld::Shape& shape = nullptr)
      : small_(
            scenes, std::numeric_limits<double>::infinity(), threads, [law = std::move(law)](int, int) { return law; },
            shape) {}

  World* operator->() { return &world_; }
  World& operator*() { return world_; }
  const Mesh& mesh(std::size_t k) const { return small_.mesh(k); }

  // Goes on to this part of the duration; `each` after every step.
  void run_to(double part, const std::function<void()>& each = nullptr) {
    if (world_.steps() == 0 && !started_) world_.start();
    started_ = true;
    while (world_.time() < part * world_.duration() && !world_.finished()) {
      make_step();
      if (each) each();
    }
  }
  void make_step() {
    if (world_.steps() % 500 == 0 && world_.steps() > 0) world_.renew_step();
    const bool looks = world_.steps() % 1000 == 0 && world_.steps() > 0;
    if (looks) world_.look_at_stored_energy();
    world_.advance(false);
    if (world_.passed_reach()) world_.renew_step();
    if (looks) {
      world_.note_greatest_energy();
      error_ = std::max(error_, world_.balance().error());
    }
    world_.compute_forces();
    if (world_.passes_reach()) world_.renew_step();
  }
  // The greatest error of the energy balance so far.
  double energy_error() const { return error_; }
  // Mean force of a ply's grip, from now to a part of the duration.
  double mean_force(std::size_t k, std::size_t grip, double part) {
    double sum = 0.0;
    int count = 0;
    run_to(part, [&] {
      sum += world_.ply(k).holds().whole_forces()[grip];
      ++count;
    });
    return sum / count;
  }

private:
  SmallWorld small_;
  World& world_ = *small_;
  bool started_ = false;
  double error_ = 0.0;
};

}  // namespace weaveform::test
