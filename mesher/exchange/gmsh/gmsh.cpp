// Gmsh MSH 4.1, ASCII. A node that belongs to node sets is a point entity of its own, in the physical group of each;
// warp and weft are curves, the cells a surface. Sections with names that Gmsh does not know are skipped by it.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mesher/exchange/weave_lines.hpp"
#include "mesher/exchange/writers.hpp"

namespace weaveform::foreign {

namespace {

struct Membership {
  std::vector<std::vector<int>> sets;  // per node: numbers of its sets, from 1
  std::vector<int> point;              // nodes that belong to any
};

Membership memberships(const Mesh& mesh) {
  Membership found{std::vector<std::vector<int>>(mesh.node_count()), {}};
  for (std::size_t s = 0; s < mesh.sets.size(); ++s)
    for (const int n : mesh.sets[s].node) found.sets[n].push_back(static_cast<int>(s) + 1);
  for (int n = 0; n < mesh.node_count(); ++n)
    if (!found.sets[n].empty()) found.point.push_back(n);
  return found;
}

std::string bounds(const Mesh& mesh) {
  std::array<double, 3> low = mesh.nodes.position.front(), high = low;
  for (const auto& x : mesh.nodes.position)
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], x[c]);
      high[c] = std::max(high[c], x[c]);
    }
  return fmt::format("{} {} {} {} {} {}", low[0], low[1], low[2], high[0], high[1], high[2]);
}

std::string quoted(std::string name) {
  std::replace(name.begin(), name.end(), '"', '\'');
  return name;
}

void add_names(const Mesh& mesh, std::string& out) {
  out += fmt::format("$PhysicalNames\n{}\n", mesh.sets.size() + 3);
  for (std::size_t s = 0; s < mesh.sets.size(); ++s)
    out += fmt::format("0 {} \"{}\"\n", s + 1, quoted(mesh.sets[s].name));
  out += "1 1 \"warp\"\n1 2 \"weft\"\n2 1 \"cells\"\n$EndPhysicalNames\n";
}

void add_entities(const Mesh& mesh, const Membership& member, std::string& out) {
  out += fmt::format("$Entities\n{} 2 1 0\n", member.point.size());
  for (const int n : member.point) {
    const auto& x = mesh.nodes.position[n];
    out += fmt::format("{} {} {} {} {} {} \n", n + 1, x[0], x[1], x[2], member.sets[n].size(),
                       fmt::join(member.sets[n], " "));
  }
  const std::string box = bounds(mesh);
  out += fmt::format("1 {0} 1 1 0 \n2 {0} 1 2 0 \n1 {0} 1 1 0 \n$EndEntities\n", box);
}

void add_nodes(const Mesh& mesh, const Membership& member, std::string& out) {
  const int count = mesh.node_count();
  std::vector<int> free;
  for (int n = 0; n < count; ++n)
    if (member.sets[n].empty()) free.push_back(n);
  const std::size_t blocks = member.point.size() + (free.empty() ? 0 : 1);
  out += fmt::format("$Nodes\n{} {} 1 {}\n", blocks, count, count);
  const auto place = [&](int n) {
    const auto& x = mesh.nodes.position[n];
    out += fmt::format("{} {} {}\n", x[0], x[1], x[2]);
  };
  for (const int n : member.point) {
    out += fmt::format("0 {0} 0 1\n{0}\n", n + 1);
    place(n);
  }
  if (!free.empty()) {
    out += fmt::format("2 1 0 {}\n", free.size());
    for (const int n : free) out += fmt::format("{}\n", n + 1);
    for (const int n : free) place(n);
  }
  out += "$EndNodes\n";
}

void add_elements(const Gathered& model, const Membership& member, std::string& out) {
  const Mesh& mesh = model.mesh;
  std::array<std::vector<int>, 2> family;
  for (int e = 0; e < mesh.yarn_count(); ++e) family[static_cast<std::size_t>(mesh.yarns.family[e])].push_back(e);
  std::array<std::vector<int>, 2> shells;  // triangles, quadrilaterals
  for (std::size_t k = 0; k < model.shells.size(); ++k)
    shells[model.shells[k].size() - 3].push_back(static_cast<int>(k));
  std::size_t blocks = member.point.size();
  for (const auto& group : {family[0], family[1], shells[0], shells[1]})
    if (!group.empty()) ++blocks;
  const int first_point = model.first_shell() + static_cast<int>(model.shells.size());
  const int last = first_point + static_cast<int>(member.point.size()) - 1;
  out += fmt::format("$Elements\n{} {} 1 {}\n", blocks, last, last);
  for (std::size_t k = 0; k < member.point.size(); ++k)
    out += fmt::format("0 {0} 15 1\n{1} {0} \n", member.point[k] + 1, first_point + static_cast<int>(k));
  for (std::size_t f = 0; f < 2; ++f) {
    if (family[f].empty()) continue;
    out += fmt::format("1 {} 1 {}\n", f + 1, family[f].size());
    for (const int e : family[f])
      out += fmt::format("{} {} {} \n", e + 1, mesh.yarns.node[e][0] + 1, mesh.yarns.node[e][1] + 1);
  }
  for (std::size_t t = 0; t < 2; ++t) {
    if (shells[t].empty()) continue;
    out += fmt::format("2 1 {} {}\n", t + 2, shells[t].size());
    for (const int k : shells[t]) {
      out += fmt::format("{} ", model.first_shell() + k);
      for (int c = 0; c < model.shells[k].size(); ++c) out += fmt::format("{} ", model.shells[k].node[c] + 1);
      out += "\n";
    }
  }
  out += "$EndElements\n";
}

// The elements' numbers in the order of add_elements: meshio takes data by their order, and must find as many.
std::vector<int> numbers_in_order(const Gathered& model, const Membership& member) {
  const Mesh& mesh = model.mesh;
  std::vector<int> numbers;
  const int first_point = model.first_shell() + static_cast<int>(model.shells.size());
  for (std::size_t k = 0; k < member.point.size(); ++k) numbers.push_back(first_point + static_cast<int>(k));
  for (const Family family : {Family::warp, Family::weft})
    for (int e = 0; e < mesh.yarn_count(); ++e)
      if (mesh.yarns.family[e] == family) numbers.push_back(e + 1);
  for (const int size : {3, 4})
    for (std::size_t k = 0; k < model.shells.size(); ++k)
      if (model.shells[k].size() == size) numbers.push_back(model.first_shell() + static_cast<int>(k));
  return numbers;
}

// 0 where there is no yarn.
void add_data(const Gathered& model, const Membership& member, std::string& out) {
  const Mesh& mesh = model.mesh;
  const std::vector<int> numbers = numbers_in_order(model, member);
  out += fmt::format("$ElementData\n1\n\"section_mm2\"\n1\n0\n3\n0\n1\n{}\n", numbers.size());
  for (const int number : numbers) {
    const int e = number - 1;
    out +=
        fmt::format("{} {}\n", number, e < mesh.yarn_count() ? mesh.yarns.section[e] * mesh.yarns.softening[e] : 0.0);
  }
  out += "$EndElementData\n";
}

}  // namespace

ExportedMesh write_gmsh(const Gathered& model) {
  ExportedMesh result{"", model.not_carried};
  auto& lost = result.not_carried;
  lost.push_back(
      "material, sections, thickness, ties, grips' motions and tools: a mesh file has none; node sets, yarn "
      "families and the element data section_mm2 are there, the rest is in a section of Weaveform's own");
  const Membership member = memberships(model.mesh);
  std::string& out = result.text;
  out = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\n" + header(model, "#", lost) + "$EndComments\n";
  add_names(model.mesh, out);
  add_entities(model.mesh, member, out);
  add_nodes(model.mesh, member, out);
  add_elements(model, member, out);
  add_data(model, member, out);
  out += "$Weaveform\n";
  for (const auto& line : weave_lines(model.scene, model.mesh)) out += line + "\n";
  out += "$EndWeaveform\n";
  return result;
}

}  // namespace weaveform::foreign
