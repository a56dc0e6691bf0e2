// Wrinkles: where the fabric rises from its tool and falls back to it within a short length, bent as no tool bends it.
//
// At a node, with the tool T nearest to it and along each of the two yarns through it:
//   relief     greatest difference of the gap to T between the node and the yarn's nodes up to half a wrinkle length
//              away (and the next node on either side in any case); a sinusoidal wrinkle of amplitude a has 2 a
//   curvature  what the yarn's curvature out of the fabric's plane, kf, has beyond the interval that 0 and kt span, kt
//              the curvature of the same nodes brought onto a tool along their distances: T, and the tools nearest to
//              the nodes before and after. A taut fabric that leaves a tool is straighter than the tool and counts for
//              nothing, also where it passes from one to another; fabric bent more than its tools, or the other way,
//              counts by the excess. kf and kt are differences over the same nodes, so that fabric on a tool has none
//              to rounding, however coarse the net. A wrinkle a sin(2 pi x/l) on a plane has a (2 pi/l)^2.
// Either is second order in the spacing. A node is wrinkled when along one yarn both pass their limits: half the height
// x thicknesses (relief > 2 x t), and the curvature that a wrinkle of this amplitude and of the limiting length has,
//   y = x t (2 pi/l)^2 .
// Neither alone will do: free spans between tools stand off without wrinkles, the rims of tools bend fabric without.
#pragma once

#include <array>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "post/forming/placed_tools.hpp"
#include "solver/result/fields.hpp"

namespace weaveform {

struct WrinkleLimits {
  double height = 0.5;   // thicknesses; x: amplitude of the least wrinkle, which stands off by a thickness in all
  double length = 60.0;  // thicknesses; l: wave length of the longest undulation called a wrinkle
  [[nodiscard]] double relief(double thickness) const { return 2.0 * height * thickness; }  // mm
  [[nodiscard]] double curvature(double thickness) const;                                   // 1/mm; y
};

struct Wrinkles {
  // Per node; 0 where no yarn runs on through it. Of the yarn with the greater product of both.
  std::vector<double> relief;                 // mm
  std::vector<double> curvature;              // 1/mm
  std::array<std::vector<double>, 2> excess;  // 1/mm; the curvature of warp and weft, positive towards warp x weft
  std::vector<bool> wrinkled;
  double area_share = 0.0;          // 1; of the flat area, a cell's in equal parts to its nodes
  double greatest_relief = 0.0;     // mm; among wrinkled nodes
  double greatest_curvature = 0.0;  // 1/mm; of all nodes
};

[[nodiscard]] Wrinkles find_wrinkles(const Mesh& mesh, const std::vector<Vec3>& position,
                                     const std::vector<PlacedTool>& tools, const WrinkleLimits& limits = {});

// mm2; per node, flat: of each cell in equal parts to its nodes.
[[nodiscard]] std::vector<double> node_areas(const Mesh& mesh);
// 1; of the marked nodes.
[[nodiscard]] double area_share(const Mesh& mesh, const std::vector<bool>& marked);

}  // namespace weaveform
