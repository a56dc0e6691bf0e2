// Keys of a stack: its plies, and how they slide on each other.
#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "mesher/scene/scene_keys.hpp"

namespace weaveform {
namespace {

// Rows of one of the plain tables as rows of a ply's, but for those that a ply has not or has in another way.
template <auto part, class Part>
void add_keys_of(const char* table, const std::vector<Key<Part>>& from, std::initializer_list<std::string_view> without,
                 std::vector<Key<PlySpec>>& keys) {
  for (auto& key : keys_of_part<part>(from)) {
    if (std::find(without.begin(), without.end(), key.rule.name) != without.end()) continue;
    key.rule.doc = "in place of `" + std::string(table) + "." + key.rule.name + "`";
    keys.push_back(std::move(key));
  }
}

std::vector<Key<PlySpec>> all_ply_keys() {
  std::vector<Key<PlySpec>> keys = {
      key<&PlySpec::name>({.name = "name",
                           .required = true,
                           .identifier = true,
                           .doc = "names it in messages, answers, grips and `--set ply.NAME.yarn_angle=...`"}),
      key<&PlySpec::position>({.name = "position",
                               .unit = "mm",
                               .limits = any_length,
                               .doc = "where the blank's centre lies in the world, in its middle plane; left out: of "
                                      "the first ply `blank.position`, of the others over or under it along z, on the "
                                      "face of the ply before, `stack.gap` away"}),
  };
  add_keys_of<&PlySpec::fabric>("fabric", fabric_keys(), {}, keys);
  add_keys_of<&PlySpec::blank>("blank", blank_keys(), {"position"}, keys);
  add_keys_of<&PlySpec::model>("model", model_keys(), {"symmetry"}, keys);
  return keys;
}

constexpr const char* law_file =
    "CSV file, relative to the scene file: slip (mm), shear stress (MPa), rising slip from 0 on; what plies that touch "
    "carry beside Coulomb's friction, by the slip since they came to touch";
constexpr const char* compaction_file =
    "CSV file, relative to the scene file: `approach_mm,pressure_MPa`, how far two plies' middle planes have come "
    "nearer "
    "under a pressure, or `thickness_mm,pressure_MPa`, the thickness of one ply under it; the first line names which. "
    "Left out: faces that give way by a few per cent of the thickness";

}  // namespace

const std::vector<Key<PlySpec>>& ply_keys() {
  static const std::vector<Key<PlySpec>> keys = all_ply_keys();
  return keys;
}

const std::vector<Key<StackSpec>>& stack_keys() {
  static const std::vector<Key<StackSpec>> keys = {
      key<&StackSpec::friction>({.name = "friction",
                                 .unit = "1",
                                 .limits = between(0, 10),
                                 .doc = "Coulomb coefficient between plies that touch"}),
      key<&StackSpec::friction_law>({.name = "friction_law", .doc = law_file}),
      key<&StackSpec::gap>(
          {.name = "gap",
           .unit = "mm",
           .limits = between(0, greatest_length),
           .doc = "between the faces of a ply and the next at the start, where that has no `position`"}),
      key<&StackSpec::compaction>({.name = "compaction", .doc = compaction_file}),
  };
  return keys;
}

const std::vector<Key<PairSpec>>& pair_keys() {
  static const std::vector<Key<PairSpec>> keys = {
      key<&PairSpec::plies>(
          {.name = "plies", .required = true, .identifier = true, .doc = "names of the two plies, in either order"}),
      key<&PairSpec::friction>(
          {.name = "friction", .unit = "1", .limits = between(0, 10), .doc = "in place of `stack.friction`"}),
      key<&PairSpec::friction_law>({.name = "friction_law", .doc = "in place of `stack.friction_law`"}),
      key<&PairSpec::gap>(
          {.name = "gap", .unit = "mm", .limits = between(0, greatest_length), .doc = "in place of `stack.gap`"}),
      key<&PairSpec::compaction>({.name = "compaction", .doc = "in place of `stack.compaction`"}),
  };
  return keys;
}

}  // namespace weaveform
