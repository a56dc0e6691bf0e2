// Stored energy of the fabric from its potentials, independent of the forces that moved it, so that the energy balance
// is a test of the run:  internal + kinetic + damping - external = start value.
//
//   yarn, incompressible   E = A0 L0 integral_0^e s de            constant section  E = A0 L0 integral_0^e s exp(e) de
//   cell                   E = V0 integral_0^s sigma d(sin gamma)  (thickness constant: times cos gamma)
// The contravariant formulation has no potential: beside dw its power is  V0 sigma s d(ln|g1||g2|)/dt  (Eq. 9's part
// along the yarns), which is integrated along the path, one trapezoid per call. Cells with a history (incremental,
// side-frame) sum their own work step by step; it is passed in.
#pragma once

#include <vector>

#include "core/vector/vector.hpp"
#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/state/archive.hpp"

namespace weaveform {

// w(gamma_L) = integral_0^s sigma d(sin gamma) with sin gamma = tanh(gamma_L), as a cubic Hermite table of its own
// slope.
class ShearPotential {
public:
  ShearPotential(const ShearCard& card, bool constant_thickness);
  [[nodiscard]] double operator()(double sin_gamma) const;  // mJ/mm^3

private:
  [[nodiscard]] double slope(double log_strain) const;  // dw/d(gamma_L)
  ShearCard card_;
  bool constant_thickness_;
  std::vector<double> value_, slope_;  // mJ/mm^3
};

class InternalEnergy {
public:
  InternalEnergy(const Mesh& mesh, const Card& card, const std::array<TangentLaw, 2>& yarn_laws,
                 const ModelSpec& model);
  // mJ; calls must follow the motion in order when the formulation has no potential. `cell_work` (mJ) stands for the
  // cells' energy when they have a history.
  [[nodiscard]] double operator()(const std::vector<Vec3>& position, double cell_work = 0.0);
  // What the path integral holds, where the formulation needs one.
  void archive(Archive& archive);

private:
  [[nodiscard]] double of_yarns(const std::vector<Vec3>& position) const;
  double of_cells(const std::vector<Vec3>& position);
  struct Path {
    double work = 0.0;                // mJ
    std::vector<double> stress;       // MPa; V0 sigma s per cell at the last call
    std::vector<double> log_stretch;  // 1; ln |g1||g2| per cell at the last call
  };

  const Mesh& mesh_;
  Card card_;
  std::array<TangentLaw, 2> yarn_laws_;
  ModelSpec model_;
  ShearPotential potential_;
  Path path_;
};

}  // namespace weaveform
