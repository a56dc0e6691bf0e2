// Fibre directions and thickness of a formed fabric in files for structural analysis.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "post/transfer/fibre_field.hpp"

namespace weaveform {

struct FibreText {
  std::string text;
  std::vector<std::string> not_carried;  // also in the file's header
};

// *DISTRIBUTION of both directions and of the thickness, with *ORIENTATION FIBRE_WARP and FIBRE_WEFT: local 1 is the
// yarn, local 2 lies in the shell's plane at right angles to it.
[[nodiscard]] FibreText orientation_abaqus(const FibreField& field, const std::string& written_by);
// /DRAPE/1 of the warp ply and /DRAPE/2 of the weft ply: thinning t/t0 and the yarn's angle from the flat warp (weft)
// direction projected into the shell, counter-clockwise about its normal.
[[nodiscard]] FibreText drape_openradioss(const FibreField& field, const std::string& written_by);
// One row per element: element,x_mm,y_mm,z_mm,warp_x..z,weft_x..z,shear_angle_deg,thickness_mm,fibre_volume_ratio,
// fibre_mass_ratio,distance_mm
[[nodiscard]] FibreText fibre_csv(const FibreField& field);
// Shells with the same as cell data. Throws FileError.
void write_fibre_vtu(const FibreField& field, const std::filesystem::path& file);

// Angle (rad) in the plane of `element` from the projection of `reference` to `direction`, and whether the projection
// is at least sin 5 deg long.
struct PlaneAngle {
  double angle = 0.0;
  bool good = true;
};
[[nodiscard]] PlaneAngle angle_in_plane(const FibreField& field, const StateElement& element, const Vec3& reference,
                                        const Vec3& direction);

}  // namespace weaveform
