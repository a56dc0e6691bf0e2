// What moves and holds the fabric in the LS-DYNA deck, and what is recorded.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/exchange/lsdyna/lsdyna.hpp"

namespace weaveform::foreign::lsdyna {

namespace {

Points way_of(double duration, const ToolSpec* tool, double travel) {
  Points points;
  for (int k = 0; k <= 100; ++k)
    points.push_back(
        {duration * k / 100.0, travel * (tool == nullptr ? smooth_way(k / 100.0) : tool_way(*tool, k / 100.0))});
  return points;
}

void add_grips(const Deck& deck, std::string& out) {
  for (const auto& grip : deck.model.grips) {
    const int set = deck.model.set_number(grip.set);
    if (set == 0 || deck.model.sets[static_cast<std::size_t>(set) - 1].node.empty()) continue;
    for (int c = 0; c < 3; ++c) {
      if (!grip.displacement[c]) continue;
      out += "*BOUNDARY_PRESCRIBED_MOTION_SET\n$#     nsid       dof       vad      lcid        sf\n";
      Card10(out).i(set).i(c + 1).i(2).i(smooth_step).r(*grip.displacement[c]);
    }
  }
}

// A body load is the acceleration of the base, against which things weigh.
void add_weight(const Deck& deck, std::string& out) {
  const auto& gravity = deck.model.scene.analysis.gravity;
  if (gravity == std::array<double, 3>{0.0, 0.0, 0.0}) return;
  add_curve(constant, "one", {{0.0, 1.0}, {1e6, 1.0}}, out);
  for (std::size_t c = 0; c < 3; ++c) {
    if (gravity[c] == 0.0) continue;
    out += fmt::format("*LOAD_BODY_{}\n$#     lcid        sf\n", "XYZ"[c]);
    Card10(out).i(constant).r(-gravity[c] / deck.model.scene.analysis.mass_scale);
  }
}

// Nodes of the fabric alone: 0 would take every node, those of other tools among them.
void add_wall(const Deck& deck, std::size_t k, std::string& out) {
  const ToolMotion& motion = deck.model.tools[k];
  const Tool& tool = motion.tool;
  const char* shape =
      tool.shape == ToolShape::plane ? "FLAT" : (tool.shape == ToolShape::sphere ? "SPHERE" : "CYLINDER");
  const auto &o = tool.start.origin, &a = tool.start.axis, &d = tool.direction;
  out += fmt::format("*RIGIDWALL_GEOMETRIC_{}_MOTION_ID\n{:>10}{}\n$#     nsid    nsidex     boxid\n", shape, k + 1,
                     tool.name);
  Card10(out).i(deck.all_nodes()).i(0).i(0);
  Card10(out).r(o[0]).r(o[1]).r(o[2]).r(o[0] + a[0]).r(o[1] + a[1]).r(o[2] + a[2]).r(tool.friction);
  if (tool.shape == ToolShape::plane) {
    const bool along = std::abs(a[0]) > 0.9;  // an edge of the endless flat: any direction in its plane
    Card10(out).r(o[0] + (along ? 0.0 : 1.0)).r(o[1] + (along ? 1.0 : 0.0)).r(o[2]).r(0.0).r(0.0);
  } else if (tool.shape == ToolShape::sphere) {
    Card10(out).r(tool.radius);
  } else {
    Card10(out).r(tool.radius).r(0.0);
  }
  const int curve = first_way + static_cast<int>(k);
  Card10(out).i(curve).i(1).r(d[0]).r(d[1]).r(d[2]);  // OPT 1: displacement along (vx, vy, vz)
  add_curve(curve, tool.name + ": displacement (mm) by time (s)",
            way_of(deck.model.duration, motion.spec, motion.spec->travel), out);
}

// Half the thickness given to the fabric's nodes is what keeps them off the tool.
void add_contact(const Deck& deck, std::size_t k, std::string& out) {
  const Tool& tool = deck.model.tools[k].tool;
  out += fmt::format("*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID\n{:>10}{}\n", k + 1, tool.name);
  out += "$#     ssid      msid     sstyp     mstyp    sboxid    mboxid       spr       mpr\n";
  Card10(out).i(deck.all_nodes()).i(deck.tool_part(k)).i(4).i(3).i(0).i(0).i(1).i(1);
  out += "$#       fs        fd        dc        vc       vdc    penchk        bt        dt\n";
  Card10(out).r(tool.friction).r(tool.friction).r(0.0).r(0.0).r(20.0).i(0).r(0.0).r(1e20);
  out += "$#      sfs       sfm       sst       mst      sfst      sfmt       fsf       vsf\n";
  Card10(out).r(1.0).r(1.0).r(2.0 * tool.offset).r(0.0).r(1.0).r(1.0).r(1.0).r(1.0);
  out += "$#     soft    sofscl    lcidab    maxpar     sbopt     depth     bsort    frcfrq\n";
  Card10(out).i(1).r(0.1).i(0).r(1.025).r(2.0).i(2).i(0).i(1);
}

void add_body_motion(const Deck& deck, std::size_t k, std::vector<std::string>& lost, std::string& out) {
  const ToolMotion& motion = deck.model.tools[k];
  const Tool& tool = motion.tool;
  const int curve = first_way + static_cast<int>(k);
  if (motion.spec->force) {
    int along = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      if (std::abs(tool.direction[c]) < 1e-12) continue;
      ++along;
      out += "*LOAD_RIGID_BODY\n$#      pid       dof      lcid        sf       cid\n";
      Card10(out)
          .i(deck.tool_part(k))
          .i(static_cast<long>(c) + 1)
          .i(rise)
          .r(*motion.spec->force * tool.direction[c])
          .i(0);
    }
    if (along > 1)
      lost.push_back(fmt::format("tool '{}': pushed along no axis of the world, it may also go aside", tool.name));
    lost.push_back(fmt::format("tool '{}': its damping of {:g} 1/s", tool.name, motion.spec->damping));
    return;
  }
  if (motion.travel == std::array<double, 3>{0.0, 0.0, 0.0}) return;
  add_curve(curve, tool.name + ": part of the way by time (s)", way_of(deck.model.duration, motion.spec, 1.0), out);
  for (std::size_t c = 0; c < 3; ++c) {
    if (motion.travel[c] == 0.0) continue;
    out += "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n$#      pid       dof       vad      lcid        sf\n";
    Card10(out).i(deck.tool_part(k)).i(static_cast<long>(c) + 1).i(2).i(curve).r(motion.travel[c]);
  }
}

void add_tools(const Deck& deck, std::vector<std::string>& lost, std::string& out) {
  const auto& tools = deck.model.tools;
  if (std::any_of(tools.begin(), tools.end(), [](const ToolMotion& motion) { return motion.spec->force.has_value(); }))
    add_curve(rise, "rise of forces", rise_of_forces(deck.model.duration), out);
  for (std::size_t k = 0; k < tools.size(); ++k) {
    const Tool& tool = tools[k].tool;
    if (is_rigid_wall(tools[k])) {
      if (tool.shape == ToolShape::sphere)
        lost.push_back(fmt::format("tool '{}': the sphere is written without its shank", tool.name));
      lost.push_back(
          fmt::format("tool '{}': its offset of {:.4g} mm from the fabric's middle plane", tool.name, tool.offset));
      add_wall(deck, k, out);
      continue;
    }
    lost.push_back(fmt::format(
        "tool '{}': a rigid body of {} shells, within {:g} mm of its surface; contact by "
        "penalty at {:.4g} mm from them, with its friction",
        tool.name, deck.tool[k].face.size(), tool.shape == ToolShape::triangles ? 0.0 : tool_sagitta, tool.offset));
    add_contact(deck, k, out);
    add_body_motion(deck, k, lost, out);
  }
}

}  // namespace

// Of the shapes that the format has, those that go a way of their own.
bool is_rigid_wall(const ToolMotion& motion) {
  const ToolShape shape = motion.tool.shape;
  const bool known = shape == ToolShape::plane || shape == ToolShape::sphere || shape == ToolShape::cylinder;
  return known && !motion.spec->force;
}

void add_loads(const Deck& deck, std::vector<std::string>& lost, std::string& out) {
  add_curve(smooth_step, "smooth step: part of the way by time (s)", way_of(deck.model.duration, nullptr, 1.0), out);
  add_grips(deck, out);
  add_weight(deck, out);
  add_tools(deck, lost, out);
}

void add_control(const Deck& deck, std::string& out) {
  const Gathered& model = deck.model;
  const auto every = [&](int parts) { return model.duration / (parts > 0 ? parts : 1); };
  out += "*CONTROL_TERMINATION\n";
  Card10(out).r(model.duration);
  out += "*CONTROL_TIMESTEP\n$#   dtinit    tssfac\n";
  Card10(out).r(0.0).r(model.scene.analysis.step_factor);
  // curves of materials are read again at lcint even steps, by themselves 100
  out += "*CONTROL_SOLUTION\n$#     soln       nlq               lcint\n";
  Card10(out).i(0).i(0).i(0).i(2001);
  out += "*DATABASE_BINARY_D3PLOT\n";
  Card10(out).r(every(model.scene.output.frames));
  for (const char* what : {"BNDOUT", "GLSTAT", "RCFORC", "RWFORC", "RBDOUT"}) {
    out += fmt::format("*DATABASE_{}\n", what);
    Card10(out).r(every(model.scene.output.history));
  }
}

}  // namespace weaveform::foreign::lsdyna
