// OpenRadioss starter deck (block format 2021): fields of 10 columns for integers, 20 for reals.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/export/writers.hpp"

namespace weaveform::foreign {

namespace {

std::string i10(long value) {
  return fmt::format("{:>10}", value);
}
std::string r20(double value) {
  return fmt::format("{:>20}", fit(value, 19));
}

// Ids: parts, properties of yarn groups from 1, the cells' after them; materials 1 warp, 2 weft, 3 fabric; node groups
// as the mesh's sets from 1, then one for all nodes; functions 1 the smooth step, tools' from 11.
int cell_part(const Gathered& model) {
  return static_cast<int>(model.yarns.size()) + 1;
}
int all_nodes(const Mesh& mesh) {
  return static_cast<int>(mesh.sets.size()) + 1;
}
int set_id(const Mesh& mesh, const std::string& name) {
  for (std::size_t s = 0; s < mesh.sets.size(); ++s)
    if (mesh.sets[s].name == name) return static_cast<int>(s) + 1;
  return 0;
}

// Nodes of moving rigid walls, after the mesh's own.
int tool_node(const Gathered& model, std::size_t tool) {
  return model.mesh.node_count() + 1 + static_cast<int>(tool);
}
bool is_wall(const ToolMotion& motion) {
  const ToolShape shape = motion.tool.shape;
  return shape == ToolShape::plane || shape == ToolShape::sphere || shape == ToolShape::cylinder;
}

void add_nodes(const Gathered& model, std::string& out) {
  out += "/NODE\n";
  const auto add = [&](int number, const std::array<double, 3>& x) {
    out += i10(number) + r20(x[0]) + r20(x[1]) + r20(x[2]) + "\n";
  };
  for (int n = 0; n < model.mesh.node_count(); ++n) add(n + 1, model.mesh.nodes.position[n]);
  for (std::size_t k = 0; k < model.tools.size(); ++k)
    if (is_wall(model.tools[k])) add(tool_node(model, k), model.tools[k].tool.start.origin);
}

void add_elements(const Gathered& model, std::string& out) {
  const bool beam = model.scene.model.yarn == "beam";
  for (std::size_t g = 0; g < model.yarns.size(); ++g) {
    out += fmt::format("/{}/{}\n", beam ? "BEAM" : "TRUSS", g + 1);
    for (const int e : model.yarns[g].element) {
      const auto& n = model.mesh.yarns.node[e];
      out += i10(e + 1) + i10(n[0] + 1) + i10(n[1] + 1) + "\n";
    }
  }
  for (const int size : {4, 3}) {
    bool begun = false;
    for (std::size_t k = 0; k < model.shells.size(); ++k) {
      const Shell& shell = model.shells[k];
      if (shell.size() != size) continue;
      if (!begun) out += fmt::format("/{}/{}\n", size == 4 ? "SHELL" : "SH3N", cell_part(model));
      begun = true;
      out += i10(model.first_shell() + static_cast<int>(k));
      for (int c = 0; c < size; ++c) out += i10(shell.node[c] + 1);
      out += "\n";
    }
  }
}

void add_parts(const Gathered& model, std::string& out) {
  const bool beam = model.scene.model.yarn == "beam";
  for (std::size_t g = 0; g < model.yarns.size(); ++g) {
    const auto& group = model.yarns[g];
    const long id = static_cast<long>(g) + 1;
    out += fmt::format("/PART/{}\n{}\n", id, group.name) + i10(id) + i10(static_cast<long>(group.family) + 1) + i10(0) +
           "\n";
    if (beam) {  // a round section: I = A^2 / (4 pi)
      const double inertia = group.section * group.section / (4.0 * 3.14159265358979323846);
      out += fmt::format("/PROP/BEAM/{}\n{}\n", id, group.name) + i10(0) + "\n" + r20(0.0) + r20(0.0) + "\n" +
             r20(group.section) + r20(inertia) + r20(inertia) + r20(2.0 * inertia) + "\n" + i10(0) + i10(0) + "\n";
    } else {
      out += fmt::format("/PROP/TRUSS/{}\n{}\n#               Area              Gapini\n", id, group.name) +
             r20(group.section) + r20(0.0) + "\n";
    }
  }
  const long id = cell_part(model);
  const double angle_x = model.direction[0][0], angle_y = model.direction[0][1];
  out += fmt::format("/PART/{}\ncells\n", id) + i10(id) + i10(3) + i10(0) + "\n";
  out += fmt::format("/PROP/SH_ORTH/{}\ncells\n", id);
  out += "#   Ishell    Ismstr     Ish3n     Idril\n" + i10(24) + i10(0) + i10(0) + i10(0) + "\n";
  out += "#                 hm                  hf                  hr                  dm                  dn\n" +
         r20(0.0) + r20(0.0) + r20(0.0) + r20(0.0) + r20(0.0) + "\n";
  out += "#        N   Istrain               Thick              Ashear              Ithick     Iplas\n" +
         i10(model.scene.model.cell == "membrane" ? 1 : 3) + i10(0) + r20(model.mesh.thickness) + r20(0.0) +
         fmt::format("{:>20}", 0) + i10(0) + "\n";
  out +=
      "#                 VX                  VY                  VZ\n" + r20(angle_x) + r20(angle_y) + r20(0.0) + "\n";
}

void add_comments(const std::string& name, const std::vector<Constant>& constants, std::string& out) {
  out += fmt::format("# Constants of {} in order:\n", name);
  for (std::size_t k = 0; k < constants.size(); ++k)
    out += fmt::format("#   {}: {} = {}\n", k + 1, constants[k].what, constants[k].value);
}

void add_materials(const Gathered& model, std::string& out) {
  for (std::size_t f = 0; f < 2; ++f) {
    const std::string name = f == 0 ? "warp" : "weft";
    add_comments(name, yarn_constants(model, f), out);
    out += fmt::format("/MAT/ELAST/{}\n{}\n#              RHO_I\n", f + 1, name) + r20(model.yarn_density(f)) +
           "\n#                  E                  Nu\n" +
           r20(model.card.yarn[f].linear_modulus * model.scene.model.yarn_stiffness_scale) +
           r20(model.scene.model.section == "incompressible" ? 0.5 : 0.0) + "\n";
  }
  const auto constants = shear_constants(model);
  add_comments("fabric", constants, out);
  out += "/MAT/USER1/3\nfabric\n#              RHO_I\n" + r20(model.shell_density()) + "\n" +
         i10(static_cast<long>(constants.size())) + "\n";
  for (std::size_t k = 0; k < constants.size(); k += 5) {
    for (std::size_t c = k; c < std::min(k + 5, constants.size()); ++c) out += r20(constants[c].value);
    out += "\n";
  }
}

void add_group(int id, const std::string& name, const std::vector<int>& node, std::string& out) {
  out += fmt::format("/GRNOD/NODE/{}\n{}\n", id, name);
  for (std::size_t k = 0; k < node.size(); ++k)
    out += i10(node[k] + 1) + (k + 1 == node.size() || k % 10 == 9 ? "\n" : "");
}

void add_sets(const Mesh& mesh, std::string& out) {
  for (std::size_t s = 0; s < mesh.sets.size(); ++s)
    if (!mesh.sets[s].node.empty()) add_group(static_cast<int>(s) + 1, mesh.sets[s].name, mesh.sets[s].node, out);
  std::vector<int> all(mesh.node_count());
  for (int n = 0; n < mesh.node_count(); ++n) all[n] = n;
  add_group(all_nodes(mesh), "all_nodes", all, out);
}

// sum alpha_i v_i = 0, one per axis.
void add_ties(const Mesh& mesh, std::string& out) {
  int id = 0;
  for (const auto& tie : mesh.tie)
    for (int c = 1; c <= 3; ++c) {
      out += fmt::format("/MPC/{}\ntie of node {}\n#  node_ID      Idof   skew_ID               alpha\n", ++id,
                         tie.node + 1);
      const auto add = [&](int node, double alpha) { out += i10(node + 1) + i10(c) + i10(0) + r20(alpha) + "\n"; };
      add(tie.node, 1.0);
      add(tie.to[0], tie.share - 1.0);
      add(tie.to[1], -tie.share);
    }
}

void add_function(int id, const std::string& name, double duration, const ToolSpec* tool, std::string& out) {
  out += fmt::format("/FUNCT/{}\n{}\n#                  X                   Y\n", id, name);
  for (int k = 0; k <= 100; ++k)
    out += r20(duration * k / 100.0) + r20(tool == nullptr ? smooth_way(k / 100.0) : tool_way(*tool, k / 100.0)) + "\n";
}

void add_motion(int id, const std::string& name, int function, int axis, int group, double value, std::string& out) {
  out += fmt::format("/IMPDISP/{}\n{}\n#  fct_IDT       Dir   Skew_ID   sens_ID    grn_ID\n", id, name) +
         i10(function) + fmt::format("{:>10}", "XYZ"[axis]) + i10(0) + i10(0) + i10(group) +
         "\n#            Ascalex             FscaleY\n" + r20(1.0) + r20(value) + "\n";
}

void add_grips(const Gathered& model, int& id, std::string& out) {
  for (const auto& grip : model.grips) {
    std::string held;  // not moved along these axes: a scale factor of 0 would mean 1
    for (int c = 0; c < 3; ++c) {
      const bool still = grip.displacement[c] && *grip.displacement[c] == 0.0;
      held += still ? "1" : "0";
      if (grip.displacement[c] && !still)
        add_motion(++id, grip.set, 1, c, set_id(model.mesh, grip.set), *grip.displacement[c], out);
    }
    if (held == "000") continue;
    out += fmt::format("/BCS/{}\n{}\n#  Tra rot   skew_ID  grnod_ID\n   {} 000", ++id, grip.set, held) + i10(0) +
           i10(set_id(model.mesh, grip.set)) + "\n";
  }
}

void add_tools(const Gathered& model, int& id, std::vector<std::string>& lost, std::string& out) {
  for (std::size_t k = 0; k < model.tools.size(); ++k) {
    const ToolMotion& motion = model.tools[k];
    const Tool& tool = motion.tool;
    if (!is_wall(motion)) {
      lost.push_back(fmt::format("tool '{}': its shape '{}' is no rigid wall of the format; not written", tool.name,
                                 motion.spec->shape));
      continue;
    }
    if (tool.shape == ToolShape::sphere)
      lost.push_back(fmt::format("tool '{}': the sphere is written without its shank", tool.name));
    lost.push_back(
        fmt::format("tool '{}': its offset of {:.4g} mm from the fabric's middle plane", tool.name, tool.offset));
    const int node = tool_node(model, k), group = all_nodes(model.mesh) + 1 + static_cast<int>(k);
    const char* shape = tool.shape == ToolShape::plane ? "PLANE" : (tool.shape == ToolShape::sphere ? "SPHER" : "CYL");
    out += fmt::format("/RWALL/{}/{}\n{}\n#  node_ID     Slide  grnd_ID1  grnd_ID2\n", shape, k + 1, tool.name) +
           i10(node) + i10(2) + i10(all_nodes(model.mesh)) + i10(0) + "\n";
    out += "#            Dsearch                fric            Diameter                ffac       ifq\n" + r20(0.0) +
           r20(tool.friction) + r20(tool.shape == ToolShape::plane ? 0.0 : 2.0 * tool.radius) + r20(0.0) + i10(0) +
           "\n";
    out += "#               Mass                 VX0                 VY0                 VZ0\n" +
           r20(motion.spec->mass.value_or(0.0)) + r20(0.0) + r20(0.0) + r20(0.0) + "\n";
    if (tool.shape != ToolShape::sphere) {
      const auto& o = tool.start.origin;
      const auto& a = tool.start.axis;
      out += "#                XM1                 YM1                 ZM1\n" + r20(o[0] + a[0]) + r20(o[1] + a[1]) +
             r20(o[2] + a[2]) + "\n";
    }
    add_group(group, "ref_" + tool.name, {node - 1}, out);
    const int function = 11 + static_cast<int>(k);
    if (motion.spec->force) {
      lost.push_back(
          fmt::format("tool '{}': its force is not written (a constant force needs a concentrated load)", tool.name));
      continue;
    }
    add_function(function, "way_" + tool.name, model.duration, motion.spec, out);
    std::string held;
    for (int c = 0; c < 3; ++c) {
      held += motion.travel[c] == 0.0 ? "1" : "0";
      if (motion.travel[c] != 0.0) add_motion(++id, tool.name, function, c, group, motion.travel[c], out);
    }
    if (held != "000")
      out += fmt::format("/BCS/{}\n{}\n#  Tra rot   skew_ID  grnod_ID\n   {} 000", ++id, tool.name, held) + i10(0) +
             i10(group) + "\n";
  }
}

}  // namespace

ExportedMesh write_openradioss(const Gathered& model) {
  ExportedMesh result{"", model.not_carried};
  auto& lost = result.not_carried;
  lost.push_back(
      "yarns: the code takes no user material on trusses and beams, so they are linear, with the card's "
      "linear modulus and the same in compression; decrimping is lost, the law stands in the comments");
  if (model.scene.model.yarn == "seatbelt") lost.push_back("model.yarn = \"seatbelt\": written as trusses");
  if (!model.mesh.tie.empty()) lost.push_back("ties: written as /MPC between velocities");
  lost.push_back("the analysis (duration, output): of the engine file, which is not written");
  std::string body;
  add_nodes(model, body);
  add_elements(model, body);
  add_parts(model, body);
  add_materials(model, body);
  add_sets(model.mesh, body);
  add_ties(model.mesh, body);
  add_function(1, "smooth_step", model.duration, nullptr, body);
  int id = 0;
  add_grips(model, id, body);
  add_tools(model, id, lost, body);
  result.text = "#RADIOSS STARTER\n" + header(model, "#", lost) + "/BEGIN\nfabric\n" + i10(2021) + i10(0) + "\n" +
                fmt::format("{0:>20}{1:>20}{2:>20}\n{0:>20}{1:>20}{2:>20}\n", "Mg", "mm", "s") + body + "/END\n";
  return result;
}

}  // namespace weaveform::foreign
