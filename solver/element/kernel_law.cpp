#include "solver/element/kernel_law.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <vector>

namespace weaveform {
namespace {

constexpr double unbounded = 1e30;  // strain; a finite stand-in for infinity, so that 0 * bound stays 0

double binomial(int n, int k) {
  double value = 1.0;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

// Coefficients of p(anchor + t) from those of p(e).
std::vector<double> shifted(const std::vector<double>& coefficient, double anchor) {
  std::vector<double> result(coefficient.size(), 0.0);
  for (int n = 0; n < static_cast<int>(coefficient.size()); ++n)
    for (int m = 0; m <= n; ++m) result[m] += coefficient[n] * binomial(n, m) * std::pow(anchor, n - m);
  return result;
}

// The law's pieces and, beyond both ends, the tangent there.
std::vector<TangentPiece> whole_line(const TangentLaw& law) {
  std::vector<TangentPiece> pieces = law.pieces();
  const double start = pieces.front().from, end = pieces.back().to;
  if (start > -unbounded) pieces.insert(pieces.begin(), {-unbounded, start, {law.tangent(start)}});
  if (end < unbounded) pieces.push_back({end, unbounded, {law.tangent(end)}});
  return pieces;
}

}  // namespace

bool pack_law(const TangentLaw& law, GeneralLaw& packed) {
  constexpr int most_pieces = std::extent_v<decltype(packed.anchor)>,
                most_terms = std::extent_v<decltype(packed.coefficient), 1>;
  const auto pieces = whole_line(law);
  if (static_cast<int>(pieces.size()) > most_pieces) return false;
  packed = {};
  for (int p = 0; p < static_cast<int>(pieces.size()); ++p) {
    const auto& piece = pieces[p];
    if (static_cast<int>(piece.coefficient.size()) > most_terms) return false;
    const double from = std::max(piece.from, -unbounded), to = std::min(piece.to, unbounded);
    const double anchor = std::clamp(0.0, from, to);
    packed.anchor[p] = anchor;
    packed.low[p] = from - anchor;
    packed.high[p] = to - anchor;
    // integral of C(anchor + t) dt from 0: c_n t^(n+1) / (n+1)
    const auto tangent = shifted(piece.coefficient, anchor);
    for (int n = 0; n < static_cast<int>(tangent.size()); ++n) packed.coefficient[p][n] = tangent[n] / (n + 1);
  }
  return true;
}

template <bool pressed>
bool pack_law(const TangentLaw& law, JointLaw<pressed>& packed) {
  packed = {};
  std::vector<TangentPiece> stretched;
  for (const TangentPiece& piece : whole_line(law)) {
    if (piece.from >= 0.0) {
      stretched.push_back(piece);
      continue;
    }
    if (piece.to > 0.0 || piece.from > -unbounded || piece.coefficient.size() > 1) return false;
    packed.slack = piece.coefficient.empty() ? 0.0 : piece.coefficient[0];
  }
  if (stretched.empty() || stretched.size() > 2) return false;
  const TangentPiece &first = stretched.front(), &last = stretched.back();
  if (first.from != 0.0 || first.coefficient.size() > std::size(packed.coefficient)) return false;
  packed.joint = std::min(first.to, unbounded);
  if (stretched.size() == 2) {
    if (last.coefficient.size() > 1) return false;
    packed.taut = last.coefficient.empty() ? 0.0 : last.coefficient[0];
  }
  for (std::size_t n = 0; n < first.coefficient.size(); ++n)
    packed.coefficient[n] = first.coefficient[n] / static_cast<double>(n + 1);
  return true;
}

template bool pack_law(const TangentLaw&, JointLaw<true>&);
template bool pack_law(const TangentLaw&, JointLaw<false>&);

}  // namespace weaveform
