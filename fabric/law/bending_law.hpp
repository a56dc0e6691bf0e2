// Moment-curvature law of a yarn out of the fabric's plane, in both senses of bending.
//
// The sense is told by the fabric: curvature and moment are positive with its face bent outwards (the face is the convex
// side, as on top of a strip that hangs face up over an edge) and negative with its back outwards,
//   M(kappa) = M_face(kappa) for kappa >= 0 ,  -M_back(-kappa) for kappa < 0 ,
// each half a tangent law (N mm^2 against 1/mm) from zero curvature on. M is continuous through zero, dM/dkappa need not
// be; W(kappa) = integral_0^kappa M is W_face or W_back of the curvature's size, and so its slope is continuous.
#pragma once

#include <utility>

#include "fabric/law/tangent_law.hpp"

namespace weaveform {

class BendingLaw {
public:
  BendingLaw() = default;                                                // no pieces: nothing is known, or borne
  BendingLaw(TangentLaw both) : face_(std::move(both)), back_(face_) {}  // odd: the same in both senses
  BendingLaw(TangentLaw face, TangentLaw back) : face_(std::move(face)), back_(std::move(back)) {}

  [[nodiscard]] const TangentLaw& face() const { return face_; }  // with the face outwards
  [[nodiscard]] const TangentLaw& back() const { return back_; }
  [[nodiscard]] bool empty() const { return face_.pieces().empty() && back_.pieces().empty(); }
  [[nodiscard]] bool is_odd() const { return face_ == back_; }

  [[nodiscard]] double moment(double curvature) const;       // N mm
  [[nodiscard]] double energy(double curvature) const;       // N; per length of yarn, integral of the moment from 0
  [[nodiscard]] double stiffest(double greatest) const;      // N mm^2; greatest tangent up to that curvature, both ways
  [[nodiscard]] double first_stiffness() const;              // N mm^2; at zero, the mean of both senses
  [[nodiscard]] double mean_secant(double curvature) const;  // N mm^2; M/kappa at a curvature > 0, mean of both senses
  [[nodiscard]] BendingLaw turned_over() const { return {back_, face_}; }  // of the fabric seen from its other side
  bool operator==(const BendingLaw&) const = default;

private:
  TangentLaw face_, back_;
};

// The law with a constant stiffness (N mm^2) beside it.
[[nodiscard]] BendingLaw with_constant(const BendingLaw& law, double stiffness);

}  // namespace weaveform
