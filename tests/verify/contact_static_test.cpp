// A sphere pressed into a held net: the explicit run's force against the static solution, found by minimising the
// energy of fabric and contact without any dynamics.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <deque>

#include "solver/contact/contact.hpp"
#include "solver/ply/ply.hpp"
#include "tests/support/chosen.hpp"
#include "tests/support/contact_scene.hpp"

namespace weaveform {
namespace {

using namespace test;
using Eigen::VectorXd;

constexpr double radius = 40.0, depth = 15.0;  // mm

Scene held_net() {
  Scene scene = contact_scene({120.0, 120.0}, 2.0);
  for (const char* edge : {"left", "right", "bottom", "top"}) {
    GripSpec grip;
    grip.name = edge;
    grip.edge = test::chosen(edge);
    scene.grip.push_back(grip);
  }
  return scene;
}

// Fabric and a frictionless sphere on springs, as a function of the free nodes' coordinates.
class NetOnSphere {
public:
  explicit NetOnSphere(const Scene& scene)
      : card_(load_card(scene.fabric.material)),
        mesh_(build_mesh(scene, card_)),
        scene_(scene),
        ply_({.whole = mesh_, .scene = scene_, .card = card_, .team = alone()}) {
    const std::vector<char> held = held_nodes(ply_.holds().grips(), mesh_, ply_.packed());
    for (int n = 0; n < mesh_.node_count(); ++n)
      if (held[n] == 0) free_.push_back(n);
    const double step = ply_.fabric_step();
    rate_ = contact_stiffness_share * 4.0 / (step * step);
    softening_ = contact_softening * card_.thickness;
  }

  [[nodiscard]] VectorXd start() const {
    VectorXd x(3 * static_cast<int>(free_.size()));
    for (std::size_t k = 0; k < free_.size(); ++k)
      for (int c = 0; c < 3; ++c) x[3 * static_cast<int>(k) + c] = mesh_.nodes.position[free_[k]][c];
    return x;
  }

  // mJ; fills the gradient (N) and the sphere's force downwards (N).
  double operator()(const VectorXd& x, VectorXd& gradient) {
    State& state = ply_.state();
    const auto& packed = ply_.packed().packed_of_mesh;
    for (std::size_t k = 0; k < free_.size(); ++k)
      for (int c = 0; c < 3; ++c) state.position[c][packed[free_[k]]] = x[3 * static_cast<int>(k) + c];
    ply_.compute_forces(0.0);
    double energy = ply_.stored_energy().total;
    force_ = 0.0;
    gradient.resize(x.size());
    const Eigen::Vector3d centre(0.0, 0.0, radius + 0.5 * card_.thickness - depth);
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const int p = packed[free_[k]], i = 3 * static_cast<int>(k);
      for (int c = 0; c < 3; ++c) gradient[i + c] = -state.force[c][p];
      const Eigen::Vector3d off = x.segment<3>(i) - centre;
      const double pressed = radius + 0.5 * card_.thickness - off.norm();
      if (pressed <= 0.0) continue;
      const double stiffness = rate_ * mesh_.nodes.mass[free_[k]], soft = std::min(pressed, softening_);
      // the contact law's normal force and its integral (contact_kernel.hpp), linear beyond the softening depth
      energy += stiffness *
                (soft * soft * soft / (6.0 * softening_) + 0.5 * (pressed - soft) * (softening_ + (pressed - soft)));
      const Eigen::Vector3d push = stiffness * soft / softening_ * (pressed - 0.5 * soft) * off.normalized();
      gradient.segment<3>(i) -= push;
      force_ -= push[2];
    }
    return energy;
  }
  [[nodiscard]] double force() const { return force_; }

private:
  Card card_;
  Mesh mesh_;
  Scene scene_;
  Ply ply_;
  std::vector<int> free_;
  double rate_, softening_;  // 1/s^2, mm; of the contact springs
  double force_ = 0.0;
};

// Limited-memory BFGS (Nocedal and Wright 2006, "Numerical Optimization", algorithm 7.4) with halved steps.
double minimise(NetOnSphere& net, VectorXd x, double tolerance) {
  VectorXd gradient, next_gradient;
  double value = net(x, gradient);
  std::deque<std::pair<VectorXd, VectorXd>> pairs;
  int iteration = 0;
  for (; iteration < 20000 && gradient.lpNorm<Eigen::Infinity>() > tolerance; ++iteration) {
    VectorXd direction = -gradient;
    std::vector<double> alpha(pairs.size());
    for (std::size_t k = pairs.size(); k-- > 0;) {
      alpha[k] = pairs[k].first.dot(direction) / pairs[k].first.dot(pairs[k].second);
      direction -= alpha[k] * pairs[k].second;
    }
    direction *= pairs.empty() ? 1e-3 : pairs.back().first.dot(pairs.back().second) / pairs.back().second.squaredNorm();
    for (std::size_t k = 0; k < pairs.size(); ++k)
      direction += (alpha[k] - pairs[k].second.dot(direction) / pairs[k].first.dot(pairs[k].second)) * pairs[k].first;
    double way = std::min(1.0, 1.0 / direction.lpNorm<Eigen::Infinity>());
    double next_value = net(x + way * direction, next_gradient);
    for (int halving = 0; halving < 40 && !(next_value <= value + 1e-4 * way * gradient.dot(direction)); ++halving) {
      way *= 0.5;
      next_value = net(x + way * direction, next_gradient);
    }
    const VectorXd s = way * direction, y = next_gradient - gradient;
    if (s.dot(y) > 0.0) pairs.emplace_back(s, y);
    if (pairs.size() > 30) pairs.pop_front();
    x += s;
    value = next_value;
    gradient = next_gradient;
  }
  EXPECT_LE(gradient.lpNorm<Eigen::Infinity>(), tolerance) << "no static solution after " << iteration << " iterations";
  return net.force();
}

TEST(HeldNet, ForceOfAPressedSphereIsThatOfTheStaticSolution) {
  Scene scene = held_net();
  NetOnSphere net(scene);
  const double expected = minimise(net, net.start(), 1e-3);

  ToolSpec sphere = make_tool_spec("sphere", ToolShape::sphere);
  sphere.radius = radius;
  sphere.travel = depth;
  scene.tools = {sphere};
  scene.analysis.duration = 0.2;
  scene.analysis.contact_stiffness = 1.0;  // as the net's springs above
  const SolveResult result = run(scene);
  // nodal forces to 1e-3 N; what is left of inertia and of the fabric's ringing stays below 0.3 % of the force
  EXPECT_GT(expected, 50.0);
  EXPECT_NEAR(result.history.values("sphere.force_N").back(), expected, 0.003 * expected);
  EXPECT_LT(result.statistics.energy_error, 0.02);
}

}  // namespace
}  // namespace weaveform
