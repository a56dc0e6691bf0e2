#include "mesher/outline/loops.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "core/error.hpp"
#include "core/files/csv.hpp"
#include "core/files/files.hpp"
#include "core/log/plain_text.hpp"
#include "core/vector/vector.hpp"

namespace weaveform {
namespace {

constexpr int ellipse_corners = 720;  // the polygon leaves the ellipse by 1e-5 of its size
constexpr double closed = 1e-6;       // of the loop's extent: how near the last point must come to the first
constexpr std::size_t most_said = 5;  // of one kind; the rest is more of the same

std::string place_of(const OutlineLoop& loop, std::size_t k) {
  if (k < loop.place.size()) return loop.place[k];
  return fmt::format("corner {}", k + 1);
}

double extent_of(const OutlineLoop& loop) {
  Vec2 low = loop.point.front(), high = low;
  for (const auto& p : loop.point)
    for (int c = 0; c < 2; ++c) {
      low[c] = std::min(low[c], p[c]);
      high[c] = std::max(high[c], p[c]);
    }
  return std::max(high[0] - low[0], high[1] - low[1]);
}

bool between(double a, double b, double x) {
  return std::min(a, b) <= x && x <= std::max(a, b);
}

// Whether two segments share a point.
bool touch(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double d1 = turn_of(a, b, c), d2 = turn_of(a, b, d), d3 = turn_of(c, d, a), d4 = turn_of(c, d, b);
  if (((d1 > 0.0) != (d2 > 0.0)) && ((d3 > 0.0) != (d4 > 0.0)) && d1 != 0.0 && d2 != 0.0 && d3 != 0.0 && d4 != 0.0)
    return true;
  const auto on = [](const Vec2& p, const Vec2& q, const Vec2& r) {
    return between(p[0], q[0], r[0]) && between(p[1], q[1], r[1]);
  };
  return (d1 == 0.0 && on(a, b, c)) || (d2 == 0.0 && on(a, b, d)) || (d3 == 0.0 && on(c, d, a)) ||
         (d4 == 0.0 && on(c, d, b));
}

// Where the lines through a, b and c, d meet; of parallel ones the end that lies on the other.
Vec2 meeting_point(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double turn = (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0]);
  if (turn == 0.0) return turn_of(a, b, c) == 0.0 && between(a[0], b[0], c[0]) && between(a[1], b[1], c[1]) ? c : d;
  const double t = ((c[0] - a[0]) * (d[1] - c[1]) - (c[1] - a[1]) * (d[0] - c[0])) / turn;
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

struct Edge {
  std::size_t loop, corner;
  Vec2 from, to;
  double low, high;  // x
};

std::vector<Edge> edges_of(const std::vector<OutlineLoop>& loops) {
  std::vector<Edge> edges;
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (std::size_t k = 0; k < loops[l].point.size(); ++k) {
      const Vec2 &a = loops[l].point[k], &b = loops[l].point[(k + 1) % loops[l].point.size()];
      edges.push_back({l, k, a, b, std::min(a[0], b[0]), std::max(a[0], b[0])});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.low < b.low; });
  return edges;
}

bool neighbours(const Edge& a, const Edge& b, const std::vector<OutlineLoop>& loops) {
  if (a.loop != b.loop) return false;
  const std::size_t count = loops[a.loop].point.size();
  return a.corner == b.corner || (a.corner + 1) % count == b.corner || (b.corner + 1) % count == a.corner;
}

// Sweep over x: only edges that overlap there are compared.
void find_crossings(const std::vector<OutlineLoop>& loops, const std::string& what,
                    std::vector<std::string>& complaints) {
  const auto edges = edges_of(loops);
  std::size_t found = 0;
  for (std::size_t i = 0; i < edges.size() && found < most_said; ++i)
    for (std::size_t j = i + 1; j < edges.size() && edges[j].low <= edges[i].high && found < most_said; ++j) {
      if (neighbours(edges[i], edges[j], loops) || !touch(edges[i].from, edges[i].to, edges[j].from, edges[j].to))
        continue;
      ++found;
      const Vec2 at = meeting_point(edges[i].from, edges[i].to, edges[j].from, edges[j].to);
      complaints.push_back(fmt::format(
          "{}: the outline meets itself at ({:.6g}, {:.6g}): the edge from {} ({:.6g}, {:.6g}) crosses or touches the "
          "one from {} ({:.6g}, {:.6g}); put its corners in order around the blank",
          what, at[0], at[1], place_of(loops[edges[i].loop], edges[i].corner), edges[i].from[0], edges[i].from[1],
          place_of(loops[edges[j].loop], edges[j].corner), edges[j].from[0], edges[j].from[1]));
    }
}

bool encloses(const OutlineLoop& loop, const Vec2& p) {
  bool inside = false;
  for (std::size_t k = 0; k < loop.point.size(); ++k) {
    const Vec2 &a = loop.point[k], &b = loop.point[(k + 1) % loop.point.size()];
    if ((a[1] > p[1]) == (b[1] > p[1])) continue;
    if (p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
  }
  return inside;
}

// Repeated points add nothing but edges without a direction.
void drop_repeats(OutlineLoop& loop) {
  OutlineLoop kept;
  for (std::size_t k = 0; k < loop.point.size(); ++k) {
    if (!kept.point.empty() && kept.point.back() == loop.point[k]) continue;
    kept.point.push_back(loop.point[k]);
    if (k < loop.place.size()) kept.place.push_back(loop.place[k]);
  }
  while (kept.point.size() > 1 && kept.point.back() == kept.point.front()) {
    kept.point.pop_back();
    if (!kept.place.empty()) kept.place.pop_back();
  }
  loop = std::move(kept);
}

// Two numbers, parted by whichever delimiter.
std::optional<Vec2> read_point(std::string_view line) {
  const std::size_t found = line.find_first_of(",;\t");
  std::vector<std::string> cells = csv_cells(line, found == std::string_view::npos ? ' ' : line[found]);
  std::erase(cells, "");
  if (cells.size() != 2) return std::nullopt;
  Vec2 point{};
  for (std::size_t c = 0; c < 2; ++c) {
    const auto number = csv_number_in(cells[c], false);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    point[c] = *number;
  }
  return point;
}

// Troubles of one kind in a file: the first in full, the others counted.
class Troubles {
public:
  void add(const std::string& what) {
    if (count_++ == 0) first_ = what;
  }
  // `more` tells of the others: "{}" is their number.
  void tell(const std::string& more, std::vector<std::string>& complaints) const {
    if (count_ > 0)
      complaints.push_back(count_ == 1 ? first_ : first_ + fmt::format(fmt::runtime("; " + more), count_ - 1));
  }
  [[nodiscard]] bool any() const { return count_ > 0; }

private:
  std::size_t count_ = 0;
  std::string first_;
};

void close_loop(OutlineLoop& loop, std::vector<OutlineLoop>& loops, Troubles& open) {
  if (loop.point.empty()) return;
  const Vec2 &first = loop.point.front(), &last = loop.point.back();
  const double gap = distance(last, first);
  if (loop.point.size() < 4 || gap > closed * extent_of(loop)) {
    open.add(fmt::format(
        "{}: the outline is open: it ends {:.4g} mm from where it began at {} ({:.6g}, {:.6g}); repeat the first point "
        "to close it",
        loop.place.back(), gap, loop.place.front(), first[0], first[1]));
  } else {
    loop.point.pop_back();
    loop.place.pop_back();
    loops.push_back(loop);
  }
  loop = {};
}

// As much of a line as a message can hold; bytes that are no text as '?'.
std::string shown(std::string_view line) {
  constexpr std::size_t most = 40;
  std::string text(line.substr(0, most));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return line.size() > most ? text + "..." : text;
}

}  // namespace

double signed_area(const std::vector<Vec2>& point) {
  double twice = 0.0;
  for (std::size_t k = 1; k + 1 < point.size(); ++k) twice += turn_of(point[0], point[k], point[k + 1]);
  return 0.5 * twice;
}

std::vector<OutlineLoop> sound_loops(std::vector<OutlineLoop> loops, const std::string& what,
                                     std::vector<std::string>& complaints) {
  if (loops.empty() && complaints.empty()) complaints.push_back(what + ": no outline in it; give at least one loop");
  const std::size_t before = complaints.size();
  for (auto& loop : loops) {
    drop_repeats(loop);
    if (loop.point.size() < 3)
      complaints.push_back(
          fmt::format("{}: a loop of {} points has no area; give at least three", what, loop.point.size()));
  }
  if (complaints.size() > before) return {};
  // before the area: that of a bow-tie's two halves cancels
  find_crossings(loops, what, complaints);
  if (complaints.size() > before) return {};
  for (const auto& loop : loops)
    if (std::abs(signed_area(loop.point)) <= 1e-9 * extent_of(loop) * extent_of(loop))
      complaints.push_back(what + ": a loop's points lie on one line, it has no area");
  if (complaints.size() > before) return {};
  for (auto& loop : loops) {
    int depth = 0;
    for (const auto& other : loops) depth += &other != &loop && encloses(other, loop.point.front()) ? 1 : 0;
    const bool is_hole = depth % 2 == 1;
    if ((signed_area(loop.point) < 0.0) == is_hole) continue;
    std::reverse(loop.point.begin(), loop.point.end());
    std::reverse(loop.place.begin(), loop.place.end());
  }
  return loops;
}

std::vector<OutlineLoop> read_outline_csv(const std::string& file, std::vector<std::string>& complaints) {
  const std::string text = plain_text(read_text_file(file));
  std::vector<OutlineLoop> loops;
  OutlineLoop loop;
  Troubles wrong, open;
  bool heading_seen = false;
  for (TextLines lines(text); lines.advance();) {
    const std::string_view line = lines.line();
    const int number = lines.number();
    if (line.find_first_not_of(" \t,;") == std::string_view::npos) {
      close_loop(loop, loops, open);
      continue;
    }
    if (line[line.find_first_not_of(" \t")] == '#') continue;
    const auto point = read_point(line);
    if (!point) {
      if (!heading_seen && loops.empty() && loop.point.empty()) {
        heading_seen = true;
        continue;
      }
      wrong.add(
          fmt::format("{}:{}: '{}' is not a point; write x,y in mm with decimal points", file, number, shown(line)));
      continue;
    }
    loop.point.push_back(*point);
    loop.place.push_back(fmt::format("{}:{}", file, number));
  }
  close_loop(loop, loops, open);
  wrong.tell(
      "{} other lines are none either: is this an outline? CSV, DXF, STEP, IGES, BREP and .geo are read, by their "
      "endings",
      complaints);
  if (!wrong.any()) open.tell("{} other loops are open too", complaints);
  return loops;
}

// A regular polygon of n corners on radius r has the area n r^2 sin(2 pi/n)/2.
OutlineLoop ellipse_loop(const std::array<double, 2>& extent) {
  const double turn = 2.0 * std::numbers::pi / ellipse_corners;
  const double swell = std::sqrt(turn / std::sin(turn));
  OutlineLoop loop;
  for (int k = 0; k < ellipse_corners; ++k)
    loop.point.push_back(
        {0.5 * extent[0] * swell * std::cos((k + 0.5) * turn), 0.5 * extent[1] * swell * std::sin((k + 0.5) * turn)});
  return loop;
}

}  // namespace weaveform
