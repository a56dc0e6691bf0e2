// Probes: the cells a [[measure]] looks at and what it says of them.
#pragma once

#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "mesher/resolve/resolved.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/result/fields.hpp"

namespace weaveform {

struct Probe {
  std::string name;
  std::vector<int> cell;
  std::vector<double> weight;  // mm^2; area of each
};

struct ShearStatistics {
  double mean = 0.0, deviation = 0.0, least = 0.0, greatest = 0.0;  // deg; area-weighted mean and standard deviation
};

// Cells whose centre lies in the measure's box in the initial configuration (blank frame). Throws InputError when there
// are none. `width` (mm) of the blank along its own x, which relative boxes are in units of.
[[nodiscard]] std::vector<Probe> make_probes(const Scene& scene, const Mesh& mesh, double width);
// Of all plies; a measure of a stack looks at the ply it names, or at all with cells there.
[[nodiscard]] std::vector<Probe> make_probes(const Resolved& model);
[[nodiscard]] ShearStatistics shear_statistics(const Probe& probe, const Fields& fields);

// Blank-frame coordinates (mm, centre = origin) of a world point on the flat blank.
[[nodiscard]] std::array<double, 2> blank_coordinates(const BlankSpec& blank, const Vec3& world);

}  // namespace weaveform
