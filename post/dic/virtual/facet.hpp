// What one facet measures: a subset of the pattern, matched by a shape function of first order, gives the displacement
// at its centre that the least-squares plane through the facet's displacements has there; for a whole facet that is
// their mean (Schreier & Sutton 2002, Exp. Mech. 42:303: the facet is a low-pass filter). Facets are squares of the
// undeformed specimen, their sides along the image's.
#pragma once

#include <vector>

#include "post/dic/virtual/flat_mesh.hpp"

namespace weaveform::dic {

// Points within a facet around the origin and their shares of its area: 4 x 4 squares with 2 x 2 Gauss points each,
// exact for polynomials up to the third degree in x and in y. A facet of size 0 is its centre.
struct FacetPoint {
  Vec2 offset;
  double weight;
};
[[nodiscard]] std::vector<FacetPoint> facet_points(double facet_size);

// The mean of a field over the facet around `centre`; for fields given by a formula.
template <class Field>
[[nodiscard]] auto facet_mean(const Field& field, const Vec2& centre, const std::vector<FacetPoint>& facet) {
  auto sum = field(centre);
  sum = 0.0 * sum;
  for (const auto& [offset, weight] : facet)
    sum = sum + weight * field(Vec2{centre[0] + offset[0], centre[1] + offset[1]});
  return sum;
}

// Sampling of the simulated displacement as facets see it. Where a facet reaches over the fabric's edge, the plane is
// fitted to the part on the fabric and taken at the facet's centre; a facet with less than `fill` of its area on the
// fabric, or its centre off it, sees nothing. `angle` (rad) turns the facets' sides from the blank's axes.
[[nodiscard]] Sampling sample_facets(const FlatMesh& flat, const std::vector<Vec2>& centres, double facet_size,
                                     double fill, double angle = 0.0);

}  // namespace weaveform::dic
