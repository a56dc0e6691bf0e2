// Equilibrium of a fabric or a yarn under dead or following loads, from the library's own force terms: Newton's method
// on the forces of FabricForces, LatticeBending and Shell, their derivatives by differences. What is left between its
// answer and a closed form is the error of the discretisation alone.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/bending/flexure.hpp"
#include "solver/bending/lattice_bending.hpp"
#include "solver/bending/shell.hpp"
#include "solver/constraint/ties.hpp"
#include "solver/lattice/forces.hpp"

namespace weaveform::test {

// Per mesh node: forces (N), and on directors (shells) moments as the gradient by the director with its sign turned
// (N mm).
struct NodalLoads {
  std::vector<Eigen::Vector3d> force, director;
};

class StaticFabric {
public:
  // Adds the loads at the current positions and directors.
  using Load = std::function<void(const StaticFabric&, NodalLoads&)>;

  // `clamped`: per mesh node; held in every component and direction. Yarns are linear and as stiff in compression as in
  // tension. Throws std::logic_error for a mesh with free yarn ends that are not tied.
  StaticFabric(Mesh mesh, const Card& card, const ModelSpec& model, const Flexure& flexure, std::vector<char> clamped);

  StaticFabric(const StaticFabric&) = delete;
  StaticFabric& operator=(const StaticFabric&) = delete;

  void hold(int node, int component);  // at its current place

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] const Card& card() const { return card_; }
  [[nodiscard]] double mass(int node) const;  // tonne; with that of the ends tied to it
  [[nodiscard]] Eigen::Vector3d position(int node) const { return position_[node]; }
  [[nodiscard]] Eigen::Vector3d director(int node) const { return director_[node]; }
  // The node nearest to a place on the flat mesh.
  [[nodiscard]] int node_at(double x, double y) const;

  // Moves the free nodes and directors to where the maps send the flat mesh: a start for relax.
  using Map = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;
  void place(const Map& position, const Map& director);

  // Moves to equilibrium. Returns the greatest force out of balance (N; N mm of directors). Throws std::runtime_error
  // when it does not come to rest.
  double relax(const Load& load);
  int iterations = 0;  // of the last relax

  // Least eigenvalue of the stiffness at the current positions (N/mm); dense, for small meshes.
  [[nodiscard]] double least_stiffness(const Load& load);

private:
  struct Unknown {
    int node;
    int component;  // 0-2: position; 3, 4: along `tilt` of the director
  };
  [[nodiscard]] Eigen::VectorXd unbalanced(const Load& load);
  [[nodiscard]] Eigen::SparseMatrix<double> stiffness(const Load& load);
  void soften_yarns(double factor);
  double come_to_rest(const Load& load, double at_rest);
  void choose_tilts();
  void shift(const Unknown& unknown, double by);
  void number_unknowns();

  Mesh mesh_;
  Card card_;
  ModelSpec model_;
  PackedMesh packed_;
  Ties ties_;
  State state_;
  std::unique_ptr<FabricForces> forces_;
  std::unique_ptr<LatticeBending> bending_;
  std::unique_ptr<Shell> shell_;
  std::vector<char> clamped_, turns_;  // turns_: has a director that may turn
  std::vector<std::array<char, 3>> held_;
  std::vector<Eigen::Vector3d> position_, director_;
  std::vector<std::array<Eigen::Vector3d, 2>> tilt_;
  std::vector<Unknown> unknown_;
  std::vector<std::array<int, 5>> number_;  // of each node's unknowns; -1: none
};

// m g on every node.
[[nodiscard]] StaticFabric::Load weight(const Eigen::Vector3d& acceleration);

}  // namespace weaveform::test
