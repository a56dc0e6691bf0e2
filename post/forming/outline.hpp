// The blank's outline before and after forming, and how far it was drawn in.
#pragma once

#include <optional>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "post/forming/part_axis.hpp"
#include "solver/result/fields.hpp"

namespace weaveform {

// The nodes around the fabric, counter-clockwise on the flat blank: the sides that belong to one cell only, the longest
// of their loops. A corner of the blank that holds no node is cut off by up to a spacing.
[[nodiscard]] std::vector<int> outline_nodes(const Mesh& mesh);

// mm; from the axis to the closed line through `nodes`, seen along the axis, in the direction of `azimuth` (rad): to
// the farthest crossing when there are several; none when there is none.
[[nodiscard]] std::optional<double> outline_radius(const std::vector<int>& nodes, const std::vector<Vec3>& position,
                                                   const PartAxis& axis, double azimuth);

struct DrawInRow {
  double azimuth = 0.0;                                            // rad; from the warp
  double before = 0.0, after = 0.0;                                // mm; from the axis to the outline
  [[nodiscard]] double draw_in() const { return before - after; }  // mm
};

struct DrawIn {
  std::vector<DrawInRow> row;                                         // every degree where both outlines are met
  double greatest = 0.0, greatest_at = 0.0, least = 0.0, mean = 0.0;  // mm, rad, mm, mm
  [[nodiscard]] std::optional<double> at(double azimuth) const;       // mm; to half a degree (rad)
};

[[nodiscard]] DrawIn draw_in(const std::vector<int>& outline, const std::vector<Vec3>& flat,
                             const std::vector<Vec3>& position, const PartAxis& axis);

}  // namespace weaveform
