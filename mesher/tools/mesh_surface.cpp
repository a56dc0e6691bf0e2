#include "mesher/tools/mesh_surface.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "core/error.hpp"
#include "mesher/exchange/foreign_mesh.hpp"

namespace weaveform {

namespace {

double squared_distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

// A quadrilateral is cut along its shorter diagonal.
void add_shell(const ForeignMesh& mesh, const std::vector<int>& node, TriangleList& list) {
  if (node.size() == 3) {
    list.triangle.push_back({node[0], node[1], node[2]});
    return;
  }
  const auto x = [&](std::size_t k) { return mesh.position[node[k]]; };
  if (squared_distance(x(0), x(2)) <= squared_distance(x(1), x(3))) {
    list.triangle.push_back({node[0], node[1], node[2]});
    list.triangle.push_back({node[0], node[2], node[3]});
  } else {
    list.triangle.push_back({node[0], node[1], node[3]});
    list.triangle.push_back({node[1], node[2], node[3]});
  }
}

}  // namespace

MeshSurface read_mesh_surface(const std::filesystem::path& file, const std::string& name) {
  const ForeignMesh mesh = read_foreign_mesh(file);
  const std::vector<int> chosen = name.empty() ? std::vector<int>() : shells_named(mesh, name);
  MeshSurface surface{{mesh.position, {}}, mesh.notes};
  std::vector<std::array<int, 3>>& triangles = surface.list.triangle;
  for (const int shell : chosen) add_shell(mesh, mesh.shells[shell].node, surface.list);
  if (chosen.empty())
    for (const ForeignElement& shell : mesh.shells) add_shell(mesh, shell.node, surface.list);
  const auto lacks_a_corner = [](const std::array<int, 3>& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), lacks_a_corner), triangles.end());
  if (triangles.empty())
    throw InputError(file.string() +
                     ": no shell in it; a tool is made of three- and four-node shells (R3D3, R3D4, S3, S4R, ...)");
  require_sound(surface.list, file.string());
  return surface;
}

}  // namespace weaveform
