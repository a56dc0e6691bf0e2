// What moves and holds the fabric in the OpenRadioss deck, and what is recorded.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/exchange/openradioss/openradioss.hpp"

namespace weaveform::foreign::radioss {

namespace {

void add_way(int function, const std::string& title, double duration, const ToolSpec* tool, std::string& out) {
  Points points;
  for (int k = 0; k <= 100; ++k)
    points.push_back({duration * k / 100.0, tool == nullptr ? smooth_way(k / 100.0) : tool_way(*tool, k / 100.0)});
  add_points(function, title, points, out);
}

void add_motion(int id, const std::string& title, int function, std::size_t axis, int group, double value,
                std::string& out) {
  out += fmt::format("/IMPDISP/{}\n{}\n#  fct_IDT       Dir   Skew_ID   sens_ID    grn_ID\n", id, title) +
         i10(function) + fmt::format("{:>10}", "XYZ"[axis]) + i10(0) + i10(0) + i10(group) +
         "\n#            Ascalex             FscaleY              Tstart               Tstop\n" + r20(1.0) +
         r20(value) + r20(0.0) + r20(0.0) + "\n";
}

// `still` and `turning`: "1" for what is held, along and about x, y, z.
void add_hold(int id, const std::string& title, const std::string& still, const std::string& turning, int group,
              std::string& out) {
  out += fmt::format("/BCS/{}\n{}\n#  Tra rot   skew_ID  grnod_ID\n   {} {}", id, title, still, turning) + i10(0) +
         i10(group) + "\n";
}

void add_force(const char* keyword, int id, const std::string& title, int function, std::size_t axis, int group,
               double value, std::string& out) {
  out += fmt::format(
             "/{}/{}\n{}\n#funct_IDT       Dir   skew_ID sensor_ID  grnod_ID                       Ascalex"
             "             Fscaley\n",
             keyword, id, title) +
         i10(function) + fmt::format("{:>10}", "XYZ"[axis]) + i10(0) + i10(0) + i10(group) + blank(10) + r20(1.0) +
         r20(value) + "\n";
}

void add_grips(const Deck& deck, int& id, std::string& out) {
  const Gathered& model = deck.model;
  for (const auto& grip : model.grips) {
    const int group = model.set_number(grip.set);
    if (group == 0 || model.sets[static_cast<std::size_t>(group) - 1].node.empty()) continue;
    std::string held;  // not moved along these axes: a scale factor of 0 would mean 1
    for (std::size_t c = 0; c < 3; ++c) {
      const bool still = grip.displacement[c] && *grip.displacement[c] == 0.0;
      held += still ? "1" : "0";
      if (grip.displacement[c] && !still) add_motion(++id, grip.set, smooth_step, c, group, *grip.displacement[c], out);
    }
    if (held != "000") add_hold(++id, grip.set, held, "000", group, out);
  }
}

void add_weight(const Deck& deck, int& id, std::string& out) {
  const auto& gravity = deck.model.scene.analysis.gravity;
  if (gravity == std::array<double, 3>{0.0, 0.0, 0.0}) return;
  const double scale = deck.model.scene.analysis.mass_scale;  // of the mass, which the weight has not
  add_points(constant, "one", {{0.0, 1.0}, {1e6, 1.0}}, out);
  for (std::size_t c = 0; c < 3; ++c)
    if (gravity[c] != 0.0) add_force("GRAV", ++id, "weight", constant, c, deck.all_nodes(), gravity[c] / scale, out);
}

void add_body(const Deck& deck, std::size_t k, std::string& out) {
  const ToolMotion& motion = deck.model.tools[k];
  const int id = static_cast<int>(k) + 1;
  const double mass = tool_mass(deck.model, motion);
  const double reach = 100.0;  // mm; of a turning that nothing asks for
  out += fmt::format("/RBODY/{}\n{}\n", id, motion.tool.name);
  out += "#  node_ID   sens_ID   Skew_ID    Ispher                Mass   grnd_ID     Ikrem      ICoG   surf_ID\n" +
         i10(deck.main_node(k)) + i10(0) + i10(0) + i10(1) + r20(mass) + i10(deck.surface_group(k)) + i10(0) + i10(3) +
         i10(0) + "\n";
  const double inertia = mass * reach * reach;
  out += "#                Jxx                 Jyy                 Jzz\n" + r20(inertia) + r20(inertia) + r20(inertia) +
         "\n#                Jxy                 Jyz                 Jxz\n" + r20(0.0) + r20(0.0) + r20(0.0) +
         "\n#  Ioptoff\n" + i10(0) + "\n";
}

// Contact of the fabric's nodes with the tool's shells at the fabric's half thickness, on either side of them.
void add_contact(const Deck& deck, std::size_t k, std::string& out) {
  const Tool& tool = deck.model.tools[k].tool;
  const int id = static_cast<int>(k) + 1;
  out += fmt::format("/SURF/PART/{}\n{}\n", id, tool.name) + i10(deck.tool_part(k)) + "\n";
  out += fmt::format("/INTER/TYPE7/{}\n{}\n", id, tool.name);
  out += "# grnod_id   surf_id      Istf      Ithe      Igap                Ibag      Idel     Icurv      Iadm\n" +
         i10(deck.all_nodes()) + i10(id) + i10(1) + i10(0) + i10(0) + blank(10) + i10(0) + i10(0) + i10(0) + i10(0) +
         "\n";
  out += "#          Fscalegap             Gap_max             Fpenmax                         Itied\n" + r20(0.0) +
         r20(0.0) + r20(0.0) + blank(20) + i10(0) + "\n";
  out += "#              Stmin               Stmax   Percent_mesh_size               dtmin  Irem_gap   Irem_i2\n" +
         r20(0.0) + r20(0.0) + r20(0.0) + r20(0.0) + i10(0) + i10(0) + "\n";
  out += "#              Stfac                Fric              GAPmin              Tstart               Tstop\n" +
         r20(contact_stiffness(deck.model)) + r20(tool.friction) + r20(tool.offset) + r20(0.0) + r20(0.0) + "\n";
  out += "#      IBC                        Inacti               VIS_S               VIS_F              Bumult\n" +
         blank(7) + "000" + blank(20) + i10(6) + r20(0.0) + r20(0.0) + r20(0.0) + "\n";
  out += "#    Ifric    Ifiltr               Xfreq     Iform   sens_ID   fct_IDF             AscaleF   fric_ID\n" +
         i10(0) + i10(0) + r20(0.0) + i10(2) + i10(0) + i10(0) + r20(0.0) + i10(0) + "\n";
}

void add_tool_motion(const Deck& deck, std::size_t k, int& id, std::vector<std::string>& lost, std::string& out) {
  const ToolMotion& motion = deck.model.tools[k];
  const Tool& tool = motion.tool;
  const int group = deck.main_group(k);
  std::string held;
  if (motion.spec->force) {
    std::size_t along = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      held += std::abs(tool.direction[c]) < 1e-12 ? "1" : "0";
      if (held.back() == '0') ++along;
      if (held.back() == '0')
        add_force("CLOAD", ++id, tool.name, rise, c, group, *motion.spec->force * tool.direction[c], out);
    }
    if (along > 1)
      lost.push_back(fmt::format("tool '{}': pushed along no axis of the world, it may also go aside", tool.name));
    lost.push_back(fmt::format("tool '{}': its damping of {:g} 1/s", tool.name, motion.spec->damping));
  } else {
    const int way = first_way + static_cast<int>(k);
    const bool moves = motion.travel != std::array<double, 3>{0.0, 0.0, 0.0};
    if (moves) add_way(way, "way_" + tool.name, deck.model.duration, motion.spec, out);
    for (std::size_t c = 0; c < 3; ++c) {
      held += motion.travel[c] == 0.0 ? "1" : "0";
      if (motion.travel[c] != 0.0) add_motion(++id, tool.name, way, c, group, motion.travel[c], out);
    }
  }
  add_hold(++id, tool.name, held, "111", group, out);
}

void add_tools(const Deck& deck, int& id, std::vector<std::string>& lost, std::string& out) {
  const auto& tools = deck.model.tools;
  if (std::any_of(tools.begin(), tools.end(), [](const ToolMotion& motion) { return motion.spec->force.has_value(); }))
    add_points(rise, "rise of forces", rise_of_forces(deck.model.duration), out);
  for (std::size_t k = 0; k < deck.tool.size(); ++k) {
    lost.push_back(
        fmt::format("tool '{}': a rigid body of {} shells, within {:g} mm of its surface; contact by "
                    "penalty at {:.4g} mm from them, with its friction",
                    tools[k].tool.name, deck.tool[k].face.size(),
                    tools[k].tool.shape == ToolShape::triangles ? 0.0 : tool_sagitta, tools[k].tool.offset));
    add_body(deck, k, out);
    add_contact(deck, k, out);
    add_tool_motion(deck, k, id, lost, out);
  }
}

}  // namespace

// sum alpha_i v_i = 0, one per axis.
void add_ties(const Deck& deck, std::string& out) {
  int id = 0;
  for (const auto& tie : deck.ties.tie)
    for (int c = 1; c <= 3; ++c) {
      out += fmt::format("/MPC/{}\ntie of node {}\n#  node_ID      Idof   skew_ID               alpha\n", ++id,
                         tie.node + 1);
      const auto add = [&](int node, double alpha) { out += i10(node + 1) + i10(c) + i10(0) + r20(alpha) + "\n"; };
      add(tie.node, 1.0);
      add(tie.to[0], tie.share - 1.0);
      add(tie.to[1], -tie.share);
    }
}

void add_loads(const Deck& deck, std::vector<std::string>& lost, std::string& out) {
  add_way(smooth_step, "smooth_step", deck.model.duration, nullptr, out);
  int id = 0;
  add_grips(deck, id, out);
  add_weight(deck, id, out);
  add_tools(deck, id, lost, out);
}

void add_histories(const Deck& deck, std::string& out) {
  std::string nodes;
  for (const auto& grip : deck.model.grips) {
    const int set = deck.model.set_number(grip.set);
    if (set == 0) continue;
    for (const int n : deck.model.sets[static_cast<std::size_t>(set) - 1].node)
      nodes += i10(n + 1) + i10(0) + fmt::format("{}_{}\n", grip.set, n + 1);
  }
  if (!nodes.empty())
    out += "/TH/NODE/1\ngrips\n#     var1      var2      var3      var4\n" +
           fmt::format("{:<10}{:<10}{:<10}{:<10}\n", "DEF", "REACX", "REACY", "REACZ") +
           "#    NODid     Iskew                                           NODname\n" + nodes;
  if (deck.tool.empty()) return;
  std::string bodies;
  for (std::size_t k = 0; k < deck.tool.size(); ++k) bodies += i10(static_cast<long>(k) + 1);
  out += "/TH/RBODY/2\ntools\n#     var1\n" + fmt::format("{:<10}\n", "DEF") + bodies + "\n";
  out += "/TH/INTER/3\ncontacts\n#     var1\n" + fmt::format("{:<10}\n", "DEF") + bodies + "\n";
}

}  // namespace weaveform::foreign::radioss
