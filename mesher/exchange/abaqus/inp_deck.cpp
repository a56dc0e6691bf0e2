#include "mesher/exchange/abaqus/inp_deck.hpp"

#include <fmt/format.h>

#include <cctype>
#include <set>

#include "core/error.hpp"
#include "core/files/text_words.hpp"

namespace weaveform {

namespace {

// These make, move or number nodes and elements; passed over they would leave another mesh than the file's.
const std::map<std::string, std::string> refused = {
    {"*NGEN", "makes nodes"},   {"*NFILL", "makes nodes"},       {"*NCOPY", "makes nodes"},
    {"*NMAP", "moves nodes"},   {"*ELGEN", "makes elements"},    {"*ELCOPY", "makes elements"},
    {"*SYSTEM", "moves nodes"}, {"*PARAMETER", "makes numbers"}, {"*SYMMETRICMODELGENERATION", "makes elements"}};

class DeckReader {
public:
  explicit DeckReader(InpLines& lines) : in_(lines) {}

  InpDeck read() {
    while (const auto keyword = in_.next_keyword()) {
      const auto no = refused.find(keyword->name);
      if (no != refused.end())
        in_.fail(fmt::format("{} {}: it is not read; have a preprocessor write the mesh out and give that file",
                             keyword->name, no->second));
      if (keyword->name == "*NODE")
        read_nodes(*keyword);
      else if (keyword->name == "*ELEMENT")
        read_elements(*keyword);
      else if (keyword->name == "*NSET" || keyword->name == "*ELSET")
        read_set(*keyword);
      else
        read_structure(*keyword);
    }
    return std::move(deck_);
  }

private:
  // Where the blocks of parts and instances begin and end.
  void read_structure(const InpKeyword& keyword) {
    if (keyword.name == "*PART") {
      if (keyword.value("NAME").empty()) in_.fail("*PART without a name (NAME=...)");
      deck_.part.push_back({keyword.value("NAME"), {}, {}, {}, {}});
      block_ = Place::part;
    } else if (keyword.name == "*INSTANCE") {
      read_instance(keyword);
    } else if (keyword.name == "*ENDPART" || keyword.name == "*ENDINSTANCE" || keyword.name == "*ASSEMBLY" ||
               keyword.name == "*ENDASSEMBLY") {
      block_ = Place::assembly;
    }
  }

  void read_instance(const InpKeyword& keyword) {
    InpInstance instance;
    instance.name = keyword.value("NAME");
    instance.part = keyword.value("PART");
    instance.at = keyword.at;
    if (instance.name.empty()) in_.fail("*INSTANCE without a name (NAME=...)");
    if (instance.part.empty())
      in_.fail(
          fmt::format("*INSTANCE, NAME={}: names no part (PART=...); instances of another analysis' results are "
                      "not read",
                      instance.name));
    std::vector<std::string> f;
    if (in_.next_fields(f)) {
      instance.translation = three(f, 0, "translation: x, y, z expected");
      if (in_.next_fields(f)) {
        if (f.size() != 7) in_.fail("rotation: two points of the axis and an angle expected, seven numbers");
        instance.axis_from = three(f, 0, "");
        instance.axis_to = three(f, 3, "");
        instance.angle = in_.real(f[6], "angle");
        if (instance.axis_from == instance.axis_to) in_.fail("rotation: the two points of the axis are one");
      }
      if (in_.next_fields(f)) in_.fail("an instance has a line of translation and one of rotation, no third");
    }
    deck_.instance.push_back(std::move(instance));
    block_ = Place::instance;
  }

  std::array<double, 3> three(const std::vector<std::string>& f, std::size_t from, const char* what) const {
    if (f.size() < from + 3 || (from == 0 && f.size() != 3 && f.size() != 7)) in_.fail(what);
    return {in_.real(f[from], "x"), in_.real(f[from + 1], "y"), in_.real(f[from + 2], "z")};
  }

  InpBlock& block() {
    if (block_ == Place::part) return deck_.part.back();
    if (block_ == Place::instance) return deck_.instance.back().own;
    return deck_.assembly;
  }

  InpSet& set_of(std::vector<InpSet>& sets, const std::string& name, const std::string& instance) {
    // CAE writes a set's members instance by instance, under one name
    if (sets.empty() || upper(sets.back().name) != upper(name) || upper(sets.back().instance) != upper(instance)) {
      sets.push_back({});
      sets.back().name = name;
      sets.back().instance = instance;
    }
    return sets.back();
  }

  static InpMembers one(long number, const InpSource& at) {
    InpMembers member;
    member.first = member.last = number;
    member.at = at;
    return member;
  }

  // x, y and z; those that a plane model leaves out are 0. Up to three more are a normal.
  void read_nodes(const InpKeyword& keyword) {
    if (keyword.has("SYSTEM") && upper(keyword.value("SYSTEM")) != "R")
      in_.fail("*NODE, SYSTEM: only rectangular coordinates are read");
    if (keyword.has("INPUT")) in_.enter_data(keyword);
    InpSet* set = keyword.has("NSET") ? &set_of(block().node_set, keyword.value("NSET"), "") : nullptr;
    std::vector<std::string> f;
    while (in_.next_fields(f)) {
      if (f.size() < 2 || f.size() > 7)
        in_.fail(fmt::format("a node's number and its coordinates expected, {} fields found", f.size()));
      InpNode node;
      node.number = in_.whole(f[0], "node number");
      node.at = in_.at();
      for (std::size_t c = 0; c < 3 && c + 1 < f.size(); ++c)
        if (!f[c + 1].empty()) node.position[c] = in_.real(f[c + 1], c == 0 ? "x" : (c == 1 ? "y" : "z"));
      if (set != nullptr) set->member.push_back(one(node.number, node.at));
      block().node.push_back(node);
    }
  }

  InpType type_of(const std::string& type) const {
    const InpType found = inp_type(type);
    if (found.shape == InpShape::unknown)
      in_.fail(
          fmt::format("element type '{}' is not read; lines are T3D2, B31 and the like, shells S3, S4, S4R, M3D3, "
                      "M3D4, R3D3, R3D4, CPS3, CPS4, STRI3, S6, S8R and the like",
                      type));
    return found;
  }

  void read_elements(const InpKeyword& keyword) {
    const std::string name = upper(keyword.value("TYPE"));
    const InpType type = type_of(name);
    if (keyword.has("OFFSET")) in_.fail("*ELEMENT, OFFSET= is not read; write the node numbers themselves");
    if (keyword.has("INPUT")) in_.enter_data(keyword);
    const std::string set_name = keyword.value("ELSET");
    InpSet* set = set_name.empty() ? nullptr : &set_of(block().element_set, set_name, "");
    std::vector<std::string> f;
    const auto nodes = static_cast<std::size_t>(type.nodes);
    const std::size_t corners = type.shape == InpShape::line ? 2 : (type.shape == InpShape::triangle ? 3 : 4);
    while (in_.next_fields(f, nodes + 1)) {
      if (f.empty()) continue;
      InpElement element{in_.whole(f[0], "element number"), type.shape, {}, in_.at()};
      if (type.shape == InpShape::other) {
        ++deck_.left_out[name];
      } else {
        // a beam may have a node of its orientation, and reads it last
        if (f.size() != nodes + 1 && !(type.shape == InpShape::line && f.size() == 4))
          in_.fail(
              fmt::format("an element of type {} has a number and {} nodes, {} fields found", name, nodes, f.size()));
        for (std::size_t k = 1; k <= nodes; ++k) {
          const long node = in_.whole(f[k], "node number");
          if (k <= corners) element.node.push_back(node);
        }
        if (nodes > corners) ++deck_.second_order[name];
      }
      if (set != nullptr) set->member.push_back(one(element.number, element.at));
      block().element.push_back(std::move(element));
    }
  }

  void read_set(const InpKeyword& keyword) {
    const bool of_nodes = keyword.name == "*NSET";
    const std::string name = keyword.value(of_nodes ? "NSET" : "ELSET");
    if (name.empty()) in_.fail(fmt::format("{} without a name ({}=...)", keyword.name, of_nodes ? "NSET" : "ELSET"));
    if (keyword.has("INPUT")) in_.enter_data(keyword);
    InpSet& set = set_of(of_nodes ? block().node_set : block().element_set, name, keyword.value("INSTANCE"));
    set.internal = keyword.has("INTERNAL");
    if (of_nodes && keyword.has("ELSET")) {
      InpMembers member = named(keyword.value("ELSET"), keyword.at);
      member.elements_of_set = true;
      set.member.push_back(member);
    }
    std::vector<std::string> f;
    while (in_.next_fields(f)) {
      if (keyword.has("GENERATE")) {
        set.member.push_back(generated(f));
        continue;
      }
      for (const auto& field : f) {
        const bool number = !field.empty() && (field[0] == '+' || field[0] == '-' ||
                                               std::isdigit(static_cast<unsigned char>(field[0])) != 0);
        if (number)
          set.member.push_back(one(in_.whole(field, "number"), in_.at()));
        else if (!field.empty())
          set.member.push_back(named(field, in_.at()));
      }
    }
  }

  InpMembers generated(const std::vector<std::string>& f) const {
    if (f.size() < 2 || f.size() > 3) in_.fail("first, last and increment expected");
    InpMembers member = one(in_.whole(f[0], "first"), in_.at());
    member.last = in_.whole(f[1], "last");
    member.step = f.size() == 3 ? in_.whole(f[2], "increment") : 1;
    member.generated = true;
    if (member.step < 1 || member.last < member.first)
      in_.fail("an increment above 0 and a last number not below the first expected");
    return member;
  }

  // NAME, "NAME", INSTANCE.NAME or INSTANCE.NUMBER.
  static InpMembers named(const std::string& field, const InpSource& at) {
    InpMembers member;
    member.at = at;
    std::string text = field;
    if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    const std::size_t dot = text.find('.');
    if (dot != std::string::npos) member.instance = text.substr(0, dot);
    member.name = dot == std::string::npos ? text : text.substr(dot + 1);
    long number = 0;
    if (!member.instance.empty() && read_whole(member.name, number).empty()) {
      member.first = member.last = number;
      member.name.clear();
    }
    return member;
  }

  enum class Place { assembly, part, instance };
  InpLines& in_;
  InpDeck deck_;
  Place block_ = Place::assembly;
};

}  // namespace

InpDeck read_deck(InpLines& lines) {
  return DeckReader(lines).read();
}

}  // namespace weaveform
