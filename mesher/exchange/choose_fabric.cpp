#include "mesher/exchange/choose_fabric.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "core/files/text_words.hpp"

namespace weaveform {

namespace {

std::set<int> lines_named(const ForeignMesh& file, const std::string& name) {
  std::set<int> found;
  for (const auto& set : file.element_sets)
    if (upper(set.name) == upper(name)) found.insert(set.line.begin(), set.line.end());
  return found;
}

std::string name_of(const ForeignInstance& instance) {
  if (instance.name.empty()) return "the assembly";
  if (instance.part == instance.name) return fmt::format("part '{}'", instance.name);
  return fmt::format("instance '{}' of part '{}'", instance.name, instance.part);
}

// Lines and shells of each instance, as places in the file.
struct Instance {
  std::vector<int> line, shell;
  int tool_shells = 0;
};

struct Chooser {
  const ForeignMesh& file;
  std::vector<Instance> instance{};
  int unnamed = 0;  // lines in neither of the sets `warp` and `weft`

  [[noreturn]] void fail(const std::string& what) const { throw InputError(fmt::format("{}: {}", file.file, what)); }

  void sort_into_instances(const std::set<int>& tool_shells, const std::set<int>& yarns) {
    instance.resize(file.instance.size());
    for (std::size_t k = 0; k < file.lines.size(); ++k)
      if (yarns.empty() || yarns.count(static_cast<int>(k)) != 0)
        instance[file.lines[k].instance].line.push_back(static_cast<int>(k));
      else
        ++unnamed;
    for (std::size_t k = 0; k < file.shells.size(); ++k) {
      Instance& of = instance[file.shells[k].instance];
      if (tool_shells.count(static_cast<int>(k)) != 0)
        ++of.tool_shells;
      else
        of.shell.push_back(static_cast<int>(k));
    }
  }

  std::size_t named(const std::string& part) const {
    std::vector<std::size_t> found;
    std::string known;
    for (std::size_t k = 0; k < instance.size(); ++k) {
      if (upper(file.instance[k].name) == upper(part)) return k;
      if (upper(file.instance[k].part) == upper(part)) found.push_back(k);
      known += (known.empty() ? "" : ", ") + name_of(file.instance[k]);
    }
    if (found.empty()) fail(fmt::format("no part or instance is named '{}'; there are: {}", part, known));
    if (found.size() > 1)
      fail(fmt::format("part '{}' has {} instances; name one of them: {}", part, found.size(), known));
    return found.front();
  }

  std::size_t fabric() const {
    std::vector<std::size_t> both;
    std::string listed;
    for (std::size_t k = 0; k < instance.size(); ++k) {
      if (!instance[k].line.empty() && !instance[k].shell.empty()) both.push_back(k);
      listed += fmt::format("{}{} has {} lines and {} shells", k == 0 ? "" : ", ", name_of(file.instance[k]),
                            instance[k].line.size(), instance[k].shell.size());
    }
    if (both.empty())
      fail(
          fmt::format("no part has both yarns (two-node lines) and cells (shells): {}; the fabric's lines and shells "
                      "must be of one part and share its nodes",
                      listed));
    if (both.size() > 1)
      fail(
          fmt::format("more than one part has lines and shells: {}; say with --part NAME which is the fabric", listed));
    return both.front();
  }

  std::vector<std::string> left_out(std::size_t fabric, const std::vector<std::string>& others) const {
    const auto is_other = [&](const ForeignInstance& one) {
      return std::any_of(others.begin(), others.end(), [&](const std::string& name) {
        return upper(name) == upper(one.name) || upper(name) == upper(one.part);
      });
    };
    std::vector<std::string> notes;
    if (unnamed > 0)
      notes.push_back(fmt::format("{} lines are in neither of the element sets 'warp' and 'weft'; left out", unnamed));
    for (std::size_t k = 0; k < instance.size(); ++k) {
      if (k == fabric || instance[k].line.size() + instance[k].shell.size() == 0 || is_other(file.instance[k]))
        continue;
      notes.push_back(
          fmt::format("{}: {} lines and {} shells are no part of the fabric, and no tool of the scene (shape "
                      "\"triangles\") has its name; left out",
                      name_of(file.instance[k]), instance[k].line.size(), instance[k].shell.size()));
    }
    return notes;
  }
};

}  // namespace

FabricElements choose_fabric(const ForeignMesh& file, const std::vector<std::string>& tools, const std::string& part,
                             const std::vector<std::string>& others) {
  const std::set<int> warp = lines_named(file, "warp");
  std::set<int> yarns = lines_named(file, "weft");
  if (warp.empty() || yarns.empty())
    yarns.clear();  // one name alone does not say that the other lines are none
  else
    yarns.insert(warp.begin(), warp.end());
  std::set<int> tool_shells;
  for (const auto& tool : tools) {
    const std::vector<int> shells = shells_named(file, tool);
    tool_shells.insert(shells.begin(), shells.end());
  }
  Chooser chooser{file};
  chooser.sort_into_instances(tool_shells, yarns);
  if (file.lines.empty()) chooser.fail("no yarns: two-node line elements are needed beside the shells");
  if (tool_shells.size() == file.shells.size())
    chooser.fail("no cells: shells with 3 or 4 nodes are needed beside the lines");
  std::size_t fabric = 0;
  if (!part.empty())
    fabric = chooser.named(part);
  else if (chooser.instance.size() > 1)
    fabric = chooser.fabric();
  FabricElements found;
  found.warp_named = !warp.empty();
  for (const int k : chooser.instance[fabric].line) {
    found.yarn.push_back(&file.lines[k]);
    found.in_warp.push_back(warp.count(k) != 0);
  }
  for (const int k : chooser.instance[fabric].shell) found.cell.push_back(&file.shells[k]);
  if (found.yarn.empty() || found.cell.empty())
    chooser.fail(fmt::format("{} has {} lines and {} shells; a fabric has yarns (two-node lines) and cells (shells)",
                             name_of(file.instance[fabric]), found.yarn.size(), found.cell.size()));
  found.notes = chooser.left_out(fabric, others);
  return found;
}

}  // namespace weaveform
