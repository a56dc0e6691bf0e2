// The true strains that a family's yarns have, or may have.
#pragma once

namespace weaveform {

struct StrainRange {
  double least = 0.0;     // <= 0
  double greatest = 0.0;  // >= 0
  void hold(const StrainRange& other) {
    least = other.least < least ? other.least : least;
    greatest = other.greatest > greatest ? other.greatest : greatest;
  }
  [[nodiscard]] bool holds(const StrainRange& other) const {
    return other.least >= least && other.greatest <= greatest;
  }
};

}  // namespace weaveform
