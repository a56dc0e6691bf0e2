// Fibre directions and thickness of a formed fabric in files for structural analysis.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/keys/choice.hpp"
#include "post/transfer/fibre_field.hpp"

namespace weaveform {

enum class FibreFormat { orientation_abaqus, orientation_calculix, drape_openradioss, composite_lsdyna, csv, vtu };
constexpr auto choices_of(FibreFormat) {
  return std::to_array<Choice<FibreFormat>>({{FibreFormat::orientation_abaqus, "orientation-abaqus"},
                                             {FibreFormat::orientation_calculix, "orientation-calculix"},
                                             {FibreFormat::drape_openradioss, "drape-openradioss"},
                                             {FibreFormat::composite_lsdyna, "composite-lsdyna"},
                                             {FibreFormat::csv, "csv"},
                                             {FibreFormat::vtu, "vtu"}});
}

struct FibreText {
  std::string text;
  std::vector<std::string> not_carried;  // also in the file's header
};

// *DISTRIBUTION of both directions and of the thickness, with *ORIENTATION FIBRE_WARP and FIBRE_WEFT: local 1 is the
// yarn, local 2 lies in the shell's plane at right angles to it. Lengths in the unit of the structure's file; shells
// far from the fabric are left to the distributions' first line. For Abaqus: CalculiX reads distributions for solids
// only.
[[nodiscard]] FibreText orientation_abaqus(const FibreField& field, const std::string& written_by);
// What CalculiX reads: per group of shells with the same directions (within `group_angle`, deg, of one another) and
// thickness (within 1 %) an element set, the *ORIENTATIONs WARP_n and WEFT_n, local 1 along the yarn, and a
// *SHELL SECTION of the material FABRIC with WARP_n. With an angle of 0 every shell that differs is a group of its own.
[[nodiscard]] FibreText orientation_calculix(const FibreField& field, double group_angle,
                                             const std::string& written_by);
// /DRAPE/1 of the warp ply and /DRAPE/2 of the weft ply: thinning t/t0 and the yarn's angle from the flat warp (weft)
// direction projected into the shell, counter-clockwise about its normal.
[[nodiscard]] FibreText drape_openradioss(const FibreField& field, const std::string& written_by);
// One /DRAPE block of a family (0 warp, 1 weft); counts in `steep` the angles that are poor. And what such files lack.
[[nodiscard]] std::string drape_block(const FibreField& field, std::size_t family, int number, const std::string& title,
                                      int& steep);
[[nodiscard]] std::vector<std::string> drape_not_carried(int steep);
// One row per element: element,x_mm,y_mm,z_mm,warp_x..z,weft_x..z,shear_angle_deg,thickness_mm,fibre_volume_ratio,
// fibre_mass_ratio,distance_mm,on_fabric (0: far from it, and the other values zero)
[[nodiscard]] FibreText fibre_csv(const FibreField& field);
// Shells with the same as cell data. Throws FileError.
void write_fibre_vtu(const FibreField& field, const std::filesystem::path& file);

// Lines that begin a file: who wrote it, of what, in which unit, and what it does not carry.
[[nodiscard]] std::string fibre_header(const std::string& mark, const FibreField& field, const std::string& written_by,
                                       const std::vector<std::string>& not_carried);

// Angle (rad) in the plane of `element` from the projection of `reference` to `direction`, and whether the projection
// is at least sin 5 deg long.
struct PlaneAngle {
  double angle = 0.0;
  bool good = true;
};
[[nodiscard]] PlaneAngle angle_in_plane(const FibreField& field, const StateElement& element, const Vec3& reference,
                                        const Vec3& direction);

}  // namespace weaveform
