// The unit-cell study as files: table for scripts, report for people, chart.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/chart/chart.hpp"
#include "post/unit_cell/study.hpp"

namespace weaveform {

// unit_cell.csv: a row about every degree; `shear_angle_deg`, `analytical_N_per_mm`, and of each variant
// `NAME.force_N_per_mm` and `NAME.relative_error` (empty at angle 0, where there is no force).
[[nodiscard]] std::string unit_cell_csv(const UnitCellStudy& study);

// unit_cell.md: angles held, errors, distance from the closed forms, convergence, cost of a rotation. `made_by` names
// the program.
[[nodiscard]] std::string unit_cell_markdown(const UnitCellStudy& study, const std::string& made_by);

// The part of it that is printed: one row for each variant.
[[nodiscard]] std::string unit_cell_table(const UnitCellStudy& study);

// The same numbers: "card", "to_deg", "increments", "tolerance" and "variants", each with "holds_to_deg" and
// "relative_error_at_deg" by angle (null beyond the angle asked for).
[[nodiscard]] nlohmann::ordered_json unit_cell_json(const UnitCellStudy& study);

// unit_cell.svg: force against angle of the square cell, the analytical response as points.
[[nodiscard]] Chart unit_cell_chart(const UnitCellStudy& study);

// unit_cell_error.svg: its relative error against positive angles, with the band of the tolerance.
[[nodiscard]] Chart unit_cell_error_chart(const UnitCellStudy& study);

}  // namespace weaveform
