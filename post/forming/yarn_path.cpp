#include "post/forming/yarn_path.hpp"

namespace weaveform {

YarnPath yarn_path(const Mesh& mesh, Family family) {
  YarnPath path{std::vector<int>(mesh.node_count(), -1), std::vector<int>(mesh.node_count(), -1)};
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    if (mesh.yarns.family[e] != family || mesh.yarns.softening[e] == 0.0) continue;
    path.after[mesh.yarns.node[e][0]] = e;
    path.before[mesh.yarns.node[e][1]] = e;
  }
  return path;
}

}  // namespace weaveform
