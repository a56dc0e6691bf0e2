// MSH 2.2 and 4.1, in text and binary (Gmsh reference manual, "MSH file format").
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/files/text_words.hpp"
#include "mesher/exchange/foreign_mesh.hpp"
#include "mesher/exchange/gmsh/msh_data.hpp"
#include "mesher/exchange/gmsh/msh_types.hpp"

namespace weaveform {

namespace {

using Entity = std::pair<int, long>;  // dimension, tag

struct MshReader {
  MshData in;
  ForeignMesh mesh;
  bool old = false;                               // version 2.2
  std::map<Entity, std::string> group_name;       // by dimension and physical tag
  std::map<Entity, std::vector<long>> groups_of;  // physical tags of an entity; 4.1 alone
  std::map<long, int> place;                      // of a node by its number
  std::map<Entity, std::set<int>> group_nodes;
  std::map<Entity, std::set<int>> group_lines, group_shells;  // places in the mesh's lists
  std::map<std::pair<long, std::size_t>, int> numbered;       // element by number and nodes; 2.2 alone
  bool nodes_read = false;
  long volumes = 0, second_order = 0;

  explicit MshReader(const std::filesystem::path& file) : in(file) {
    mesh.file = in.name();
    mesh.files = {mesh.file};
  }

  void end(const std::string& section) {
    std::string_view line;
    do line = in.text_line();
    while (line.empty() && in.binary());  // binary data may end with a line break or without one
    if (line != "$End" + section) in.fail(fmt::format("$End{} expected; more lines than announced?", section));
  }

  void read_format() {
    const std::string first(in.text_line());
    const auto w = words_of(first);
    if (w.size() < 3) in.fail("version, file type and data size expected");
    old = w[0] == "2.2" || w[0] == "2.1" || w[0] == "2" || w[0] == "2.0";
    if (!old && w[0] != "4.1")
      in.fail(fmt::format("version {}: 2.2 and 4.1 are read; save it again with -format msh41 or msh22", w[0]));
    if (w[1] == "1") {
      if (w[2] != "8") in.fail(fmt::format("numbers of {} bytes; those of 8 are read", w[2]));
      read_byte_order();
    } else if (w[1] != "0") {
      in.fail(fmt::format("file type {}: 0 (text) or 1 (binary) expected", w[1]));
    }
    end("MeshFormat");
  }

  void read_byte_order() {
    in.set_binary(false);
    const long one = in.integer("byte order");
    if (one == 0x01000000)
      in.set_binary(true);
    else if (one != 1)
      in.fail("a binary file begins with the number 1, which is not there");
  }

  void read_names() {
    const long n = count_line("names");
    for (long k = 0; k < n; ++k) {
      const std::string line(in.text_line());
      const auto w = words_of(line);
      const std::size_t from = line.find('"'), to = line.rfind('"');
      long dimension = 0, tag = 0;
      if (w.size() < 3 || from == std::string::npos || to == from || !read_whole(w[0], dimension).empty() ||
          !read_whole(w[1], tag).empty())
        in.fail("dimension, tag and \"name\" expected");
      group_name[{static_cast<int>(dimension), tag}] = line.substr(from + 1, to - from - 1);
    }
    end("PhysicalNames");
  }

  void read_entities() {
    in.begin_record();
    std::array<long, 4> n{};
    for (long& each : n) each = in.count("points, curves, surfaces, volumes");
    in.end_record();
    for (int dimension = 0; dimension < 4; ++dimension)
      for (long k = 0; k < n[static_cast<std::size_t>(dimension)]; ++k) {
        in.begin_record();
        auto& groups = groups_of[{dimension, in.integer("tag")}];
        for (int c = 0; c < (dimension == 0 ? 3 : 6); ++c) (void)in.real("coordinate");
        const long tags = in.count("physical tags");
        for (long t = 0; t < tags; ++t) groups.push_back(std::abs(in.integer("physical tag")));
        if (!in.binary() || dimension == 0) continue;  // the rest of a text line is what bounds the entity
        const long bounds = in.count("bounding entities");
        in.skip(4 * static_cast<std::size_t>(bounds), "bounding entities");
      }
    end("Entities");
  }

  void add_node(long tag) {
    if (!place.emplace(tag, static_cast<int>(mesh.position.size())).second)
      in.fail(fmt::format("node {} is there twice", tag));
    mesh.number.push_back(tag);
    std::array<double, 3> x{};
    for (double& c : x) c = in.real("x y z");
    mesh.position.push_back(x);
  }

  // Of a section: a line of text in binary files too.
  long count_line(const std::string& what) {
    const std::string line(in.text_line());
    long n = 0;
    if (!read_whole(line, n).empty() || n < 0 || n > 100'000'000)
      in.fail(fmt::format("a number of {} expected, '{}' found", what, line.substr(0, 40)));
    return n;
  }

  void read_nodes() {
    nodes_read = true;
    if (old)
      read_nodes_2();
    else
      read_nodes_4();
    end("Nodes");
  }

  void read_nodes_2() {
    const long n = count_line("nodes");
    for (long k = 0; k < n; ++k) {
      in.begin_record();
      add_node(in.integer("node tag"));
      in.end_record();
    }
  }

  void read_nodes_4() {
    in.begin_record();
    const long blocks = in.count("blocks"), total = in.count("nodes");
    for (int k = 0; k < 2; ++k) (void)in.size("least and greatest tag");
    in.end_record();
    for (long b = 0; b < blocks; ++b) {
      in.begin_record();
      (void)in.integer("dimension");
      (void)in.integer("entity");
      if (in.integer("parametric") != 0) in.fail("parametric nodes are not read; save without them");
      const long n = in.count("nodes in block");
      in.end_record();
      std::vector<long> tags;
      for (long k = 0; k < n; ++k) {
        in.begin_record();
        tags.push_back(in.size("node tag"));
        in.end_record();
      }
      for (const long tag : tags) {
        in.begin_record();
        add_node(tag);
        in.end_record();
      }
    }
    if (total != static_cast<long>(mesh.position.size()))
      in.fail(fmt::format("{} nodes announced, {} found", total, mesh.position.size()));
  }

  MshType type_of(long type) const {
    const MshType found = msh_type(type);
    if (found.shape == MshShape::unknown)
      in.fail(
          fmt::format("element type {}: points (15), lines (1), triangles (2), quadrilaterals (3) and those of "
                      "second order (8, 9, 10, 16) are read; mesh with first order",
                      type));
    return found;
  }

  void read_elements() {
    if (!nodes_read) in.fail("$Elements before $Nodes");
    if (!old)
      read_elements_4();
    else if (in.binary())
      read_elements_2_binary();
    else
      read_elements_2();
    end("Elements");
  }

  void read_elements_4() {
    in.begin_record();
    const long blocks = in.count("blocks"), total = in.count("elements");
    for (int k = 0; k < 2; ++k) (void)in.size("least and greatest tag");
    in.end_record();
    long found = 0;
    for (long b = 0; b < blocks; ++b) {
      in.begin_record();
      const long dimension = in.integer("dimension"), tag = in.integer("entity");
      const MshType type = type_of(in.integer("element type"));
      const long n = in.count("elements in block");
      in.end_record();
      const auto groups = groups_of.find({static_cast<int>(dimension), tag});
      for (long k = 0; k < n; ++k, ++found) {
        in.begin_record();
        ForeignElement element{in.size("element tag"), in.line(), {}};
        read_element_nodes(type, element);
        in.end_record();
        add_element(type, std::move(element), static_cast<int>(dimension),
                    groups == groups_of.end() ? std::vector<long>{} : groups->second);
      }
    }
    if (total != found) in.fail(fmt::format("{} elements announced, {} found", total, found));
  }

  // In 2.2 the first tag of an element is its physical group, and an element of several groups stands several times.
  void read_elements_2() {
    const long n = count_line("elements");
    for (long k = 0; k < n; ++k) {
      in.begin_record();
      ForeignElement element{in.integer("element tag"), in.line(), {}};
      const MshType type = type_of(in.integer("element type"));
      const long tags = in.count("tags");
      std::vector<long> group;
      for (long t = 0; t < tags; ++t) {
        const long tag = in.integer("tag of the element");
        if (t == 0 && tag != 0) group.push_back(std::abs(tag));
      }
      read_element_nodes(type, element);
      in.end_record();
      add_element(type, std::move(element), dimension_of(type), group);
    }
  }

  void read_elements_2_binary() {
    const long n = count_line("elements");
    for (long found = 0; found < n;) {
      const MshType type = type_of(in.integer("element type"));
      const long block = in.count("elements in block", true), tags = in.count("tags", true);
      if (block < 1 || block > n - found)
        in.fail(fmt::format("a block of {} elements where {} are left", block, n - found));
      for (long k = 0; k < block; ++k, ++found) {
        ForeignElement element{in.integer("element tag"), 0, {}};
        std::vector<long> group;
        for (long t = 0; t < tags; ++t) {
          const long tag = in.integer("tag of the element");
          if (t == 0 && tag != 0) group.push_back(std::abs(tag));
        }
        read_element_nodes(type, element);
        add_element(type, std::move(element), dimension_of(type), group);
      }
    }
  }

  static int dimension_of(const MshType& type) {
    if (type.shape == MshShape::point) return 0;
    if (type.shape == MshShape::line) return 1;
    return type.shape == MshShape::volume ? 3 : 2;
  }

  void read_element_nodes(const MshType& type, ForeignElement& element) {
    for (int k = 0; k < type.nodes; ++k) {
      const long tag = old ? in.integer("node tag") : in.size("node tag");
      if (k >= type.corners) continue;
      const auto at = place.find(tag);
      if (at == place.end()) in.fail(fmt::format("element {} names node {}, which is not there", element.number, tag));
      element.node.push_back(at->second);
    }
  }

  void add_element(const MshType& type, ForeignElement element, int dimension, const std::vector<long>& groups) {
    if (type.shape == MshShape::volume) ++volumes;
    if (type.corners > 0 && type.nodes > type.corners) ++second_order;
    for (const long tag : groups) group_nodes[{dimension, tag}].insert(element.node.begin(), element.node.end());
    if (type.shape == MshShape::point || type.shape == MshShape::volume) return;
    const bool is_line = type.shape == MshShape::line;
    auto& list = is_line ? mesh.lines : mesh.shells;
    int at = static_cast<int>(list.size());
    // several times with one number and the same nodes: one element, of several groups
    const auto known =
        old ? numbered.emplace(std::pair{element.number, element.node.size()}, at) : std::pair{numbered.end(), true};
    const bool fresh = known.second || list[static_cast<std::size_t>(known.first->second)].node != element.node;
    if (!fresh) at = known.first->second;
    for (const long tag : groups) (is_line ? group_lines : group_shells)[{dimension, tag}].insert(at);
    if (fresh) list.push_back(std::move(element));
  }

  // Sections that are not the mesh's are passed over whole.
  void pass_over(const std::string& section) {
    const int begin = in.line();
    while (!in.at_end()) {
      const std::string_view line = in.text_line();
      if (line == "$End" + section) return;
      if (section == "Weaveform") mesh.weave.push_back({in.line(), std::string(line)});
    }
    in.fail(fmt::format("${}{} has no end; the file may have been cut short", section,
                        begin > 0 ? fmt::format(" (line {})", begin) : ""));
  }

  void collect_sets() {
    for (const auto& [group, nodes] : group_nodes) {
      const auto named = group_name.find(group);
      const std::string name =
          named == group_name.end() ? fmt::format("physical_{}_{}", group.first, group.second) : named->second;
      mesh.node_sets.push_back({name, {nodes.begin(), nodes.end()}});
      const auto &lines = group_lines[group], &shells = group_shells[group];
      if (lines.size() + shells.size() > 0)
        mesh.element_sets.push_back({name, {lines.begin(), lines.end()}, {shells.begin(), shells.end()}});
    }
    if (volumes > 0) mesh.notes.push_back(fmt::format("{} volume elements are left out", volumes));
    if (second_order > 0)
      mesh.notes.push_back(fmt::format("of {} elements of second order the corners are taken", second_order));
  }

  void read_section(const std::string& name) {
    if (name == "PhysicalNames")
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

  ForeignMesh read() {
    bool format = false;
    while (!in.at_end()) {
      const std::string section(in.text_line());
      if (section.empty()) continue;
      if (section[0] != '$' || section.size() < 2) in.fail("a section ($...) expected; is this a .msh file?");
      const std::string name = section.substr(1);
      if (name == "NOD") in.fail("version 1: 2.2 and 4.1 are read; save it again with -format msh41 or msh22");
      if (!format && name != "MeshFormat" && name != "Comments") in.fail("$MeshFormat must come first");
      if (name == "MeshFormat")
        read_format(), format = true;
      else
        read_section(name);
    }
    if (mesh.position.empty() || (mesh.lines.empty() && mesh.shells.empty()))
      in.fail("no nodes or no lines and shells in the file");
    collect_sets();
    return std::move(mesh);
  }
};

}  // namespace

ForeignMesh read_msh(const std::filesystem::path& file) {
  return MshReader(file).read();
}

}  // namespace weaveform
