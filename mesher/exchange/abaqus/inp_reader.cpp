// An Abaqus deck put together: every instance of a part in its place, numbers made places, sets resolved.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "core/files/text_words.hpp"
#include "mesher/exchange/abaqus/inp_deck.hpp"
#include "mesher/exchange/abaqus/inp_lines.hpp"
#include "mesher/exchange/foreign_mesh.hpp"

namespace weaveform {

namespace {

constexpr long most_members = 10'000'000;  // of all sets together

struct Elements {
  std::set<int> line, shell;
  void add(const Elements& other) {
    line.insert(other.line.begin(), other.line.end());
    shell.insert(other.shell.begin(), other.shell.end());
  }
};

// What an element number means: a place in lines or in shells, or an element that is neither.
struct Slot {
  InpShape shape = InpShape::other;
  int place = 0;
};

// Names and numbers of one instance, or of the assembly.
struct Scope {
  std::map<long, int> node;
  std::map<long, Slot> element;
  std::map<std::string, std::set<int>> node_set;  // by name in capitals
  std::map<std::string, Elements> element_set;
};

class Assembler {
public:
  Assembler(const InpDeck& deck, const InpLines& lines) : deck_(deck), lines_(lines) {
    mesh_.files = lines.files();
    mesh_.file = mesh_.files.front();
    mesh_.weave = lines.weave();
  }

  ForeignMesh put_together() {
    mesh_.instance.clear();
    if (deck_.instance.empty())
      // parts without an assembly stand where they were drawn
      for (const InpBlock& part : deck_.part) add_instance({part.name, part.name, {}, {}, {}, 0.0, {}, {}}, &part);
    for (const InpInstance& instance : deck_.instance) add_instance(instance, part_of(instance));
    note_idle_parts();
    // the assembly's own nodes (reference points) and, in a file without parts, all there is
    current_ = &assembly_;
    if (mesh_.instance.empty() || !deck_.assembly.element.empty()) mesh_.instance.push_back({});
    add_mesh(deck_.assembly, {});
    add_sets(deck_.assembly);
    note_left_out();
    if (mesh_.position.empty() || (mesh_.lines.empty() && mesh_.shells.empty()))
      throw InputError(fmt::format("{}: no nodes or no lines and shells in the file{}", mesh_.file,
                                   deck_.left_out.empty() ? "" : "; its elements are " + listed(deck_.left_out)));
    return std::move(mesh_);
  }

private:
  const InpBlock* part_of(const InpInstance& instance) const {
    for (const InpBlock& part : deck_.part)
      if (upper(part.name) == upper(instance.part)) return &part;
    lines_.fail(instance.at, fmt::format("*INSTANCE, NAME={}: no part is named '{}'", instance.name, instance.part));
  }

  void add_instance(const InpInstance& instance, const InpBlock* part) {
    if (!scope_.emplace(upper(instance.name), Scope{}).second)
      lines_.fail(instance.at, fmt::format("instance '{}' is there twice", instance.name));
    current_ = &scope_[upper(instance.name)];
    mesh_.instance.push_back({instance.name, instance.part, instance.angle != 0.0});
    for (const InpBlock* block : {part, &instance.own}) {
      add_mesh(*block, instance);
      add_sets(*block);
    }
  }

  static std::array<double, 3> placed(const std::array<double, 3>& x, const InpInstance& instance) {
    using Eigen::Vector3d;
    if (instance.angle == 0.0)
      return {x[0] + instance.translation[0], x[1] + instance.translation[1], x[2] + instance.translation[2]};
    const Vector3d from(instance.axis_from.data()), to(instance.axis_to.data());
    const Eigen::AngleAxisd turn(instance.angle * std::numbers::pi / 180.0, (to - from).normalized());
    const Vector3d moved = Vector3d(x.data()) + Vector3d(instance.translation.data());
    const Vector3d turned = from + turn * (moved - from);
    return {turned.x(), turned.y(), turned.z()};
  }

  void add_mesh(const InpBlock& block, const InpInstance& instance) {
    for (const InpNode& node : block.node) {
      if (!current_->node.emplace(node.number, static_cast<int>(mesh_.position.size())).second)
        lines_.fail(node.at, fmt::format("node {} is there twice", node.number));
      mesh_.number.push_back(node.number);
      mesh_.position.push_back(placed(node.position, instance));
    }
    for (const InpElement& element : block.element) add_element(element);
  }

  void add_element(const InpElement& from) {
    ForeignElement element{from.number, from.at.line, {}, from.at.file, static_cast<int>(mesh_.instance.size()) - 1};
    for (const long number : from.node) {
      const auto at = current_->node.find(number);
      if (at == current_->node.end())
        lines_.fail(from.at, fmt::format("element {} names node {}, which is not there", from.number, number));
      element.node.push_back(at->second);
    }
    Slot slot{from.shape, 0};
    if (from.shape != InpShape::other) {
      auto& list = from.shape == InpShape::line ? mesh_.lines : mesh_.shells;
      slot.place = static_cast<int>(list.size());
      list.push_back(std::move(element));
    }
    if (!current_->element.emplace(from.number, slot).second)
      lines_.fail(from.at, fmt::format("element {} is there twice", from.number));
  }

  // The names that a member of a set means: those of its instance, else those around the set.
  Scope& scope_of(const std::string& instance, const InpSource& at) {
    if (instance.empty()) return *current_;
    const auto found = scope_.find(upper(instance));
    if (found == scope_.end()) lines_.fail(at, fmt::format("no instance is named '{}'", instance));
    return found->second;
  }

  void count(std::size_t members, const InpSource& at) {
    members_ += static_cast<long>(members);
    if (members_ > most_members) lines_.fail(at, "more members of sets than any mesh has");
  }

  // Calls add(what stands under the number) for each number that is there; one that was written out must be.
  template <class Value, class Add>
  void each_numbered(const std::map<long, Value>& numbered, const InpMembers& member, const std::string& complaint,
                     Add add) {
    bool any = false;
    for (auto at = numbered.lower_bound(member.first); at != numbered.end() && at->first <= member.last; ++at) {
      count(1, member.at);
      // as unsigned numbers, for the difference of two long ones may be no long
      const auto way = static_cast<unsigned long>(at->first) - static_cast<unsigned long>(member.first);
      if (way % static_cast<unsigned long>(member.step) != 0) continue;
      add(at->second);
      any = true;
    }
    if (!any)
      lines_.fail(member.at, fmt::format("{} {}, which is not there", complaint,
                                         member.generated ? fmt::format("{} to {}", member.first, member.last)
                                                          : fmt::format("{}", member.first)));
  }

  std::set<int> members_of(const InpSet& set) {
    std::set<int> nodes;
    for (const InpMembers& member : set.member) {
      Scope& scope = scope_of(member.instance.empty() ? set.instance : member.instance, member.at);
      if (member.name.empty()) {
        each_numbered(scope.node, member, fmt::format("set '{}' names node", set.name),
                      [&](int node) { nodes.insert(node); });
      } else if (member.elements_of_set) {
        const auto found = scope.element_set.find(upper(member.name));
        if (found == scope.element_set.end())
          lines_.fail(member.at, fmt::format("no element set is named '{}'", member.name));
        count(found->second.line.size() + found->second.shell.size(), member.at);
        for (const int e : found->second.line) nodes.insert(mesh_.lines[e].node.begin(), mesh_.lines[e].node.end());
        for (const int e : found->second.shell) nodes.insert(mesh_.shells[e].node.begin(), mesh_.shells[e].node.end());
      } else {
        const auto found = scope.node_set.find(upper(member.name));
        if (found == scope.node_set.end())
          lines_.fail(member.at, fmt::format("no node set is named '{}'", member.name));
        count(found->second.size(), member.at);
        nodes.insert(found->second.begin(), found->second.end());
      }
    }
    return nodes;
  }

  Elements elements_of(const InpSet& set) {
    Elements elements;
    for (const InpMembers& member : set.member) {
      Scope& scope = scope_of(member.instance.empty() ? set.instance : member.instance, member.at);
      if (member.name.empty()) {
        each_numbered(scope.element, member, fmt::format("set '{}' names element", set.name), [&](const Slot& slot) {
          if (slot.shape != InpShape::other)
            (slot.shape == InpShape::line ? elements.line : elements.shell).insert(slot.place);
        });
      } else {
        const auto found = scope.element_set.find(upper(member.name));
        if (found == scope.element_set.end())
          lines_.fail(member.at, fmt::format("no element set is named '{}'", member.name));
        count(found->second.line.size() + found->second.shell.size(), member.at);
        elements.add(found->second);
      }
    }
    return elements;
  }

  // Sets of one name in one scope are one set.
  void add_sets(const InpBlock& block) {
    std::vector<std::string> order;
    for (const InpSet& set : block.element_set) {
      const std::string name = upper(set.name);
      const bool seen = current_->element_set.count(name) != 0;
      current_->element_set[name].add(elements_of(set));
      if (!seen) order.push_back(set.name);
    }
    for (const auto& name : order) {
      const Elements& all = current_->element_set[upper(name)];
      mesh_.element_sets.push_back({name, {all.line.begin(), all.line.end()}, {all.shell.begin(), all.shell.end()}});
    }
    order.clear();
    for (const InpSet& set : block.node_set) {
      const std::string name = upper(set.name);
      const bool seen = current_->node_set.count(name) != 0;
      const std::set<int> nodes = members_of(set);
      current_->node_set[name].insert(nodes.begin(), nodes.end());
      if (!seen) order.push_back(set.name);
      if (set.internal) mesh_.internal_sets.push_back(name);
    }
    for (const auto& name : order) {
      const std::set<int>& all = current_->node_set[upper(name)];
      mesh_.node_sets.push_back({name, {all.begin(), all.end()}});
    }
  }

  void note_idle_parts() {
    if (deck_.instance.empty()) return;
    for (const InpBlock& part : deck_.part)
      if (std::none_of(deck_.instance.begin(), deck_.instance.end(),
                       [&](const InpInstance& instance) { return upper(instance.part) == upper(part.name); }))
        mesh_.notes.push_back(fmt::format("part '{}' has no instance in the assembly; left out", part.name));
  }

  static std::string listed(const std::map<std::string, int>& types) {
    std::string text;
    for (const auto& [type, number] : types) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number, type);
    return text;
  }

  void note_left_out() {
    if (!deck_.left_out.empty())
      mesh_.notes.push_back("elements that are neither lines nor shells are left out: " + listed(deck_.left_out));
    if (!deck_.second_order.empty())
      mesh_.notes.push_back("of elements of second order the corners are taken: " + listed(deck_.second_order));
  }

  const InpDeck& deck_;
  const InpLines& lines_;
  ForeignMesh mesh_;
  std::map<std::string, Scope> scope_;  // by the instance's name in capitals
  Scope assembly_;
  Scope* current_ = nullptr;
  long members_ = 0;
};

}  // namespace

ForeignMesh read_inp(const std::filesystem::path& file) {
  InpLines lines(file);
  const InpDeck deck = read_deck(lines);
  return Assembler(deck, lines).put_together();
}

}  // namespace weaveform
