// Abaqus input file. Every line after `**` is a comment there.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "mesher/exchange/abaqus/inp_words.hpp"
#include "mesher/exchange/weave_lines.hpp"
#include "mesher/exchange/writers.hpp"

namespace weaveform::foreign {

namespace {

bool is_shell(const Gathered& model) {
  return model.scene.model.cell != CellElement::membrane;
}

void add_mesh(const Gathered& model, std::string& out) {
  const Mesh& mesh = model.mesh;
  add_nodes(mesh, out);
  const char* line_type = model.scene.model.yarn == YarnElement::beam ? "B31" : "T3D2";
  for (const auto& group : model.yarns) {
    out += fmt::format("*ELEMENT, TYPE={}, ELSET={}\n", line_type, group.name);
    for (const int e : group.element)
      out += fmt::format("{}, {}, {}\n", e + 1, mesh.yarns.node[e][0] + 1, mesh.yarns.node[e][1] + 1);
  }
  // S3R is the same element as S3 in Abaqus; S3 is the name that CalculiX knows too.
  for (const int size : {4, 3}) {
    const bool any =
        std::any_of(model.shells.begin(), model.shells.end(), [&](const Shell& shell) { return shell.size() == size; });
    if (!any) continue;
    const char* type = size == 4 ? (is_shell(model) ? "S4R" : "M3D4R") : (is_shell(model) ? "S3" : "M3D3");
    out += fmt::format("*ELEMENT, TYPE={}, ELSET=CELLS_{}\n", type, size);
    for (std::size_t k = 0; k < model.shells.size(); ++k) {
      const Shell& shell = model.shells[k];
      if (shell.size() != size) continue;
      out += fmt::format("{}", model.first_shell() + static_cast<int>(k));
      for (int c = 0; c < size; ++c) out += fmt::format(", {}", shell.node[c] + 1);
      out += "\n";
    }
  }
}

// After the shells, so that yarns and shells keep their numbers.
void add_members(const Gathered& model, std::string& out) {
  if (model.members.empty()) return;
  out += "*ELEMENT, TYPE=T3D2, ELSET=FRAME_MEMBERS\n";
  int number = model.first_extra();
  for (const auto& member : model.members)
    out += fmt::format("{}, {}, {}\n", number++, member.node[0] + 1, member.node[1] + 1);
}

bool has_shells(const Gathered& model, int size) {
  return std::any_of(model.shells.begin(), model.shells.end(), [&](const Shell& s) { return s.size() == size; });
}

void add_sets(const Gathered& model, std::string& out) {
  for (std::size_t f = 0; f < 2; ++f) {
    std::string names;
    for (const auto& group : model.yarns)
      if (group.family == f) names += (names.empty() ? "" : ",\n") + group.name;
    if (!names.empty()) out += fmt::format("*ELSET, ELSET={}\n{}\n", f == 0 ? "WARP" : "WEFT", names);
  }
  out += "*ELSET, ELSET=CELLS\n";
  for (const int size : {4, 3})
    if (has_shells(model, size)) out += fmt::format("CELLS_{}\n", size);
  if (!model.members.empty()) out += "*ELSET, ELSET=FRAME\nFRAME_MEMBERS\n";
  for (const auto& set : model.sets) {
    add_node_set(set.name, set.node, out);
  }
}

void add_material(const std::string& name, const std::vector<Constant>& constants, double density, std::string& out) {
  out += fmt::format("**\n** Constants of {} in order:\n", name);
  for (std::size_t k = 0; k < constants.size(); ++k)
    out += fmt::format("**   {}: {} = {}\n", k + 1, constants[k].what, constants[k].value);
  out += fmt::format("*MATERIAL, NAME={}\n*DENSITY\n{}\n*USER MATERIAL, CONSTANTS={}\n", name, num(density),
                     constants.size());
  for (std::size_t k = 0; k < constants.size(); ++k)
    out += num(constants[k].value) + (k + 1 == constants.size() ? "\n" : (k % 8 == 7 ? ",\n" : ", "));
}

// Idle ends have idle_share of a section: with as many times the density they weigh what they should, and the wave in
// them is slow, so that they set no step.
void add_yarn_materials(const Gathered& model, std::string& out) {
  for (std::size_t f = 0; f < 2; ++f) {
    const std::string name = f == 0 ? "YARN_WARP" : "YARN_WEFT";
    const double density = model.yarn_density(f) * model.scene.analysis.mass_scale;
    add_material(name, yarn_constants(model, f), density, out);
    if (std::any_of(model.yarns.begin(), model.yarns.end(),
                    [&](const YarnGroup& group) { return group.idle && group.family == f; }))
      add_material(name + "_IDLE", yarn_constants(model, f), density / idle_share, out);
  }
}

void add_sections(const Gathered& model, std::string& out) {
  const bool beam = model.scene.model.yarn == YarnElement::beam;
  for (const auto& group : model.yarns) {
    const std::string material =
        std::string(group.family == 0 ? "YARN_WARP" : "YARN_WEFT") + (group.idle ? "_IDLE" : "");
    if (beam)
      // a round section of the yarn's area; its stiffness in bending is the user material's affair
      out += fmt::format("*BEAM SECTION, ELSET={}, MATERIAL={}, SECTION=CIRC\n{}\n0., 0., 1.\n", group.name, material,
                         num(std::sqrt(group.section / 3.14159265358979323846)));
    else
      out += fmt::format("*SOLID SECTION, ELSET={}, MATERIAL={}\n{}\n", group.name, material, num(group.section));
  }
  if (!model.members.empty())
    out += fmt::format(
        "*MATERIAL, NAME=FRAME_MEMBER\n*DENSITY\n{}\n*ELASTIC\n{}, 0.\n*SOLID SECTION, ELSET=FRAME_MEMBERS, "
        "MATERIAL=FRAME_MEMBER\n{}\n",
        num(model.member_density()), num(model.scene.frame->modulus), num(model.member_section()));
  for (const int size : {4, 3}) {
    if (!has_shells(model, size)) continue;
    out += fmt::format("*{} SECTION, ELSET=CELLS_{}, MATERIAL=FABRIC_SHEAR, ORIENTATION=FABRIC\n{}\n",
                       is_shell(model) ? "SHELL" : "MEMBRANE", size, num(model.mesh.thickness));
    if (is_shell(model) && model.card.bending.transverse_shear) {
      const std::string stiffness = num(*model.card.bending.transverse_shear);
      out += fmt::format("*TRANSVERSE SHEAR STIFFNESS\n{0}, {0}, 0.\n", stiffness);
    }
  }
}

// Degree by degree: x - (1 - share) x_a - share x_b = 0 in displacements, which is the tie as it holds at the start.
void add_ties(const Gathered& model, std::string& out) {
  for (const auto& tie : model.mesh.tie)
    for (int c = 1; c <= 3; ++c)
      out += fmt::format("*EQUATION\n3\n{0}, {1}, 1., {2}, {1}, {3}, {4}, {1}, {5}\n", tie.node + 1, c, tie.to[0] + 1,
                         num(tie.share - 1.0), tie.to[1] + 1, num(-tie.share));
}

// Profile (r, z) of a tool of revolution about its axis through its origin; the outward side is on the left of the way.
std::string profile_of(const Tool& tool, double reach) {
  const double r = tool.radius, f = tool.fillet_radius;
  switch (tool.shape) {
    case ToolShape::plane:
      return fmt::format("START, 0., 0.\nLINE, {}, 0.\n", num(reach));
    case ToolShape::sphere:  // shank up the axis, then the lower half
      return fmt::format("START, {0}, {1}\nLINE, {0}, 0.\nCIRCL, 0., {2}, 0., 0.\n", num(r), num(reach), num(-r));
    case ToolShape::cylinder:
      return fmt::format("START, {0}, {1}\nLINE, {0}, {2}\n", num(r), num(reach), num(-reach));
    case ToolShape::ring: {
      std::string text = fmt::format("START, {}, {}\nLINE, {}, {}\n", num(r), num(-f - reach), num(r), num(-f));
      if (f > 0.0) text += fmt::format("CIRCL, {}, 0., {}, {}\n", num(r + f), num(r + f), num(-f));
      return text + fmt::format("LINE, {}, 0.\n", num(r + f + reach));
    }
    case ToolShape::revolved: {  // Weaveform's profile has its material on the left: the other way round
      std::string text;
      for (auto piece = tool.profile.piece.rbegin(); piece != tool.profile.piece.rend(); ++piece) {
        if (text.empty()) text = fmt::format("START, {}, {}\n", num(piece->end[0]), num(piece->end[1]));
        text += piece->radius == 0.0 ? fmt::format("LINE, {}, {}\n", num(piece->start[0]), num(piece->start[1]))
                                     : fmt::format("CIRCL, {}, {}, {}, {}\n", num(piece->start[0]),
                                                   num(piece->start[1]), num(piece->centre[0]), num(piece->centre[1]));
      }
      return text;
    }
    case ToolShape::triangles:
      break;
  }
  return "";
}

double reach_of(const Gathered& model) {
  double most = 1.0;
  for (const auto& x : model.mesh.nodes.position)
    for (const double c : x) most = std::max(most, std::abs(c));
  return 2.0 * most;
}

void add_tools(const Gathered& model, std::vector<std::string>& not_carried, std::string& out) {
  int number = model.mesh.node_count();
  for (const auto& motion : model.tools) {
    const Tool& tool = motion.tool;
    if (tool.shape == ToolShape::triangles) {
      not_carried.push_back(fmt::format("tool '{}': triangles; read {} there", tool.name, motion.spec->file));
      continue;
    }
    const std::string name = plain_name(tool.name);
    const auto& o = tool.start.origin;
    const auto& a = tool.start.axis;
    ++number;
    out += fmt::format("** Tool {}: its outward side is on the left of the profile's way\n", tool.name);
    out += fmt::format("*NODE, NSET=REF_{}\n{}, {}, {}, {}\n", name, number, num(o[0]), num(o[1]), num(o[2]));
    out += fmt::format("*SURFACE, TYPE=REVOLUTION, NAME=TOOL_{}\n{}, {}, {}, {}, {}, {}\n", name, num(o[0]), num(o[1]),
                       num(o[2]), num(o[0] + a[0]), num(o[1] + a[1]), num(o[2] + a[2]));
    out += profile_of(tool, reach_of(model));
    out += fmt::format("*RIGID BODY, ANALYTICAL SURFACE=TOOL_{0}, REF NODE={1}\n", name, number);
    if (motion.spec->mass)
      out += fmt::format("*ELEMENT, TYPE=MASS, ELSET=MASS_{0}\n{1}, {1}\n*MASS, ELSET=MASS_{0}\n{2}\n", name,
                         10000000 + number, num(*motion.spec->mass));
    out += fmt::format("*SURFACE INTERACTION, NAME=RUB_{}\n*FRICTION\n{}\n", name, num(tool.friction));
    not_carried.push_back(
        fmt::format("tool '{}': its offset of {:.4g} mm from the fabric's middle plane; the nodes "
                    "touch the tool itself",
                    tool.name, tool.offset));
    if (motion.spec->force && !motion.spec->mass)
      not_carried.push_back(fmt::format("tool '{}': its mass, chosen by Weaveform, and its damping", tool.name));
  }
  if (!model.tools.empty()) out += "*SURFACE, TYPE=NODE, NAME=FABRIC_NODES\nALL_NODES, 1.\n";
}

void add_amplitudes(const Gathered& model, std::string& out) {
  out += fmt::format("*AMPLITUDE, NAME=SMOOTH, DEFINITION=SMOOTH STEP\n0., 0., {}, 1.\n", num(model.duration));
  for (const auto& motion : model.tools) {
    if (motion.spec->speed.empty()) continue;
    out += fmt::format("*AMPLITUDE, NAME=WAY_{}\n", plain_name(motion.tool.name));
    for (int k = 0; k <= 200; ++k)
      out += fmt::format("{}, {}\n", num(model.duration * k / 200.0), num(tool_way(*motion.spec, k / 200.0)));
  }
}

void add_boundary(const std::string& set, int axis, double value, std::string& out) {
  out += fmt::format("{}, {}, {}, {}\n", set, axis, axis, num(value));
}

void add_step(const Gathered& model, std::string& out) {
  out += fmt::format("*STEP, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, {}\n", num(model.duration));
  for (const auto& grip : model.grips) {
    out += "*BOUNDARY, AMPLITUDE=SMOOTH\n";
    for (int c = 0; c < 3; ++c)
      if (grip.displacement[c]) add_boundary(plain_name(grip.set), c + 1, *grip.displacement[c], out);
  }
  for (const auto& motion : model.tools) {
    if (motion.tool.shape == ToolShape::triangles) continue;
    const std::string name = plain_name(motion.tool.name);
    out += fmt::format("*BOUNDARY, AMPLITUDE={}\n", motion.spec->speed.empty() ? "SMOOTH" : "WAY_" + name);
    if (!motion.spec->force) {
      for (int c = 0; c < 3; ++c) add_boundary("REF_" + name, c + 1, motion.travel[c], out);
    } else {  // free along its direction only, when that is a world axis
      for (int c = 0; c < 3; ++c)
        if (std::abs(motion.tool.direction[c]) < 1e-12) add_boundary("REF_" + name, c + 1, 0.0, out);
    }
    out += fmt::format("REF_{}, 4, 6\n", name);
    if (motion.spec->force) {
      out += "*CLOAD\n";
      for (int c = 0; c < 3; ++c)
        if (motion.tool.direction[c] != 0.0)
          out += fmt::format("REF_{}, {}, {}\n", name, c + 1, num(*motion.spec->force * motion.tool.direction[c]));
    }
    out += fmt::format("*CONTACT PAIR, INTERACTION=RUB_{0}\nFABRIC_NODES, TOOL_{0}\n", name);
  }
  const auto& g = model.scene.analysis.gravity;
  const double weight = std::hypot(g[0], g[1], g[2]) / model.scene.analysis.mass_scale;
  if (weight > 0.0)
    for (const char* set : {"WARP", "WEFT"})
      out += fmt::format("*DLOAD\n{}, GRAV, {}, {}, {}, {}\n", set, num(weight), num(g[0]), num(g[1]), num(g[2]));
  out += "*OUTPUT, FIELD, NUMBER INTERVAL=20\n*NODE OUTPUT\nU, RF\n*ELEMENT OUTPUT\nS, LE\n*END STEP\n";
}

}  // namespace

ExportedMesh write_abaqus(const Gathered& model) {
  ExportedMesh result{"", model.not_carried};
  auto& lost = result.not_carried;
  if (!model.mesh.tie.empty()) lost.push_back("ties: written as linear equations between displacements");
  std::string body = "*HEADING\nWoven fabric: yarns merged with shear cells\n";
  list_frame(model, lost);
  list_coupling(model, lost);
  list_user_materials(model, lost);
  add_mesh(model, body);
  add_members(model, body);
  add_sets(model, body);
  body += fmt::format(
      "** 1: along the warp, 2: along the weft, on the flat blank\n*ORIENTATION, NAME=FABRIC\n"
      "{}, {}, {}, {}, {}, {}\n3, 0.\n",
      num(model.direction[0][0]), num(model.direction[0][1]), num(model.direction[0][2]), num(model.direction[1][0]),
      num(model.direction[1][1]), num(model.direction[1][2]));
  add_yarn_materials(model, body);
  add_material("FABRIC_SHEAR", shear_constants(model), model.shell_density(), body);
  add_sections(model, body);
  add_ties(model, body);
  add_tools(model, lost, body);
  add_amplitudes(model, body);
  add_step(model, body);
  result.text = header(model, "**", lost) + body;
  result.text += "**\n** What only Weaveform knows (weaveform import):\n";
  for (const auto& line : weave_lines(model.scene, model.mesh)) result.text += "** weaveform " + line + "\n";
  return result;
}

}  // namespace weaveform::foreign
