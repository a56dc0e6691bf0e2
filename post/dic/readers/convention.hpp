// What the readers share: column names with units, the length of a unit, the sense of y, rows into points.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "post/dic/readers/measurement.hpp"
#include "post/dic/readers/point_table.hpp"

namespace weaveform::dic {

// "x_undef [mm]" -> {"x_undef", "mm"}
struct ColumnName {
  std::string name, unit;
};
[[nodiscard]] ColumnName column_name(const std::string& heading);

// Index of a column by its name without unit; nothing when there is none.
[[nodiscard]] std::optional<std::size_t> find_column(const std::vector<std::string>& heading, const std::string& name);
[[nodiscard]] bool has_columns(const std::vector<std::string>& heading, const std::vector<std::string>& names);

// mm per unit of a column. `unit` is what the file says ("" when nothing). When neither file nor settings decide it
// asks and gives 1. Throws InputError when they contradict each other.
[[nodiscard]] double length_factor(const std::string& unit, const MeasurementSpec& spec, const std::string& file,
                                   const std::string& column, Questions& questions);
[[nodiscard]] bool is_pixel(const std::string& unit);

// Whether y points up: as the settings say, else as `told`; asks when neither does. `column` is y's.
[[nodiscard]] bool settle_up(const MeasurementSpec& spec, const std::optional<bool>& told, const std::string& file,
                             const std::string& column, Questions& questions);

// Columns that by their names may tell failed points from good ones, of those that `known` does not list.
[[nodiscard]] std::vector<std::string> quality_columns(const std::vector<std::string>& heading,
                                                       const std::vector<std::string>& known);

// One factor for all of the columns, which must have the same unit.
[[nodiscard]] double common_length_factor(const PointTable& table, const std::vector<std::size_t>& columns,
                                          const MeasurementSpec& spec, Questions& questions);

// Columns that make points; an index of -1 stands for a column there is not.
struct PointColumns {
  int x = -1, y = -1, z = -1, u = -1, v = -1, w = -1;
  std::vector<int> flags;  // others to be read along
};
struct PointRows {
  std::vector<Vec3> position, displacement;  // as in the file, times the factor
  std::vector<std::vector<double>> flags;
};
[[nodiscard]] PointRows read_points(const PointTable& table, const PointColumns& columns, double factor);

// Turns y (and z, so that the frame stays right-handed) from down to up.
void flip_y(PointRows& rows);

// Moves the rows into the stage: those without a position are dropped and counted, those without a displacement are
// kept invalid, as are those that `failed` names.
void take_rows(PointRows rows, const std::vector<bool>& failed, MeasuredStage& stage);

// Whether the same points' y in pixels (down) and in length units run against each other: then length's y is up.
// Nothing when the data does not tell (one row of points).
[[nodiscard]] std::optional<bool> y_is_up(const std::vector<double>& y_pixel, const std::vector<Vec3>& position);

}  // namespace weaveform::dic
