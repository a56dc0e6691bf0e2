// Worlds from scenes in memory, made of the pieces that the analysis makes its own of.
#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mesher/lattice/build.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/analysis/world.hpp"

namespace weaveform::test {

// One ply for each scene, all in the world of the first: its analysis, output and tools. With `pair_law` they touch each
// other, from bottom to top.
class SmallWorld {
public:
  using Shape = std::function<void(std::size_t ply, Mesh& mesh)>;  // the start, where it is not the flat blank
  explicit SmallWorld(const std::vector<Scene>& scenes, double longest_step = std::numeric_limits<double>::infinity(),
                      int threads = 1, std::function<PairLaw(int, int)> pair_law = nullptr,
                      const Shape& shape = nullptr)
      : scenes_(scenes.begin(), scenes.end()),
        team_(threads),
        world_(make_setup(longest_step, std::move(pair_law), shape)) {}

  World* operator->() { return &world_; }
  World& operator*() { return world_; }
  [[nodiscard]] const Mesh& mesh(std::size_t ply) const { return meshes_[ply]; }

  // `steps` of the loop that analysis.cpp goes through with observers in between.
  void run(int steps) {
    if (world_.steps() == 0) world_.start();
    for (int n = 0; n < steps && !world_.finished(); ++n) {
      if (world_.steps() % 500 == 0 && world_.steps() > 0) world_.renew_step();
      world_.advance(false);
      if (world_.passed_reach()) world_.renew_step();
      world_.compute_forces();
      if (world_.passes_reach()) world_.renew_step();
    }
  }

private:
  WorldSetup make_setup(double longest_step, std::function<PairLaw(int, int)> pair_law, const Shape& shape) {
    WorldSetup setup{.plies = {},
                     .tools = {},
                     .scene = scenes_.front(),
                     .loading = {},
                     .pair_law = std::move(pair_law),
                     .longest_step = longest_step,
                     .team = team_};
    for (const auto& scene : scenes_) {
      cards_.push_back(load_card(scene.fabric.material));
      meshes_.push_back(build_mesh(scene, cards_.back()));
      if (shape) shape(meshes_.size() - 1, meshes_.back());
      setup.plies.push_back({.whole = meshes_.back(), .card = cards_.back(), .scene = scene});
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
};

}  // namespace weaveform::test
