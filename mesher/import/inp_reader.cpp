// Abaqus input: keyword lines begin with '*', comments with '**'; data lines are separated by commas.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "mesher/base/error.hpp"
#include "mesher/import/foreign_mesh.hpp"
#include "mesher/import/text_lines.hpp"

namespace weaveform {

namespace {

const std::string weave_mark = "** weaveform ";

struct InpReader {
  TextLines in;
  ForeignMesh mesh;
  std::map<long, int> place;  // of a node by its number
  std::set<long> element_numbers;
  std::map<std::string, std::set<int>> node_sets;  // by upper-case name
  std::map<std::string, std::vector<long>> element_sets;
  std::vector<std::string> node_set_order, element_set_order;  // as first written
  long generated = 0;                                          // members of sets that were not written out
  std::map<std::string, std::string> parameter;                // of the keyword at hand, upper-case names

  explicit InpReader(const std::filesystem::path& file) : in(file) { mesh.file = in.name(); }

  std::set<int>& node_set(const std::string& name) {
    if (node_sets.count(upper(name)) == 0) node_set_order.push_back(name);
    return node_sets[upper(name)];
  }
  std::vector<long>& element_set(const std::string& name) {
    if (element_sets.count(upper(name)) == 0) element_set_order.push_back(name);
    return element_sets[upper(name)];
  }

  // Takes the next data line into `line`; false at a keyword or the end. Comments in between are passed over.
  bool data(std::string& line) {
    while (!in.at_end()) {
      const std::string& ahead = in.peek();
      if (ahead.compare(0, 2, "**") == 0) {
        comment(in.next());
        continue;
      }
      if (!ahead.empty() && ahead[0] == '*') return false;
      line = in.next();
      if (!trimmed(line).empty()) return true;
    }
    return false;
  }
  void comment(const std::string& line) {
    if (line.compare(0, weave_mark.size(), weave_mark) == 0)
      mesh.weave.push_back({in.number(), line.substr(weave_mark.size())});
  }

  std::string keyword(const std::string& line) {
    parameter.clear();
    auto fields = fields_of(line, ',');
    for (std::size_t k = 1; k < fields.size(); ++k) {
      const std::size_t equal = fields[k].find('=');
      const std::string value =
          equal == std::string_view::npos ? "" : std::string(trimmed(fields[k].substr(equal + 1)));
      parameter[upper(trimmed(fields[k].substr(0, equal)))] =
          value.size() > 1 && value.front() == '"' && value.back() == '"' ? value.substr(1, value.size() - 2) : value;
    }
    return upper(fields[0]);
  }

  void read_nodes() {
    std::set<int>* set = parameter.count("NSET") != 0 ? &node_set(parameter["NSET"]) : nullptr;
    if (parameter.count("SYSTEM") != 0 && upper(parameter["SYSTEM"]) != "R")
      in.fail("*NODE, SYSTEM: only rectangular coordinates are read");
    for (std::string line; data(line);) {
      auto f = fields_of(line, ',');
      if (!f.empty() && f.back().empty()) f.pop_back();
      if (f.size() != 4)
        in.fail(fmt::format("a node's number and three coordinates expected, {} fields found", f.size()));
      const long number = in.whole(f[0], "node number");
      if (!place.emplace(number, static_cast<int>(mesh.position.size())).second)
        in.fail(fmt::format("node {} is there twice", number));
      mesh.number.push_back(number);
      mesh.position.push_back({in.real(f[1], "x"), in.real(f[2], "y"), in.real(f[3], "z")});
      if (set != nullptr) set->insert(place[number]);
    }
  }

  void read_elements() {
    static const std::map<std::string, std::size_t> size_of = {{"T3D2", 2}, {"B31", 2},  {"M3D3", 3}, {"S3", 3},
                                                               {"S3R", 3},  {"R3D3", 3}, {"M3D4", 4}, {"M3D4R", 4},
                                                               {"S4", 4},   {"S4R", 4},  {"R3D4", 4}, {"MASS", 1}};
    const std::string type = upper(parameter["TYPE"]);
    const auto size = size_of.find(type);
    if (size == size_of.end())
      in.fail(
          fmt::format("element type '{}' is not read; known are T3D2, B31, M3D3, M3D4, M3D4R, S3, S3R, S4, S4R, "
                      "R3D3, R3D4",
                      type));
    const std::string set = parameter["ELSET"];
    for (std::string line; data(line);) {
      auto f = fields_of(line, ',');
      if (!f.empty() && f.back().empty()) f.pop_back();
      if (f.size() != size->second + 1)
        in.fail(fmt::format("an element of type {} has a number and {} nodes, {} fields found", type, size->second,
                            f.size()));
      ForeignElement element{in.whole(f[0], "element number"), in.number(), {}};
      if (!element_numbers.insert(element.number).second)
        in.fail(fmt::format("element {} is there twice", element.number));
      for (std::size_t k = 1; k < f.size(); ++k) {
        const long number = in.whole(f[k], "node number");
        const auto at = place.find(number);
        if (at == place.end())
          in.fail(fmt::format("element {} names node {}, which is not there (nodes must come first)", element.number,
                              number));
        element.node.push_back(at->second);
      }
      if (!set.empty()) element_set(set).push_back(element.number);
      if (size->second == 2)
        mesh.lines.push_back(std::move(element));
      else if (size->second > 2)
        mesh.shells.push_back(std::move(element));
    }
  }

  // Numbers of one data line of a set, or the names of other sets given to `named`.
  template <class Add, class Named>
  void read_set(Add add, Named named) {
    const bool generate = parameter.count("GENERATE") != 0;
    for (std::string line; data(line);) {
      auto f = fields_of(line, ',');
      if (!f.empty() && f.back().empty()) f.pop_back();
      if (generate) {
        if (f.size() < 2 || f.size() > 3) in.fail("first, last and increment expected");
        const long first = in.whole(f[0], "first"), last = in.whole(f[1], "last");
        const long step = f.size() == 3 ? in.whole(f[2], "increment") : 1;
        if (step < 1 || last < first) in.fail("an increment above 0 and a last number not below the first expected");
        constexpr long greatest = 1'000'000'000'000, most = 10'000'000;  // numbers; members of all sets together
        if (first < -greatest || last > greatest || step > greatest) in.fail("numbers beyond those of any mesh");
        generated += (last - first) / step + 1;
        if (generated > most) in.fail("more members than any mesh has");
        for (long k = first; k <= last; k += step) add(k);
        continue;
      }
      for (const auto& field : f) {
        if (!field.empty() && (field[0] == '+' || field[0] == '-' || (field[0] >= '0' && field[0] <= '9')))
          add(in.whole(field, "number"));
        else if (!field.empty())
          named(std::string(field));
      }
    }
  }

  void read_node_set() {
    if (parameter["NSET"].empty()) in.fail("*NSET without a name (NSET=...)");
    const std::string name = parameter["NSET"];
    (void)node_set(name);
    if (parameter.count("ELSET") != 0) in.fail("*NSET, ELSET=...: nodes of an element set are not read; list them");
    read_set(
        [&](long number) {
          const auto at = place.find(number);
          if (at == place.end()) in.fail(fmt::format("set '{}' names node {}, which is not there", name, number));
          node_set(name).insert(at->second);
        },
        [&](const std::string& other) {
          if (node_sets.count(upper(other)) == 0) in.fail(fmt::format("no node set is named '{}'", other));
          const std::set<int> members = node_sets[upper(other)];
          node_set(name).insert(members.begin(), members.end());
        });
  }

  void read_element_set() {
    if (parameter["ELSET"].empty()) in.fail("*ELSET without a name (ELSET=...)");
    const std::string name = parameter["ELSET"];
    (void)element_set(name);
    read_set(
        [&](long number) {
          if (element_numbers.count(number) == 0)
            in.fail(fmt::format("set '{}' names element {}, which is not there", name, number));
          element_set(name).push_back(number);
        },
        [&](const std::string& other) {
          if (element_sets.count(upper(other)) == 0) in.fail(fmt::format("no element set is named '{}'", other));
          const std::vector<long> members = element_sets[upper(other)];
          auto& all = element_set(name);
          all.insert(all.end(), members.begin(), members.end());
        });
  }

  void check_instance() {
    std::string line;
    if (data(line)) in.fail("*INSTANCE with a translation or rotation is not read; write the assembly flat");
  }

  ForeignMesh read() {
    while (!in.at_end()) {
      const std::string line = in.next();
      if (line.compare(0, 2, "**") == 0) {
        comment(line);
        continue;
      }
      if (trimmed(line).empty()) continue;
      if (line[0] != '*') {
        if (mesh.position.empty() && mesh.lines.empty() && parameter.empty() && node_set_order.empty() &&
            in.number() == 1)
          in.fail("a keyword (*...) expected; is this an Abaqus input file?");
        continue;  // data of a block that is passed over
      }
      const std::string word = keyword(line);
      if (word == "*NODE")
        read_nodes();
      else if (word == "*ELEMENT")
        read_elements();
      else if (word == "*NSET")
        read_node_set();
      else if (word == "*ELSET")
        read_element_set();
      else if (word == "*INSTANCE")
        check_instance();
      else if (word == "*INCLUDE")
        in.fail("*INCLUDE is not read; paste the file in");
    }
    if (mesh.position.empty() || (mesh.lines.empty() && mesh.shells.empty()))
      in.fail("no nodes or no elements in the file");
    for (const auto& name : node_set_order) {
      const auto& nodes = node_sets[upper(name)];
      mesh.node_sets.push_back({name, {nodes.begin(), nodes.end()}});
    }
    for (const auto& name : element_set_order) mesh.element_sets.push_back({name, element_sets[upper(name)]});
    return std::move(mesh);
  }
};

}  // namespace

ForeignMesh read_inp(const std::filesystem::path& file) {
  return InpReader(file).read();
}

ForeignMesh read_foreign_mesh(const std::filesystem::path& file) {
  if (file.extension() == ".msh") return read_msh(file);
  if (file.extension() == ".inp") return read_inp(file);
  throw InputError(
      fmt::format("{}: the ending '{}' is no mesh known here; give a .msh (4.1, ASCII) or .inp (Abaqus) file",
                  file.string(), file.extension().string()));
}

}  // namespace weaveform
