// What friction in bending remembers, at crossings in rows and at loose bends, or at the edges of shell cells: shares of
// the greatest moment and the curvatures they belong to; and what it has lost.
#pragma once

#include <array>
#include <vector>

#include "solver/bending/flexure.hpp"
#include "solver/bending/friction_kernels.hpp"
#include "solver/state/archive.hpp"

namespace weaveform {

// N mm^2 of one yarn: the greatest slope of friction's moment over curvature, just after a reversal.
[[nodiscard]] double stiffest_friction(const BendingFriction& friction);

// Shares and curvatures of a number of bends, [family][out of plane, in plane].
struct FrictionColumns {
  std::vector<double> phi[2][2], curvature[2][2];  // 1, 1/mm
  explicit FrictionColumns(int bends);
  [[nodiscard]] BendFrictionView at(std::size_t offset);
  void archive(Archive& archive);
};

struct FrictionLaws {
  std::array<YarnFriction, 2> yarn;  // warp, weft
  [[nodiscard]] bool any() const;
  // mJ/mm per bend and family: M rise phi^2/2 times `yarns`.
  [[nodiscard]] std::array<std::vector<double>, 2> stored(const std::array<const std::vector<double>*, 2>& yarns,
                                                          const FrictionColumns& columns) const;
};
[[nodiscard]] FrictionLaws friction_laws(const Flexure& flexure);

struct FrictionOfBends {
  FrictionOfBends(const FrictionLaws& the_laws, int lattice_nodes, int row_count, int loose_bends);

  FrictionLaws laws;
  FrictionColumns rows, loose;
  std::vector<double> lost, lost_loose;  // mJ; per bend, of the last step
  std::vector<double> lost_of_row;       // mJ; so far: one sum a row, so that no number of threads changes it
  double lost_by_loose = 0.0;            // mJ; so far
  bool begun = false;                    // curvatures have been taken note of
  [[nodiscard]] double lost_so_far() const;
  void archive(Archive& archive);
};

}  // namespace weaveform
