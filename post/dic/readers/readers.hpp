// The formats, one source file each. `names_*` tells a heading of the format, `read_*` turns the rows into a stage.
#pragma once

#include "post/dic/readers/convention.hpp"

namespace weaveform::dic {

// ARAMIS / GOM text exports: header lines of '#' with "key : value", among them stage, facet and the machine's signals;
// columns "x_undef [mm]", ..., "u [mm]", ... separated by ';'. Coordinates are the specimen's, in the unit of the
// heading. After the public exporter aramis-data-exporter (MIT licence) and its nodemap files.
[[nodiscard]] bool names_aramis(const std::vector<std::string>& heading);
[[nodiscard]] MeasuredStage read_aramis(const PointTable& table, const MeasurementSpec& spec);

// DICe solution files: header lines of '***' (may be left out), COORDINATE_X, DISPLACEMENT_X, ... in pixels with y
// down; from stereo also MODEL_COORDINATES_X, MODEL_DISPLACEMENT_X, ..., which are then used. A point failed when MATCH
// or SIGMA is below 0 or STATUS_FLAG is a failure. After the Digital Image Correlation Engine's own files and headers
// (Sandia, BSD licence: enum Status_Flag).
[[nodiscard]] bool names_dice(const std::vector<std::string>& heading);
[[nodiscard]] MeasuredStage read_dice(const PointTable& table, const MeasurementSpec& spec);

// VIC-2D and VIC-3D CSV: "X [mm]", "Y [mm]", "Z [mm]", "U [mm]", ... (3-D), "x_c", "y_c", "u_c", "v_c" (2-D,
// calibrated) or "x", "y", "u", "v" (2-D, pixels with y down), quoted or not; a title line may stand above. sigma below
// 0: failed.
[[nodiscard]] bool names_vic(const std::vector<std::string>& heading);
// Whether it is one that VIC may have written: x, y, u, v without units are those of many programs, so that all other
// columns must be VIC's too.
[[nodiscard]] bool only_vic(const std::vector<std::string>& heading);
[[nodiscard]] MeasuredStage read_vic(const PointTable& table, const MeasurementSpec& spec);

// pyvale CSV, pixels with y down: displacements (subset_x, displacement_u, ..., converged) or strain windows (window_x,
// def_grad_00, ...), whose deformation gradient is taken; the strain columns eps_* are not.
[[nodiscard]] bool names_pyvale(const std::vector<std::string>& heading);
[[nodiscard]] MeasuredStage read_pyvale(const PointTable& table, const MeasurementSpec& spec);

// OpenCorr tables: planar x, y, u, v in pixels with y down, ZNCC (older: zncc), or the deformation table with ux, uy,
// ...; stereo x, y in pixels of the first camera, u, v, w and ref_x, ref_y, ref_z in the calibration's unit, three
// columns of ZNCC. A ZNCC that is not above 0 is a failure (its negative values are codes, 0 was never computed). After
// OpenCorr's own writer (src/oc_io.cpp, MPL 2.0).
[[nodiscard]] bool names_opencorr(const std::vector<std::string>& heading);
[[nodiscard]] MeasuredStage read_opencorr(const PointTable& table, const MeasurementSpec& spec);

// MatchID point tables: "Coordinates.Image X [Pixel]", "coor.X [mm]", "disp.Horizontal Displacement U [mm]", ...
// (2024), or x_pic, y_pic, x, y, u, v (2023). The pixel columns tell whether y points up. Failed points hold words.
[[nodiscard]] bool names_matchid(const std::vector<std::string>& heading);
[[nodiscard]] MeasuredStage read_matchid(const PointTable& table, const MeasurementSpec& spec);

// A matrix for each component (MatchID, Ncorr, OpenCorr's maps; matrix_files.hpp), rows down the image; places by the
// settings' grid or by matrices of X and Y. Cells that are no numbers, in whatever words, are failed points.
[[nodiscard]] bool looks_like_matrix(const std::string& text, const MeasurementSpec& spec);
[[nodiscard]] MeasuredStage read_matrix(const std::filesystem::path& file, const MeasurementSpec& spec);

// Any table, by the column names (or numbers) of the settings.
[[nodiscard]] bool names_columns(const std::vector<std::string>& heading, const MeasurementSpec& spec);
[[nodiscard]] bool numbered_columns(const MeasurementSpec& spec);  // all of them by number: the file needs no heading
[[nodiscard]] std::vector<MeasuredStage> read_mapped(const PointTable& table, const MeasurementSpec& spec);

}  // namespace weaveform::dic
