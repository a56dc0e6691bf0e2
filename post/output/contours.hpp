// contours.vtp: shear-angle isolines on the deformed fabric.
#pragma once

#include <filesystem>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "solver/result/fields.hpp"

namespace weaveform {

namespace file_name {
inline constexpr const char* contours = "contours.vtp";
}

struct Isoline {
  double level = 0.0;       // deg; signed shear angle
  std::vector<Vec3> point;  // mm
  int ply = 0;              // of a stack, its number; not read back
};

// Lines at the multiples of `step` (deg) that the angle passes, on the cells at their current positions; the angle at a
// node is the mean of the cells around it. The zero level is left out: where fabric is unsheared it would draw the
// noise. Throws InputError when `step` is so small that there would be more than 1000 levels.
[[nodiscard]] std::vector<Isoline> shear_angle_isolines(const Mesh& mesh, const Fields& fields, double step);

// Polylines with cell data `shear_angle_deg`, the level, and of a stack `ply`; a file without lines is valid too. Throws
// FileError.
void write_contours(const std::vector<Isoline>& isolines, const std::filesystem::path& file, bool of_stack = false);
// Reads what write_contours wrote. Throws FileError or InputError.
[[nodiscard]] std::vector<Isoline> read_contours(const std::filesystem::path& file);

}  // namespace weaveform
