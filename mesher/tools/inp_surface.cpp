#include "mesher/tools/inp_surface.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include "mesher/base/error.hpp"
#include "mesher/import/foreign_mesh.hpp"

namespace weaveform {

namespace {

bool same_but_for_case(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::set<long> shells_of_set(const ForeignMesh& mesh, const std::string& name) {
  std::set<long> listed, shells;
  for (const ElementSet& set : mesh.element_sets)
    if (!name.empty() && same_but_for_case(set.name, name)) listed.insert(set.element.begin(), set.element.end());
  for (const ForeignElement& shell : mesh.shells)
    if (listed.count(shell.number) != 0) shells.insert(shell.number);
  return shells;
}

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

TriangleList read_inp_surface(const std::filesystem::path& file, const std::string& set) {
  const ForeignMesh mesh = read_inp(file);
  const std::set<long> chosen = shells_of_set(mesh, set);
  TriangleList list;
  list.point = mesh.position;
  for (const ForeignElement& shell : mesh.shells)
    if (chosen.empty() || chosen.count(shell.number) != 0) add_shell(mesh, shell.node, list);
  const auto lacks_a_corner = [](const std::array<int, 3>& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
  list.triangle.erase(std::remove_if(list.triangle.begin(), list.triangle.end(), lacks_a_corner), list.triangle.end());
  if (list.triangle.empty())
    throw InputError(file.string() +
                     ": no shell in it; a tool is made of three- and four-node shells (R3D3, R3D4, S3, S4R, ...)");
  require_sound(list, file.string());
  return list;
}

}  // namespace weaveform
