#include "mesher/outline/cad_outline.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>

#include "core/error.hpp"
#include "core/files/bytes.hpp"
#include "core/vector/vector.hpp"
#include "mesher/outline/join_curves.hpp"
#include "mesher/tools/gmsh_session.hpp"
#include "mesher/tools/triangles.hpp"

namespace weaveform {
namespace {

using Polyline = std::vector<Vec3>;

constexpr int most_chords = 1 << 16;  // of one curve; a tolerance that wants more is a slip of the pen
constexpr double joined = 1e-6;       // of the outline's extent: how near two curves' ends must lie
constexpr double flat = 1e-6;         // of the extent: how far points may leave the plane

Polyline sampled(int curve, double from, double to, int chords) {
  std::vector<double> parameter, coordinate;
  for (int k = 0; k <= chords; ++k) parameter.push_back(from + (to - from) * k / chords);
  gmsh::model::getValue(1, curve, parameter, coordinate);
  Polyline line;
  for (std::size_t k = 0; k + 2 < coordinate.size(); k += 3)
    line.push_back({coordinate[k], coordinate[k + 1], coordinate[k + 2]});
  return line;
}

// Chords are halved until the curve's own points lie within the tolerance of their middles; the error of a chord falls
// by four each time, so that the last look is on the safe side.
Polyline chords_of(int curve, double tolerance) {
  std::vector<double> low, high;
  gmsh::model::getParametrizationBounds(1, curve, low, high);
  std::string type;
  gmsh::model::getType(1, curve, type);
  if (type == "Line") return sampled(curve, low[0], high[0], 1);
  for (int chords = 4; chords < most_chords; chords *= 2) {
    const Polyline line = sampled(curve, low[0], high[0], chords), finer = sampled(curve, low[0], high[0], 2 * chords);
    double worst = 0.0;
    for (int k = 0; k < chords; ++k) {
      const Vec3 middle = {0.5 * (line[k][0] + line[k + 1][0]), 0.5 * (line[k][1] + line[k + 1][1]),
                           0.5 * (line[k][2] + line[k + 1][2])};
      worst = std::max(worst, distance(middle, finer[2 * k + 1]));
    }
    if (worst <= tolerance) return line;
  }
  return sampled(curve, low[0], high[0], most_chords);
}

// Curves that belong to one face only; between two faces the fabric goes on.
std::vector<int> boundary_curves() {
  gmsh::vectorpair faces, curves;
  gmsh::model::getEntities(faces, 2);
  std::vector<int> result;
  if (faces.empty()) {
    gmsh::model::getEntities(curves, 1);
    for (const auto& entity : curves) result.push_back(entity.second);
    return result;
  }
  std::map<int, int> uses;
  for (const auto& face : faces) {
    gmsh::vectorpair around;
    gmsh::model::getBoundary({face}, around, false, false, false);
    for (const auto& entity : around) ++uses[std::abs(entity.second)];
  }
  for (const auto& [curve, count] : uses)
    if (count == 1) result.push_back(curve);
  return result;
}

std::string encoded_boundary(double chord_tolerance) {
  const std::vector<int> curves = boundary_curves();
  ByteWriter bytes;
  bytes.value<std::uint64_t>(curves.size());
  for (const int curve : curves) bytes.list(chords_of(curve, chord_tolerance));
  return bytes.take();
}

// What a child sends is believed no more than the file it read.
std::vector<Polyline> decoded(const std::string& bytes, const std::string& file) {
  std::vector<Polyline> lines;
  try {
    ByteReader reader(bytes);
    for (std::size_t left = reader.count_of(sizeof(std::uint64_t)); left > 0; --left)
      lines.push_back(reader.list<Vec3>());
  } catch (const std::runtime_error& trouble) {
    throw InputError(
        fmt::format("{}: its curves came back in pieces ({}); write the file again", file, trouble.what()));
  }
  for (const Polyline& line : lines) {
    if (line.empty()) throw InputError(file + ": holds a curve without points; write the file again");
    for (const Vec3& point : line)
      for (const double x : point)
        if (!(std::abs(x) <= farthest_corner))
          throw InputError(fmt::format("{}: a curve runs to {} mm; lengths of an outline are within {:g} mm", file, x,
                                       farthest_corner));
  }
  return lines;
}

double extent_of(const std::vector<Polyline>& lines) {
  Vec3 low = {1e300, 1e300, 1e300}, high = {-1e300, -1e300, -1e300};
  for (const auto& line : lines)
    for (const auto& p : line)
      for (int c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], p[c]);
        high[c] = std::max(high[c], p[c]);
      }
  return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], 0.0});
}

}  // namespace

std::vector<OutlineLoop> read_cad_outline(const std::string& file, double chord_tolerance,
                                          std::vector<std::string>& complaints) {
  std::vector<Polyline> lines = decoded(with_gmsh(file, [&] { return encoded_boundary(chord_tolerance); }), file);
  if (lines.empty()) {
    complaints.push_back(file + ": no curve in it; an outline is a planar face or closed curves");
    return {};
  }
  const double extent = extent_of(lines), height = lines.front().front()[2];
  for (const auto& line : lines)
    for (const auto& p : line)
      if (std::abs(p[2] - height) > flat * extent) {
        complaints.push_back(
            fmt::format("{}: the outline leaves its plane, z = {:.6g} mm at ({:.6g}, {:.6g}) and {:.6g} "
                        "elsewhere; turn it into a plane of constant z",
                        file, p[2], p[0], p[1], height));
        return {};
      }
  std::vector<OutlineCurve> curves;
  for (const auto& line : lines) {
    curves.push_back({});
    for (const auto& p : line) curves.back().point.push_back({p[0], p[1]});
  }
  return join_curves(std::move(curves), joined * extent, file, complaints);
}

}  // namespace weaveform
