// Properties and materials of the OpenRadioss deck.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/exchange/openradioss/openradioss.hpp"

namespace weaveform::foreign::radioss {

namespace {

// /PROP/TYPE4 with Ileng = 1: mass and stiffness a length, a curve over L/L0 - 1. The curve is a stress, and field A
// its factor, the section. `stretch` is the factor on the curve's abscissa (a yarn's reach into a jaw).
void add_spring(int id, const std::string& title, double section, double mass_per_length, double modulus,
                double stretch, int function, std::string& out) {
  out += fmt::format("/PROP/SPRING/{}\n{}\n", id, title);
  out += "#               MASS                                 sens_ID    Isflag     Ileng\n" + r20(mass_per_length) +
         blank(30) + i10(0) + i10(0) + i10(1) + "\n";
  out += "#                  K                   C                   A                   B                   D\n" +
         r20(section * modulus / stretch) + r20(0.0) + r20(section) + r20(0.0) + r20(0.0) + "\n";
  out += "# fct_ID11        H1  fct_ID21  fct_ID31  fct_ID41                      DeltaMin            DeltaMax\n" +
         i10(function) + i10(0) + i10(0) + i10(0) + i10(0) + blank(10) + r20(0.0) + r20(0.0) + "\n";
  out += "#                 F1                  E1             AScale1             HScale1\n" + r20(0.0) + r20(0.0) +
         r20(stretch) + r20(0.0) + "\n";
}

void add_follower_spring(const Deck& deck, std::string& out) {
  const auto [stiffness, mass] = holding_spring(deck.model);
  out += fmt::format("/PROP/SPR_GENE/{}\nfollowers\n", deck.follower_part());
  out += "#               Mass             Inertia   skew_ID   sens_ID    Isflag     Ifail   Ifail2     Iequil\n" +
         r20(mass) + r20(mass) + i10(0) + i10(0) + i10(0) + i10(0) + i10(0) + i10(0) + "\n";
  for (int axis = 1; axis <= 6; ++axis) {
    out += fmt::format(
               "#                 K{0}                  C{0}                  A{0}                  B{0}"
               "                  D{0}\n",
               axis) +
           r20(axis <= 3 ? stiffness : 0.0) + r20(0.0) + r20(0.0) + r20(0.0) + r20(0.0) + "\n";
    out += fmt::format(
               "# fct_ID1{0}        H{0}  fct_ID2{0}  fct_ID3{0}  fct_ID4{0}                     DeltaMin{0}"
               "           DeltaMax{0}\n",
               axis) +
           i10(0) + i10(0) + i10(0) + i10(0) + i10(0) + blank(10) + r20(0.0) + r20(0.0) + "\n";
    out += fmt::format("#                 F{0}                  E{0}             Ascale{0}             Hscale{0}\n",
                       axis) +
           r20(0.0) + r20(0.0) + r20(0.0) + r20(0.0) + "\n";
  }
  out += "#  Fsmooth                Fcut\n" + i10(0) + r20(0.0) + "\n";
}

// I = EI/E of a linear beam of the card's modulus. The third node lies in the fabric's plane, so that local y does, and
// bending about y is out of that plane.
void add_beam(const Gathered& model, int id, const YarnGroup& group, std::string& out) {
  const auto [in_plane, out_of_plane] = model.second_moments(group);
  out += fmt::format("/PROP/BEAM/{}\n{}\n#   Ismstr\n", id, group.name) + i10(0) + "\n";
  out += "#                 dm                  df\n" + r20(0.0) + r20(0.0) + "\n";
  out += "#               Area                 Iyy                 Izz                 Ixx\n" + r20(group.section) +
         r20(out_of_plane) + r20(in_plane) + r20(in_plane + out_of_plane) + "\n" + i10(0) + i10(0) + "\n";
}

int yarn_material(const Deck& deck, const YarnGroup& group) {
  if (deck.yarns_are_springs()) return 0;
  return (group.idle ? idle_warp : warp) + static_cast<int>(group.family);
}

void add_part(int id, const std::string& title, int property, int material, std::string& out) {
  out += fmt::format("/PART/{}\n{}\n#  prop_ID    mat_ID  subset_ID\n", id, title) + i10(property) + i10(material) +
         i10(0) + "\n";
}

void add_yarn_parts(const Deck& deck, std::string& out) {
  const Gathered& model = deck.model;
  for (std::size_t g = 0; g < model.yarns.size(); ++g) {
    const auto& group = model.yarns[g];
    const int id = static_cast<int>(g) + 1;
    add_part(id, group.name, id, yarn_material(deck, group), out);
    if (deck.yarns_are_springs()) {
      const double mass = model.yarn_density(group.family) * group.whole_section * model.scene.analysis.mass_scale;
      add_spring(id, group.name, group.section, mass, yarn_stiffness(model, group.family), group.jaw_stretch,
                 warp_law + static_cast<int>(group.family), out);
    } else if (model.scene.model.yarn == YarnElement::beam) {
      add_beam(model, id, group, out);
    } else {
      out += fmt::format("/PROP/TRUSS/{}\n{}\n#               Area              Gapini\n", id, group.name) +
             r20(group.section) + r20(0.0) + "\n";
    }
  }
}

// One layer: warp along the vector, weft 90 deg from it, on the flat fabric; the law turns both with the fabric.
void add_fabric_property(const Deck& deck, std::string& out) {
  const Gathered& model = deck.model;
  const int id = deck.cell_part();
  const double thickness = model.mesh.thickness;
  out += fmt::format("/PROP/SH_FABR/{}\ncells\n", id);
  out += "#   Ishell    Ismstr     Ish3n                                      P_Thick_Fail\n" + i10(24) + i10(4) +
         i10(2) + blank(30) + r20(0.0) + "\n";
  out += "#                 Hm                  Hf                  Hr                  Dm\n" + r20(0.0) + r20(0.0) +
         r20(0.0) + r20(0.0) + "\n";
  out += "#        N   Istrain               Thick              Ashear              Ithick\n" + i10(1) + i10(1) +
         r20(thickness) + r20(0.0) + blank(10) + i10(2) + "\n";
  out += "#                 Vx                  Vy                  Vz   Skew_ID      Ipos                  Ip\n" +
         r20(model.direction[0][0]) + r20(model.direction[0][1]) + r20(model.direction[0][2]) + i10(0) + i10(0) +
         blank(10) + i10(0) + "\n";
  out += "#              Phi_i             Alpha_i                 T_i                 Z_i   mat_IDi\n" + r20(0.0) +
         r20(90.0) + r20(thickness) + r20(0.0) + i10(fabric) + "\n";
}

void add_orthotropic_property(const Deck& deck, std::string& out) {
  const Gathered& model = deck.model;
  out += fmt::format("/PROP/SH_ORTH/{}\ncells\n", deck.cell_part());
  out += "#   Ishell    Ismstr     Ish3n     Idril\n" + i10(24) + i10(0) + i10(0) + i10(0) + "\n";
  out += "#                 hm                  hf                  hr                  dm                  dn\n" +
         r20(0.0) + r20(0.0) + r20(0.0) + r20(0.0) + r20(0.0) + "\n";
  out += "#        N   Istrain               Thick              Ashear              Ithick     Iplas\n" +
         i10(model.scene.model.cell == CellElement::membrane ? 1 : 3) + i10(0) + r20(model.mesh.thickness) + r20(0.0) +
         blank(10) + i10(0) + i10(0) + "\n";
  out += "#                 VX                  VY                  VZ\n" + r20(model.direction[0][0]) +
         r20(model.direction[0][1]) + r20(model.direction[0][2]) + "\n";
}

void add_tool_property(int id, const std::string& title, std::string& out) {
  out += fmt::format("/PROP/SHELL/{}\n{}\n", id, title);
  out += "#   Ishell    Ismstr     Ish3n    Idrill                            P_Thick_Fail\n" + i10(24) + i10(0) +
         i10(0) + i10(0) + blank(20) + r20(0.0) + "\n";
  out += "#                 Hm                  Hf                  Hr                  Dm                  Dn\n" +
         r20(0.0) + r20(0.0) + r20(0.0) + r20(0.0) + r20(0.0) + "\n";
  out += "#        N   Istrain               Thick              Ashear              Ithick     Iplas\n" + i10(1) +
         i10(0) + r20(1.0) + r20(0.0) + blank(10) + i10(0) + i10(0) + "\n";
}

void add_comments(const std::string& name, const std::vector<Constant>& constants, std::string& out) {
  out += fmt::format("# Constants of {} in order:\n", name);
  for (std::size_t k = 0; k < constants.size(); ++k)
    out += fmt::format("#   {}: {} = {}\n", k + 1, constants[k].what, constants[k].value);
}

void add_elastic(int id, const std::string& title, double density, double modulus, double poisson, std::string& out) {
  out += fmt::format("/MAT/ELAST/{}\n{}\n#              RHO_I\n", id, title) + r20(density) +
         "\n#                  E                  Nu\n" + r20(modulus) + r20(poisson) + "\n";
}

// Idle ends have idle_share of a section: with as many times the density they weigh what they should, and the wave in
// them is slow, so that they set no step.
void add_yarn_materials(const Deck& deck, std::string& out) {
  const Gathered& model = deck.model;
  for (std::size_t f = 0; f < 2; ++f) {
    const std::string name = f == 0 ? "warp" : "weft";
    const double modulus = model.card.yarn[f].linear_modulus * model.scene.model.yarn_stiffness_scale;
    const double poisson = model.scene.model.section == Section::incompressible ? 0.49 : 0.0;
    const double density = model.yarn_density(f) * model.scene.analysis.mass_scale;
    add_comments(name, yarn_constants(model, f), out);
    add_elastic(warp + static_cast<int>(f), name, density, modulus, poisson, out);
    const bool idle = std::any_of(model.yarns.begin(), model.yarns.end(),
                                  [&](const YarnGroup& group) { return group.idle && group.family == f; });
    if (idle) add_elastic(idle_warp + static_cast<int>(f), name + "_idle", density / idle_share, modulus, poisson, out);
  }
}

// /MAT/LAW58: fibres that bear next to nothing, shear by the function of the angle in degrees.
void add_fabric_law(const Gathered& model, std::string& out) {
  const double modulus = fibre_modulus(model);
  out += "/MAT/FABR_A/3\nfabric\n#              RHO_I\n" + r20(model.shell_density()) + "\n";
  out += "#                 E1                  B1                  E2                  B2                Flex\n" +
         r20(modulus) + r20(0.0) + r20(modulus) + r20(0.0) + r20(0.01) + "\n";
  out += "#                 G0                  GT              AlphaT                 Gsh           sensor_ID\n" +
         r20(0.0) + r20(0.0) + r20(0.0) + r20(0.0) + blank(10) + i10(0) + "\n";
  out += "#                 Df                  Ds               GFROT                             ZERO_STRESS\n" +
         r20(0.05) + r20(0.0) + r20(0.0) + blank(20) + r20(0.0) + "\n";
  out += "#       N1        N2                  S1                  S2               FLEX1               FLEX2\n" +
         i10(1) + i10(1) + r20(0.0) + r20(0.0) + r20(0.0) + r20(0.0) + "\n";
  for (int k = 1; k <= 3; ++k)
    out += fmt::format("#  FCT_ID{0}                       Fscale{0}\n", k) + i10(k == 3 ? shear_law : 0) + blank(10) +
           r20(1.0) + "\n";
}

void add_user_law(const Gathered& model, std::string& out) {
  const auto constants = shear_constants(model);
  add_comments("fabric", constants, out);
  out += "/MAT/USER1/3\nfabric\n#              RHO_I\n" + r20(model.shell_density()) + "\n" +
         i10(static_cast<long>(constants.size())) + "\n";
  for (std::size_t k = 0; k < constants.size(); k += 5) {
    for (std::size_t c = k; c < std::min(k + 5, constants.size()); ++c) out += r20(constants[c].value);
    out += "\n";
  }
}

}  // namespace

void add_parts(const Deck& deck, std::string& out) {
  const Gathered& model = deck.model;
  add_yarn_parts(deck, out);
  add_part(deck.cell_part(), "cells", deck.cell_part(), fabric, out);
  if (deck.materials == Materials::built_in)
    add_fabric_property(deck, out);
  else
    add_orthotropic_property(deck, out);
  if (!model.members.empty()) {
    const auto& frame = *model.scene.frame;
    add_part(deck.member_part(), "frame_members", deck.member_part(), 0, out);
    add_spring(deck.member_part(), "frame_members", frame.section, model.member_density() * frame.section,
               frame.modulus, 1.0, member_law, out);
  }
  if (!deck.ties.follower.empty()) {
    add_part(deck.follower_part(), "followers", deck.follower_part(), 0, out);
    add_follower_spring(deck, out);
  }
  for (std::size_t k = 0; k < deck.tool.size(); ++k) {
    add_part(deck.tool_part(k), "tool_" + model.tools[k].tool.name, deck.tool_part(k), rigid, out);
    add_tool_property(deck.tool_part(k), "tool_" + model.tools[k].tool.name, out);
  }
}

void add_materials(const Deck& deck, std::string& out) {
  if (!deck.yarns_are_springs()) add_yarn_materials(deck, out);
  if (deck.materials == Materials::built_in)
    add_fabric_law(deck.model, out);
  else
    add_user_law(deck.model, out);
  if (!deck.tool.empty()) add_elastic(rigid, "tools", 1e-15, 210000.0, 0.3, out);  // they weigh what their body says
}

Points shear_points(const Gathered& model, double& changed) {
  constexpr double greatest = 85.0;
  Points points = cell_points_by_angle(model, greatest);
  changed = make_rising(points, model.card.shear.valid_to_deg);
  return points;
}

void add_law_functions(const Deck& deck, std::string& out) {
  const Gathered& model = deck.model;
  if (deck.yarns_are_springs())
    for (std::size_t f = 0; f < 2; ++f)
      add_points(warp_law + static_cast<int>(f),
                 fmt::format("stress of {} s(e) L0/L (MPa) over L/L0 - 1", f == 0 ? "warp" : "weft"),
                 yarn_points(model, f), out);
  double changed = 0.0;
  if (deck.materials == Materials::built_in)
    add_points(shear_law, "shear stress t (MPa) over the shear angle (deg)", shear_points(model, changed), out);
  if (!model.members.empty())
    add_points(member_law, "stress of frame members (MPa) over L/L0 - 1", member_points(model.scene.frame->modulus),
               out);
}

}  // namespace weaveform::foreign::radioss
