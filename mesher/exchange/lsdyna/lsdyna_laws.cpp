// Parts, sections and materials of the LS-DYNA deck.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/exchange/lsdyna/lsdyna.hpp"

namespace weaveform::foreign::lsdyna {

namespace {

constexpr std::size_t most_constants = 48;  // of *MAT_USER_DEFINED_MATERIAL_MODELS
constexpr double tool_thickness = 0.002;    // mm; the contact stands off by half of it beside the tool's offset

void add_part(const std::string& name, int part, int section, int material, std::string& out) {
  out += fmt::format("*PART\n{}\n$#      pid     secid       mid\n", name);
  Card10(out).i(part).i(section).i(material);
}

void add_discrete_section(int id, std::string& out) {
  out += "*SECTION_DISCRETE\n$#    secid       dro        kd        v0        cl        fd\n";
  Card10(out).i(id).i(0).r(0.0).r(0.0).r(0.0).r(0.0);
  out += "$#      cdl       tdl\n";
  Card10(out).r(0.0).r(0.0);
}

void add_nonlinear_spring(int material, int curve, std::string& out) {
  out += "*MAT_SPRING_NONLINEAR_ELASTIC\n$#      mid       lcd       lcr\n";
  Card10(out).i(material).i(curve).i(0);
}

// N = A f(x L0/(L0 + jaw)): the curve is f over millimetres, field S of the elements the section A. Where an element
// has lost a fourth of its length the curve ends.
Points spring_curve(const Gathered& model, const YarnPart& part) {
  const double stretch = part.group->jaw_stretch;
  std::vector<double> knots = yarn_knots(model, part.group->family, std::log1p(-0.25 / stretch));
  for (double& knot : knots) knot = std::expm1(knot);
  const auto law = [&](double x) { return yarn_force_per_section(model, part.group->family, x); };
  Points points = points_of(law, knots, 1e-11 * yarn_stiffness(model, part.group->family));
  for (auto& point : points) point[0] *= part.rest * stretch;
  return points;
}

// A resultant beam has its area and its moments of inertia apart: I = EI/E.
void add_beam_section(const Deck& deck, int id, const YarnGroup& group, std::string& out) {
  const auto [in_plane, out_of_plane] = deck.model.second_moments(group);
  out += "*SECTION_BEAM\n$#    secid    elform      shrf   qr/irid       cst\n";
  Card10(out).i(id).i(2).r(1.0).i(0).i(0);
  out += "$#        a       iss       itt         j        sa       ist\n";
  Card10(out).r(group.section).r(out_of_plane).r(in_plane).r(in_plane + out_of_plane).r(group.section).r(0.0);
}

void add_yarn_section(const Deck& deck, int id, const YarnPart& part, std::string& out) {
  switch (deck.yarn_element()) {
    case LineElement::spring:
      add_discrete_section(id, out);
      break;
    case LineElement::seatbelt:
      out += "*SECTION_SEATBELT\n$#    secid      area\n";
      Card10(out).i(id).r(part.group->section);
      break;
    case LineElement::beam:
      add_beam_section(deck, id, *part.group, out);
      break;
    case LineElement::truss:
      out += "*SECTION_BEAM\n$#    secid    elform; area\n";
      Card10(out).i(id).i(3);
      Card10(out).r(part.group->section);
      break;
  }
}

int yarn_material(const Deck& deck, int part) {
  const YarnGroup& group = *deck.yarns[static_cast<std::size_t>(part) - 1].group;
  switch (deck.yarn_element()) {
    case LineElement::spring:
      return springs + part;
    case LineElement::seatbelt:
      return seatbelts + part;
    default:
      return (group.idle ? idle_warp : warp) + static_cast<int>(group.family);
  }
}

// ro: tonne/mm^3; mt: the user's material number (41, 42).
void add_user_material(const std::string& name, int id, int mt, double density, const std::vector<Constant>& constants,
                       std::vector<std::string>& lost, std::string& out) {
  if (constants.size() > most_constants)
    lost.push_back(
        fmt::format("material '{}': {} constants, of which the format takes the first {}; all stand in the comments",
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

// Seatbelts carry force by engineering strain: F = A f(x).
void add_seatbelt_materials(const Deck& deck, std::string& out) {
  const Gathered& model = deck.model;
  constexpr double greatest = 0.2;
  constexpr int points = 100;
  for (std::size_t part = 0; part < deck.yarns.size(); ++part) {
    const YarnGroup& group = *deck.yarns[part].group;
    const int id = seatbelts + static_cast<int>(part) + 1;
    out += "*MAT_SEATBELT\n$#      mid      mpul     llcid     ulcid      lmin\n";
    Card10(out)
        .i(id)
        .r(model.yarn_density(group.family) * group.whole_section * model.scene.analysis.mass_scale)
        .i(id)
        .i(id)
        .r(0.0);
    Points curve;
    for (int k = 0; k <= points; ++k) {
      const double x = greatest * k / points;
      curve.push_back({x, group.section * yarn_force_per_section(model, group.family, x)});
    }
    add_curve(id, fmt::format("force (N) by engineering strain of {}, from the card's tension law", group.name), curve,
              out);
  }
}

bool has_idle(const Gathered& model, std::size_t family) {
  return std::any_of(model.yarns.begin(), model.yarns.end(),
                     [&](const YarnGroup& group) { return group.idle && group.family == family; });
}

// Idle ends have idle_share of a section: with as many times the density they weigh what they should, and the wave in
// them is slow, so that they set no step.
void add_bar_materials(const Deck& deck, std::vector<std::string>& lost, std::string& out) {
  const Gathered& model = deck.model;
  for (std::size_t f = 0; f < 2; ++f) {
    const std::string name = f == 0 ? "warp" : "weft";
    const double density = model.yarn_density(f) * model.scene.analysis.mass_scale;
    for (const bool idle : {false, true}) {
      if (idle && !has_idle(model, f)) continue;
      const int id = (idle ? idle_warp : warp) + static_cast<int>(f);
      const double ro = idle ? density / idle_share : density;
      if (deck.yarn_element() == LineElement::truss) {
        add_user_material(idle ? name + "_idle" : name, id, 41, ro, yarn_constants(model, f), lost, out);
        continue;
      }
      out += "*MAT_ELASTIC\n$#      mid        ro         e        pr\n";
      Card10(out).i(id).r(ro).r(model.card.yarn[f].linear_modulus * model.scene.model.yarn_stiffness_scale).r(0.3);
    }
  }
}

// FORM 14: second Piola-Kirchhoff stress over Green strain, axes along the yarns of the flat fabric (AOPT 2).
void add_fabric(const Gathered& model, std::string& out) {
  const double fibre = fibre_modulus(model);
  const auto &a = model.direction[0], &d = model.direction[1];
  out += "*MAT_FABRIC\n$#      mid        ro        ea        eb        ec      prba      prca      prcb\n";
  Card10(out).i(fabric).r(model.shell_density()).r(fibre).r(fibre).r(0.0).r(0.0).r(0.0).r(0.0);
  out += "$#      gab       gbc       gca       cse        el       prl    lratio      damp\n";
  Card10(out).r(std::abs(shear_tangent(model.card.shear, 0.0))).r(0.0).r(0.0).r(0.0).r(0.0).r(0.0).r(0.0).r(0.0);
  out += "$#     aopt    flc/x2    fac/x3       ela      lnrc      form     fvopt    tsrfac\n";
  Card10(out).r(2.0).r(0.0).r(0.0).r(0.0).r(0.0).r(14.0).r(0.0).r(0.0);
  out += "$#   rgbrth     a0ref        a1        a2        a3        x0        x1\n";
  Card10(out).r(0.0).r(0.0).r(0.0).r(a[0]).r(a[1]).r(a[2]).r(0.0).r(0.0);
  out += "$#       v1        v2        v3        d1        d2        d3      beta    isrefg\n";
  Card10(out).r(0.0).r(0.0).r(0.0).r(d[0]).r(d[1]).r(d[2]).r(0.0).i(0);
  out += "$#      lca       lcb      lcab      lcua      lcub     lcuab        rl\n";
  Card10(out).i(0).i(0).i(shear_law).i(0).i(0).i(0).r(0.0);
  add_curve(shear_law, "fabric: second Piola-Kirchhoff shear stress (MPa) over 2 E12 = sine of the shear angle",
            cell_points_by_sine(model, far_angle(model)), out);
}

// A discrete beam without length: a spring of equal stiffness along every axis.
void add_follower_material(const Deck& deck, std::string& out) {
  const auto [stiffness, mass] = holding_spring(deck.model);
  out += "*SECTION_BEAM\n$#    secid    elform      shrf   qr/irid       cst     scoor\n";
  Card10(out).i(deck.follower_part()).i(6).r(1.0).i(0).i(0).r(0.0);
  out += "$#      vol     iner       cid        ca    offset     rrcon     srcon     trcon\n";
  Card10(out).r(1.0).r(mass).i(0).r(0.0).r(0.0).r(0.0).r(0.0).r(0.0);
  out +=
      "*MAT_LINEAR_ELASTIC_DISCRETE_BEAM\n$#      mid        ro       tkr       tks       tkt       rkr       rks"
      "       rkt\n";
  Card10(out).i(follower).r(mass).r(stiffness).r(stiffness).r(stiffness).r(0.0).r(0.0).r(0.0);
  Card10(out).r(0.0).r(0.0).r(0.0).r(0.0).r(0.0).r(0.0);
  Card10(out).r(0.0).r(0.0).r(0.0).r(0.0).r(0.0).r(0.0);
}

double area_of(const ToolMesh& mesh) {
  double area = 0.0;
  for (const auto& face : mesh.face)
    for (int k = 1; k + 1 < (face[3] < 0 ? 3 : 4); ++k) {
      const auto &o = mesh.node[face[0]], &p = mesh.node[face[k]], &q = mesh.node[face[k + 1]];
      std::array<double, 3> a{}, b{};
      for (std::size_t c = 0; c < 3; ++c) a[c] = p[c] - o[c], b[c] = q[c] - o[c];
      area += 0.5 * std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
    }
  return area;
}

// Which translations of a rigid body are held: LS-DYNA's code for "x, y, z held".
int held_code(const ToolMotion& motion) {
  static constexpr std::array<int, 8> code = {0, 1, 2, 4, 3, 6, 5, 7};  // bit 0: x, 1: y, 2: z
  std::size_t held = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const bool moves = motion.spec->force ? std::abs(motion.tool.direction[c]) >= 1e-12 : motion.travel[c] != 0.0;
    if (!moves) held |= std::size_t{1} << c;
  }
  return code[held];
}

// Rigid shells that weigh what the tool does.
void add_tool(const Deck& deck, std::size_t k, std::string& out) {
  const ToolMotion& motion = deck.model.tools[k];
  const int part = deck.tool_part(k), material = rigid + static_cast<int>(k);
  add_part("tool_" + motion.tool.name, part, part, material, out);
  out += "*SECTION_SHELL\n$#    secid    elform      shrf       nip\n";
  Card10(out).i(part).i(2).r(1.0).i(1);
  Card10(out).r(tool_thickness).r(tool_thickness).r(tool_thickness).r(tool_thickness);
  const double density = tool_mass(deck.model, motion) / (area_of(deck.tool[k]) * tool_thickness);
  out += "*MAT_RIGID\n$#      mid        ro         e        pr         n    couple         m     alias\n";
  Card10(out).i(material).r(density).r(210000.0).r(0.3).r(0.0).r(0.0).r(0.0).i(0);
  out += "$#      cmo      con1      con2\n";
  Card10(out).r(1.0).i(held_code(motion)).i(7);
  Card10(out).r(0.0).r(0.0).r(0.0).r(0.0).r(0.0).r(0.0);
}

}  // namespace

void add_parts(const Deck& deck, std::string& out) {
  const Gathered& model = deck.model;
  for (std::size_t k = 0; k < deck.yarns.size(); ++k) {
    const int id = static_cast<int>(k) + 1;
    add_part(deck.yarns[k].name, id, id, yarn_material(deck, id), out);
    add_yarn_section(deck, id, deck.yarns[k], out);
  }
  add_part("cells", deck.cell_part(), deck.cell_part(), fabric, out);
  // 5: Belytschko-Tsay membrane; 6: S/R Hughes-Liu, for a user material that bends
  const bool bends = deck.materials == Materials::user && model.scene.model.cell != CellElement::membrane;
  out += "*SECTION_SHELL\n$#    secid    elform      shrf       nip\n";
  Card10(out).i(deck.cell_part()).i(bends ? 6 : 5).r(1.0).i(bends ? 3 : 1);
  const double t = model.mesh.thickness;
  Card10(out).r(t).r(t).r(t).r(t);
  if (!model.members.empty()) {
    add_part("frame_members", deck.member_part(), deck.member_part(), member, out);
    add_discrete_section(deck.member_part(), out);
  }
  if (!deck.ties.follower.empty()) add_part("followers", deck.follower_part(), deck.follower_part(), follower, out);
}

void add_materials(const Deck& deck, std::vector<std::string>& lost, std::string& out) {
  const Gathered& model = deck.model;
  switch (deck.yarn_element()) {
    case LineElement::spring:
      for (std::size_t k = 0; k < deck.yarns.size(); ++k) {
        const int id = springs + static_cast<int>(k) + 1;
        add_nonlinear_spring(id, id, out);
        add_curve(id, fmt::format("{}: stress (MPa) by elongation (mm)", deck.yarns[k].name),
                  spring_curve(model, deck.yarns[k]), out);
      }
      break;
    case LineElement::seatbelt:
      add_seatbelt_materials(deck, out);
      break;
    default:
      add_bar_materials(deck, lost, out);
  }
  if (deck.materials == Materials::built_in)
    add_fabric(model, out);
  else
    add_user_material("fabric", fabric, 42, model.shell_density(), shear_constants(model), lost, out);
  if (!model.members.empty()) {
    add_nonlinear_spring(member, member_law, out);
    Points points = member_points(model.scene.frame->modulus);
    for (auto& point : points) point[0] *= model.scene.frame->length;
    add_curve(member_law, "frame members: stress (MPa) by elongation (mm)", points, out);
  }
  if (!deck.ties.follower.empty()) add_follower_material(deck, out);
  for (std::size_t k = 0; k < deck.tool.size(); ++k)
    if (!deck.tool[k].face.empty()) add_tool(deck, k, out);
}

}  // namespace weaveform::foreign::lsdyna
