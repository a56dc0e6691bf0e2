// Stacks of plies that touch each other, in one world, run with the balance watched.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "mesher/lattice/build.hpp"
#include "solver/analysis/world.hpp"

namespace weaveform::test {

// One ply for each scene, from bottom to top, in the world of the first: its analysis, output and tools.
class StackWorld {
public:
  using Shape = std::function<void(std::size_t ply, Mesh& mesh)>;  // the start, where it is not the flat blank
  StackWorld(const std::vector<Scene>& scenes, PairLaw law, int threads = 1, const Shape& shape = nullptr)
      : scenes_(scenes.begin(), scenes.end()), team_(threads), world_(make_setup(std::move(law), shape)) {}

  World* operator->() { return &world_; }
  World& operator*() { return world_; }
  const Mesh& mesh(std::size_t k) const { return meshes_[k]; }

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
  WorldSetup make_setup(PairLaw law, const Shape& shape) {
    WorldSetup setup{.plies = {},
                     .tools = {},
                     .scene = scenes_.front(),
                     .loading = {},
                     .pair_law = [law = std::move(law)](int, int) { return law; },
                     .team = team_};
    for (std::size_t k = 0; k < scenes_.size(); ++k) {
      cards_.push_back(load_card(scenes_[k].fabric.material));
      meshes_.push_back(build_mesh(scenes_[k], cards_.back()));
      if (shape) shape(k, meshes_.back());
      setup.plies.push_back({.whole = meshes_.back(), .card = cards_.back(), .scene = scenes_[k]});
    }
    setup.loading = choose_loading(scenes_.front(), cards_.front(), scenes_.front().blank.size);
    if (!scenes_.front().tools.empty()) setup.tools = make_tools(scenes_.front(), meshes_.front());
    return setup;
  }

  std::deque<Scene> scenes_;
  std::deque<Card> cards_;
  std::deque<Mesh> meshes_;
  Team team_;
  World world_;
  bool started_ = false;
  double error_ = 0.0;
};

}  // namespace weaveform::test
