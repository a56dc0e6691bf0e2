#include "mesher/drape/surface.hpp"

#include <algorithm>
#include <cmath>

namespace weaveform {
namespace {

using Eigen::Vector3d;

constexpr double tight = 1e-12;  // of the radius; lengths do not hang on it
constexpr double reach = 2.0;    // rad; a root further round the circle would turn the cell over

struct OnCircle {
  double value, slope;
  bool beyond;
};

Vector3d point_of(const Circle& c, double t) {
  return c.centre + c.radius * (std::cos(t) * c.e1 + std::sin(t) * c.e2);
}

OnCircle look(const DrapeSurface& surface, const Circle& c, double t, int& hint) {
  const SurfacePoint p = surface.at(point_of(c, t), hint);
  return {p.value, c.radius * p.gradient.dot(std::cos(t) * c.e2 - std::sin(t) * c.e1), p.beyond};
}

// Newton with a limited step: true with the root in t.
bool newton(const DrapeSurface& surface, const Circle& c, double& t, bool& beyond, int& hint) {
  double value_before = INFINITY;
  for (int n = 0; n < 25; ++n) {
    const OnCircle f = look(surface, c, t, hint);
    beyond = f.beyond;
    // rounding level reached: the value no longer falls
    if (std::abs(f.value) <= tight * c.radius || (n > 3 && std::abs(f.value) >= value_before && value_before < 1e-11))
      return true;
    if (!(std::abs(f.slope) > 1e-6 * c.radius)) return false;
    const double step = std::clamp(-f.value / f.slope, -0.5, 0.5);
    t += step;
    if (std::abs(t) > reach) return false;
    if (std::abs(step) < tight) return true;
    value_before = std::abs(f.value);
  }
  return value_before < 1e-11;
}

// The change of sign nearest to t = 0, closed in by halving.
bool search(const DrapeSurface& surface, const Circle& c, double& t, bool& beyond, int& hint) {
  constexpr int steps = 40;
  const auto value = [&](double at) { return look(surface, c, at, hint).value; };
  double before[2] = {value(0.0), 0.0};
  before[1] = before[0];
  for (int n = 1; n <= steps; ++n)
    for (const int side : {0, 1}) {
      const double sign = side == 0 ? 1.0 : -1.0;
      double from = sign * reach * (n - 1) / steps, to = sign * reach * n / steps;
      const double here = value(to);
      if (before[side] * here <= 0.0) {
        for (int k = 0; k < 60; ++k) {
          const double middle = 0.5 * (from + to);
          (value(middle) * before[side] > 0.0 ? from : to) = middle;
        }
        t = 0.5 * (from + to);
        beyond = look(surface, c, t, hint).beyond;
        return true;
      }
      before[side] = here;
    }
  return false;
}

}  // namespace

ToolSurface::ToolSurface(Tool tool, double offset) : tool_(std::move(tool)), offset_(offset) {
  if (tool_.shape == ToolShape::triangles) smooth_ = std::make_shared<SmoothNormals>(*tool_.surface);
}

Vector3d ToolSurface::normal(const Vector3d& x, int& hint) const {
  if (!smooth_) return at(x, hint).gradient.normalized();
  const auto& o = tool_.start.origin;
  const Vector3d local = x - Vector3d(o[0], o[1], o[2]);
  const SurfaceDistance found = tool_.surface->distance({local[0], local[1], local[2]}, hint);
  hint = found.triangle;
  if (found.beyond) {  // the surface goes on in the plane of its last triangle
    const auto plane = tool_.surface->face_normal(found.triangle);
    return {plane[0], plane[1], plane[2]};
  }
  return smooth_->at(found.triangle,
                     local - found.distance * Vector3d(found.normal[0], found.normal[1], found.normal[2]));
}

SurfacePoint ToolSurface::at(const Vector3d& x, int& hint) const {
  SurfacePoint point;
  if (tool_.shape == ToolShape::triangles) {
    const auto& o = tool_.start.origin;
    const SurfaceDistance found = tool_.surface->distance({x[0] - o[0], x[1] - o[1], x[2] - o[2]}, hint);
    hint = found.triangle;
    point.value = found.distance - offset_;
    point.gradient = {found.normal[0], found.normal[1], found.normal[2]};
    point.beyond = found.beyond;
    if (found.beyond) {
      // past a rim the surface goes on in the plane of its last triangle: x - distance * normal is the rim's
      // point
      const auto face = tool_.surface->face_normal(found.triangle);
      const Vector3d plane(face[0], face[1], face[2]);
      point.value = found.distance * plane.dot(point.gradient) - offset_;
      point.gradient = plane;
    }
    return point;
  }
  Distances out;
  tool_distances(tool_, tool_.start, {&x[0], &x[1], &x[2]}, 1, nullptr, out);
  point.value = out.distance[0] - offset_;
  point.gradient = {out.normal[0][0], out.normal[1][0], out.normal[2][0]};
  return point;
}

bool project(const DrapeSurface& surface, Vector3d& x, int& hint) {
  for (int n = 0; n < 50; ++n) {
    const SurfacePoint p = surface.at(x, hint);
    const double square = p.gradient.squaredNorm();
    if (!(square > 0.0)) return false;
    const Vector3d step = -p.value / square * p.gradient;
    x += step;
    if (step.norm() <= 1e-13 * (1.0 + x.norm())) return !p.beyond;
  }
  return false;
}

CircleMeets meet(const DrapeSurface& surface, const Circle& circle, Vector3d& x, int& hint) {
  double t = 0.0;
  bool beyond = false;
  if (!newton(surface, circle, t, beyond, hint)) {
    t = 0.0;
    if (!search(surface, circle, t, beyond, hint))
      return look(surface, circle, 0.0, hint).beyond ? CircleMeets::past_rim : CircleMeets::nothing;
  }
  x = point_of(circle, t);
  return beyond ? CircleMeets::past_rim : CircleMeets::surface;
}

}  // namespace weaveform
