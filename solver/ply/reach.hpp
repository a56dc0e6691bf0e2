// The strains that the stable step allows yarns to have, and the watch over them.
//
// A decrimping yarn (Table 2: C = c e^3 up to its linear modulus) is an order of magnitude softer at the strains of a
// forming process than at its stiffest, and the stable step goes with 1/sqrt(C). The step may therefore be taken from
// the stiffest tangent that any yarn of the family has reached, never from each yarn's own current one: a slack yarn
// that snaps taut meets a tangent that some other yarn has shown before, while with current tangents a hemisphere tears
// itself apart (docs/stability.md). The fabric's strains, and those that they come to within two steps at their present
// rate, are known at every step; the first that is beyond what the step allows shortens the very next step. Without the
// look ahead a seatbelt with slack, which nothing but its soft cells gives a step, met its tension in one step of 0.6
// ms, and blew up.
//
// A cell that closes stiffens without limit (critical_step.hpp takes its angle of the moment), and may do so within a few
// steps where it folds over: the first shear beyond what it was renews the step too.
#pragma once

#include <array>

#include "solver/element/strain_range.hpp"
#include "solver/state/archive.hpp"

namespace weaveform {

inline constexpr double steps_ahead = 2.0;  // that strains are watched for

// A yarn never bears this true strain; the stable step is bounded up to here, and a run whose yarns pass it stops.
inline constexpr double torn_strain = 0.5;

using FamilyStrains = std::array<StrainRange, 2>;  // warp, weft
inline constexpr FamilyStrains every_strain = {{{-torn_strain, torn_strain}, {-torn_strain, torn_strain}}};

class Reach {
public:
  // Fixed: every strain that a yarn bears is allowed, always. Otherwise what is allowed follows what yarns reach.
  explicit Reach(bool fixed);

  // Notes the yarns' strains and the cells' greatest sin^2 gamma of this step; true when the step must be renewed because
  // they are beyond the allowed ones.
  [[nodiscard]] bool passed_by(const FamilyStrains& now, double sharpest);
  // Whether any of them since the last renewal were.
  [[nodiscard]] bool passed() const;
  // From now on what was reached since the last renewal is allowed, with a margin.
  void renew();
  [[nodiscard]] const FamilyStrains& allowed() const { return allowed_; }

  void archive(Archive& archive);

private:
  [[nodiscard]] bool allows(const FamilyStrains& strains, double sharpest) const;

  bool fixed_;
  FamilyStrains allowed_, reached_;
  double allowed_sharpest_, reached_sharpest_ = 0.0;  // sin^2 gamma
};

}  // namespace weaveform
