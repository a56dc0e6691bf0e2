#include "mesher/outline/dxf_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "core/files/text_words.hpp"
#include "core/vector/angle.hpp"
#include "mesher/outline/dxf_shapes.hpp"

namespace weaveform {
namespace {

constexpr int most_nested = 8;                  // blocks within blocks
constexpr std::size_t most_points = 4'000'000;  // of all curves together
constexpr int most_inserts = 100'000;
constexpr double out_of_plane = 1e-6;  // of a coordinate: how far points may leave the plane

// What stands beside an outline without bounding it.
const std::set<std::string> annotation = {"TEXT",
                                          "MTEXT",
                                          "ATTDEF",
                                          "ATTRIB",
                                          "DIMENSION",
                                          "LEADER",
                                          "MULTILEADER",
                                          "MLEADER",
                                          "TOLERANCE",
                                          "HATCH",
                                          "VIEWPORT",
                                          "IMAGE",
                                          "POINT",
                                          "WIPEOUT",
                                          "OLE2FRAME",
                                          "OLEFRAME",
                                          "ACAD_TABLE",
                                          "RAY",
                                          "XLINE",
                                          "ARC_DIMENSION",
                                          "LARGE_RADIAL_DIMENSION",
                                          "ACAD_PROXY_ENTITY",
                                          "PDFUNDERLAY",
                                          "DWFUNDERLAY",
                                          "LIGHT",
                                          "SUN",
                                          "SEQEND"};

// From the place where an entity is written to the drawing's plane.
struct Placing {
  std::array<double, 2> x = {1.0, 0.0}, y = {0.0, 1.0}, origin = {0.0, 0.0};
  [[nodiscard]] DrawnPoint operator()(const DrawnPoint& p) const {
    return {origin[0] + p[0] * x[0] + p[1] * y[0], origin[1] + p[0] * x[1] + p[1] * y[1]};
  }
  [[nodiscard]] Placing after(const Placing& inner) const {  // first inner, then this
    Placing both;
    both.origin = (*this)(inner.origin);
    for (std::size_t c = 0; c < 2; ++c) {
      both.x[c] = inner.x[0] * x[c] + inner.x[1] * y[c];
      both.y[c] = inner.y[0] * x[c] + inner.y[1] * y[c];
    }
    return both;
  }
  [[nodiscard]] double stretch() const { return std::max(std::hypot(x[0], x[1]), std::hypot(y[0], y[1])); }
};

class CurveReader {
public:
  CurveReader(const DxfDrawing& drawing, double tolerance) : drawing_(drawing), tolerance_(tolerance) {}

  DxfCurves read() {
    read_list(drawing_.entities, {}, "", 0);
    for (const auto& [what, seen] : refused_)
      found_.complaints.push_back(fmt::format("{}:{}: {} on layer '{}'{}", drawing_.file, seen.line, what, seen.layer,
                                              seen.count > 1 ? fmt::format(" and {} more", seen.count - 1) : ""));
    return std::move(found_);
  }

private:
  struct Seen {
    int count = 0, line = 0;
    std::string layer;
  };

  [[noreturn]] void fail(int line, const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", drawing_.file, line, what));
  }
  double real(const DxfEntity& e, int code, double otherwise) const { return dxf_real(drawing_, e, code, otherwise); }
  long whole(const DxfEntity& e, int code, long otherwise) const { return dxf_whole(drawing_, e, code, otherwise); }
  DrawnPoint point(const DxfEntity& e, int x) const { return {real(e, x, 0.0), real(e, x + 10, 0.0)}; }

  void refuse(const DxfEntity& entity, const std::string& layer, const std::string& why) {
    Seen& seen = refused_[entity.type + " " + why];
    if (seen.count++ == 0) {
      seen.line = entity.line;
      seen.layer = layer;
    }
  }

  void read_list(const std::vector<DxfEntity>& entities, const Placing& placing, const std::string& around, int depth) {
    for (const DxfEntity& entity : entities) {
      std::string layer = entity.find(8) == nullptr ? "0" : entity.text(8);
      if (layer == "0" && !around.empty()) layer = around;  // of a block: on the layer of its INSERT
      if (drawing_.hidden.count(upper(layer)) != 0) continue;
      if (annotation.count(entity.type) != 0)
        ++found_.passed_over[entity.type];
      else if (entity.type == "INSERT")
        read_insert(entity, placing, layer, depth);
      else
        read_curve(entity, placing, layer);
    }
  }

  // Entities of a plane are written in it; seen from behind, x runs the other way.
  bool turned_over(const DxfEntity& entity, const std::string& layer, bool& readable) {
    const double x = real(entity, 210, 0.0), y = real(entity, 220, 0.0), z = real(entity, 230, 1.0);
    readable = std::hypot(x, y) <= out_of_plane * std::abs(z) && z != 0.0;
    if (!readable) refuse(entity, layer, "lies in another plane than the drawing's; turn it into z = 0");
    return z < 0.0;
  }

  // Of an entity with that plane: the way from there to the drawing.
  std::optional<Placing> plane_of(const DxfEntity& entity, const Placing& placing, const std::string& layer) {
    bool readable = false;
    Placing own;
    if (turned_over(entity, layer, readable)) own.x = {-1.0, 0.0};
    if (!readable) return std::nullopt;
    return placing.after(own);
  }

  void read_insert(const DxfEntity& entity, const Placing& placing, const std::string& layer, int depth) {
    const auto plane = plane_of(entity, placing, layer);
    if (!plane) return;
    if (whole(entity, 70, 1) > 1 || whole(entity, 71, 1) > 1)
      return refuse(entity, layer, "places a block in rows and columns; explode it");
    const auto block = drawing_.blocks.find(upper(entity.text(2)));
    if (block == drawing_.blocks.end())
      return refuse(entity, layer, fmt::format("names the block '{}', which is not in the file", entity.text(2)));
    if (depth >= most_nested) fail(entity.line, fmt::format("blocks within blocks more than {} deep", most_nested));
    if (++inserts_ > most_inserts) fail(entity.line, fmt::format("more than {} blocks are placed", most_inserts));
    const double turn = real(entity, 50, 0.0) * degree, a = real(entity, 41, 1.0), b = real(entity, 42, 1.0);
    Placing own;
    own.x = {a * std::cos(turn), a * std::sin(turn)};
    own.y = {-b * std::sin(turn), b * std::cos(turn)};
    const DrawnPoint at = point(entity, 10), &base = block->second.base;
    own.origin = {at[0] - own.x[0] * base[0] - own.y[0] * base[1], at[1] - own.x[1] * base[0] - own.y[1] * base[1]};
    read_list(block->second.entities, plane->after(own), layer, depth + 1);
  }

  void read_curve(const DxfEntity& entity, const Placing& placing, const std::string& layer) {
    if (entity.type == "LINE") return read_line(entity, placing, layer);
    if (entity.type == "SPLINE") return read_spline(entity, placing, layer);
    if (entity.type == "ELLIPSE") return read_ellipse(entity, placing, layer);
    const bool arc = entity.type == "ARC" || entity.type == "CIRCLE";
    if (!arc && entity.type != "LWPOLYLINE" && entity.type != "POLYLINE")
      return refuse(entity, layer, "is not read; explode it into lines, arcs and polylines");
    if (entity.type == "POLYLINE" && (whole(entity, 70, 0) & (16 | 64)) != 0)
      return refuse(entity, layer, "is a mesh of faces, no curve; draw its outline");
    const auto plane = plane_of(entity, placing, layer);
    if (!plane) return;
    if (arc)
      read_arc(entity, *plane, layer);
    else
      read_polyline(entity, *plane, layer);
  }

  void keep(const DxfEntity& entity, const Placing& placing, const std::string& layer,
            const std::vector<DrawnPoint>& line) {
    points_ += line.size();
    if (points_ > most_points) fail(entity.line, "more points than any outline has");
    DxfCurve curve{layer, entity.line, {}};
    for (const DrawnPoint& p : line) curve.point.push_back(placing(p));
    if (curve.point.size() > 1) found_.curve.push_back(std::move(curve));
  }

  // All that is drawn has to lie at one height.
  bool in_plane(const DxfEntity& entity, const std::string& layer, std::initializer_list<double> heights) {
    for (const double z : heights)
      if (std::abs(z - *heights.begin()) > out_of_plane * std::max(1.0, std::abs(z))) {
        refuse(entity, layer, "leaves the plane z = constant; flatten it");
        return false;
      }
    return true;
  }

  void read_line(const DxfEntity& entity, const Placing& placing, const std::string& layer) {
    if (in_plane(entity, layer, {real(entity, 30, 0.0), real(entity, 31, 0.0)}))
      keep(entity, placing, layer, {point(entity, 10), point(entity, 11)});
  }

  void read_arc(const DxfEntity& entity, const Placing& placing, const std::string& layer) {
    const double r = real(entity, 40, 0.0);
    if (!(r > 0.0)) fail(entity.line, fmt::format("{} of radius {:g}; it must be above 0", entity.type, r));
    double from = 0.0, sweep = 2.0 * std::numbers::pi;
    if (entity.type == "ARC") {
      from = real(entity, 50, 0.0) * degree;
      sweep = std::fmod(real(entity, 51, 360.0) * degree - from, 2.0 * std::numbers::pi);
      if (sweep <= 1e-12) sweep += 2.0 * std::numbers::pi;
    }
    keep(entity, placing, layer,
         elliptic_arc(point(entity, 10), {r, 0.0}, {0.0, r}, from, sweep, tolerance_ / placing.stretch()));
  }

  // The second axis is the ratio times the first, turned by 90 degrees about the normal.
  void read_ellipse(const DxfEntity& entity, const Placing& placing, const std::string& layer) {
    bool readable = false;
    const double side = turned_over(entity, layer, readable) ? -1.0 : 1.0;
    if (!readable || !in_plane(entity, layer, {0.0, real(entity, 31, 0.0)})) return;
    const DrawnPoint first = point(entity, 11);
    const double ratio = real(entity, 40, 1.0), from = real(entity, 41, 0.0);
    if (!(ratio > 0.0) || std::hypot(first[0], first[1]) == 0.0) fail(entity.line, "ELLIPSE without an extent");
    double sweep = std::fmod(real(entity, 42, 2.0 * std::numbers::pi) - from, 2.0 * std::numbers::pi);
    if (sweep <= 1e-9) sweep += 2.0 * std::numbers::pi;
    if (std::abs(sweep - 2.0 * std::numbers::pi) < 1e-6) sweep = 2.0 * std::numbers::pi;  // written to six digits
    keep(entity, placing, layer,
         elliptic_arc(point(entity, 10), first, {-side * ratio * first[1], side * ratio * first[0]}, from, sweep,
                      tolerance_ / placing.stretch()));
  }

  struct Corner {
    DrawnPoint at = {0.0, 0.0};
    double bulge = 0.0;
  };

  std::vector<Corner> corners_of(const DxfEntity& entity) const {
    std::vector<Corner> corners;
    for (const DxfPair& pair : entity.pairs) {  // of an LWPOLYLINE: 10 begins a corner
      if (pair.code == 10) corners.push_back({{dxf_real(drawing_, pair), 0.0}, 0.0});
      if (corners.empty()) continue;
      if (pair.code == 20) corners.back().at[1] = dxf_real(drawing_, pair);
      if (pair.code == 42) corners.back().bulge = dxf_real(drawing_, pair);
    }
    return corners;
  }

  void read_polyline(const DxfEntity& entity, const Placing& placing, const std::string& layer) {
    std::vector<Corner> corners;
    if (entity.type == "LWPOLYLINE") corners = corners_of(entity);
    double lowest = 0.0, highest = 0.0;
    for (const DxfEntity& vertex : entity.vertices) {
      if ((whole(vertex, 70, 0) & 16) != 0) continue;  // what a fitted spline was drawn from
      const double z = real(vertex, 30, 0.0);
      lowest = corners.empty() ? z : std::min(lowest, z);
      highest = corners.empty() ? z : std::max(highest, z);
      corners.push_back({point(vertex, 10), real(vertex, 42, 0.0)});
    }
    if (corners.size() < 2 || !in_plane(entity, layer, {lowest, highest})) return;
    std::vector<DrawnPoint> line = {corners.front().at};
    const std::size_t edges = corners.size() - ((whole(entity, 70, 0) & 1) != 0 ? 0 : 1);
    for (std::size_t k = 0; k < edges; ++k) {
      const auto arc = bulge_arc(corners[k].at, corners[(k + 1) % corners.size()].at, corners[k].bulge,
                                 tolerance_ / placing.stretch());
      line.insert(line.end(), arc.begin(), arc.end());
    }
    keep(entity, placing, layer, line);
  }

  void read_spline(const DxfEntity& entity, const Placing& placing, const std::string& layer) {
    Spline spline;
    std::vector<double> height;
    for (const DxfPair& pair : entity.pairs) {
      if (pair.code == 10) spline.control.push_back({dxf_real(drawing_, pair), 0.0});
      if (pair.code == 20 && !spline.control.empty()) spline.control.back()[1] = dxf_real(drawing_, pair);
      if (pair.code == 30) height.push_back(dxf_real(drawing_, pair));
      if (pair.code == 40) spline.knot.push_back(dxf_real(drawing_, pair));
      if (pair.code == 41) spline.weight.push_back(dxf_real(drawing_, pair));
    }
    if (spline.control.empty())
      return refuse(entity, layer, "has fit points alone, through which many curves go; explode it");
    spline.degree = static_cast<int>(std::clamp(whole(entity, 71, 3), -1L, 100L));
    if (spline.weight.empty()) spline.weight.assign(spline.control.size(), 1.0);
    const std::size_t n = spline.control.size();
    const auto p = static_cast<std::size_t>(std::max(spline.degree, 0));
    if (p < 1 || p > 25 || n <= p || spline.knot.size() != n + p + 1 || spline.weight.size() != n ||
        !std::is_sorted(spline.knot.begin(), spline.knot.end()) || !(spline.knot[n] > spline.knot[p]) ||
        std::any_of(spline.weight.begin(), spline.weight.end(), [](double w) { return !(w > 1e-12 && w < 1e12); }))
      fail(entity.line,
           fmt::format("SPLINE of degree {} with {} control points, {} knots and {} weights; knots must rise "
                       "and be as many as points + degree + 1, weights be positive",
                       spline.degree, n, spline.knot.size(), spline.weight.size()));
    if (!height.empty()) {
      const auto [low, high] = std::minmax_element(height.begin(), height.end());
      if (!in_plane(entity, layer, {*low, *high})) return;
    }
    keep(entity, placing, layer, spline_chords(spline, tolerance_ / placing.stretch()));
  }

  const DxfDrawing& drawing_;
  double tolerance_;
  DxfCurves found_;
  std::map<std::string, Seen> refused_;
  std::size_t points_ = 0;
  int inserts_ = 0;
};

}  // namespace

DxfCurves curves_of(const DxfDrawing& drawing, double tolerance) {
  return CurveReader(drawing, tolerance).read();
}

}  // namespace weaveform
