// Files of a comparison: each written whole or not at all.
#pragma once

#include <filesystem>

#include "post/dic/comparison/stage.hpp"
#include "post/dic/comparison/triangulation.hpp"

namespace weaveform::dic {

// One row for each point: position and displacements (mm, blank frame), angles (deg), agreement; empty cells where
// there is no value.
void write_points_csv(const StageFields& fields, double coverage, const std::filesystem::path& file);

// The same on the points' triangles, for ParaView; points at their places on the flat blank. `agrees` is 1, 0, or -1
// where nothing was compared.
void write_points_vtu(const StageFields& fields, const std::vector<std::array<int, 3>>& triangles, double coverage,
                      const std::filesystem::path& file);

// Lines of equal angle of the measured (field = 0), levelled (1) and raw (2) field at the same levels: cell data
// `field` and `shear_angle_deg`.
void write_isolines(const StageFields& fields, const std::vector<std::array<int, 3>>& triangles, double step,
                    const std::filesystem::path& file);

// 1 agrees, 0 does not, -1 nothing to compare.
[[nodiscard]] int agreement(const StageFields& fields, std::size_t i, double coverage);

}  // namespace weaveform::dic
