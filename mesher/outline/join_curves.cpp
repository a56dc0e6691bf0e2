#include "mesher/outline/join_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "core/vector/vector.hpp"

namespace weaveform {
namespace {

constexpr std::size_t most_complaints = 3;  // of one kind
constexpr std::size_t most_there = 64;      // ends at one place: a scribble that is refused anyway

// End e of curve e / 2: its first point when e is even, else its last.
class Ends {
public:
  Ends(const std::vector<OutlineCurve>& curves, double near) : curves_(curves), near_(near) {
    for (std::size_t e = 0; e < 2 * curves.size(); ++e) at_[key(cell(point(e)))].push_back(e);
  }
  [[nodiscard]] const Vec2& point(std::size_t e) const {
    const auto& line = curves_[e / 2].point;
    return e % 2 == 0 ? line.front() : line.back();
  }
  // Other ends there, rising; of more than `most_there` only some.
  [[nodiscard]] std::vector<std::size_t> others(std::size_t e) const {
    std::vector<std::size_t> found;
    const auto [i, j] = cell(point(e));
    for (std::int64_t a = i - 1; a <= i + 1; ++a)
      for (std::int64_t b = j - 1; b <= j + 1; ++b) {
        const auto here = at_.find(key({a, b}));
        if (here == at_.end()) continue;
        for (const std::size_t other : here->second)
          if (other != e && found.size() < most_there && distance(point(other), point(e)) <= near_)
            found.push_back(other);
      }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());  // two cells may share a key
    return found;
  }
  [[nodiscard]] double gap(std::size_t e) const {
    double least = std::numeric_limits<double>::max();
    for (std::size_t other = 0; other < 2 * curves_.size(); ++other)
      if (other != e) least = std::min(least, distance(point(other), point(e)));
    return least;
  }

private:
  using Cell = std::array<std::int64_t, 2>;
  [[nodiscard]] Cell cell(const Vec2& p) const {
    return {static_cast<std::int64_t>(std::floor(p[0] / near_)), static_cast<std::int64_t>(std::floor(p[1] / near_))};
  }
  static std::uint64_t key(const Cell& c) {
    return static_cast<std::uint64_t>(c[0]) * 0x9E3779B97F4A7C15U + static_cast<std::uint64_t>(c[1]);
  }
  const std::vector<OutlineCurve>& curves_;
  double near_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> at_;
};

bool same_points(const std::vector<Vec2>& a, const std::vector<Vec2>& b, double near) {
  const auto close = [near](const Vec2& p, const Vec2& q) { return distance(p, q) <= near; };
  return a.size() == b.size() &&
         (std::equal(a.begin(), a.end(), b.begin(), close) || std::equal(a.begin(), a.end(), b.rbegin(), close));
}

bool is_closed(const OutlineCurve& curve, double near) {
  return distance(curve.point.front(), curve.point.back()) <= near;
}

bool is_nothing(const OutlineCurve& curve, double near) {
  return std::all_of(curve.point.begin(), curve.point.end(),
                     [&](const Vec2& p) { return distance(p, curve.point.front()) <= near; });
}

// Curves that begin where another one does and go the same way.
void drop_doubles(std::vector<OutlineCurve>& curves, double near) {
  const Ends ends(curves, near);
  std::vector<bool> gone(curves.size(), false);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    if (gone[k]) continue;
    for (const std::size_t end : ends.others(2 * k)) {
      const std::size_t other = end / 2;
      if (other > k && !gone[other] && same_points(curves[k].point, curves[other].point, near)) gone[other] = true;
    }
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < curves.size(); ++k)
    if (!gone[k]) {
      if (kept != k) curves[kept] = std::move(curves[k]);
      ++kept;
    }
  curves.resize(kept);
}

void complain(const std::vector<OutlineCurve>& curves, const Ends& ends, const std::string& what,
              std::vector<std::string>& complaints) {
  std::size_t open = 0, branched = 0;
  for (std::size_t e = 0; e < 2 * curves.size(); ++e) {
    const auto others = ends.others(e);
    const Vec2& p = ends.point(e);
    const std::string& place = curves[e / 2].place.empty() ? what : curves[e / 2].place;
    if (others.empty() && ++open <= most_complaints)
      complaints.push_back(
          fmt::format("{}: the outline is open at ({:.6g}, {:.6g}); close it: {:.4g} mm are missing to "
                      "the next curve's end",
                      place, p[0], p[1], ends.gap(e)));
    if (others.size() > 1 && others.front() > e && ++branched <= most_complaints)
      complaints.push_back(
          fmt::format("{}: {} curves meet at ({:.6g}, {:.6g}), so that it is not told how the outline "
                      "goes on; leave two",
                      place, others.size() + 1, p[0], p[1]));
  }
  if (open > most_complaints)
    complaints.push_back(fmt::format("{}: {} ends of curves are open, the first were named", what, open));
  if (branched > most_complaints)
    complaints.push_back(
        fmt::format("{}: more than two curves meet in {} places, the first were named", what, branched));
}

OutlineLoop loop_of(const OutlineCurve& curve) {
  OutlineLoop loop;
  loop.point.assign(curve.point.begin(), curve.point.end() - 1);
  if (!curve.place.empty()) loop.place.assign(loop.point.size(), curve.place);
  return loop;
}

// Every end meets one other: from curve to curve until all are used.
std::vector<OutlineLoop> walk(const std::vector<OutlineCurve>& curves, const Ends& ends) {
  std::vector<OutlineLoop> loops;
  std::vector<bool> used(curves.size(), false);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    OutlineLoop loop;
    for (std::size_t from = 2 * k; !used[from / 2]; from = ends.others(from ^ 1U).front()) {
      const OutlineCurve& curve = curves[from / 2];
      used[from / 2] = true;
      if (from % 2 == 0)
        loop.point.insert(loop.point.end(), curve.point.begin(), curve.point.end() - 1);
      else
        loop.point.insert(loop.point.end(), curve.point.rbegin(), curve.point.rend() - 1);
      if (!curve.place.empty()) loop.place.resize(loop.point.size(), curve.place);
    }
    if (!loop.point.empty()) loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

std::vector<OutlineLoop> join_curves(std::vector<OutlineCurve> curves, double near, const std::string& what,
                                     std::vector<std::string>& complaints) {
  double farthest = 0.0;
  for (const auto& curve : curves)
    for (const auto& p : curve.point) farthest = std::max({farthest, std::abs(p[0]), std::abs(p[1])});
  // no finer than the numbers are, so that the cells of Ends can be counted
  near = std::max({near, 1e-12 * farthest, std::numeric_limits<double>::min()});
  curves.erase(std::remove_if(curves.begin(), curves.end(), [&](const auto& c) { return is_nothing(c, near); }),
               curves.end());
  drop_doubles(curves, near);
  std::vector<OutlineLoop> loops;
  std::vector<OutlineCurve> open;
  for (auto& curve : curves) {
    if (is_closed(curve, near))
      loops.push_back(loop_of(curve));
    else
      open.push_back(std::move(curve));
  }
  const Ends ends(open, near);
  const std::size_t before = complaints.size();
  complain(open, ends, what, complaints);
  if (complaints.size() > before) return {};
  for (OutlineLoop& loop : walk(open, ends)) loops.push_back(std::move(loop));
  return loops;
}

}  // namespace weaveform
