// A surface of triangles as edges that turn it and vertices that curve it.
#pragma once

#include <vector>

#include "core/vector/vector.hpp"
#include "mesher/tools/triangles.hpp"

namespace weaveform {

struct FacetEdge {
  Vec3 at = {0.0, 0.0, 0.0};     // mm; its middle
  Vec3 along = {0.0, 0.0, 0.0};  // from one end to the other, of length 1
  double turn = 0.0;             // rad; of the surface across it, positive where the material bulges
  double length = 0.0;           // mm
  double width = 0.0;            // mm; over which it turns: between the centres of the two triangles
};

struct FacetVertex {
  Vec3 at = {0.0, 0.0, 0.0};  // mm
  double deficit = 0.0;       // rad; 2 pi less the angles around it: the integral of the Gaussian curvature
  double turn_length = 0.0;   // mm; of its edges, turn times length: positive where the surface is convex
};

// Edges between two triangles, and vertices that have no other; corners at the same place are one vertex.
struct Facets {
  std::vector<FacetEdge> edge;
  std::vector<FacetVertex> vertex;
};

[[nodiscard]] Facets facets_of(const TriangleSurface& surface);

}  // namespace weaveform
