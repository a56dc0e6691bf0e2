#include "mesher/exchange/abaqus/inp_words.hpp"

#include <fmt/format.h>

#include "mesher/exchange/gathered.hpp"

namespace weaveform::foreign {

std::string num(double value) {
  return fit(value, 20);
}

void add_nodes(const Mesh& mesh, std::string& out) {
  out += "*NODE, NSET=ALL_NODES\n";
  for (int n = 0; n < mesh.node_count(); ++n) {
    const auto& x = mesh.nodes.position[n];
    out += fmt::format("{}, {}, {}, {}\n", n + 1, num(x[0]), num(x[1]), num(x[2]));
  }
}

void add_node_set(const std::string& name, const std::vector<int>& nodes, std::string& out) {
  if (nodes.empty()) return;
  out += fmt::format("*NSET, NSET={}\n", plain_name(name));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    out += fmt::format("{}{}", nodes[k] + 1, k + 1 == nodes.size() ? "\n" : (k % 16 == 15 ? ",\n" : ", "));
}

}  // namespace weaveform::foreign
