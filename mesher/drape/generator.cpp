#include "mesher/drape/generator.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace weaveform {
namespace {

using Eigen::Vector3d;

constexpr int steps_per_chord = 32;

// The march's plane through x: along the last step, and the surface's normal.
Circle march_circle(const DrapeSurface& surface, const Vector3d& x, const Vector3d& direction, double length,
                    int& hint) {
  const Vector3d normal = surface.normal(x, hint);
  const Vector3d tangent = (direction - direction.dot(normal) * normal).normalized();
  return {x, tangent, normal, length};
}

}  // namespace

std::optional<Vector3d> next_along(const DrapeSurface& surface, const Vector3d& x, const Vector3d& direction,
                                   double length, int& hint) {
  Vector3d next;
  const Circle circle = march_circle(surface, x, direction, length, hint);
  if (meet(surface, circle, next, hint) != CircleMeets::surface) return std::nullopt;
  return next;
}

Generator geodesic(const DrapeSurface& surface, const Vector3d& seed, const Vector3d& direction, double chord,
                   int count) {
  Generator result;
  int hint = 0;
  const double step = chord / steps_per_chord;
  Vector3d x = seed, ahead = direction;
  while (static_cast<int>(result.node.size()) < count) {
    const Vector3d last = result.node.empty() ? seed : result.node.back();
    const Circle circle = march_circle(surface, x, ahead, step, hint);
    Vector3d next;
    if (meet(surface, circle, next, hint) == CircleMeets::nothing) return result;
    if ((next - last).norm() >= chord) {
      // The node lies in this step: its length h such that |x(h) - last| = chord, by the secant method.
      double h0 = 0.0, h1 = step, f0 = (x - last).norm() - chord, f1 = (next - last).norm() - chord;
      Vector3d node = f0 > -1e-14 * chord ? x : next;
      for (int n = 0; n < 40 && node != x && std::abs(f1) > 4e-15 * chord && f1 != f0; ++n) {
        Circle part = circle;
        part.radius = std::clamp(h1 - f1 * (h1 - h0) / (f1 - f0), 1e-14 * step, 1.5 * step);
        Vector3d at;
        if (meet(surface, part, at, hint) == CircleMeets::nothing) break;
        h0 = h1;
        f0 = f1;
        h1 = part.radius;
        f1 = (at - last).norm() - chord;
        node = at;
      }
      result.node.push_back(node);
      result.beyond.push_back(surface.at(node, hint).beyond ? 1 : 0);
    }
    ahead = next - x;  // the march itself goes on in full steps, wherever nodes lie
    x = next;
  }
  return result;
}

Generator along_curve(const DrapeSurface& surface, const Vector3d& seed, const std::vector<Vector3d>& curve,
                      double chord, int count) {
  Generator result;
  int hint = 0;
  std::vector<Vector3d> point = {seed};
  point.insert(point.end(), curve.begin(), curve.end());
  const auto at = [&](std::size_t piece, double t, Vector3d& x) {
    x = (1.0 - t) * point[piece] + t * point[piece + 1];
    return project(surface, x, hint);  // a curve that leaves the surface ends there, the geodesic goes on
  };
  std::size_t piece = 0;
  double t = 0.0;
  Vector3d last = seed, before = seed;
  while (static_cast<int>(result.node.size()) < count) {
    // the first place ahead that is a chord away: found in small steps, closed in by halving
    double from = t;
    Vector3d x = last;
    bool found = false;
    while (piece + 1 < point.size() && !found) {
      const double length = (point[piece + 1] - point[piece]).norm();
      const double step = length > 0.0 ? std::min(1.0, chord / steps_per_chord / length) : 1.0;
      double to = std::min(1.0, from + step);
      if (!at(piece, to, x)) {
        piece = point.size();
        break;
      }
      if ((x - last).norm() >= chord) {
        for (int n = 0; n < 60; ++n) {
          const double middle = 0.5 * (from + to);
          if (!at(piece, middle, x)) break;
          ((x - last).norm() >= chord ? to : from) = middle;
        }
        t = to;
        found = at(piece, to, x);
      } else if (to >= 1.0) {
        ++piece;
        from = 0.0;
      } else {
        from = to;
      }
    }
    if (!found) {
      const Vector3d ahead = last == before ? x - last : last - before;
      Generator rest = geodesic(surface, last, ahead, chord, count - static_cast<int>(result.node.size()));
      result.node.insert(result.node.end(), rest.node.begin(), rest.node.end());
      result.beyond.insert(result.beyond.end(), rest.beyond.begin(), rest.beyond.end());
      return result;
    }
    before = last;
    last = x;
    result.node.push_back(x);
    result.beyond.push_back(0);
  }
  return result;
}

}  // namespace weaveform
