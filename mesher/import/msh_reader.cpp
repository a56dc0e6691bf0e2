// MSH 4.1, ASCII (Gmsh reference manual, "MSH file format").
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "mesher/import/foreign_mesh.hpp"
#include "mesher/import/text_lines.hpp"

namespace weaveform {

namespace {

using Entity = std::pair<int, long>;  // dimension, tag

struct MshReader {
  TextLines in;
  ForeignMesh mesh;
  std::map<Entity, std::string> group_name;       // by dimension and physical tag
  std::map<Entity, std::vector<long>> groups_of;  // physical tags of an entity
  std::map<long, int> place;                      // of a node by its number
  std::map<Entity, std::set<int>> group_nodes;
  std::map<Entity, std::vector<long>> group_elements;
  bool nodes_read = false;

  explicit MshReader(const std::filesystem::path& file) : in(file) { mesh.file = in.name(); }

  std::vector<std::string_view> words(std::size_t least, const std::string& what) {
    const auto found = words_of(in.next());
    if (found.size() < least) in.fail(fmt::format("{} numbers expected ({}), {} found", least, what, found.size()));
    return found;
  }
  long count(std::string_view word, const std::string& what) {
    const long value = in.whole(word, what);
    if (value < 0 || value > 100'000'000) in.fail(fmt::format("{} {} is out of range", value, what));
    return value;
  }
  void end(const std::string& section) {
    if (in.next() != "$End" + section) in.fail(fmt::format("$End{} expected; more lines than announced?", section));
  }

  void read_format() {
    const auto w = words(3, "version, file type, data size");
    if (w[0] != "4.1") in.fail(fmt::format("version {}: only 4.1 is read; save it with -format msh41", w[0]));
    if (w[1] != "0") in.fail("a binary file: only ASCII is read; save it without -bin");
    end("MeshFormat");
  }

  void read_names() {
    const long n = count(words(1, "number of names")[0], "names");
    for (long k = 0; k < n; ++k) {
      const std::string& line = in.next();
      const auto w = words_of(line);
      const std::size_t from = line.find('"'), to = line.rfind('"');
      if (w.size() < 3 || from == std::string::npos || to == from) in.fail("dimension, tag and \"name\" expected");
      group_name[{static_cast<int>(in.whole(w[0], "dimension")), in.whole(w[1], "tag")}] =
          line.substr(from + 1, to - from - 1);
    }
    end("PhysicalNames");
  }

  void read_entities() {
    const auto w = words(4, "numbers of points, curves, surfaces, volumes");
    const std::array<long, 4> n = {count(w[0], "points"), count(w[1], "curves"), count(w[2], "surfaces"),
                                   count(w[3], "volumes")};
    for (int dimension = 0; dimension < 4; ++dimension)
      for (long k = 0; k < n[static_cast<std::size_t>(dimension)]; ++k) {
        const std::size_t box = dimension == 0 ? 3 : 6;
        const auto e = words(box + 2, "tag, coordinates, number of physical tags");
        const long tags = count(e[box + 1], "physical tags");
        if (e.size() < box + 2 + static_cast<std::size_t>(tags)) in.fail("fewer physical tags than announced");
        auto& groups = groups_of[{dimension, in.whole(e[0], "tag")}];
        for (long t = 0; t < tags; ++t)
          groups.push_back(std::abs(in.whole(e[box + 2 + static_cast<std::size_t>(t)], "physical tag")));
      }
    end("Entities");
  }

  void read_nodes() {
    nodes_read = true;
    const auto w = words(4, "blocks, nodes, least and greatest tag");
    const long blocks = count(w[0], "blocks"), total = count(w[1], "nodes");
    for (long b = 0; b < blocks; ++b) {
      const auto h = words(4, "dimension, entity, parametric, nodes in block");
      if (h[2] != "0") in.fail("parametric nodes are not read; save without them");
      const long n = count(h[3], "nodes in block");
      std::vector<long> tags;
      for (long k = 0; k < n; ++k) tags.push_back(in.whole(words(1, "node tag")[0], "node tag"));
      for (const long tag : tags) {
        const auto x = words(3, "x y z");
        if (!place.emplace(tag, static_cast<int>(mesh.position.size())).second)
          in.fail(fmt::format("node {} is there twice", tag));
        mesh.number.push_back(tag);
        mesh.position.push_back({in.real(x[0], "x"), in.real(x[1], "y"), in.real(x[2], "z")});
      }
    }
    if (total != static_cast<long>(mesh.position.size()))
      in.fail(fmt::format("{} nodes announced, {} found", total, mesh.position.size()));
    end("Nodes");
  }

  void read_elements() {
    if (!nodes_read) in.fail("$Elements before $Nodes");
    static const std::map<long, std::size_t> size_of = {{1, 2}, {2, 3}, {3, 4}, {15, 1}};
    const auto w = words(4, "blocks, elements, least and greatest tag");
    const long blocks = count(w[0], "blocks"), total = count(w[1], "elements");
    long found = 0;
    for (long b = 0; b < blocks; ++b) {
      const auto h = words(4, "dimension, entity, type, elements in block");
      const Entity entity = {static_cast<int>(in.whole(h[0], "dimension")), in.whole(h[1], "entity")};
      const long type = in.whole(h[2], "element type"), n = count(h[3], "elements in block");
      const auto size = size_of.find(type);
      if (size == size_of.end())
        in.fail(
            fmt::format("element type {}: only points (15), lines (1), triangles (2) and quadrilaterals (3) are "
                        "read; mesh with first order and no volumes",
                        type));
      for (long k = 0; k < n; ++k, ++found) read_element(entity, size->second);
    }
    if (total != found) in.fail(fmt::format("{} elements announced, {} found", total, found));
    end("Elements");
  }

  void read_element(const Entity& entity, std::size_t size) {
    const auto w = words(size + 1, "tag and nodes");
    if (w.size() != size + 1) in.fail(fmt::format("an element of {} nodes has {} numbers", size, w.size() - 1));
    ForeignElement element{in.whole(w[0], "element tag"), in.number(), {}};
    for (std::size_t k = 1; k <= size; ++k) {
      const long tag = in.whole(w[k], "node tag");
      const auto at = place.find(tag);
      if (at == place.end()) in.fail(fmt::format("element {} names node {}, which is not there", element.number, tag));
      element.node.push_back(at->second);
    }
    for (const long tag : groups_of[entity]) {
      const Entity group = {entity.first, tag};
      group_nodes[group].insert(element.node.begin(), element.node.end());
      if (size > 1) group_elements[group].push_back(element.number);
    }
    if (size == 2)
      mesh.lines.push_back(std::move(element));
    else if (size > 2)
      mesh.shells.push_back(std::move(element));
  }

  // Sections that are not the mesh's are passed over whole.
  void pass_over(const std::string& section) {
    const int begin = in.number();
    while (!in.at_end()) {
      const std::string& line = in.next();
      if (line == "$End" + section) return;
      if (section == "Weaveform") mesh.weave.push_back({in.number(), line});
    }
    in.fail_at(begin, fmt::format("${} has no end; the file may have been cut short", section));
  }

  void collect_sets() {
    for (const auto& [group, nodes] : group_nodes) {
      const auto named = group_name.find(group);
      const std::string name =
          named == group_name.end() ? fmt::format("physical_{}_{}", group.first, group.second) : named->second;
      mesh.node_sets.push_back({name, {nodes.begin(), nodes.end()}});
      if (group_elements.count(group) != 0) mesh.element_sets.push_back({name, group_elements[group]});
    }
  }

  ForeignMesh read() {
    bool format = false;
    while (!in.at_end()) {
      const std::string section = std::string(trimmed(in.next()));
      if (section.empty()) continue;
      if (section[0] != '$' || section.size() < 2) in.fail("a section ($...) expected; is this a .msh file?");
      const std::string name = section.substr(1);
      if (!format && name != "MeshFormat" && name != "Comments") in.fail("$MeshFormat must come first");
      if (name == "MeshFormat")
        read_format(), format = true;
      else if (name == "PhysicalNames")
        read_names();
      else if (name == "Entities")
        read_entities();
      else if (name == "Nodes")
        read_nodes();
      else if (name == "Elements")
        read_elements();
      else if (name == "PartitionedEntities")
        in.fail("a partitioned mesh is not read; save the whole");
      else
        pass_over(name);
    }
    if (mesh.position.empty() || (mesh.lines.empty() && mesh.shells.empty()))
      in.fail("no nodes or no elements in the file");
    collect_sets();
    return std::move(mesh);
  }
};

}  // namespace

ForeignMesh read_msh(const std::filesystem::path& file) {
  return MshReader(file).read();
}

}  // namespace weaveform
