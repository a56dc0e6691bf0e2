#include "mesher/exchange/foreign_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/files/text_words.hpp"
#include "mesher/exchange/gathered.hpp"
#include "mesher/exchange/import.hpp"
#include "mesher/scene/scene_copy.hpp"

namespace weaveform {

namespace {

struct SetKeeper {
  const ForeignMesh& file;
  const Scene& scene;
  const std::vector<int>& ours;
  Mesh& mesh;
  std::vector<std::string>& notes;

  // Nodes of the fabric in the sets of that name. Sets of several parts may share it; those of other parts are empty.
  std::vector<int> grip_nodes(const std::string& name, std::vector<int>& taken, bool& known) const {
    std::vector<int> held;
    for (const auto& set : file.node_sets) {
      if (upper(set.name) != upper(name) && upper(set.name) != upper(foreign::plain_name(name))) continue;
      known = true;
      const std::vector<int> all = members(set);
      if (!held.empty() && !all.empty() && held != all)
        throw InputError(
            fmt::format("{}: grip '{}': two node sets of that name hold different nodes of the fabric, one "
                        "of its part and one of the assembly; rename one of them",
                        file.file, name));
      if (!all.empty()) held = all;
    }
    held.erase(std::remove_if(held.begin(), held.end(), [&](int n) { return taken[n] != 0; }), held.end());
    for (const int n : held) taken[n] = 1;  // the first grip wins where two meet
    return held;
  }

  void keep_grips() {
    std::vector<std::string> missing;
    std::vector<int> taken(mesh.nodes.position.size(), 0);
    for (const auto& grip : scene.grip) {
      bool known = false;
      mesh.sets.push_back({grip.name, grip_nodes(grip.name, taken, known)});
      if (!mesh.sets.back().node.empty()) continue;
      missing.push_back(fmt::format(
          "{}: grip '{}': {}", file.file, grip.name,
          known ? "its node set holds no node of the fabric" : "the mesh has no node set of that name" + known_sets()));
    }
    if (!missing.empty()) throw InputError(missing);
  }

  std::string known_sets() const {
    std::string names;
    int count = 0;
    for (const auto& set : file.node_sets) {
      if (members(set).empty() || is_internal(set)) continue;
      if (++count > 8) return "; its sets: " + names + ", ...";
      names += (names.empty() ? "'" : ", '") + set.name + "'";
    }
    return names.empty() ? "" : "; its sets: " + names;
  }

  bool is_internal(const NodeSet& set) const {
    return std::find(file.internal_sets.begin(), file.internal_sets.end(), upper(set.name)) != file.internal_sets.end();
  }

  void keep_sets() {
    keep_grips();
    for (const auto& set : file.node_sets) {
      const std::string name = upper(set.name);
      const auto same = [&](const NodeSet& s) {
        return upper(s.name) == name || upper(foreign::plain_name(s.name)) == name;
      };
      if (name == "WARP" || name == "WEFT" || name == "CELLS" || name == "ALL_NODES" || name == "OUTLINE" ||
          is_internal(set) || std::any_of(mesh.sets.begin(), mesh.sets.end(), same))
        continue;
      const std::vector<int> node = members(set);
      if (!node.empty())
        mesh.sets.push_back({set.name, node});
      else if (file.instance.size() == 1)  // else it is another part's
        notes.push_back(fmt::format("node set '{}' holds no node of the fabric; left out", set.name));
    }
    std::vector<int> elements(mesh.nodes.position.size(), 0);
    for (const auto& ends : mesh.yarns.node)
      for (const int n : ends) ++elements[n];
    NodeSet outline{"outline", {}};
    for (std::size_t n = 0; n < mesh.nodes.position.size(); ++n)
      if (elements[n] < 4) outline.node.push_back(static_cast<int>(n));
    mesh.sets.push_back(outline);
  }

  std::vector<int> members(const NodeSet& set) const {
    std::vector<int> node;
    for (const int n : set.node)
      if (ours[n] >= 0) node.push_back(ours[n]);
    std::sort(node.begin(), node.end());
    return node;
  }
};

}  // namespace

void keep_node_sets(const ForeignMesh& file, const Scene& scene, const std::vector<int>& ours, Mesh& mesh,
                    std::vector<std::string>& notes) {
  SetKeeper{file, scene, ours, mesh, notes}.keep_sets();
}

std::optional<std::string> tool_surface(const ForeignMesh& file, const std::string& tool) {
  std::string text = fmt::format("solid {} ({} import)\n", foreign::plain_name(tool), written_mark);
  const std::vector<int> shells = shells_named(file, tool);
  for (const int each : shells) {
    const ForeignElement& shell = file.shells[each];
    for (std::size_t k = 1; k + 1 < shell.node.size(); ++k) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int n : {shell.node[0], shell.node[k], shell.node[k + 1]})
        text += fmt::format("vertex {} {} {}\n", file.position[n][0], file.position[n][1], file.position[n][2]);
      text += "endloop\nendfacet\n";
    }
  }
  if (shells.empty()) return std::nullopt;
  return text + fmt::format("endsolid {}\n", foreign::plain_name(tool));
}

}  // namespace weaveform
