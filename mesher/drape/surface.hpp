// What a net is draped on: the zero level of a function, with its gradient. For a tool that is the signed distance less
// the offset of the fabric's middle plane from its face, so that a drape starts in contact and not inside the tool.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>

#include "mesher/drape/smooth_normals.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {

struct SurfacePoint {
  double value = 0.0;                                   // mm (or any unit that is smooth in x): 0 on the surface
  Eigen::Vector3d gradient = Eigen::Vector3d::UnitZ();  // outward, never zero near the surface
  // past a rim of an open surface or over a hole in it, where the surface is continued in its tangent plane: nothing
  // lies there, but the net can pass through
  bool beyond = false;
};

class DrapeSurface {
public:
  virtual ~DrapeSurface() = default;
  // `hint` is kept by the caller from point to point, for speed alone.
  [[nodiscard]] virtual SurfacePoint at(const Eigen::Vector3d& x, int& hint) const = 0;
  // Unit; what directions are carried along the surface with: the gradient's, but of triangles that of the surface they
  // stand for (smooth_normals.hpp).
  [[nodiscard]] virtual Eigen::Vector3d normal(const Eigen::Vector3d& x, int& hint) const {
    return at(x, hint).gradient.normalized();
  }
};

// A tool at its place at the start.
class ToolSurface : public DrapeSurface {
public:
  ToolSurface(Tool tool, double offset);
  [[nodiscard]] SurfacePoint at(const Eigen::Vector3d& x, int& hint) const override;
  [[nodiscard]] Eigen::Vector3d normal(const Eigen::Vector3d& x, int& hint) const override;

private:
  Tool tool_;
  double offset_;                                // mm
  std::shared_ptr<const SmoothNormals> smooth_;  // of triangles
};

// Any smooth function with its gradient, e.g. a height field z - h(x, y).
class ImplicitSurface : public DrapeSurface {
public:
  using Function = std::function<SurfacePoint(const Eigen::Vector3d&)>;
  explicit ImplicitSurface(Function function) : function_(std::move(function)) {}
  [[nodiscard]] SurfacePoint at(const Eigen::Vector3d& x, int& /*hint*/) const override { return function_(x); }

private:
  Function function_;
};

// The nearest point of the surface along its gradient (Newton). False when there is none near or it is past a rim.
[[nodiscard]] bool project(const DrapeSurface& surface, Eigen::Vector3d& x, int& hint);

// The point of a circle that lies on the surface: x(t) = centre + radius (cos t e1 + sin t e2), |t| < 2, the one
// nearest to t = 0 (Newton from there, a search for a change of sign when that fails). The radius is kept to rounding.
struct Circle {
  Eigen::Vector3d centre, e1, e2;
  double radius;  // mm
};
enum class CircleMeets { surface, nothing, past_rim };  // past_rim: the point lies beyond one
[[nodiscard]] CircleMeets meet(const DrapeSurface& surface, const Circle& circle, Eigen::Vector3d& x, int& hint);

}  // namespace weaveform
