#include "app/stages/resolved_text.hpp"

#include <fmt/format.h>

#include <numeric>

#include "core/keys/key_value.hpp"
#include "core/version/version.hpp"
#include "mesher/resolve/resolve.hpp"
#include "post/forming/waves.hpp"
#include "post/trust/expected_waves.hpp"
#include "solver/bending/flexure.hpp"
#include "solver/contact/contact.hpp"
#include "solver/element/yarn_law.hpp"
#include "solver/ply/reach.hpp"
#include "solver/solve.hpp"

namespace weaveform {
namespace {

class Lines {
public:
  void table(const std::string& name) { text_ += fmt::format("\n[{}]\n", name); }
  template <class Value>
  void add(const std::string& key, const Value& value, const std::string& comment = "") {
    text_ +=
        fmt::format("{} = {}{}\n", key, toml_text(value).value_or("\"\""), comment.empty() ? "" : "  # " + comment);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

private:
  std::string text_;
};

// `table`: of a ply, "resolved.ply.NAME.mesh".
void add_mesh(const Resolved& model, const std::string& table, Lines& lines) {
  const Mesh& mesh = model.mesh;
  lines.table(table);
  lines.add("cells", mesh.cells.size());
  lines.add("yarn_elements", mesh.yarn_count());
  lines.add("nodes", mesh.node_count());
  lines.add("spacing", mesh.spacing, "mm; along warp and weft");
  lines.add("coarsening",
            std::array{mesh.spacing[1] / model.card.yarn[0].interval, mesh.spacing[0] / model.card.yarn[1].interval},
            "that the lattice came to, of warp and weft");
  lines.add("thickness", mesh.thickness, "mm");
  lines.add("extent", model.extent(), "mm; of the blank along its own axes");
  lines.add("mass", std::accumulate(mesh.nodes.mass.begin(), mesh.nodes.mass.end(), 0.0),
            "tonne; without mass scaling");
}

void add_analysis(const Resolved& model, const SolveStatistics& first, Lines& lines) {
  lines.table("resolved.analysis");
  const std::string why = describe(model.symmetry);
  lines.add("symmetry", model.symmetry.word(), why.substr(why.find(": ") + 2));
  lines.add("cells_solved", first.cells_solved);
  lines.add("duration", first.duration_s, "s");
  lines.add("damping", first.damping_per_s, "1/s; proportional to mass");
  lines.add("first_step", first.step_s, "s; set by " + first.step_set_by);
  lines.add("threads", first.threads);
}

void add_laws(const Resolved& model, const std::string& table, Lines& lines) {
  const Card& card = model.card;
  const auto laws = yarn_laws(card, model.scene.model);
  lines.table(table);
  lines.add("card", card.name);
  lines.add("yarn_tangent", std::array{laws[0].tangent(0.0), laws[1].tangent(0.0)}, "MPa; unstretched, warp and weft");
  lines.add("stiffest_yarn_tangent",
            std::array{laws[0].stiffest(-torn_strain, torn_strain), laws[1].stiffest(-torn_strain, torn_strain)},
            "MPa");
  lines.add("yarn_section", std::array{card.yarn[0].section, card.yarn[1].section}, "mm^2; of one yarn");
  lines.add("shear_tangent", shear_tangent(card.shear, 0.0), "MPa; unsheared");
  lines.add("shear_valid_to", card.shear.valid_to_deg, "deg");
  const Flexure flexure = choose_flexure(card, model.scene);
  if (const auto waves = expected_waves(model)) {
    lines.add("expected_wavelength", waves->wavelength, "mm; of wrinkles, if any: docs/wrinkles.md");
    lines.add("cells_per_expected_wave", waves->cells,
              fmt::format("{:g} or more make it the fabric's", least_cells_per_wave));
  }
  lines.add("bends", flexure.bends_yarns || flexure.rotation_free || flexure.has_shell);
}

void add_stack(const Resolved& model, Lines& lines) {
  lines.table("resolved.mesh");
  lines.add("plies", static_cast<int>(model.ply.size()));
  lines.add("cells", model.mesh.cells.size());
  lines.add("yarn_elements", model.mesh.yarn_count());
  lines.add("nodes", model.mesh.node_count());
  for (std::size_t k = 0; k < model.ply.size(); ++k) {
    const std::string table = "resolved.ply." + *toml_text(model.mesh.ply[k].name);
    add_mesh(model.ply[k], table + ".mesh", lines);
    lines.add("position", model.ply[k].scene.blank.position, "mm; of the blank's centre, in its middle plane");
    lines.add("first_node", model.mesh.ply[k].first_node, "in mesh.vtu");
    add_laws(model.ply[k], table + ".laws", lines);
  }
}

void add_pairs(const Resolved& model, Lines& lines) {
  for (std::size_t k = 1; k < model.ply.size(); ++k) {
    const ResolvedPair& pair = model.pair[pair_number(k - 1, k)];
    lines.table("resolved.pair." + *toml_text(model.mesh.ply[k - 1].name + "/" + model.mesh.ply[k].name));
    lines.add("friction", pair.friction);
    lines.add("shear_law_rows", static_cast<int>(pair.shear_law.size()));
    lines.add("compaction_rows", static_cast<int>(pair.compaction.size()), "0: faces that hardly give way");
    lines.add("gap", pair.gap, "mm");
  }
}

void add_tool(const Resolved& model, std::size_t number, double blank_mass, Lines& lines) {
  const Tool& tool = model.tools[number];
  const ToolSpec& spec = model.scene.tools[number];
  lines.table("resolved.tools." + *toml_text(tool.name));
  lines.add("shape", name_of(spec.shape));
  if (tool.surface) lines.add("triangles", tool.surface->size());
  lines.add("position", tool.start.origin, "mm; at the start");
  lines.add("direction", tool.direction, "of its motion");
  lines.add("offset", tool.offset, "mm; of the fabric's middle plane from its face");
  if (spec.force)
    lines.add("mass", spec.mass.value_or(default_tool_mass(model.scene.analysis, blank_mass)),
              "tonne; follows a force");
}

}  // namespace

std::string resolved_text(const Resolved& model) {
  const auto first = solve(without_perturbation(model), {}, {.quiet = true, .most_steps = 1}).statistics;
  Lines lines;
  lines.table("resolved");
  lines.add("program", std::string(version_line()));
  if (model.ply.empty())
    add_mesh(model, "resolved.mesh", lines);
  else
    add_stack(model, lines);
  add_analysis(model, first, lines);
  if (model.ply.empty())
    add_laws(model, "resolved.laws", lines);
  else
    add_pairs(model, lines);
  double blank_mass = 0.0;  // tonne; with mass scaling
  for (const double mass : model.mesh.nodes.mass) blank_mass += mass * model.scene.analysis.mass_scale;
  for (std::size_t t = 0; t < model.tools.size(); ++t) add_tool(model, t, blank_mass, lines);
  return lines.text();
}

}  // namespace weaveform
