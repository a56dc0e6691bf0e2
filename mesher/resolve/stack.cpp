#include "mesher/resolve/stack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include "core/error.hpp"
#include "mesher/automatic/take.hpp"
#include "mesher/drape/drape.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/mesh/stack.hpp"
#include "mesher/scene/ply_scene.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

// "scene.toml: blank.size: ..." becomes "scene.toml: ply 'top': blank.size: ...".
std::string with_ply(const std::string& line, const std::string& file, const std::string& ply) {
  const std::string name = fmt::format("ply '{}': ", ply);
  const std::string before = file + ": ";
  return !file.empty() && line.starts_with(before) ? before + name + line.substr(before.size()) : name + line;
}

// What `look` complains of, it complains of the ply.
template <class Look>
void of_ply(const Resolved& model, std::size_t ply, Look look) {
  const auto renamed = [&](const std::vector<std::string>& complaints) {
    std::vector<std::string> lines;
    for (const std::string& line : complaints)
      lines.push_back(with_ply(line, model.scene.file, model.scene.ply[ply].name));
    return lines;
  };
  try {
    look();
  } catch (const InputError& error) {
    throw InputError(renamed(error.complaints()));
  } catch (const FileError& error) {
    throw FileError(renamed(error.complaints()));
  } catch (const PhysicsError& error) {
    throw PhysicsError(with_ply(error.what(), model.scene.file, model.scene.ply[ply].name));
  }
}

void require_outline_file(const Scene& scene) {
  if (scene.blank.outline.empty()) return;
  const fs::path file = fs::path(scene.file).parent_path() / scene.blank.outline;
  if (!fs::exists(file))
    throw FileError(
        fmt::format("{}: outline: {}: no such file; correct the path, which is taken from the scene's folder",
                    scene.file, file.string()));
}

// Card and outline. Grips that hold whatever lies in their box leave a ply alone that has nothing there.
void read_ply(Resolved& ply) {
  require_outline_file(ply.scene);
  ply.card = load_card(ply.scene.fabric.material, ply.scene.file);
  ply.outline = read_blank_outline(ply.scene);
  std::erase_if(ply.scene.grip, [&](const GripSpec& grip) {
    return grip.plies.empty() && grip.box && lies_off(*grip.box, ply.extent());
  });
  std::erase_if(ply.scene.measure, [&](const MeasureSpec& measure) {
    return measure.ply.empty() && measure.box && lies_off(*measure.box, ply.extent());
  });
}

void read_pairs(Resolved& model) {
  const auto& plies = model.scene.ply;
  model.pair.clear();
  for (std::size_t k = 1; k < plies.size(); ++k)
    for (std::size_t i = 0; i < k; ++i) model.pair.push_back(resolve_pair(model.scene, plies[i].name, plies[k].name));
}

// mm; between the middle planes of a ply and the next.
double distance_between(const Resolved& model, std::size_t lower) {
  return 0.5 * (model.ply[lower].card.thickness + model.ply[lower + 1].card.thickness) +
         model.pair[pair_number(lower, lower + 1)].gap;
}

void place_plies(Resolved& model) {
  for (std::size_t k = 1; k < model.ply.size(); ++k)
    if (!model.scene.ply[k].position)
      model.ply[k].scene.blank.position[2] = model.ply[k - 1].scene.blank.position[2] + distance_between(model, k - 1);
}

// A grip that all plies leave alone holds nothing.
void require_grips(const Resolved& model) {
  std::vector<std::string> complaints;
  for (const GripSpec& grip : model.scene.grip) {
    const bool holds = std::any_of(model.ply.begin(), model.ply.end(), [&](const Resolved& ply) {
      return std::any_of(ply.scene.grip.begin(), ply.scene.grip.end(),
                         [&](const GripSpec& own) { return own.name == grip.name; });
    });
    if (!holds)
      complaints.push_back(fmt::format("{}: grip '{}' holds no node: no ply has fabric in its box; enlarge it",
                                       model.scene.file, grip.name));
  }
  if (!complaints.empty()) throw InputError(complaints);
}

void join(Resolved& model) {
  std::vector<NamedMesh> plies;
  for (std::size_t k = 0; k < model.ply.size(); ++k) plies.push_back({model.scene.ply[k].name, &model.ply[k].mesh});
  model.mesh = joined_mesh(plies);
  for (std::size_t k = 0; k < model.ply.size(); ++k) model.ply[k].mesh.first_shown = model.mesh.ply[k].first_node;
  model.card = model.ply.front().card;
  model.outline = model.ply.front().outline;
}

// A tool that is laid on the blank lies on the stack's lower or upper face.
Tool stack_tool(const ToolSpec& spec, const Resolved& model) {
  const Resolved& touched = lies_below(spec) ? model.ply.front() : model.ply.back();
  return make_tool(spec, touched.scene, touched.card.thickness, cell_edge_of(model.mesh));
}

// Each ply's middle plane lies half of its own thickness off the tools.
void give_tools(Resolved& model) {
  for (Resolved& ply : model.ply) {
    ply.tools = model.tools;
    ply.scene.tools = model.scene.tools;
    for (std::size_t t = 0; t < ply.tools.size(); ++t)
      ply.tools[t].offset = offset_of(ply.scene.tools[t], ply.card.thickness);
  }
}

// mm; from the tool: how near and how far a draped ply comes with its nodes and the middles of its cells, which are
// chords of the tool.
struct Standing {
  double least = std::numeric_limits<double>::infinity(), greatest = -std::numeric_limits<double>::infinity();
};

Standing standing_of(const Tool& tool, const Mesh& mesh) {
  Standing found;
  int hint = 0;
  const auto look = [&](const std::array<double, 3>& x) {
    Distances here;
    tool_distances(tool, tool.start, {x.data(), &x[1], &x[2]}, 1, &hint, here);
    found.least = std::min(found.least, here.distance[0]);
    found.greatest = std::max(found.greatest, here.distance[0]);
  };
  for (const auto& x : mesh.nodes.position) look(x);
  for (int c = 0; c < mesh.cells.size(); ++c) look(cell_centre(mesh.cells, c, mesh.nodes.position));
  return found;
}

const Tool& draped_tool(const std::vector<Tool>& tools, const std::string& name) {
  return *std::find_if(tools.begin(), tools.end(), [&](const Tool& tool) { return tool.name == name; });
}

bool is_there(const std::vector<Tool>& tools, const std::string& name) {
  return std::any_of(tools.begin(), tools.end(), [&](const Tool& tool) { return tool.name == name; });
}

Mesh draped_at(const Resolved& ply, double off) {
  std::vector<Tool> tools = ply.tools;
  for (Tool& tool : tools)
    if (tool.name == ply.scene.drape->tool) tool.offset = off;
  Mesh mesh = ply.mesh;
  lay_drape(ply.scene, drape_blank(ply.scene, mesh, tools), mesh);
  return mesh;
}

// Each ply's net lies on those between it and the tool, as far off as its chords and theirs need not to start inside each
// other: the way of a chord changes little with the distance, so that a few looks find it.
void drape_stack(Resolved& model) {
  constexpr int looks = 4;
  constexpr double room = 1e-3;  // of a thickness
  const std::string& name = model.scene.drape->tool;
  const bool from_above = model.scene.drape->projection[2] <= 0.0;
  const std::size_t count = model.ply.size();
  double before = 0.0;  // mm; how far the ply before comes from the tool
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t k = from_above ? n : count - 1 - n;
    Resolved& ply = model.ply[k];
    const double least = n == 0 ? 0.0 : before + distance_between(model, from_above ? k - 1 : k);
    const double step = room * ply.card.thickness;
    double off = n == 0 ? draped_tool(ply.tools, name).offset : least;
    Mesh mesh;
    of_ply(model, k, [&] { mesh = draped_at(ply, off); });
    for (int look = 0; look < looks && n > 0; ++look) {
      const double lacking = least - standing_of(draped_tool(ply.tools, name), mesh).least;
      if (lacking <= step) break;
      off += lacking + step;
      of_ply(model, k, [&] { mesh = draped_at(ply, off); });
    }
    ply.mesh = std::move(mesh);
    before = standing_of(draped_tool(ply.tools, name), ply.mesh).greatest;
  }
  join(model);
}

}  // namespace

void mirror_stack(Resolved& model) {
  std::vector<PlyToMirror> plies;
  for (std::size_t k = 0; k < model.ply.size(); ++k)
    plies.push_back({model.scene.ply[k].name, model.ply[k].scene, model.ply[k].card, model.ply[k].mesh});
  std::vector<Symmetry> found = find_symmetry(plies, model.tools);
  for (std::size_t k = 0; k < model.ply.size(); ++k) model.ply[k].symmetry = std::move(found[k]);
  model.symmetry = model.ply.front().symmetry;
  model.symmetry.map.clear();  // each ply has its own
}

void resolve_stack(Resolved& model, Findings& found, const ResolveChecks& checks, ResolveTo to) {
  bool whole = true;
  for (std::size_t k = 0; k < model.scene.ply.size(); ++k) {
    Resolved& ply = model.ply.emplace_back();
    ply.scene = scene_of_ply(model.scene, k);
    const bool read = found.attempt([&] {
      of_ply(model, k, [&] {
        read_ply(ply);
        take_what_is_open(model.scene, k, ply.scene, ply.card, ply.outline);
      });
    });
    if (read && checks.of_card) found.attempt([&] { of_ply(model, k, [&] { checks.of_card(ply.scene, ply.card); }); });
    whole = whole && read;
  }
  whole = found.attempt([&] { read_pairs(model); }) && whole;
  if (whole) place_plies(model);
  for (std::size_t k = 0; k < model.ply.size(); ++k) {
    Resolved& ply = model.ply[k];
    if (ply.card.thickness <= 0.0) continue;  // it could not be read
    const bool meshed = found.attempt([&] {
      of_ply(model, k, [&] {
        if (checks.of_size) checks.of_size(ply.scene, ply.card, ply.outline);
        ply.mesh = build_flat_mesh(ply.scene, ply.card, ply.outline);
      });
    });
    whole = whole && meshed;
  }
  if (whole) whole = found.attempt([&] { require_grips(model); });
  if (!whole) return;
  join(model);
  std::vector<ToolSpec> made;
  for (const ToolSpec& spec : model.scene.tools)
    if (found.attempt([&] { model.tools.push_back(stack_tool(spec, model)); })) made.push_back(spec);
  model.scene.tools = std::move(made);
  give_tools(model);
  if (to == ResolveTo::flat) return;
  const bool draped = !model.scene.drape ||
                      (is_there(model.tools, model.scene.drape->tool) && found.attempt([&] { drape_stack(model); }));
  if (!draped || !found.attempt([&] { mirror_stack(model); })) model.mesh = {};  // nothing can be run of it
}

void resolve_stack_around(Resolved& model) {
  const auto& plies = model.scene.ply;
  bool same = model.mesh.ply.size() == plies.size();
  for (std::size_t k = 0; k < plies.size() && same; ++k) same = model.mesh.ply[k].name == plies[k].name;
  if (!same)
    throw InputError(
        fmt::format("{}: its plies are not those of the mesh, which has {}; make the mesh again with "
                    "'weaveform mesh'",
                    model.scene.file, model.mesh.ply.empty() ? "none" : std::to_string(model.mesh.ply.size())));
  for (std::size_t k = 0; k < plies.size(); ++k) {
    Resolved& ply = model.ply.emplace_back();
    ply.scene = scene_of_ply(model.scene, k);
    of_ply(model, k, [&] { read_ply(ply); });
    ply.mesh = ply_mesh(model.mesh, k);
  }
  read_pairs(model);
  place_plies(model);
  model.card = model.ply.front().card;
  model.outline = model.ply.front().outline;
  for (const ToolSpec& spec : model.scene.tools) model.tools.push_back(stack_tool(spec, model));
  give_tools(model);
  mirror_stack(model);
}

}  // namespace weaveform
