// The shear angle of fabric on a spherical tool against s = u v/R^2, u and v the yarn lengths along warp and weft from
// the pole on the flat blank, beside the exact net of inextensible pin-jointed yarns, gamma = g(s)
// (mesher/drape/sphere_net.hpp). Where the angles lie on that one curve the yarns behave as inextensible ones from the
// pole on; where they leave it, friction, stretch and the flange take over.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "post/forming/fabric_surface.hpp"
#include "post/forming/placed_tools.hpp"
#include "solver/result/fields.hpp"

namespace weaveform {

// A node this far from a tool still lies on it, in thicknesses: the contact law sets in over 2 % of the thickness, and
// a node that carries little hovers about it.
inline constexpr double contact_tolerance = 0.05;
inline constexpr double holds_within = 2.0;  // deg; see holds_to
inline constexpr double bin_width = 0.1;     // of |s|

struct SphereNetCell {
  double u = 0.0, v = 0.0;  // mm
  double s = 0.0;           // 1
  double angle = 0.0;       // rad; of the cell
  double net = 0.0;         // rad; g(s); not a number where the net has folded, |s| > sphere_net_end()
  bool on_sphere = false;   // all its nodes lie on the spherical part of the tool
};

struct SphereNetFit {
  std::string tool;
  double radius = 0.0;              // mm; R, of the fabric's middle plane: tool's radius and offset
  std::vector<SphereNetCell> cell;  // in the mesh's order
  // Over the cells on the sphere that the net reaches, weighted with their flat area:
  int cells = 0;
  double rms = 0.0, greatest = 0.0;  // rad; difference of angles; not a number without a cell
  double greatest_s = 0.0;           // |s| reached by a cell
  double holds_to =
      0.0;  // |s| up to which the difference stays within 2 deg (RMS over bins of 0.1), of what is reached
};

// The first sphere that travels, else the first sphere; none when the scene has none. The pole is the material point on
// the sphere's own axis.
[[nodiscard]] std::optional<SphereNetFit> compare_with_sphere_net(const Scene& scene, const Mesh& mesh,
                                                                  const Fields& fields,
                                                                  const std::vector<PlacedTool>& tools);

}  // namespace weaveform
