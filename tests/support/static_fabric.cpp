#include "tests/support/static_fabric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "solver/bending/shell_energy.hpp"
#include "solver/element/yarn_law.hpp"

namespace weaveform::test {
namespace {

using Eigen::Vector3d;

constexpr int reach = 3;  // lattice spacings over which a node's force feels another, ties included
constexpr int period = 2 * reach + 1;
// Fourth-order differences, exact to (step/L)^4 and to rounding over the step.
constexpr double step = 1e-3;  // mm, rad

Card symmetric(Card card) {
  for (auto& yarn : card.yarn) {
    yarn.compression_modulus = yarn.linear_modulus;
    yarn.compression = {};
  }
  return card;
}

ModelSpec linear(ModelSpec model) {
  model.yarn_law = YarnLaw::linear;
  return model;
}

}  // namespace

StaticFabric::StaticFabric(Mesh mesh, const Card& card, const ModelSpec& model, const Flexure& flexure,
                           std::vector<char> clamped)
    : mesh_(std::move(mesh)),
      card_(symmetric(card)),
      model_(linear(model)),
      packed_(pack_mesh(mesh_)),
      ties_(mesh_, packed_),
      state_(initial_state(packed_, mesh_)),
      clamped_(std::move(clamped)),
      turns_(mesh_.node_count(), 0),
      held_(mesh_.node_count(), {0, 0, 0}) {
  forces_ = std::make_unique<FabricForces>(packed_, card_, yarn_laws(card_, model_), model_, state_, alone());
  if (flexure.bends_yarns || flexure.rotation_free)
    bending_ = std::make_unique<LatticeBending>(mesh_, packed_, flexure, clamped_, state_, alone());
  if (flexure.has_shell) {
    shell_ =
        std::make_unique<Shell>(mesh_, packed_, card_, flexure, clamped_, state_, Shell::Setup{1e-6, 0.0, alone()});
    for (const auto& edge : find_shell_edges(mesh_, card_, flexure.transverse_shear))
      for (const int n : edge.node) turns_[n] = clamped_[n] == 0 ? 1 : 0;
  }
  for (int n = 0; n < mesh_.node_count(); ++n) {
    const auto& x = mesh_.nodes.position[n];
    position_.emplace_back(x[0], x[1], x[2]);
    director_.emplace_back(Vector3d::UnitZ());
    if (clamped_[n] != 0) held_[n] = {1, 1, 1};
  }
  for (const auto& tie : mesh_.tie) held_[tie.node] = {1, 1, 1};
  tilt_.resize(mesh_.node_count());
  number_unknowns();
}

void StaticFabric::hold(int node, int component) {
  held_[node][component] = 1;
  number_unknowns();
}

void StaticFabric::number_unknowns() {
  unknown_.clear();
  number_.assign(mesh_.node_count(), {-1, -1, -1, -1, -1});
  for (int n = 0; n < mesh_.node_count(); ++n) {
    const auto add = [&](int c) {
      if (mesh_.nodes.crossing[n][0] < 0) throw std::logic_error("StaticFabric: a free yarn end that is not tied");
      number_[n][c] = static_cast<int>(unknown_.size());
      unknown_.push_back({n, c});
    };
    for (int c = 0; c < 3; ++c)
      if (held_[n][c] == 0) add(c);
    if (turns_[n] == 0) continue;
    add(3);
    add(4);
  }
}

double StaticFabric::mass(int node) const {
  return packed_.mass[packed_.packed_of_mesh[node]];
}

int StaticFabric::node_at(double x, double y) const {
  int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < mesh_.node_count(); ++n) {
    const double distance = std::hypot(mesh_.nodes.position[n][0] - x, mesh_.nodes.position[n][1] - y);
    if (distance >= least) continue;
    least = distance;
    nearest = n;
  }
  return nearest;
}

void StaticFabric::place(const Map& position, const Map& director) {
  for (int n = 0; n < mesh_.node_count(); ++n) {
    const auto& x = mesh_.nodes.position[n];
    const Vector3d to = position({x[0], x[1], x[2]});
    for (int c = 0; c < 3; ++c)
      if (held_[n][c] == 0) position_[n][c] = to[c];
    if (turns_[n] != 0) director_[n] = director({x[0], x[1], x[2]}).normalized();
  }
}

Eigen::VectorXd StaticFabric::unbalanced(const Load& load) {
  for (int n = 0; n < mesh_.node_count(); ++n)
    for (int c = 0; c < 3; ++c) state_.position[c][packed_.packed_of_mesh[n]] = position_[n][c];
  ties_.follow(state_);
  for (const auto& tie : mesh_.tie)
    for (int c = 0; c < 3; ++c) position_[tie.node][c] = state_.position[c][packed_.packed_of_mesh[tie.node]];
  forces_->compute(state_);
  if (bending_) bending_->add_forces(state_, 0.0);
  NodalLoads loads{std::vector<Vector3d>(mesh_.node_count(), Vector3d::Zero()),
                   std::vector<Vector3d>(mesh_.node_count(), Vector3d::Zero())};
  if (shell_) {
    std::vector<Vec3> directors;
    for (const auto& d : director_) directors.push_back({d[0], d[1], d[2]});
    shell_->set_directors(directors);
    shell_->add_forces(state_, 0.0);
    const auto of_directors = shell_->director_forces();
    for (int n = 0; n < mesh_.node_count(); ++n) loads.director[n] = Vector3d(of_directors[n].data());
  }
  ties_.give_forces(state_);
  load(*this, loads);
  Eigen::VectorXd result(unknown_.size());
  for (std::size_t k = 0; k < unknown_.size(); ++k) {
    const auto [n, c] = unknown_[k];
    if (c < 3) {
      result[static_cast<int>(k)] = state_.force[c][packed_.packed_of_mesh[n]] + loads.force[n][c];
      continue;
    }
    const Vector3d &d = director_[n], &f = loads.director[n];
    result[static_cast<int>(k)] = tilt_[n][c - 3].dot(f - f.dot(d) * d);
  }
  return result;
}

void StaticFabric::choose_tilts() {
  for (int n = 0; n < mesh_.node_count(); ++n) {
    const Vector3d across = std::abs(director_[n][0]) < 0.7 ? Vector3d::UnitX() : Vector3d::UnitY();
    tilt_[n][0] = (across - across.dot(director_[n]) * director_[n]).normalized();
    tilt_[n][1] = director_[n].cross(tilt_[n][0]);
  }
}

void StaticFabric::shift(const Unknown& unknown, double by) {
  if (unknown.component < 3)
    position_[unknown.node][unknown.component] += by;
  else
    director_[unknown.node] = (director_[unknown.node] + by * tilt_[unknown.node][unknown.component - 3]).normalized();
}

// All nodes a period apart along both families are shifted at once.
Eigen::SparseMatrix<double> StaticFabric::stiffness(const Load& load) {
  std::map<std::array<int, 2>, int> at;
  for (int n = 0; n < mesh_.node_count(); ++n)
    if (mesh_.nodes.crossing[n][0] >= 0) at[mesh_.nodes.crossing[n]] = n;
  std::vector<Eigen::Triplet<double>> entries;
  constexpr std::array<double, 4> shifts = {-2.0, -1.0, 1.0, 2.0}, weights = {1.0, -8.0, 8.0, -1.0};
  for (int colour = 0; colour < period * period; ++colour)
    for (int component = 0; component < 5; ++component) {
      std::vector<int> shifted;
      for (std::size_t k = 0; k < unknown_.size(); ++k) {
        const auto [i, j] = mesh_.nodes.crossing[unknown_[k].node];
        if (unknown_[k].component == component && (i % period) * period + j % period == colour)
          shifted.push_back(static_cast<int>(k));
      }
      if (shifted.empty()) continue;
      Eigen::VectorXd change = Eigen::VectorXd::Zero(static_cast<int>(unknown_.size()));
      const auto positions = position_;
      const auto directors = director_;
      for (std::size_t s = 0; s < shifts.size(); ++s) {
        for (const int k : shifted) shift(unknown_[k], shifts[s] * step);
        change += weights[s] / (12.0 * step) * unbalanced(load);
        position_ = positions;
        director_ = directors;
      }
      for (const int k : shifted) {
        const auto [i, j] = mesh_.nodes.crossing[unknown_[k].node];
        for (int di = -reach; di <= reach; ++di)
          for (int dj = -reach; dj <= reach; ++dj) {
            const auto near = at.find({i + di, j + dj});
            if (near == at.end()) continue;
            for (const int row : number_[near->second])
              if (row >= 0 && change[row] != 0.0) entries.emplace_back(row, k, -change[row]);
          }
      }
    }
  Eigen::SparseMatrix<double> matrix(static_cast<int>(unknown_.size()), static_cast<int>(unknown_.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// From soft yarns to their own stiffness: almost inextensible ones leave Newton's steps no room to turn in.
double StaticFabric::relax(const Load& load) {
  iterations = 0;
  for (const double softness : {1e-3, 3e-2}) {
    soften_yarns(softness);
    come_to_rest(load, 1e-4);
  }
  soften_yarns(1.0);
  return come_to_rest(load, 1e-8);
}

void StaticFabric::soften_yarns(double factor) {
  ModelSpec model = model_;
  model.yarn_stiffness_scale *= factor;
  forces_ = std::make_unique<FabricForces>(packed_, card_, yarn_laws(card_, model), model, state_, alone());
}

// Until a step moves nothing by more than `at_rest` spacings (radians).
double StaticFabric::come_to_rest(const Load& load, double at_rest) {
  constexpr int most_iterations = 60;
  constexpr double longest = 0.25;  // spacings, rad; of one step
  const double spacing = std::min(mesh_.spacing[0], mesh_.spacing[1]);
  for (int n = 0; n < most_iterations; ++n) {
    ++iterations;
    choose_tilts();
    Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(stiffness(load));
    if (solver.info() != Eigen::Success) throw std::runtime_error("StaticFabric: the stiffness is singular");
    const Eigen::VectorXd move = solver.solve(unbalanced(load));
    double greatest = 0.0;
    for (std::size_t k = 0; k < unknown_.size(); ++k)
      greatest = std::max(greatest, std::abs(move[static_cast<int>(k)]) / (unknown_[k].component < 3 ? spacing : 1.0));
    const double part = std::min(1.0, longest / greatest);
    for (std::size_t k = 0; k < unknown_.size(); ++k) shift(unknown_[k], part * move[static_cast<int>(k)]);
    if (greatest < at_rest) return unbalanced(load).cwiseAbs().maxCoeff();
  }
  throw std::runtime_error("StaticFabric: no equilibrium found");
}

double StaticFabric::least_stiffness(const Load& load) {
  choose_tilts();
  const Eigen::MatrixXd matrix(stiffness(load));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (matrix + matrix.transpose()),
                                                              Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0];
}

StaticFabric::Load weight(const Vector3d& acceleration) {
  return [acceleration](const StaticFabric& fabric, NodalLoads& loads) {
    for (int n = 0; n < fabric.mesh().node_count(); ++n) {
      bool tied = false;
      for (const auto& tie : fabric.mesh().tie) tied |= tie.node == n;
      if (!tied) loads.force[n] += fabric.mass(n) * acceleration;
    }
  };
}

}  // namespace weaveform::test
