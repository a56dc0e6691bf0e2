#include "solver/bending/moment_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"

namespace weaveform {
namespace {

constexpr double never = 1e30;  // 1/mm; a curvature that no yarn has

// c_n of p(from + t) = sum c_n t^n, by Taylor's formula
Polynomial about(const Polynomial& p, double from) {
  Polynomial result, derivative = p;
  double factorial = 1.0;
  for (std::size_t n = 0; n < p.size(); ++n) {
    result.push_back(value_of(derivative, from) / factorial);
    derivative = derivative_of(derivative);
    factorial *= static_cast<double>(n + 1);
  }
  return result;
}

// The law from zero curvature on, with what goes on beyond its ends.
std::vector<TangentPiece> from_zero(const TangentLaw& law) {
  std::vector<TangentPiece> pieces;
  const double begins = law.pieces().front().from, ends = law.pieces().back().to;
  if (begins > 0.0) pieces.push_back({0.0, begins, {law.tangent(begins)}});
  for (const auto& piece : law.pieces())
    if (piece.to > 0.0) pieces.push_back({std::max(piece.from, 0.0), piece.to, piece.coefficient});
  if (ends <= 0.0) return {{0.0, never, {law.tangent(ends)}}};
  if (std::isfinite(ends)) pieces.push_back({ends, never, {law.tangent(ends)}});
  return pieces;
}

// Into the columns from `first` on.
template <int sides>
void look_up(const TangentLaw& law, int first, LookedUpLaw<sides>& packed) {
  std::fill_n(packed.from + first, LongLaw::most_pieces, never);
  packed.from[first] = 0.0;
  if (law.pieces().empty()) return;
  const auto pieces = from_zero(law);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const std::size_t p = first + k;
    packed.from[p] = pieces[k].from;
    packed.moment[p] = law.stress(pieces[k].from);
    const Polynomial stiffness = about(pieces[k].coefficient, pieces[k].from);
    for (std::size_t n = 0; n < stiffness.size(); ++n)
      packed.coefficient[n][p] = stiffness[n] / static_cast<double>(n + 1);
  }
}

}  // namespace

MomentShape moment_shape(const TangentLaw& law) {
  const auto& pieces = law.pieces();
  if (pieces.empty() || (pieces.size() == 1 && pieces[0].coefficient.size() == 1)) return MomentShape::constant;
  GeneralLaw packed;
  if (pack_law(law, packed)) return MomentShape::short_law;
  const int count = static_cast<int>(from_zero(law).size());
  if (count > LongLaw::most_pieces)
    throw InputError(fmt::format("material: a bending law has {} pieces, more than {}; join some of them", count,
                                 LongLaw::most_pieces));
  for (const auto& piece : pieces)
    if (piece.coefficient.size() > LongLaw::most_terms)
      throw InputError(
          fmt::format("material: a bending law has a stiffness of degree {} from {} /mm on, above 5; "
                      "give it in several pieces of a lower degree",
                      piece.coefficient.size() - 1, piece.from));
  return MomentShape::long_law;
}

MomentShape moment_shape(const BendingLaw& law) {
  const MomentShape face = moment_shape(law.face());
  if (law.is_odd()) return face;
  (void)moment_shape(law.back());  // complains
  return MomentShape::sided_law;
}

GeneralLaw packed_moment(const TangentLaw& law) {
  GeneralLaw packed;
  if (!law.pieces().empty() && !pack_law(law, packed)) throw InputError("material: a bending law is not a short one");
  return packed;
}

std::shared_ptr<const LongLaw> long_moment(const TangentLaw& law) {
  auto packed = std::make_shared<LongLaw>();
  *packed = {};
  look_up(law, 0, *packed);
  return packed;
}

std::shared_ptr<const SidedLaw> sided_moment(const BendingLaw& law) {
  auto packed = std::make_shared<SidedLaw>();
  *packed = {};
  look_up(law.face(), 0, *packed);
  look_up(law.back(), SidedLaw::most_pieces, *packed);
  return packed;
}

}  // namespace weaveform
