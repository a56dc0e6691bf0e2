#include "post/forming/forming.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weaveform {
namespace {

void find_greatest_angle(const Mesh& mesh, const Fields& fields, Forming& forming) {
  const int most = most_sheared_cell(fields);
  forming.greatest_angle = fields.shear_angle[most];
  forming.greatest_angle_at = vector_of(cell_centre(mesh.cells, most, fields.position));
}

}  // namespace

std::optional<Forming> evaluate_forming(const Scene& scene, const Mesh& mesh, const std::vector<Tool>& tools,
                                        const Fields& fields, const History& history) {
  if (tools.empty()) return {};
  const std::vector<PlacedTool> placed = place_tools(tools, history, fields.time);
  Forming forming;
  forming.axis = part_axis(scene, tools);
  forming.punch = punch_curve(scene, history);
  forming.balance = force_balance(scene, tools, history);
  const FabricSurface surface = make_surface(mesh, fields.position, fields.shear_angle);
  for (std::size_t k = 0; k < meridian_azimuths.size(); ++k)
    forming.meridian[k] = meridian(surface, forming.axis, meridian_azimuths[k] * std::numbers::pi / 180.0);
  find_greatest_angle(mesh, fields, forming);
  forming.outline = outline_nodes(mesh);
  forming.draw_in = draw_in(forming.outline, flat_positions(mesh), fields.position, forming.axis);
  forming.wrinkles = find_wrinkles(mesh, fields.position, placed, forming.wrinkle_limits);
  forming.waves = evaluate_waves(scene.model, mesh, fields, &forming.wrinkles);
  for (const Vec3& x : fields.position)
    forming.gap.push_back(gap_to(placed[nearest_tool(placed, vector_of(x))], vector_of(x)).gap);
  forming.flat_thickness = mesh.thickness;
  if (!fields.thickness.empty()) {
    const auto [least, greatest] = std::minmax_element(fields.thickness.begin(), fields.thickness.end());
    forming.thinnest = *least;
    forming.thickest = *greatest;
  }
  forming.sphere_net = compare_with_sphere_net(scene, mesh, fields, placed);
  return forming;
}

}  // namespace weaveform
