// CalculiX input file (checked with ccx 2.20). CalculiX has no law for fabrics, but springs with a table of force over
// elongation, SPRINGA with *SPRING, NONLINEAR, whose axis turns with its nodes: the yarn law is such a table, jaws
// included, and the shear cells are springs across them (cell_springs.hpp). Springs weigh nothing, so that every node
// has the very mass that Weaveform lumps, as a MASS element.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/vector/vector.hpp"
#include "mesher/exchange/abaqus/inp_words.hpp"
#include "mesher/exchange/cell_springs.hpp"
#include "mesher/exchange/laws.hpp"
#include "mesher/exchange/ties.hpp"
#include "mesher/exchange/writers.hpp"

namespace weaveform::foreign {

namespace {

constexpr std::size_t most_points = 200;  // that CalculiX reads of a table

// The line after *SPRING holds directions of other kinds of springs.
void add_law(const std::string& set, const Points& points, std::string& out) {
  out += fmt::format("*SPRING, ELSET={}, NONLINEAR\n\n", set);
  for (const auto& [elongation, force] : points) out += fmt::format("{}, {}\n", num(force), num(elongation));
}

double start_length(const Mesh& mesh, const std::array<int, 2>& node) {
  return distance(mesh.nodes.position[node[0]], mesh.nodes.position[node[1]]);
}

// Elements of a group of yarns that have the same table: equally long, flat and at the start.
struct SameYarns {
  double rest = 0.0, start = 0.0;  // mm
  std::vector<int> element;
};
std::vector<SameYarns> same_yarns(const Mesh& mesh, const YarnGroup& group) {
  const auto agree = [](double a, double b) { return std::abs(a - b) <= 1e-9 * b; };
  std::vector<SameYarns> parts;
  for (const int e : group.element) {
    const double rest = mesh.yarns.rest_length[e], start = start_length(mesh, mesh.yarns.node[e]);
    const auto same = std::find_if(parts.begin(), parts.end(), [&](const SameYarns& part) {
      return agree(rest, part.rest) && agree(start, part.start);
    });
    if (same != parts.end())
      same->element.push_back(e);
    else
      parts.push_back({rest, start, {e}});
  }
  return parts;
}

// N = A f(x L0/(L0 + jaw)) over L - start, from where the element has lost a fourth of its length on.
Points force_of(const YarnGroup& group, const SameYarns& yarns, const Gathered& model) {
  std::vector<double> knots = yarn_knots(model, group.family, std::log1p(-0.25 / group.jaw_stretch));
  for (double& knot : knots) knot = std::expm1(knot);
  const auto law = [&](double x) { return group.section * yarn_force_per_section(model, group.family, x); };
  Points points = fitted_points(law, knots, 1e-11 * group.section * yarn_stiffness(model, group.family), most_points);
  for (auto& point : points) point[0] = yarns.rest * (1.0 + point[0] * group.jaw_stretch) - yarns.start;
  return points;
}

void add_yarns(const Gathered& model, std::array<std::string, 2>& family_sets, std::string& out) {
  for (const auto& group : model.yarns) {
    if (group.idle) continue;  // carries nothing, and its tie holds its end
    int number = 0;
    for (const auto& yarns : same_yarns(model.mesh, group)) {
      const std::string set = fmt::format("{}_{}", group.name, ++number);
      out += fmt::format("*ELEMENT, TYPE=SPRINGA, ELSET={}\n", set);
      for (const int e : yarns.element)
        out += fmt::format("{}, {}, {}\n", e + 1, model.mesh.yarns.node[e][0] + 1, model.mesh.yarns.node[e][1] + 1);
      add_law(set, force_of(group, yarns, model), out);
      family_sets[group.family] += set + "\n";
    }
  }
}

void add_mirrored_nodes(const Mesh& mesh, const CellSprings& springs, std::string& out) {
  const auto& x = mesh.nodes.position;
  if (!springs.mirrored.empty()) out += "** Corners of cells at the outline, mirrored in a corner beside them\n";
  int number = mesh.node_count();
  for (const auto& node : springs.mirrored) {
    const auto &o = x[node.through], &a = x[node.of];
    out += fmt::format("*NODE\n{}, {}, {}, {}\n", ++number, num(2.0 * o[0] - a[0]), num(2.0 * o[1] - a[1]),
                       num(2.0 * o[2] - a[2]));
  }
}

void add_mirrored_ties(const Mesh& mesh, const CellSprings& springs, std::string& out) {
  int number = mesh.node_count();
  for (const auto& node : springs.mirrored) {
    ++number;
    for (int c = 1; c <= 3; ++c)
      out += fmt::format("*EQUATION\n3\n{0}, {1}, 1., {2}, {1}, -2., {3}, {1}, 1.\n", number, c, node.through + 1,
                         node.of + 1);
  }
}

void add_cells(const Gathered& model, const CellSprings& springs, int& element, std::string& out) {
  int number = 0;
  std::string names;
  add_mirrored_nodes(model.mesh, springs, out);
  for (const auto& group : springs.group) {
    const std::string set = fmt::format("CELLS_{}", ++number);
    out += fmt::format("*ELEMENT, TYPE=SPRINGA, ELSET={}\n", set);
    for (const auto& node : group.node) out += fmt::format("{}, {}, {}\n", ++element, node[0] + 1, node[1] + 1);
    add_law(set, spring_points(model, group, most_points), out);
    names += set + "\n";
  }
  out += "*ELSET, ELSET=CELLS\n" + names;
}

void add_members(const Gathered& model, int& element, std::string& out) {
  if (model.members.empty()) return;
  const auto& frame = *model.scene.frame;
  out += "*ELEMENT, TYPE=SPRINGA, ELSET=FRAME\n";
  for (const auto& member : model.members)
    out += fmt::format("{}, {}, {}\n", ++element, member.node[0] + 1, member.node[1] + 1);
  Points points = member_points(frame.modulus);
  for (auto& point : points) {
    point[0] *= frame.length;
    point[1] *= frame.section;
  }
  add_law("FRAME", points, out);
}

// CalculiX counts a tie's force to no node, so that the reaction of a held node lacked it: held nodes hold followers by
// springs, which it does count.
void add_followers(const Gathered& model, const FreeTies& ties, int first, int& element, std::string& out) {
  if (ties.follower.empty()) return;
  out += "** Followers of held nodes, to which ties refer\n";
  int number = first;
  for (const int n : ties.follower) {
    const auto& x = model.mesh.nodes.position[n];
    out += fmt::format("*NODE\n{}, {}, {}, {}\n", number++, num(x[0]), num(x[1]), num(x[2]));
  }
  const auto [stiffness, mass] = holding_spring(model);
  for (int c = 1; c <= 3; ++c) {
    out += fmt::format("*ELEMENT, TYPE=SPRING2, ELSET=FOLLOW_{}\n", c);
    for (std::size_t k = 0; k < ties.follower.size(); ++k)
      out += fmt::format("{}, {}, {}\n", ++element, ties.follower[k] + 1, first + static_cast<int>(k));
    out += fmt::format("*SPRING, ELSET=FOLLOW_{0}\n{0}, {0}\n{1}\n", c, num(stiffness));
  }
  out += "*ELEMENT, TYPE=MASS, ELSET=FOLLOWERS\n";
  for (std::size_t k = 0; k < ties.follower.size(); ++k)
    out += fmt::format("{}, {}\n", ++element, first + static_cast<int>(k));
  out += fmt::format("*MASS, ELSET=FOLLOWERS\n{}\n", num(0.5 * mass));
}

std::vector<char> tied_nodes(const Mesh& mesh) {
  std::vector<char> tied(mesh.node_count(), 0);
  for (const auto& tie : mesh.tie) tied[tie.node] = 1;
  return tied;
}

struct SameMass {
  double mass = 0.0;  // tonne
  std::vector<int> node;
};
std::vector<SameMass> same_masses(const Mesh& mesh) {
  std::vector<SameMass> groups;
  for (int n = 0; n < mesh.node_count(); ++n) {
    const double mass = mesh.nodes.mass[n];
    if (mass <= 0.0) continue;
    const auto same = std::find_if(groups.begin(), groups.end(),
                                   [&](const SameMass& group) { return std::abs(group.mass - mass) <= 1e-12 * mass; });
    if (same != groups.end())
      same->node.push_back(n);
    else
      groups.push_back({mass, {n}});
  }
  return groups;
}

void add_masses(const Gathered& model, int& element, std::string& out) {
  int number = 0;
  for (const auto& group : same_masses(model.mesh)) {
    out += fmt::format("*ELEMENT, TYPE=MASS, ELSET=MASS_{}\n", ++number);
    for (const int n : group.node) out += fmt::format("{}, {}\n", ++element, n + 1);
    out += fmt::format("*MASS, ELSET=MASS_{}\n{}\n", number, num(group.mass * model.scene.analysis.mass_scale));
  }
}

// x - (1 - share) x_a - share x_b = 0, which holds in displacements at any deformation, as it is linear.
void add_ties(const Mesh& mesh, const FreeTies& ties, int first_follower, std::string& out) {
  const auto number = [&](int node) {
    return node < mesh.node_count() ? node + 1 : first_follower + node - mesh.node_count();
  };
  for (const auto& tie : ties.tie)
    for (int c = 1; c <= 3; ++c)
      out += fmt::format("*EQUATION\n3\n{0}, {1}, 1., {2}, {1}, {3}, {4}, {1}, {5}\n", tie.node + 1, c,
                         number(tie.to[0]), num(tie.share - 1.0), number(tie.to[1]), num(-tie.share));
}

// CalculiX knows amplitudes as tables only.
void add_smooth_step(double duration, std::string& out) {
  out += "*AMPLITUDE, NAME=SMOOTH\n";
  for (int k = 0; k <= 100; ++k) out += fmt::format("{}, {}\n", num(duration * k / 100.0), num(smooth_way(k / 100.0)));
}

void add_motions(const Gathered& model, bool is_static, std::string& out) {
  for (const auto& grip : model.grips) {
    const int set = model.set_number(grip.set);
    if (set == 0 || model.sets[static_cast<std::size_t>(set) - 1].node.empty()) continue;
    out += is_static ? "*BOUNDARY\n" : "*BOUNDARY, AMPLITUDE=SMOOTH\n";
    for (int c = 0; c < 3; ++c)
      if (grip.displacement[c])
        out += fmt::format("{}, {}, {}, {}\n", plain_name(grip.set), c + 1, c + 1, num(*grip.displacement[c]));
  }
}

// Weight, as a force on every node: springs and masses have no distributed load.
void add_weight(const Gathered& model, std::string& out) {
  const auto& gravity = model.scene.analysis.gravity;
  if (gravity == std::array<double, 3>{0.0, 0.0, 0.0}) return;
  out += "*CLOAD\n";
  for (int n = 0; n < model.mesh.node_count(); ++n)
    for (std::size_t c = 0; c < 3; ++c)
      if (gravity[c] != 0.0 && model.mesh.nodes.mass[n] > 0.0)
        out += fmt::format("{}, {}, {}\n", n + 1, c + 1, num(model.mesh.nodes.mass[n] * gravity[c]));
}

void add_step(const Gathered& model, bool is_static, std::string& out) {
  if (is_static) {
    out += "*STEP, NLGEOM, INC=10000\n*STATIC\n0.02, 1., 1e-6, 0.02\n";
    out += "** The fabric stays in its plane\n*BOUNDARY\nUNTIED, 3, 3, 0.\n";
  } else {
    const double duration = model.duration;
    out += fmt::format("*STEP, NLGEOM, INC=1000000\n*DYNAMIC, ALPHA=-0.3\n{}, {}, {}, {}\n", num(duration / 1000.0),
                       num(duration), num(duration * 2e-6), num(duration / 200.0));
  }
  add_motions(model, is_static, out);
  add_weight(model, out);
  for (const auto& grip : model.grips)
    out += fmt::format("*NODE PRINT, NSET={}, TOTALS=ONLY\nRF\n", plain_name(grip.set));
  // one frequency holds for all prints of a step; the last increment is always printed
  out += fmt::format("*NODE PRINT, NSET=ALL_NODES, FREQUENCY={0}\nU\n*NODE FILE, FREQUENCY={0}\nU, RF\n*END STEP\n",
                     is_static ? 10000 : 10);
}

void require_plane(const Gathered& model) {
  const char* instead = "leave --static out, so that the masses hold the fabric";
  if (!model.tools.empty())
    throw InputError(
        fmt::format("--static: the scene has tools, and limp yarns have no stiffness out of their plane; {}", instead));
  const double level = model.mesh.nodes.position.front()[2];
  for (const auto& x : model.mesh.nodes.position)
    if (std::abs(x[2] - level) > 1e-9)
      throw InputError(fmt::format("--static: the blank is not flat in a plane z = const; {}", instead));
  for (const auto& grip : model.grips)
    if (grip.displacement[2].value_or(0.0) != 0.0)
      throw InputError(fmt::format("--static: grip '{}' leaves the fabric's plane; {}", grip.set, instead));
  if (model.scene.analysis.gravity[2] != 0.0)
    throw InputError(fmt::format("--static: analysis.gravity acts across the fabric's plane; {}", instead));
}

void list_losses(const Gathered& model, std::vector<std::string>& lost) {
  lost.push_back(
      "yarns: springs with the law's table, jaws, free and softened ends included; the table has at most 200 "
      "points, which is all that CalculiX reads");
  lost.push_back(
      "cells: two springs across each with the shear law's table: exact while yarns keep their length; stretching "
      "yarns by e also takes about G e^2 per volume, G the shear law's tangent");
  if (model.scene.model.yarn == YarnElement::beam) lost.push_back("model.yarn = \"beam\": bending of the yarns");
  if (model.scene.model.cell == CellElement::shell || model.scene.model.cell == CellElement::rotation_free)
    lost.push_back(fmt::format("model.cell = \"{}\": bending of the cells", name_of(model.scene.model.cell)));
  for (const auto& motion : model.tools)
    lost.push_back(
        fmt::format("tool '{}': not written; contact of nodes on springs with rigid tools did not converge in CalculiX",
                    motion.tool.name));
}

}  // namespace

ExportedMesh write_calculix(const Gathered& model, bool is_static) {
  if (is_static) require_plane(model);
  ExportedMesh result{"", {}, ""};
  auto& lost = result.not_carried;
  for (const auto& line : model.not_carried)  // what springs and masses carry
    if (line.rfind("jaws:", 0) != 0 && line.rfind("masses:", 0) != 0 && line.rfind("areas:", 0) != 0 &&
        line.rfind("cut cells:", 0) != 0 && line.rfind("draped start:", 0) != 0 && line.rfind("softening:", 0) != 0)
      lost.push_back(line);
  list_frame(model, lost);
  list_coupling(model, lost);
  list_losses(model, lost);
  std::string body = "*HEADING\nWoven fabric: yarns and shear cells as springs\n";
  add_nodes(model.mesh, body);
  int element = model.first_shell() - 1;
  std::array<std::string, 2> family_sets;
  add_yarns(model, family_sets, body);
  for (std::size_t f = 0; f < 2; ++f)
    if (!family_sets[f].empty()) body += fmt::format("*ELSET, ELSET={}\n{}", f == 0 ? "WARP" : "WEFT", family_sets[f]);
  const CellSprings springs = cell_springs(model);
  add_cells(model, springs, element, body);
  add_members(model, element, body);
  const FreeTies ties = free_ties(model);
  const int first_follower = model.mesh.node_count() + static_cast<int>(springs.mirrored.size()) + 1;
  add_followers(model, ties, first_follower, element, body);
  if (!is_static) add_masses(model, element, body);
  for (const auto& set : model.sets) add_node_set(set.name, set.node, body);
  const auto tied = tied_nodes(model.mesh);
  std::vector<int> untied;
  for (int n = 0; n < model.mesh.node_count(); ++n)
    if (!tied[n]) untied.push_back(n);
  add_node_set("UNTIED", untied, body);
  add_ties(model.mesh, ties, first_follower, body);
  add_mirrored_ties(model.mesh, springs, body);
  if (!is_static) add_smooth_step(model.duration, body);
  add_step(model, is_static, body);
  result.text = header(model, "**", lost) + body;
  return result;
}

}  // namespace weaveform::foreign
