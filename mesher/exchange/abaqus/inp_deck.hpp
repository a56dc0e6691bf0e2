// An Abaqus input file as it is written: parts, instances and the assembly, nothing yet put in its place.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mesher/exchange/abaqus/inp_lines.hpp"
#include "mesher/exchange/abaqus/inp_types.hpp"

namespace weaveform {

struct InpNode {
  long number = 0;
  std::array<double, 3> position = {0.0, 0.0, 0.0};
  InpSource at;
};

struct InpElement {
  long number = 0;
  InpShape shape = InpShape::other;
  std::vector<long> node;  // corners; none of `other`
  InpSource at;
};

// Members of a set: numbers first, first + step, ... last, or what `name` names.
struct InpMembers {
  long first = 0, last = 0, step = 1;
  bool generated = false;        // numbers in between need not all be there
  std::string instance, name;    // name: another set; instance: of what stands before the dot in INSTANCE.NAME
  bool elements_of_set = false;  // the nodes of the elements of set `name`
  InpSource at;
};

struct InpSet {
  std::string name;
  std::string instance;  // INSTANCE=, of sets in the assembly
  bool internal = false;
  std::vector<InpMembers> member;
};

// What can stand in a part, in an instance, or in the assembly (and in a file without parts).
struct InpBlock {
  std::string name;
  std::vector<InpNode> node;
  std::vector<InpElement> element;
  std::vector<InpSet> node_set, element_set;
};

struct InpInstance {
  std::string name, part;
  std::array<double, 3> translation = {0.0, 0.0, 0.0};
  // After the translation: about the axis from a to b, by the right hand.
  std::array<double, 3> axis_from = {0.0, 0.0, 0.0}, axis_to = {0.0, 0.0, 1.0};
  double angle = 0.0;  // deg
  InpBlock own;        // of an instance that was meshed itself
  InpSource at;
};

struct InpDeck {
  std::vector<InpBlock> part;
  std::vector<InpInstance> instance;
  InpBlock assembly;
  std::map<std::string, int> left_out;      // elements by type that are no lines or shells
  std::map<std::string, int> second_order;  // elements by type of which the corners were taken
};

// Reads all of it. Throws InputError, FileError.
[[nodiscard]] InpDeck read_deck(InpLines& lines);

}  // namespace weaveform
