#include "mesher/resolve/resolved.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "mesher/scene/idle.hpp"
#include "mesher/scene/taken.hpp"
#include "mesher/tools/out_of_reach.hpp"

namespace weaveform {
namespace {

// Of fabric laid with its face down; "" where that is another thing than up.
std::string same_either_way(const Resolved& ply) {
  const ModelSpec& model = ply.scene.model;
  if (ply.scene.fabric.face == FabricFace::up) return "";
  if (ply.card.yarn[0].bending_out_of_plane.is_odd() && ply.card.yarn[1].bending_out_of_plane.is_odd())
    return fmt::format(
        "face = \"down\" changes nothing: the yarns of card '{}' bend alike with face and back outwards; give "
        "them bending_out_of_plane_back, or leave it out",
        ply.card.name);
  const bool by_beams = model.yarn == YarnElement::beam && !model.yarn_bending;
  const bool by_cells = model.yarn != YarnElement::beam && model.cell != CellElement::membrane && !model.cell_bending &&
                        !ply.card.bending.rigidity;
  if (by_beams || by_cells) return "";
  return fmt::format(
      "face = \"down\" changes nothing: no element bends by the two laws of card '{}'; set model.yarn = "
      "\"beam\" or model.cell = \"rotation-free\" without numbers of their own, or leave it out",
      ply.card.name);
}

}  // namespace

std::vector<std::string> early_warnings(const Resolved& model) {
  std::vector<std::string> lines = idle_parts(model.scene);
  const auto add = [&](const std::vector<std::string>& more) { lines.insert(lines.end(), more.begin(), more.end()); };
  for (std::size_t k = 0; k < model.plies(); ++k)
    for (const std::string& note : model.of_ply(k).outline.notes) lines.push_back(name_before(model, k) + note);
  for (std::size_t k = 0; k < model.plies(); ++k)
    if (const std::string line = same_either_way(model.of_ply(k)); !line.empty())
      lines.push_back(name_before(model, k) + line);
  for (const Tool& tool : model.tools) add(tool.notes);
  for (std::size_t k = 0; k < model.plies(); ++k)
    for (const std::string& line : missed_lines(model.of_ply(k).scene)) lines.push_back(name_before(model, k) + line);
  add(tools_out_of_reach(model.scene, model.mesh, model.tools));
  return lines;
}

std::string name_before(const Resolved& model, std::size_t ply) {
  return model.ply.empty() ? "" : fmt::format("ply '{}': ", model.mesh.ply[ply].name);
}

std::string describe(const Resolved& model) {
  const Mesh& mesh = model.mesh;
  if (!model.ply.empty()) {
    std::string lines = fmt::format("mesh: {} plies, {} cells, {} yarn elements, {} nodes", model.ply.size(),
                                    mesh.cells.size(), mesh.yarn_count(), mesh.node_count());
    for (std::size_t k = 0; k < model.ply.size(); ++k)
      lines += fmt::format("\n  {}{}, at z = {:.4g} mm", name_before(model, k), describe(model.ply[k]).substr(6),
                           model.ply[k].scene.blank.position[2]);
    return lines;
  }
  std::string line = fmt::format(
      "mesh: {} cells, {} yarn elements, {} nodes; spacing {:.4g} mm along the warp, {:.4g} mm along the weft",
      mesh.cells.size(), mesh.yarn_count(), mesh.node_count(), mesh.spacing[0], mesh.spacing[1]);
  // The spacing along one family is that of the other family's lines.
  const std::array<double, 2>& asked = model.scene.blank.coarsening;
  const std::array<double, 2> real = {mesh.spacing[1] / model.card.yarn[0].interval,
                                      mesh.spacing[0] / model.card.yarn[1].interval};
  const auto differs = [&](std::size_t f) { return std::abs(real[f] - asked[f]) > 1e-9 * asked[f]; };
  if (differs(0) || differs(1))
    line += fmt::format("; fitted to the grips: coarsening {:.4g} (warp), {:.4g} (weft) instead of {:.4g}, {:.4g}",
                        real[0], real[1], asked[0], asked[1]);
  return line;
}

}  // namespace weaveform
