#include "post/forming/tools_near.hpp"

#include <map>

namespace weaveform {
namespace {

// The part of a convex polygon on one side of a plane square to an axis (Sutherland and Hodgman 1974).
std::vector<Vec3> cut(const std::vector<Vec3>& polygon, std::size_t axis, double at, double side) {
  std::vector<Vec3> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double da = side * (a[axis] - at), db = side * (b[axis] - at);
    if (da >= 0.0) kept.push_back(a);
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) kept.push_back(plus(a, scaled(minus(b, a), da / (da - db))));
  }
  return kept;
}

class Surface {
public:
  void add(const std::vector<Vec3>& polygon) {
    for (std::size_t k = 1; k + 1 < polygon.size(); k += 2) {
      const bool four = k + 2 < polygon.size();
      mesh.face.push_back(
          {place(polygon[0]), place(polygon[k]), place(polygon[k + 1]), four ? place(polygon[k + 2]) : -1});
    }
  }
  foreign::ToolMesh mesh;

private:
  int place(const Vec3& x) {
    const auto [at, is_new] = places_.try_emplace(x, static_cast<int>(mesh.node.size()));
    if (is_new) mesh.node.push_back(x);
    return at->second;
  }
  std::map<Vec3, int> places_;
};

}  // namespace

foreign::ToolMesh cut_to_box(const foreign::ToolMesh& surface, const Vec3& low, const Vec3& high) {
  Surface inside;
  for (const auto& face : surface.face) {
    std::vector<Vec3> polygon;
    for (const int corner : face)
      if (corner >= 0) polygon.push_back(surface.node[static_cast<std::size_t>(corner)]);
    for (std::size_t axis = 0; axis < 3 && !polygon.empty(); ++axis)
      polygon = cut(cut(polygon, axis, low[axis], 1.0), axis, high[axis], -1.0);
    if (polygon.size() >= 3) inside.add(polygon);
  }
  return inside.mesh;
}

std::vector<NearTool> tools_near(const Resolved& model, const std::vector<Vec3>& moved, const Vec3& low,
                                 const Vec3& high) {
  constexpr double any_duration = 1.0;  // s; the surfaces are those at the start
  const auto gathered = foreign::gather(model.scene, model.card, model.mesh, model.tools, any_duration, "");
  const double room = room_around * distance(low, high);
  const Vec3 around = {room, room, room};
  std::vector<NearTool> near;
  for (std::size_t t = 0; t < gathered.tools.size(); ++t)
    near.push_back({model.scene.tools[t].name,
                    cut_to_box(mesh_of_tool(gathered, gathered.tools[t]), minus(minus(low, around), moved[t]),
                               minus(plus(high, around), moved[t]))});
  return near;
}

}  // namespace weaveform
