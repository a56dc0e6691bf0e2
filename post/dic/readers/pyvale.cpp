#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "post/dic/readers/readers.hpp"

namespace weaveform::dic {
namespace {

// F in the frame with y up from that with y down: F' = S F S, S = diag(1, -1).
std::array<double, 4> turned_up(const std::array<double, 4>& f) {
  return {f[0], -f[1], -f[2], f[3]};
}

MeasuredStage read_windows(const PointTable& table, double factor, bool down, MeasuredStage stage) {
  PointColumns columns;
  columns.x = column_of(table, "window_x");
  columns.y = column_of(table, "window_y");
  for (const char* name : {"def_grad_00", "def_grad_01", "def_grad_10", "def_grad_11"})
    columns.flags.push_back(column_of(table, name));
  PointRows rows = read_points(table, columns, factor);
  if (down) flip_y(rows);
  for (std::size_t i = 0; i < rows.position.size(); ++i) {
    std::array<double, 4> gradient{};
    for (std::size_t k = 0; k < 4; ++k) gradient[k] = rows.flags[k][i];
    const bool known = std::isfinite(gradient[0] + gradient[1] + gradient[2] + gradient[3]);
    if (!known) ++stage.missing;
    if (!std::isfinite(rows.position[i][0] + rows.position[i][1])) continue;
    stage.reference.push_back(rows.position[i]);
    stage.displacement_field.push_back({std::nan(""), std::nan(""), std::nan("")});
    stage.gradient.push_back(down ? turned_up(gradient) : gradient);
    stage.valid.push_back(known);
  }
  stage.notes.emplace_back("pyvale: deformation gradients of strain windows; strain columns eps_* not used");
  return stage;
}

MeasuredStage read_subsets(const PointTable& table, double factor, bool down, MeasuredStage stage) {
  PointColumns columns;
  columns.x = column_of(table, "subset_x");
  columns.y = column_of(table, "subset_y");
  columns.u = column_of(table, "displacement_u");
  columns.v = column_of(table, "displacement_v");
  const auto converged = find_column(table.heading, "converged");
  if (converged) columns.flags.push_back(static_cast<int>(*converged));
  PointRows rows = read_points(table, columns, factor);
  std::vector<bool> failed(rows.position.size(), false);
  for (std::size_t i = 0; converged && i < failed.size(); ++i) failed[i] = !(rows.flags[0][i] > 0.0);
  if (down) flip_y(rows);
  stage.notes.push_back(fmt::format("pyvale: displacements; failed correlations by: {}",
                                    converged ? "converged = 0" : "none in the file"));
  take_rows(std::move(rows), failed, stage);
  return stage;
}

}  // namespace

bool names_pyvale(const std::vector<std::string>& heading) {
  return has_columns(heading, {"window_x", "window_y", "def_grad_00", "def_grad_01", "def_grad_10", "def_grad_11"}) ||
         has_columns(heading, {"subset_x", "subset_y", "displacement_u", "displacement_v"});
}

MeasuredStage read_pyvale(const PointTable& table, const MeasurementSpec& spec) {
  MeasuredStage stage;
  stage.label = std::filesystem::path(table.file).filename().string();
  if (column_of(table, "def_grad_20") >= 0)
    throw InputError(
        fmt::format("{}: holds gradients of a surface in space (def_grad_20), whose frame the file does not "
                    "tell; compare pyvale's displacement file instead",
                    table.file));
  const bool windows = column_of(table, "window_x") >= 0;
  const double factor = length_factor("px", spec, table.file, windows ? "window_x" : "subset_x", stage.questions);
  const bool down = spec.y_axis != YAxis::up;
  stage.notes.push_back(fmt::format("pixels, y {}{}", down ? "down, turned up" : "up",
                                    spec.y_axis == YAxis::automatic ? ", the image's" : " as the settings say"));
  return windows ? read_windows(table, factor, down, std::move(stage))
                 : read_subsets(table, factor, down, std::move(stage));
}

}  // namespace weaveform::dic
