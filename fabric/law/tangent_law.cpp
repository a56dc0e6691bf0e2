#include "fabric/law/tangent_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace weaveform {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void check_pieces(const std::vector<TangentPiece>& pieces) {
  if (pieces.empty()) throw InputError("tangent law: no pieces; give at least one");
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const TangentPiece& piece = pieces[i];
    const auto complain = [&](const std::string& what) {
      throw InputError(fmt::format("tangent law: piece {} from strain {}: {}", i + 1, piece.from, what));
    };
    const auto& c = piece.coefficient;
    if (c.empty()) complain("no coefficients; give at least the constant one");
    if (!std::all_of(c.begin(), c.end(), [](double x) { return std::isfinite(x); }))
      complain("a coefficient is not finite");
    if (!(piece.from < piece.to)) complain("it must end above its beginning");
    if (i > 0 && !std::isfinite(piece.from)) complain("only the first piece may have no beginning");
    const bool last = i + 1 == pieces.size();
    if (!last && !std::isfinite(piece.to)) complain("only the last piece may have no end");
    if (!last && piece.to != pieces[i + 1].from) {
      complain(
          fmt::format("it ends at {} but the next begins at {}; pieces must adjoin", piece.to, pieces[i + 1].from));
    }
  }
}

}  // namespace

TangentLaw::TangentLaw(std::vector<TangentPiece> pieces) : pieces_(std::move(pieces)) {
  check_pieces(pieces_);
  const TangentPiece& first = pieces_.front();
  const TangentPiece& last = pieces_.back();
  if (std::isfinite(first.from))
    segments_.push_back({-infinity, first.from, {value_of(first.coefficient, first.from)}, {}, {}});
  for (const auto& piece : pieces_) segments_.push_back({piece.from, piece.to, piece.coefficient, {}, {}});
  if (std::isfinite(last.to)) segments_.push_back({last.to, infinity, {value_of(last.coefficient, last.to)}, {}, {}});
  integrate();
}

// Integrates every segment, then chooses each constant so that the integral is continuous, then zero at zero strain.
void TangentLaw::integrate() {
  const auto join = [this](Polynomial Segment::*of, Polynomial Segment::*to) {
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      Segment& segment = segments_[i];
      segment.*to = integral_of(segment.*of);
      if (i == 0) continue;
      const double joint = segment.from;
      (segment.*to)[0] = value_of(segments_[i - 1].*to, joint) - value_of(segment.*to, joint);
    }
    const double at_zero = value_of(at(0.0).*to, 0.0);
    for (Segment& segment : segments_) (segment.*to)[0] -= at_zero;
  };
  join(&Segment::tangent, &Segment::stress);
  join(&Segment::stress, &Segment::energy);
}

const TangentLaw::Segment& TangentLaw::at(double strain) const {
  const auto found = std::find_if(segments_.begin(), segments_.end(), [&](const Segment& s) { return strain < s.to; });
  return found == segments_.end() ? segments_.back() : *found;
}

double TangentLaw::tangent(double strain) const {
  return segments_.empty() ? 0.0 : value_of(at(strain).tangent, strain);
}
double TangentLaw::stress(double strain) const {
  return segments_.empty() ? 0.0 : value_of(at(strain).stress, strain);
}
double TangentLaw::energy(double strain) const {
  return segments_.empty() ? 0.0 : value_of(at(strain).energy, strain);
}

double TangentLaw::stiffest(double from, double to) const {
  if (segments_.empty()) return 0.0;
  double greatest = -infinity;
  for (const Segment& segment : segments_) {
    if (segment.to < from || segment.from > to) continue;
    const double low = std::max(from, segment.from), high = std::min(to, segment.to);
    greatest = std::max(greatest, range_of(segment.tangent, low, high)[1]);
  }
  return greatest;
}

std::vector<Interval> TangentLaw::negative_intervals(double from, double to) const {
  std::vector<Interval> parts;
  for (const Segment& segment : segments_) {
    const double low = std::max(from, segment.from), high = std::min(to, segment.to);
    if (!(low < high)) continue;
    for (const Interval& part : weaveform::negative_intervals(segment.tangent, low, high)) {
      if (!parts.empty() && parts.back()[1] == part[0]) {
        parts.back()[1] = part[1];
      } else {
        parts.push_back(part);
      }
    }
  }
  return parts;
}

std::string TangentLaw::negative_range(double from, double to) const {
  std::string text;
  for (const Interval& part : negative_intervals(from, to)) {
    double least = infinity, where = part[0];
    for (const Segment& segment : segments_) {
      const double low = std::max(part[0], segment.from), high = std::min(part[1], segment.to);
      if (!(low < high)) continue;
      // The least value stands at an end or where the derivative changes sign.
      std::vector<double> candidates = sign_changes(derivative_of(segment.tangent), low, high);
      candidates.insert(candidates.end(), {low, high});
      for (const double strain : candidates) {
        if (!std::isfinite(strain)) continue;
        const double tangent_there = value_of(segment.tangent, strain);
        if (tangent_there < least) least = tangent_there, where = strain;
      }
    }
    text += fmt::format("{}e in [{:.4g}, {:.4g}]: least tangent {:.4g} MPa at {:.4g}", text.empty() ? "" : "; ",
                        part[0], part[1], least, where);
  }
  return text;
}

}  // namespace weaveform
