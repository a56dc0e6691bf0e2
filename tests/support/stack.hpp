// Plies that touch each other, to be placed and moved by hand.
#pragma once

#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "mesher/lattice/build.hpp"
#include "solver/contact/ply_contact.hpp"
#include "solver/ply/ply.hpp"

namespace weaveform::test {

class Stack {
public:
  // From bottom to top; each ply lies where its scene says. The law is that of all pairs.
  explicit Stack(const std::vector<Scene>& scenes, const PairLaw& law = {}, int threads = 1, double frequency = 1e5)
      : scenes_(scenes.begin(), scenes.end()), team_(threads) {
    std::vector<Ply*> all;
    for (const auto& scene : scenes_) {
      cards_.push_back(load_card(scene.fabric.material));
      meshes_.push_back(build_mesh(scene, cards_.back()));
      plies_.push_back(std::make_unique<Ply>(PlySetup{.whole = meshes_.back(),
                                                      .part = nullptr,
                                                      .scene = scene,
                                                      .card = cards_.back(),
                                                      .duration = 1.0,
                                                      .damping = 0.0,
                                                      .team = team_}));
      all.push_back(plies_.back().get());
      sheared_.push_back(
          scene.model.contact_thickness == ContactThickness::sheared
              ? std::make_unique<ShearedThickness>(meshes_.back(), plies_.back()->packed(), plies_.back()->state())
              : nullptr);
    }
    std::vector<ShearedThickness*> sheared;
    for (auto& one : sheared_) sheared.push_back(one.get());
    contact_ = std::make_unique<PlyContact>(PlyContactSetup{.plies = all,
                                                            .names = {},
                                                            .law = [law](int, int) { return law; },
                                                            .frequency = frequency,
                                                            .sheared = sheared,
                                                            .team = team_});
  }

  Ply& ply(std::size_t k) { return *plies_[k]; }
  const Mesh& mesh(std::size_t k) const { return meshes_[k]; }
  double thickness(std::size_t k) const { return meshes_[k].thickness; }
  PlyContact& contact() { return *contact_; }
  ShearedThickness& sheared(std::size_t k) { return *sheared_[k]; }
  std::size_t size() const { return plies_.size(); }

  // Every node of a ply to map(where it starts).
  void place(std::size_t k, const std::function<Vec3(const Vec3&)>& map) {
    State& state = plies_[k]->state();
    for (int n = 0; n < meshes_[k].node_count(); ++n) {
      const Vec3 x = map(meshes_[k].nodes.position[n]);
      for (std::size_t c = 0; c < 3; ++c) state.position[c][plies_[k]->packed().packed_of_mesh[n]] = x[c];
    }
  }

  // Forces of contact alone, after a step of this length (s).
  void touch(double step = 1e-6) {
    for (auto& ply : plies_) {
      for (auto& component : ply->state().force) std::fill(component.begin(), component.end(), 0.0);
      ply->state().time += step;
      ++ply->state().step;
    }
    for (std::size_t k = 0; k < size(); ++k)
      if (sheared_[k]) sheared_[k]->look(ply(k).state(), team_);
    contact_->add_forces();
    for (std::size_t k = 0; k < size(); ++k)
      if (sheared_[k]) sheared_[k]->add_forces(ply(k).state());
  }

  Vec3 force(std::size_t k, int node) const {
    const auto& f = plies_[k]->state().force;
    const int p = plies_[k]->packed().packed_of_mesh[node];
    return {f[0][p], f[1][p], f[2][p]};
  }
  Vec3 position(std::size_t k, int node) const {
    const auto& x = plies_[k]->state().position;
    const int p = plies_[k]->packed().packed_of_mesh[node];
    return {x[0][p], x[1][p], x[2][p]};
  }
  // Sums over one ply's nodes.
  Vec3 force(std::size_t k) const {
    Vec3 sum = {0.0, 0.0, 0.0};
    for (int n = 0; n < meshes_[k].node_count(); ++n) sum = plus(sum, force(k, n));
    return sum;
  }
  Vec3 moment(std::size_t k) const {
    Vec3 sum = {0.0, 0.0, 0.0};
    for (int n = 0; n < meshes_[k].node_count(); ++n) sum = plus(sum, cross(position(k, n), force(k, n)));
    return sum;
  }

private:
  std::deque<Scene> scenes_;
  std::deque<Card> cards_;
  std::deque<Mesh> meshes_;
  Team team_;
  std::vector<std::unique_ptr<Ply>> plies_;
  std::vector<std::unique_ptr<ShearedThickness>> sheared_;  // null where the ply has the card's thickness
  std::unique_ptr<PlyContact> contact_;
};

// A flat piece at height z.
inline Scene piece(std::array<double, 2> size, double coarsening, double yarn_angle, double z) {
  Scene scene;
  scene.blank.size = size;
  scene.blank.yarn_angle = yarn_angle;
  scene.blank.coarsening = {coarsening, coarsening};
  scene.blank.position = {0.0, 0.0, z};
  return scene;
}

// Of 60 x 50 mm, with a corner cut out.
inline Scene piece_without_a_corner(double yarn_angle) {
  Scene scene = piece({60.0, 50.0}, 1.0, yarn_angle, 0.0);
  scene.blank.shape = BlankShape::polygon;
  scene.blank.corners = {{-30.0, -25.0}, {30.0, -25.0}, {30.0, 5.0}, {8.0, 5.0}, {8.0, 25.0}, {-30.0, 25.0}};
  return scene;
}

}  // namespace weaveform::test
