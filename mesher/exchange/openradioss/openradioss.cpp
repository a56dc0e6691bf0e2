#include "mesher/exchange/openradioss/openradioss.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/exchange/writers.hpp"

namespace weaveform::foreign {

namespace radioss {

std::string i10(long value) {
  return fmt::format("{:>10}", value);
}
std::string r20(double value) {
  return fmt::format("{:>20}", fit(value, 19));
}
std::string blank(std::size_t columns) {
  return std::string(columns, ' ');
}

int Deck::main_node(std::size_t k) const {
  int number = model.mesh.node_count() + static_cast<int>(ties.follower.size()) + 1;
  for (std::size_t t = 0; t < k; ++t) number += static_cast<int>(tool[t].node.size()) + 1;
  return number;
}

int Deck::first_tool_shell(std::size_t k) const {
  int number = first_follower_spring() + static_cast<int>(ties.follower.size());
  for (std::size_t t = 0; t < k; ++t) number += static_cast<int>(tool[t].face.size());
  return number;
}

void add_points(int function, const std::string& title, const Points& points, std::string& out) {
  out += fmt::format("/FUNCT/{}\n{}\n#                  X                   Y\n", function, title);
  for (const auto& [x, y] : points) out += r20(x) + r20(y) + "\n";
}

void add_group(int group, const std::string& title, const std::vector<int>& numbers, std::string& out) {
  out += fmt::format("/GRNOD/NODE/{}\n{}\n", group, title);
  for (std::size_t k = 0; k < numbers.size(); ++k)
    out += i10(numbers[k]) + (k + 1 == numbers.size() || k % 10 == 9 ? "\n" : "");
}

namespace {

void add_nodes(const Deck& deck, std::string& out) {
  const auto& x = deck.model.mesh.nodes.position;
  int number = 0;
  const auto add = [&](const std::array<double, 3>& place) {
    out += i10(++number) + r20(place[0]) + r20(place[1]) + r20(place[2]) + "\n";
  };
  out += "/NODE\n";
  for (const auto& place : x) add(place);
  for (const int n : deck.ties.follower) add(x[n]);
  for (std::size_t k = 0; k < deck.tool.size(); ++k) {
    add(deck.model.tools[k].tool.start.origin);
    for (const auto& place : deck.tool[k].node) add(place);
  }
}

void add_yarns(const Deck& deck, std::string& out) {
  const Gathered& model = deck.model;
  const bool beam = model.scene.model.yarn == YarnElement::beam;
  const char* keyword = deck.yarns_are_springs() ? "SPRING" : (beam ? "BEAM" : "TRUSS");
  for (std::size_t g = 0; g < model.yarns.size(); ++g) {
    out += fmt::format("/{}/{}\n", keyword, g + 1);
    for (const int e : model.yarns[g].element) {
      const auto& n = model.mesh.yarns.node[e];
      out += i10(e + 1) + i10(n[0] + 1) + i10(n[1] + 1) + (beam ? i10(model.node_beside(e) + 1) : "") + "\n";
    }
  }
}

void add_shells(int part, int first, const std::vector<std::array<int, 4>>& shells, int first_node, std::string& out) {
  for (const std::size_t size : {4UL, 3UL}) {
    bool begun = false;
    for (std::size_t k = 0; k < shells.size(); ++k) {
      if ((shells[k][3] < 0 ? 3UL : 4UL) != size) continue;
      if (!begun) out += fmt::format("/{}/{}\n", size == 4 ? "SHELL" : "SH3N", part);
      begun = true;
      out += i10(first + static_cast<long>(k));
      for (std::size_t c = 0; c < size; ++c) out += i10(shells[k][c] + first_node);
      out += "\n";
    }
  }
}

void add_elements(const Deck& deck, std::string& out) {
  const Gathered& model = deck.model;
  add_yarns(deck, out);
  std::vector<std::array<int, 4>> cells;
  for (const Shell& shell : model.shells) cells.push_back(shell.node);
  add_shells(deck.cell_part(), model.first_shell(), cells, 1, out);
  int number = model.first_extra();
  if (!model.members.empty()) out += fmt::format("/SPRING/{}\n", deck.member_part());
  for (const auto& member : model.members)
    out += i10(number++) + i10(member.node[0] + 1) + i10(member.node[1] + 1) + "\n";
  if (!deck.ties.follower.empty()) out += fmt::format("/SPRING/{}\n", deck.follower_part());
  for (std::size_t k = 0; k < deck.ties.follower.size(); ++k)
    out +=
        i10(number++) + i10(deck.ties.follower[k] + 1) + i10(model.mesh.node_count() + static_cast<long>(k) + 1) + "\n";
  for (std::size_t k = 0; k < deck.tool.size(); ++k)
    add_shells(deck.tool_part(k), deck.first_tool_shell(k), deck.tool[k].face, deck.main_node(k) + 1, out);
}

void add_groups(const Deck& deck, std::string& out) {
  const auto numbers_of = [](const std::vector<int>& nodes) {
    std::vector<int> numbers;
    for (const int n : nodes) numbers.push_back(n + 1);
    return numbers;
  };
  for (std::size_t s = 0; s < deck.model.sets.size(); ++s)
    if (!deck.model.sets[s].node.empty())
      add_group(static_cast<int>(s) + 1, deck.model.sets[s].name, numbers_of(deck.model.sets[s].node), out);
  std::vector<int> all(deck.model.mesh.node_count());
  for (std::size_t n = 0; n < all.size(); ++n) all[n] = static_cast<int>(n) + 1;
  add_group(deck.all_nodes(), "all_nodes", all, out);
  for (std::size_t k = 0; k < deck.tool.size(); ++k) {
    add_group(deck.main_group(k), "ref_" + deck.model.tools[k].tool.name, {deck.main_node(k)}, out);
    std::vector<int> own(deck.tool[k].node.size());
    for (std::size_t n = 0; n < own.size(); ++n) own[n] = deck.main_node(k) + 1 + static_cast<int>(n);
    add_group(deck.surface_group(k), "surface_" + deck.model.tools[k].tool.name, own, out);
  }
}

void list_built_in(const Deck& deck, std::vector<std::string>& lost) {
  const ModelSpec& spec = deck.model.scene.model;
  if (deck.yarns_are_springs()) amend(lost, "jaws:", "; written so, the curve's abscissa stretched");
  if (deck.yarns_are_springs())
    lost.push_back("yarns: springs with the law's table, jaws and softened ends included, and the yarns' whole mass");
  else
    lost.push_back(
        "yarns: beams are linear here, with the card's linear modulus and the same in compression: decrimping, "
        "slack, jaws and a bending law beyond its initial stiffness are lost; bending is right (Iyy = EI/E), torsion "
        "is their sum");
  lost.push_back(
      "cells: /MAT/FABR_A with the shear law's table, exact while yarns keep their length (the law's volume stays, the "
      "shell's thickness does); its own fibres bear a thousandth of the shear modulus");
  double changed = 0.0;
  (void)shear_points(deck.model, changed);
  if (changed > 0.0)
    lost.push_back(
        fmt::format("cells: the shear curve falls, which the starter refuses; it is held level there, by at "
                    "most {:.3g} MPa",
                    changed));
  if (spec.cell != CellElement::membrane)
    lost.push_back(
        fmt::format("model.cell = \"{}\": the cells' bending and transverse shear are not written; the "
                    "fabric law ties them to its fibres, which are the yarns here",
                    name_of(spec.cell)));
}

void list_user(const Deck& deck, std::vector<std::string>& lost) {
  list_user_materials(deck.model, lost);
  lost.push_back(
      "materials: /MAT/USER1 takes a routine of yours, linked to starter and engine; its constants say what it must "
      "do");
  lost.push_back(
      "yarns: the code takes no user material on trusses and beams, so they are linear, with the card's linear modulus "
      "and the same in compression; decrimping and jaws are lost, the law stands in the comments");
  if (deck.model.scene.model.yarn == YarnElement::seatbelt)
    lost.push_back("model.yarn = \"seatbelt\": written as trusses");
}

}  // namespace

}  // namespace radioss

ExportedMesh write_openradioss(const Gathered& model, Materials materials, const std::string& run_name) {
  radioss::Deck deck{model, materials, free_ties(model), {}};
  for (const auto& motion : model.tools) deck.tool.push_back(mesh_of_tool(model, motion));
  ExportedMesh result{"", {}, ""};
  auto& lost = result.not_carried;
  lost = model.not_carried;
  list_frame(model, lost);
  list_coupling(model, lost);
  if (materials == Materials::built_in)
    radioss::list_built_in(deck, lost);
  else
    radioss::list_user(deck, lost);
  if (!model.mesh.tie.empty())
    lost.push_back(fmt::format(
        "ties: written as /MPC between velocities; {} nodes of grips that they refer to have a follower on a stiff "
        "spring, as a node must not be in both; {} tied nodes are moved by their grip alone",
        deck.ties.follower.size(), deck.ties.dropped));
  std::string body;
  radioss::add_nodes(deck, body);
  radioss::add_elements(deck, body);
  radioss::add_parts(deck, body);
  radioss::add_materials(deck, body);
  radioss::add_law_functions(deck, body);
  radioss::add_groups(deck, body);
  radioss::add_ties(deck, body);
  radioss::add_loads(deck, lost, body);
  radioss::add_histories(deck, body);
  result.text = "#RADIOSS STARTER\n" + header(model, "#", lost) + "/BEGIN\n" + run_name + "\n" + radioss::i10(2021) +
                radioss::i10(0) + "\n" +
                fmt::format("{0:>20}{1:>20}{2:>20}\n{0:>20}{1:>20}{2:>20}\n", "Mg", "mm", "s") + body + "/END\n";
  result.engine = radioss::engine_file(deck, run_name);
  return result;
}

}  // namespace weaveform::foreign
