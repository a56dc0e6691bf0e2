// LS-DYNA keyword file in the standard fixed columns: nodes I8, 3E16; elements I8; all other cards eight fields of 10.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/export/writers.hpp"

namespace weaveform::foreign {

namespace {

// One card of fields 10 wide, right-justified.
class Card10 {
public:
  explicit Card10(std::string& out) : out_(out) {}
  ~Card10() { out_ += "\n"; }
  Card10(const Card10&) = delete;
  Card10& operator=(const Card10&) = delete;
  Card10& i(long value) {
    out_ += fmt::format("{:>10}", value);
    return *this;
  }
  Card10& r(double value) {
    out_ += fmt::format("{:>10}", fit(value, 10));
    return *this;
  }

private:
  std::string& out_;
};

constexpr std::size_t most_constants = 48;  // of *MAT_USER_DEFINED_MATERIAL_MODELS

// Ids of what there is one of: materials 1 warp, 2 weft, 3 fabric; parts of yarn groups from 1, the cells' after them;
// node sets as in the mesh from 1; curve 1 the smooth step, tools' from 11.
int cell_part(const Gathered& model) {
  return static_cast<int>(model.yarns.size()) + 1;
}
int set_id(const Mesh& mesh, const std::string& name) {
  for (std::size_t s = 0; s < mesh.sets.size(); ++s)
    if (mesh.sets[s].name == name) return static_cast<int>(s) + 1;
  return 0;
}

void add_nodes(const Mesh& mesh, std::string& out) {
  out += "*NODE\n$    nid               x               y               z\n";
  for (int n = 0; n < mesh.node_count(); ++n) {
    const auto& x = mesh.nodes.position[n];
    out += fmt::format("{:>8}{:>16}{:>16}{:>16}\n", n + 1, fit(x[0], 16), fit(x[1], 16), fit(x[2], 16));
  }
}

void add_elements(const Gathered& model, std::string& out) {
  const bool seatbelt = model.scene.model.yarn == "seatbelt";
  out += seatbelt ? "*ELEMENT_SEATBELT\n$    eid     pid      n1      n2    sbrid                          slen\n"
                  : "*ELEMENT_BEAM\n$    eid     pid      n1      n2      n3\n";
  for (std::size_t g = 0; g < model.yarns.size(); ++g)
    for (const int e : model.yarns[g].element) {
      const auto& n = model.mesh.yarns.node[e];
      out += fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}", e + 1, g + 1, n[0] + 1, n[1] + 1, 0);
      if (seatbelt) out += fmt::format("{:>16}", "0.0");
      out += "\n";
    }
  out += "*ELEMENT_SHELL\n$    eid     pid      n1      n2      n3      n4\n";
  for (std::size_t k = 0; k < model.shells.size(); ++k) {
    const Shell& shell = model.shells[k];
    const int fourth = shell.size() == 4 ? shell.node[3] : shell.node[2];  // a triangle names its last node twice
    out += fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}\n", model.first_shell() + static_cast<int>(k), cell_part(model),
                       shell.node[0] + 1, shell.node[1] + 1, shell.node[2] + 1, fourth + 1);
  }
}

void add_parts(const Gathered& model, std::string& out) {
  const std::string& yarn = model.scene.model.yarn;
  for (std::size_t g = 0; g < model.yarns.size(); ++g) {
    const auto& group = model.yarns[g];
    const int id = static_cast<int>(g) + 1;
    // a seatbelt's law is a force, so each section has a material of its own
    const int material = yarn == "seatbelt" ? 100 + id : static_cast<int>(group.family) + 1;
    out += fmt::format("*PART\n{}\n$#      pid     secid       mid\n", group.name);
    Card10(out).i(id).i(id).i(material);
    if (yarn == "seatbelt") {
      out += "*SECTION_SEATBELT\n$#    secid      area\n";
      Card10(out).i(id).r(group.section);
    } else if (yarn == "beam") {
      out += "*SECTION_BEAM\n$#    secid    elform      shrf   qr/irid       cst\n";
      Card10(out).i(id).i(1).r(1.0).i(2).i(1);
      const double diameter = 2.0 * std::sqrt(group.section / 3.14159265358979323846);
      Card10(out).r(diameter).r(diameter).r(0.0).r(0.0);
    } else {
      out += "*SECTION_BEAM\n$#    secid    elform; area\n";
      Card10(out).i(id).i(3);
      Card10(out).r(group.section);
    }
  }
  out += "*PART\ncells\n$#      pid     secid       mid\n";
  Card10(out).i(cell_part(model)).i(cell_part(model)).i(3);
  // 6: S/R Hughes-Liu; 5: Belytschko-Tsay membrane
  const int form = model.scene.model.cell == "membrane" ? 5 : 6;
  out += "*SECTION_SHELL\n$#    secid    elform      shrf       nip\n";
  Card10(out).i(cell_part(model)).i(form).r(1.0).i(form == 5 ? 1 : 3);
  const double t = model.mesh.thickness;
  Card10(out).r(t).r(t).r(t).r(t);
}

// ro: tonne/mm^3; mt: the user's material number (41, 42).
void add_user_material(const std::string& name, int id, int mt, double density, const std::vector<Constant>& constants,
                       std::vector<std::string>& lost, std::string& out) {
  if (constants.size() > most_constants)
    lost.push_back(
        fmt::format("material '{}': {} constants, of which the format takes the first {}; all stand in the "
                    "comments",
                    name, constants.size(), most_constants));
  out += fmt::format("$ Constants of {} in order:\n", name);
  for (std::size_t k = 0; k < constants.size(); ++k)
    out += fmt::format("$   {}: {} = {}\n", k + 1, constants[k].what, constants[k].value);
  const std::size_t count = std::min(constants.size(), most_constants);
  out +=
      "*MAT_USER_DEFINED_MATERIAL_MODELS\n$#      mid        ro        mt       lmc       nhv    iortho     ibulk"
      "        ig\n";
  Card10(out).i(id).r(density).i(mt).i(static_cast<long>(count)).i(1).i(0).i(5).i(5);
  Card10(out).i(0).i(0).i(0).i(0).i(0).i(0);
  for (std::size_t k = 0; k < count; k += 8) {
    Card10 card(out);
    for (std::size_t c = k; c < std::min(k + 8, count); ++c) card.r(constants[c].value);
  }
}

// Seatbelts carry force by engineering strain: F = s(e) A L0/L at e = ln(1 + strain).
void add_seatbelt_materials(const Gathered& model, std::string& out) {
  constexpr double greatest = 0.2;
  constexpr int points = 100;
  for (std::size_t g = 0; g < model.yarns.size(); ++g) {
    const auto& group = model.yarns[g];
    const int id = 100 + static_cast<int>(g) + 1;
    out += "*MAT_SEATBELT\n$#      mid      mpul     llcid     ulcid      lmin\n";
    Card10(out).i(id).r(model.yarn_density(group.family) * group.section).i(id).i(id).r(0.0);
    out += fmt::format("$ force (N) by engineering strain of {}, from the card's tension law\n*DEFINE_CURVE\n",
                       group.name);
    Card10(out).i(id).i(0).r(1.0).r(1.0).r(0.0).r(0.0);
    for (int k = 0; k <= points; ++k) {
      const double stretch = 1.0 + greatest * k / points;
      const double stress =
          model.scene.model.yarn_stiffness_scale * model.card.yarn[group.family].tension.stress(std::log(stretch));
      const double force = stress * group.section / (model.scene.model.section == "incompressible" ? stretch : 1.0);
      out += fmt::format("{:>20}{:>20}\n", fit(stretch - 1.0, 20), fit(force, 20));
    }
  }
}

void add_sets(const Mesh& mesh, std::string& out) {
  for (std::size_t s = 0; s < mesh.sets.size(); ++s) {
    const auto& set = mesh.sets[s];
    if (set.node.empty()) continue;
    out += fmt::format("*SET_NODE_LIST_TITLE\n{}\n$#      sid\n", set.name);
    Card10(out).i(static_cast<long>(s) + 1);
    for (std::size_t k = 0; k < set.node.size(); k += 8) {
      Card10 card(out);
      for (std::size_t c = k; c < std::min(k + 8, set.node.size()); ++c) card.i(set.node[c] + 1);
    }
  }
  for (std::size_t f = 0; f < 2; ++f) {
    out += fmt::format("*SET_BEAM_TITLE\n{}\n", f == 0 ? "warp" : "weft");
    Card10(out).i(static_cast<long>(f) + 1);
    std::vector<int> member;
    for (int e = 0; e < mesh.yarn_count(); ++e)
      if (static_cast<std::size_t>(mesh.yarns.family[e]) == f) member.push_back(e + 1);
    for (std::size_t k = 0; k < member.size(); k += 8) {
      Card10 card(out);
      for (std::size_t c = k; c < std::min(k + 8, member.size()); ++c) card.i(member[c]);
    }
  }
}

// *CONSTRAINED_LINEAR_GLOBAL: one per axis; coefficients sum c_i u_i = 0.
void add_ties(const Mesh& mesh, std::string& out) {
  int id = 0;
  for (const auto& tie : mesh.tie)
    for (int c = 1; c <= 3; ++c) {
      out += "*CONSTRAINED_LINEAR_GLOBAL\n";
      Card10(out).i(++id);
      Card10(out).i(tie.node + 1).i(c).r(1.0);
      Card10(out).i(tie.to[0] + 1).i(c).r(tie.share - 1.0);
      Card10(out).i(tie.to[1] + 1).i(c).r(-tie.share);
    }
}

void add_curve(int id, double duration, const std::string& what, const ToolSpec* tool, std::string& out) {
  out += fmt::format("$ {}: part of the way by time (s)\n*DEFINE_CURVE\n", what);
  Card10(out).i(id).i(0).r(1.0).r(1.0).r(0.0).r(0.0);
  for (int k = 0; k <= 100; ++k) {
    const double way = tool == nullptr ? smooth_way(k / 100.0) : tool_way(*tool, k / 100.0);
    out += fmt::format("{:>20}{:>20}\n", fit(duration * k / 100.0, 20), fit(way, 20));
  }
}

void add_grips(const Gathered& model, std::string& out) {
  for (const auto& grip : model.grips)
    for (int c = 0; c < 3; ++c) {
      if (!grip.displacement[c]) continue;
      out += "*BOUNDARY_PRESCRIBED_MOTION_SET\n$#     nsid       dof       vad      lcid        sf\n";
      Card10(out).i(set_id(model.mesh, grip.set)).i(c + 1).i(2).i(1).r(*grip.displacement[c]);
    }
}

void add_tools(const Gathered& model, std::vector<std::string>& lost, std::string& out) {
  for (std::size_t k = 0; k < model.tools.size(); ++k) {
    const ToolMotion& motion = model.tools[k];
    const Tool& tool = motion.tool;
    const bool known =
        tool.shape == ToolShape::plane || tool.shape == ToolShape::sphere || tool.shape == ToolShape::cylinder;
    if (!known || motion.spec->force) {
      lost.push_back(fmt::format("tool '{}': {}; not written", tool.name,
                                 known ? "a rigid wall moved by a force is none of the format's"
                                       : "its shape '" + motion.spec->shape + "' is no rigid wall of the format"));
      continue;
    }
    if (tool.shape == ToolShape::sphere)
      lost.push_back(fmt::format("tool '{}': the sphere is written without its shank", tool.name));
    lost.push_back(
        fmt::format("tool '{}': its offset of {:.4g} mm from the fabric's middle plane", tool.name, tool.offset));
    const char* shape =
        tool.shape == ToolShape::plane ? "FLAT" : (tool.shape == ToolShape::sphere ? "SPHERE" : "CYLINDER");
    const int curve = 11 + static_cast<int>(k);
    const auto& o = tool.start.origin;
    const auto& a = tool.start.axis;
    out += fmt::format("*RIGIDWALL_GEOMETRIC_{}_MOTION_ID\n{:>10}{}\n", shape, k + 1, tool.name);
    Card10(out).i(0).i(0).i(0);
    Card10(out).r(o[0]).r(o[1]).r(o[2]).r(o[0] + a[0]).r(o[1] + a[1]).r(o[2] + a[2]).r(tool.friction);
    if (tool.shape == ToolShape::plane) {
      const bool along = std::abs(a[0]) > 0.9;  // an edge of the endless flat: any direction in its plane
      Card10(out).r(o[0] + (along ? 0.0 : 1.0)).r(o[1] + (along ? 1.0 : 0.0)).r(o[2]).r(0.0).r(0.0);
    } else if (tool.shape == ToolShape::sphere) {
      Card10(out).r(tool.radius);
    } else {
      Card10(out).r(tool.radius).r(0.0);
    }
    // OPT 1: displacement along (vx, vy, vz)
    double way = 0.0;
    for (const double c : motion.travel) way = std::hypot(way, c);
    const auto& d = tool.direction;
    Card10(out).i(curve).i(1).r(d[0]).r(d[1]).r(d[2]);
    out += fmt::format("$ {}: displacement (mm) by time (s)\n*DEFINE_CURVE\n", tool.name);
    Card10(out).i(curve).i(0).r(1.0).r(motion.spec->travel).r(0.0).r(0.0);
    for (int s = 0; s <= 100; ++s)
      out += fmt::format("{:>20}{:>20}\n", fit(model.duration * s / 100.0, 20),
                         fit(way == 0.0 ? 0.0 : tool_way(*motion.spec, s / 100.0), 20));
  }
}

}  // namespace

ExportedMesh write_lsdyna(const Gathered& model, Materials /*materials*/) {
  ExportedMesh result{"", model.not_carried};
  auto& lost = result.not_carried;
  lost.push_back("rounding: coordinates have 16 characters, other numbers 10");
  if (!model.mesh.tie.empty()) lost.push_back("ties: written as *CONSTRAINED_LINEAR_GLOBAL between displacements");
  if (model.scene.model.cell == "membrane") lost.push_back("cells: a membrane, so shell form 5 instead of 6");
  if (model.scene.model.yarn == "seatbelt" && model.scene.model.partner == "compression")
    lost.push_back("model.partner = \"compression\": a seatbelt carries tension only; the partner is not written");
  lost.push_back("the fabric's directions: shells of user materials take theirs from the card's AOPT, not written");
  std::string body;
  add_nodes(model.mesh, body);
  add_elements(model, body);
  add_parts(model, body);
  if (model.scene.model.yarn == "seatbelt") {
    add_seatbelt_materials(model, body);
  } else {
    add_user_material("warp", 1, 41, model.yarn_density(0), yarn_constants(model, 0), lost, body);
    add_user_material("weft", 2, 41, model.yarn_density(1), yarn_constants(model, 1), lost, body);
  }
  add_user_material("fabric", 3, 42, model.shell_density(), shear_constants(model), lost, body);
  add_sets(model.mesh, body);
  add_ties(model.mesh, body);
  add_curve(1, model.duration, "smooth step", nullptr, body);
  add_grips(model, body);
  add_tools(model, lost, body);
  body += "*CONTROL_TERMINATION\n";
  Card10(body).r(model.duration);
  result.text =
      header(model, "$", lost) + "*KEYWORD\n*TITLE\nWoven fabric: yarns merged with shear cells\n" + body + "*END\n";
  return result;
}

}  // namespace weaveform::foreign
