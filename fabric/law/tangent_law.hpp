// Tangent laws of a material card (Tables 2 and 3 of the paper) and their exact integrals.
#pragma once

#include <string>
#include <vector>

#include "fabric/law/polynomial.hpp"

namespace weaveform {

// One piece of a tangent law: C(e) = sum_n coefficient[n] * e^n (MPa) for from <= e < to, e the absolute strain (1).
// The first piece may have no beginning, the last no end: from = -infinity, to = infinity.
struct TangentPiece {
  double from = 0.0;
  double to = 0.0;
  Polynomial coefficient;
  bool operator==(const TangentPiece&) const = default;
};

// A piecewise-polynomial tangent law, pieces adjoining and in rising order. Stress is its integral from zero strain,
//   s(e) = integral_0^e C(e') de' ,
// so that stress is continuous even where the tangent jumps. Before the first and after the last piece the tangent
// keeps its value at that end.
class TangentLaw {
public:
  TangentLaw() = default;
  // Throws InputError when pieces are empty, out of order, not finite inside or leave a gap.
  explicit TangentLaw(std::vector<TangentPiece> pieces);

  [[nodiscard]] double tangent(double strain) const;            // MPa
  [[nodiscard]] double stress(double strain) const;             // MPa
  [[nodiscard]] double energy(double strain) const;             // mJ/mm^3: integral of stress from 0
  [[nodiscard]] double stiffest(double from, double to) const;  // MPa: greatest tangent in [from, to]
  // Strains in [from, to] where the tangent is negative, as text "e in [a, b]: least tangent c MPa at d"; "" when none.
  [[nodiscard]] std::string negative_range(double from, double to) const;
  // Strains in [from, to] where the tangent is negative, as intervals.
  [[nodiscard]] std::vector<Interval> negative_intervals(double from, double to) const;
  [[nodiscard]] const std::vector<TangentPiece>& pieces() const { return pieces_; }
  bool operator==(const TangentLaw& other) const { return pieces_ == other.pieces_; }

private:
  // A piece with its integrals; the ends' continuations are segments too.
  struct Segment {
    double from, to;
    Polynomial tangent, stress, energy;  // MPa, MPa, mJ/mm^3; of the absolute strain
  };
  [[nodiscard]] const Segment& at(double strain) const;
  void integrate();

  std::vector<TangentPiece> pieces_;
  std::vector<Segment> segments_;  // from -infinity to infinity; empty for a default-constructed law, which is zero
};

}  // namespace weaveform
