#include "post/report/tools_json.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "post/forming/placed_tools.hpp"
#include "post/forming/tools_near.hpp"
#include "post/report/base64.hpp"

namespace weaveform {
namespace {

using Json = nlohmann::ordered_json;

Json surface_json(const std::string& name, const foreign::ToolMesh& surface) {
  std::vector<float> points;
  for (const Vec3& x : surface.node)
    for (const double component : x) points.push_back(static_cast<float>(component));
  std::vector<std::uint32_t> triangles;
  const auto add = [&](int a, int b, int c) {
    for (const int corner : {a, b, c}) triangles.push_back(static_cast<std::uint32_t>(corner));
  };
  for (const auto& face : surface.face) {
    add(face[0], face[1], face[2]);
    if (face[3] >= 0) add(face[0], face[2], face[3]);
  }
  return {{"name", name}, {"points", base64(points)}, {"triangles", base64(triangles)}, {"motion", Json::array()}};
}

}  // namespace

Json tools_json(ResultFolder& folder, const std::vector<FrameFile>& frames, const Vec3& low, const Vec3& high) {
  const Resolved& model = folder.model();
  Json tools = Json::array();
  if (model.tools.empty()) return tools;
  std::vector<Vec3> moved = displacements(model.tools, folder.history(), frames.back().time);
  for (const NearTool& tool : tools_near(model, moved, low, high))
    tools.push_back(surface_json(tool.name, tool.surface));
  for (const FrameFile& frame : frames) {
    moved = displacements(model.tools, folder.history(), frame.time);
    for (std::size_t t = 0; t < moved.size(); ++t) tools[t]["motion"].push_back(moved[t]);
  }
  return tools;
}

}  // namespace weaveform
