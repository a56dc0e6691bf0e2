#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "mesher/exchange/gathered.hpp"
#include "mesher/exchange/import.hpp"

namespace weaveform {

namespace {

[[noreturn]] void changed(const ForeignMesh& file, int line, const std::string& what) {
  throw InputError(
      fmt::format("{}{}: {}: changed since Weaveform wrote it; remove the weaveform lines and import it "
                  "with --scene",
                  file.file, line > 0 ? fmt::format(":{}", line) : "", what));
}

void check_nodes(const ForeignMesh& file, const Mesh& mesh, std::vector<int>& ours) {
  double extent = 0.0;
  for (const auto& x : mesh.nodes.position)
    for (const double c : x) extent = std::max(extent, std::abs(c));
  ours.assign(file.position.size(), -1);
  int found = 0;
  for (std::size_t k = 0; k < file.position.size(); ++k) {
    const long n = file.number[k] - 1;
    if (n < 0 || n >= mesh.node_count()) continue;  // a tool's reference node
    ours[k] = static_cast<int>(n);
    ++found;
    for (std::size_t c = 0; c < 3; ++c)
      if (std::abs(file.position[k][c] - mesh.nodes.position[static_cast<std::size_t>(n)][c]) > 1e-9 * extent)
        changed(file, 0, fmt::format("node {} has moved", n + 1));
  }
  if (found != mesh.node_count()) changed(file, 0, fmt::format("{} of {} nodes", found, mesh.node_count()));
}

void check_elements(const ForeignMesh& file, const Mesh& mesh, const std::vector<int>& ours) {
  const auto shells = foreign::shells_of(mesh.cells);
  const long last = mesh.yarn_count() + static_cast<long>(shells.size());  // a frame's members come after
  const auto own_lines = std::count_if(file.lines.begin(), file.lines.end(),
                                       [&](const ForeignElement& line) { return line.number <= last; });
  if (static_cast<std::size_t>(own_lines) != mesh.yarns.node.size() || file.shells.size() != shells.size())
    changed(file, 0,
            fmt::format("{} lines and {} shells instead of {} and {}", own_lines, file.shells.size(),
                        mesh.yarns.node.size(), shells.size()));
  const auto same = [&](const ForeignElement& element, const int* node, std::size_t size) {
    if (element.node.size() != size) return false;
    for (std::size_t k = 0; k < size; ++k)
      if (ours[element.node[k]] != node[k]) return false;
    return true;
  };
  for (const auto& line : file.lines) {
    if (line.number > last) continue;
    const long e = line.number - 1;
    if (e < 0 || e >= mesh.yarn_count() || !same(line, mesh.yarns.node[static_cast<std::size_t>(e)].data(), 2))
      changed(file, line.line, fmt::format("element {}", line.number));
  }
  for (const auto& shell : file.shells) {
    const long k = shell.number - 1 - mesh.yarn_count();
    if (k < 0 || k >= static_cast<long>(shells.size()) ||
        !same(shell, shells[static_cast<std::size_t>(k)].node.data(),
              static_cast<std::size_t>(shells[static_cast<std::size_t>(k)].size())))
      changed(file, shell.line, fmt::format("element {}", shell.number));
  }
}

// A set that the file names otherwise than the lines do was edited by hand.
void check_sets(const ForeignMesh& file, const Mesh& mesh, const std::vector<int>& ours) {
  for (const auto& set : mesh.sets) {
    if (set.node.empty()) continue;
    const auto found = std::find_if(file.node_sets.begin(), file.node_sets.end(), [&](const NodeSet& s) {
      return s.name == set.name || s.name == foreign::plain_name(set.name);
    });
    if (found == file.node_sets.end()) changed(file, 0, fmt::format("node set '{}' is gone", set.name));
    std::vector<int> member;
    for (const int n : found->node) member.push_back(ours[n]);
    std::sort(member.begin(), member.end());
    if (member != set.node) changed(file, 0, fmt::format("node set '{}'", set.name));
  }
}

}  // namespace

ImportedMesh import_own(const ForeignMesh& file) {
  if (file.weave.empty())
    throw InputError(
        fmt::format("{}: has no weaveform lines, so another program wrote it; give its fabric and motion "
                    "with --scene SCENE",
                    file.file));
  WovenMesh woven = read_weave_lines(file.weave, file.file);
  std::vector<int> ours;
  check_nodes(file, woven.mesh, ours);
  check_elements(file, woven.mesh, ours);
  check_sets(file, woven.mesh, ours);
  return {std::move(woven.mesh),
          std::move(woven.scene),
          {"written by Weaveform: taken as it was, bit for bit"},
          std::move(woven.scene_name)};
}

}  // namespace weaveform
