#include "mesher/exchange/lsdyna/lsdyna.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/exchange/writers.hpp"

namespace weaveform::foreign {

namespace lsdyna {

Card10& Card10::i(long value) {
  out_ += fmt::format("{:>10}", value);
  return *this;
}
Card10& Card10::r(double value) {
  out_ += fmt::format("{:>10}", fit(value, 10));
  return *this;
}

LineElement Deck::yarn_element() const {
  const YarnElement yarn = model.scene.model.yarn;
  if (yarn == YarnElement::seatbelt) return LineElement::seatbelt;
  if (yarn == YarnElement::beam) return LineElement::beam;
  return materials == Materials::built_in ? LineElement::spring : LineElement::truss;
}

int Deck::first_tool_node(std::size_t k) const {
  int number = model.mesh.node_count() + static_cast<int>(ties.follower.size()) + 1;
  for (std::size_t t = 0; t < k; ++t) number += static_cast<int>(tool[t].node.size());
  return number;
}

int Deck::first_tool_shell(std::size_t k) const {
  int number = first_follower_spring() + static_cast<int>(ties.follower.size());
  for (std::size_t t = 0; t < k; ++t) number += static_cast<int>(tool[t].face.size());
  return number;
}

std::vector<YarnPart> yarn_parts(const Gathered& model, LineElement element) {
  const auto& rest = model.mesh.yarns.rest_length;
  std::vector<YarnPart> parts;
  for (const auto& group : model.yarns) {
    if (element != LineElement::spring) {
      parts.push_back({&group, group.name, 0.0, group.element});
      continue;
    }
    const std::size_t first = parts.size();
    for (const int e : group.element) {
      const auto same =
          std::find_if(parts.begin() + static_cast<std::ptrdiff_t>(first), parts.end(),
                       [&](const YarnPart& part) { return std::abs(part.rest - rest[e]) <= 1e-9 * rest[e]; });
      if (same != parts.end())
        same->element.push_back(e);
      else
        parts.push_back({&group, fmt::format("{}_{}", group.name, parts.size() - first + 1), rest[e], {e}});
    }
  }
  return parts;
}

void add_curve(int curve, const std::string& what, const Points& points, std::string& out) {
  out += fmt::format("$ {}\n*DEFINE_CURVE\n", what);
  Card10(out).i(curve).i(0).r(1.0).r(1.0).r(0.0).r(0.0);
  for (const auto& [x, y] : points) out += fmt::format("{:>20}{:>20}\n", fit(x, 19), fit(y, 19));
}

namespace {

void add_nodes(const Deck& deck, std::string& out) {
  const auto& x = deck.model.mesh.nodes.position;
  int number = 0;
  const auto add = [&](const std::array<double, 3>& p) {
    out += fmt::format("{:>8}{:>16}{:>16}{:>16}\n", ++number, fit(p[0], 16), fit(p[1], 16), fit(p[2], 16));
  };
  out += "*NODE\n$    nid               x               y               z\n";
  for (const auto& place : x) add(place);
  for (const int n : deck.ties.follower) add(x[n]);
  for (const auto& tool : deck.tool)
    for (const auto& place : tool.node) add(place);
}

std::string line_of(long number, int part, long a, long b) {
  return fmt::format("{:>8}{:>8}{:>8}{:>8}", number, part, a, b);
}

void add_yarns(const Deck& deck, std::string& out) {
  const LineElement kind = deck.yarn_element();
  if (kind == LineElement::spring)
    out += "*ELEMENT_DISCRETE\n$    eid     pid      n1      n2     vid               s      pf          offset\n";
  else if (kind == LineElement::seatbelt)
    out += "*ELEMENT_SEATBELT\n$    eid     pid      n1      n2    sbrid                          slen\n";
  else
    out += "*ELEMENT_BEAM\n$    eid     pid      n1      n2      n3\n";
  for (std::size_t part = 0; part < deck.yarns.size(); ++part)
    for (const int e : deck.yarns[part].element) {
      const auto& n = deck.model.mesh.yarns.node[e];
      out += line_of(e + 1, static_cast<int>(part) + 1, n[0] + 1, n[1] + 1);
      if (kind == LineElement::spring)  // s: factor on the curve, which is a stress
        out += fmt::format("{:>8}{:>16}{:>8}{:>16}", 0, fit(deck.yarns[part].group->section, 16), 0, "0.0");
      else
        out += fmt::format("{:>8}", kind == LineElement::beam ? deck.model.node_beside(e) + 1 : 0);
      if (kind == LineElement::seatbelt) out += fmt::format("{:>16}", "0.0");
      out += "\n";
    }
}

void add_shells(int part, int first, const std::vector<std::array<int, 4>>& shells, int first_node, std::string& out) {
  int number = first;
  for (const auto& shell : shells) {
    const int fourth = shell[3] >= 0 ? shell[3] : shell[2];  // a triangle names its last node twice
    out += line_of(number++, part, shell[0] + first_node, shell[1] + first_node) +
           fmt::format("{:>8}{:>8}\n", shell[2] + first_node, fourth + first_node);
  }
}

void add_elements(const Deck& deck, std::string& out) {
  const Gathered& model = deck.model;
  add_yarns(deck, out);
  out += "*ELEMENT_SHELL\n$    eid     pid      n1      n2      n3      n4\n";
  std::vector<std::array<int, 4>> cells;
  for (const Shell& shell : model.shells) cells.push_back(shell.node);
  add_shells(deck.cell_part(), model.first_shell(), cells, 1, out);
  for (std::size_t k = 0; k < deck.tool.size(); ++k)
    add_shells(deck.tool_part(k), deck.first_tool_shell(k), deck.tool[k].face, deck.first_tool_node(k), out);
  int number = model.first_extra();
  if (!model.members.empty())
    out += "*ELEMENT_DISCRETE\n$    eid     pid      n1      n2     vid               s      pf          offset\n";
  for (const auto& frame : model.members)
    out += line_of(number++, deck.member_part(), frame.node[0] + 1, frame.node[1] + 1) +
           fmt::format("{:>8}{:>16}{:>8}{:>16}\n", 0, fit(model.member_section(), 16), 0, "0.0");
  if (!deck.ties.follower.empty()) out += "*ELEMENT_BEAM\n$    eid     pid      n1      n2      n3\n";
  for (std::size_t k = 0; k < deck.ties.follower.size(); ++k)
    out += line_of(number++, deck.follower_part(), deck.ties.follower[k] + 1,
                   model.mesh.node_count() + static_cast<long>(k) + 1) +
           fmt::format("{:>8}\n", 0);
}

// Springs weigh nothing: every node has the mass that Weaveform lumps. In beams and bars it is the elements'; a frame's
// corners have it from here in any case.
void add_masses(const Deck& deck, std::string& out) {
  const Mesh& mesh = deck.model.mesh;
  int number = deck.first_tool_shell(deck.tool.size());
  const auto add = [&](int node) {
    out += fmt::format("{:>8}{:>8}{:>16}\n", number++, node + 1,
                       fit(mesh.nodes.mass[node] * deck.model.scene.analysis.mass_scale, 16));
  };
  std::vector<int> nodes;
  if (deck.yarn_element() == LineElement::spring)
    for (int n = 0; n < mesh.node_count(); ++n) nodes.push_back(n);
  else if (mesh.frame.present())
    nodes.assign(mesh.frame.corner.begin(), mesh.frame.corner.end());
  if (nodes.empty()) return;
  out += "*ELEMENT_MASS\n$    eid     nid            mass\n";
  for (const int n : nodes)
    if (mesh.nodes.mass[n] > 0.0) add(n);
}

void add_node_set(int id, const std::string& name, const std::vector<int>& nodes, std::string& out) {
  out += fmt::format("*SET_NODE_LIST_TITLE\n{}\n$#      sid\n", name);
  Card10(out).i(id);
  for (std::size_t k = 0; k < nodes.size(); k += 8) {
    Card10 card(out);
    for (std::size_t c = k; c < std::min(k + 8, nodes.size()); ++c) card.i(nodes[c] + 1);
  }
}

void add_sets(const Deck& deck, std::string& out) {
  const Gathered& model = deck.model;
  for (std::size_t s = 0; s < model.sets.size(); ++s)
    if (!model.sets[s].node.empty()) add_node_set(static_cast<int>(s) + 1, model.sets[s].name, model.sets[s].node, out);
  std::vector<int> all(model.mesh.node_count());
  for (std::size_t n = 0; n < all.size(); ++n) all[n] = static_cast<int>(n);
  add_node_set(deck.all_nodes(), "all_nodes", all, out);
  const char* kind = deck.yarn_element() == LineElement::spring ? "DISCRETE" : "BEAM";
  for (std::size_t f = 0; f < 2; ++f) {
    out += fmt::format("*SET_{}_TITLE\n{}\n", kind, f == 0 ? "warp" : "weft");
    Card10(out).i(static_cast<long>(f) + 1);
    std::vector<int> member;
    for (int e = 0; e < model.mesh.yarn_count(); ++e)
      if (static_cast<std::size_t>(model.mesh.yarns.family[e]) == f) member.push_back(e + 1);
    for (std::size_t k = 0; k < member.size(); k += 8) {
      Card10 card(out);
      for (std::size_t c = k; c < std::min(k + 8, member.size()); ++c) card.i(member[c]);
    }
  }
}

// *CONSTRAINED_LINEAR_GLOBAL: one per axis; coefficients sum c_i u_i = 0.
void add_ties(const Deck& deck, std::string& out) {
  int id = 0;
  for (const auto& tie : deck.ties.tie)
    for (int c = 1; c <= 3; ++c) {
      out += "*CONSTRAINED_LINEAR_GLOBAL\n";
      Card10(out).i(++id);
      Card10(out).i(tie.node + 1).i(c).r(1.0);
      Card10(out).i(tie.to[0] + 1).i(c).r(tie.share - 1.0);
      Card10(out).i(tie.to[1] + 1).i(c).r(-tie.share);
    }
}

void list_built_in(const Deck& deck, std::vector<std::string>& lost) {
  const ModelSpec& spec = deck.model.scene.model;
  if (deck.yarn_element() == LineElement::spring) {
    amend(lost, "jaws:", "; written so");
    replace(lost, "masses:",
            "masses: every node has Weaveform's own, as *ELEMENT_MASS; the shells add a thousandth of the fabric's");
  }
  if (deck.yarn_element() == LineElement::spring)
    lost.push_back("yarns: discrete springs with the law's curve, jaws included, and the nodes' own masses");
  if (deck.yarn_element() == LineElement::beam)
    lost.push_back(
        "yarns: beams are linear, with the card's linear modulus and the same in compression; decrimping, slack, "
        "jaws and a bending law beyond its initial stiffness are lost; bending is right (I = EI/E)");
  if (deck.yarn_element() == LineElement::seatbelt)
    lost.push_back(
        "yarns: seatbelts with the tension law's curve of 100 points; jaws are lost, so that the elements in "
        "them are stiffer");
  if (deck.yarn_element() == LineElement::seatbelt && spec.partner == SeatbeltPartner::compression)
    lost.push_back("model.partner = \"compression\": a seatbelt carries tension only; the partner is not written");
  lost.push_back(
      "cells: *MAT_FABRIC, FORM 14, with the shear law as second Piola-Kirchhoff stress over Green shear strain "
      "2 E12: exact for the law by that measure, whose factor of 2 is as the manual's engineering strain and was not "
      "run; *MAT_VISCOELASTIC_LOOSE_FABRIC and *MAT_MICROMECHANICS_DRY_FABRIC have laws of their own that the card's "
      "is not one of");
  if (spec.cell != CellElement::membrane)
    lost.push_back(
        fmt::format("model.cell = \"{}\": bending of the cells; *MAT_FABRIC is for membranes", name_of(spec.cell)));
}

}  // namespace

}  // namespace lsdyna

ExportedMesh write_lsdyna(const Gathered& model, Materials materials) {
  lsdyna::Deck deck{model, materials, free_ties(model), {}, {}};
  deck.yarns = lsdyna::yarn_parts(model, deck.yarn_element());
  for (const auto& motion : model.tools)
    deck.tool.push_back(lsdyna::is_rigid_wall(motion) ? ToolMesh{} : mesh_of_tool(model, motion));
  ExportedMesh result{"", model.not_carried, ""};
  auto& lost = result.not_carried;
  list_frame(model, lost);
  list_coupling(model, lost);
  lost.push_back("rounding: coordinates have 16 characters, other numbers 10");
  if (materials == Materials::built_in)
    lsdyna::list_built_in(deck, lost);
  else
    list_user_materials(model, lost);
  if (!model.mesh.tie.empty())
    lost.push_back(
        fmt::format("ties: written as *CONSTRAINED_LINEAR_GLOBAL between displacements; {} nodes of grips "
                    "that they refer to have a follower on a stiff spring",
                    deck.ties.follower.size()));
  std::string body;
  lsdyna::add_nodes(deck, body);
  lsdyna::add_elements(deck, body);
  lsdyna::add_masses(deck, body);
  lsdyna::add_parts(deck, body);
  lsdyna::add_materials(deck, lost, body);
  lsdyna::add_sets(deck, body);
  lsdyna::add_ties(deck, body);
  lsdyna::add_loads(deck, lost, body);
  lsdyna::add_control(deck, body);
  result.text =
      header(model, "$", lost) + "*KEYWORD\n*TITLE\nWoven fabric: yarns merged with shear cells\n" + body + "*END\n";
  return result;
}

}  // namespace weaveform::foreign
