// The stable step of the explicit analysis, from the stiffest tangent that the yarns of a family can have at the
// strains allowed to them (reach.hpp).
//
// Central difference is stable for step <= 2 / sqrt(lambda), lambda the greatest eigenvalue of M^-1 K. For yarns
//   u.K u = sum_e k_e (n_e.(u_a - u_b))^2 <= sum_e 2 k_e ((n_e.u_a)^2 + (n_e.u_b)^2)   (factor 1 where an end is held)
// so that lambda <= max_i 2 eigmax(B_i) / m_i with B_i = sum of k n n^T over the yarns at node i: a bound at every
// shear angle, tight (4 K (1 + sin gamma)/m) on a regular lattice. Cells add their row sums (Gershgorin), tension its
// N/L.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/vector/vector.hpp"
#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/ply/reach.hpp"

namespace weaveform {

struct StableStep {
  double step = 0.0;   // s
  std::string set_by;  // e.g. "yarns at node 123"
};

// N/mm; per mesh node, 0 where it is held or follows others.
struct NodeStiffness {
  std::vector<double> yarns;  // greatest eigenvalue
  std::vector<double> cells;  // row sum
};

class CriticalStep {
public:
  // `held`: per mesh node, true where every component is prescribed.
  CriticalStep(const Mesh& mesh, const Card& card, const std::array<TangentLaw, 2>& yarn_laws, const ModelSpec& model,
               std::vector<char> held);
  // MPa; the stiffest tangent of each family's yarns at the allowed strains
  [[nodiscard]] std::array<double, 2> stiffest(const FamilyStrains& allowed) const;
  // `yarn_modulus` (MPa): of each family.
  [[nodiscard]] NodeStiffness at_nodes(const std::vector<Vec3>& position,
                                       const std::array<double, 2>& yarn_modulus) const;
  // `further`: per mesh node, row sums of everything else that is stiff there (N/mm); may be empty.
  [[nodiscard]] StableStep step(const NodeStiffness& stiffness, std::vector<double> further = {}) const;
  // Of yarns and cells alone.
  [[nodiscard]] StableStep operator()(const std::vector<Vec3>& position,
                                      const std::array<double, 2>& yarn_modulus) const {
    return step(at_nodes(position, yarn_modulus));
  }

private:
  void move_images(std::vector<Eigen::Matrix3d>& bound, std::vector<double>& cell_rows) const;
  void add_other_sides(std::vector<Eigen::Matrix3d>& bound) const;

  const Mesh& mesh_;
  ShearCard shear_;
  std::array<TangentLaw, 2> yarn_laws_;
  bool constant_section_;
  std::vector<double> yarn_shape_;  // mm; section over length, so that times a modulus it is dN/dL
  std::vector<char> held_;
  std::vector<char> tied_;               // nodes that follow others
  std::vector<Eigen::Matrix3d> mirror_;  // by the set of planes
};

}  // namespace weaveform
