#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/error.hpp"
#include "core/files/csv.hpp"
#include "core/files/files.hpp"
#include "core/log/plain_text.hpp"
#include "core/missing.hpp"
#include "post/dic/readers/matrix_files.hpp"
#include "post/dic/readers/readers.hpp"

namespace weaveform::dic {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t sampled_lines = 20;  // looked at to tell a matrix from a table
constexpr std::size_t least_columns = 3;   // fewer are a list
constexpr double suspicious_zeros = 0.01;  // share of points that are exactly zero in every component
constexpr std::size_t bad_rows_shown = 5;

struct Matrix {
  std::string file;
  std::size_t rows = 0, columns = 0;
  std::vector<double> value;    // row by row; not a number where the cell is no number
  std::set<std::string> words;  // that stood there instead
};

// Blanks separate when commas are decimal ones.
char delimiter_of(const std::string& line, const MeasurementSpec& spec) {
  if (const auto given = delimiter_named(spec.delimiter)) return *given;
  for (const char c : {';', '\t'})
    if (line.find(c) != std::string::npos) return c;
  const auto blanks = csv_cells(line, ' ');
  const bool by_blanks =
      blanks.size() >= least_columns &&
      std::all_of(blanks.begin(), blanks.end(), [](const auto& cell) { return std::isfinite(number_of(cell)); });
  return by_blanks || line.find(',') == std::string::npos ? ' ' : ',';
}

std::vector<std::string> lines_of(const std::string& text, std::size_t most) {
  std::vector<std::string> lines;
  for (TextLines all(text); lines.size() < most && all.advance();) lines.emplace_back(all.line());
  while (!lines.empty() && lines.back().find_first_not_of(" \t") == std::string::npos) lines.pop_back();
  return lines;
}

std::vector<std::string> cells_of(const std::string& line, char delimiter) {
  auto cells = csv_cells(line, delimiter);
  if (!cells.empty() && cells.back().empty()) cells.pop_back();  // a delimiter ends the line
  return cells;
}

Matrix read_matrix_file(const fs::path& file, const MeasurementSpec& spec) {
  const auto lines = lines_of(plain_text(read_text_file(file)), std::numeric_limits<std::size_t>::max());
  Matrix matrix;
  matrix.file = file.string();
  if (lines.empty()) throw InputError(fmt::format("{}: is empty; export the matrix anew", matrix.file));
  const char delimiter = delimiter_of(lines.front(), spec);
  std::vector<std::string> complaints;
  for (std::size_t r = 0; r < lines.size() && complaints.size() < bad_rows_shown; ++r) {
    const auto cells = cells_of(lines[r], delimiter);
    if (r == 0) matrix.columns = cells.size();
    if (cells.size() != matrix.columns)
      complaints.push_back(
          fmt::format("{}:{}: the row has {} cell(s), the first has {}; is the file cut off, or "
                      "'delimiter' of [measurement] another one?",
                      matrix.file, r + 1, cells.size(), matrix.columns));
    for (const std::string& cell : cells) {
      const double number = number_of(cell);
      matrix.value.push_back(std::isfinite(number) ? number : missing);
      if (!std::isfinite(number)) matrix.words.insert(cell);
    }
  }
  if (!complaints.empty()) throw InputError(complaints);
  matrix.rows = lines.size();
  return matrix;
}

// The component's matrix, which must be of the same size as u's.
Matrix sister_matrix(const fs::path& file, const Matrix& u, const MeasurementSpec& spec) {
  Matrix matrix = read_matrix_file(file, spec);
  if (matrix.rows != u.rows || matrix.columns != u.columns)
    throw InputError(fmt::format("{}: has {} x {} cells, {} has {} x {}; export both of one stage", matrix.file,
                                 matrix.rows, matrix.columns, u.file, u.rows, u.columns));
  return matrix;
}

double factor_of(const fs::path& file, const MeasurementSpec& spec, Questions& questions) {
  const auto name = matrix_name(file);
  return length_factor(name ? name->unit : "", spec, file.string(), fs::path(file).filename().string(), questions);
}

bool in_pixels(const fs::path& file, const MeasurementSpec& spec) {
  const auto name = matrix_name(file);
  return name && !name->unit.empty() ? is_pixel(name->unit) : spec.length_unit == MeasuredUnit::px;
}

struct Grid {
  double pitch = 1.0;                        // mm; from point to point
  std::array<double, 2> first = {0.0, 0.0};  // mm; of the first column and row
};

Grid grid_of(const Matrix& u, const MeasurementSpec& spec, Questions& questions) {
  Grid grid;
  const bool placed = spec.grid_first[0] != 0.0 || spec.grid_first[1] != 0.0;
  if (spec.grid_pitch) grid.pitch = *spec.grid_pitch;
  if (!spec.grid_pitch && !spec.grid_step)
    ask(questions, {fmt::format("{}: a matrix of {} rows and {} columns: how many pixels is it from one point to the "
                                "next (or mm: grid_pitch)?",
                                u.file, u.rows, u.columns),
                    "measurement.grid_step", "5"});
  if ((!spec.grid_pitch || placed) && !spec.pixel_size)
    ask(questions, {fmt::format("{}: the points' places are in pixels: how many mm is one pixel?", u.file),
                    "measurement.pixel_size", "0.05"});
  const double pixel = spec.pixel_size.value_or(1.0);
  if (!spec.grid_pitch && spec.grid_step) grid.pitch = pixel * *spec.grid_step;
  grid.first = {pixel * spec.grid_first[0], pixel * spec.grid_first[1]};
  return grid;
}

// Zero in every component may be a point that did not move, or one outside the region (Ncorr and OpenCorr write zeros
// there).
void mark_zeros(const Matrix& u, const MeasurementSpec& spec, PointRows& rows, MeasuredStage& stage) {
  std::vector<std::size_t> zero;
  for (std::size_t i = 0; i < rows.displacement.size(); ++i)
    if (rows.displacement[i] == Vec3{0.0, 0.0, 0.0}) zero.push_back(i);
  const auto share = static_cast<double>(zero.size()) / static_cast<double>(rows.displacement.size());
  if (spec.grid_zeros == GridZeros::automatic && share > suspicious_zeros && zero.size() < rows.displacement.size())
    ask(stage.questions, {fmt::format("{}: {} of {} points have displacements of exactly zero: were they measured, or "
                                      "are they missing (outside the region, or failed)?",
                                      u.file, zero.size(), rows.displacement.size()),
                          "measurement.grid_zeros", "missing"});
  if (spec.grid_zeros != GridZeros::missing) return;
  for (const std::size_t i : zero) rows.displacement[i][0] = missing;
  stage.notes.push_back(fmt::format("{} points with displacements of exactly zero taken as missing", zero.size()));
}

std::string quoted(const std::set<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += fmt::format("{}'{}'", text.empty() ? "" : ", ", word);
  return text;
}

}  // namespace

bool looks_like_matrix(const std::string& text, const MeasurementSpec& spec) {
  const auto lines = lines_of(text.substr(0, std::min<std::size_t>(text.size(), 1'000'000)), sampled_lines);
  if (lines.size() < 3) return false;
  const char delimiter = delimiter_of(lines.front(), spec);
  const std::size_t width = cells_of(lines.front(), delimiter).size();
  std::size_t numbers = 0;
  for (std::size_t r = 0; r < lines.size(); ++r) {
    const auto cells = cells_of(lines[r], delimiter);
    if (cells.size() != width) return false;
    for (const auto& cell : cells) numbers += std::isfinite(number_of(cell)) ? 1 : 0;
    // a heading has no number; a row of failed points has one word
    const std::set<std::string> different(cells.begin(), cells.end());
    if (r == 0 && different.size() > 1 &&
        std::none_of(cells.begin(), cells.end(), [](const auto& cell) { return std::isfinite(number_of(cell)); }))
      return false;
  }
  return width >= least_columns && numbers > 0;
}

MeasuredStage read_matrix(const fs::path& file, const MeasurementSpec& spec) {
  const auto name = matrix_name(file);
  if (!name)
    throw InputError(
        fmt::format("{0}: is a matrix of numbers without a heading: of which component? let its name say it ({1}_U{2} "
                    "and {1}_V{2}), or export one table with columns x, y, u and v",
                    file.string(), file.stem().string(), file.extension().string()));
  const fs::path u_file = name->component == 'u' ? file : sister_of(file, 'u'), v_file = sister_of(file, 'v');
  for (const auto& [component, path] : {std::pair('U', u_file), {'V', v_file}})
    if (path.empty())
      throw InputError(fmt::format(
          "{}: is a matrix of one component, and there is none of {} beside it; export U and V of the stage "
          "into one folder, under names that differ in this letter only",
          file.string(), component));
  MeasuredStage stage;
  stage.label = u_file.filename().string();
  const Matrix u = read_matrix_file(u_file, spec), v = sister_matrix(v_file, u, spec);
  const fs::path w_file = sister_of(file, 'w'), x_file = sister_of(file, 'x'), y_file = sister_of(file, 'y');
  std::optional<Matrix> w, x, y;
  if (!w_file.empty()) w = sister_matrix(w_file, u, spec);
  if (!x_file.empty() && !y_file.empty()) {
    x = sister_matrix(x_file, u, spec);
    y = sister_matrix(y_file, u, spec);
  }
  const double factor = factor_of(u_file, spec, stage.questions), v_factor = factor_of(v_file, spec, stage.questions);
  const double position_factor = x ? factor_of(x_file, spec, stage.questions) : 1.0;
  const Grid grid = x ? Grid{} : grid_of(u, spec, stage.questions);
  if (spec.y_axis == YAxis::automatic && !in_pixels(v_file, spec))
    ask(stage.questions, {fmt::format("{}: is the displacement V positive upwards or downwards? its rows go down "
                                      "the image;",
                                      v.file),
                          "measurement.y_axis", "down"});
  const bool up = spec.y_axis == YAxis::up;

  PointRows rows;
  std::vector<double> row_number;
  for (std::size_t r = 0; r < u.rows; ++r)
    for (std::size_t c = 0; c < u.columns; ++c) {
      const std::size_t k = r * u.columns + c;
      // rows go down whatever the sense of v
      rows.position.push_back(x ? Vec3{position_factor * x->value[k], position_factor * y->value[k], 0.0}
                                : Vec3{grid.first[0] + grid.pitch * static_cast<double>(c),
                                       (up ? -1.0 : 1.0) * (grid.first[1] + grid.pitch * static_cast<double>(r)), 0.0});
      rows.displacement.push_back({factor * u.value[k], v_factor * v.value[k], w ? factor * w->value[k] : 0.0});
      row_number.push_back(static_cast<double>(r));
    }
  mark_zeros(u, spec, rows, stage);
  if (!up) flip_y(rows);
  std::set<std::string> words = u.words;
  words.insert(v.words.begin(), v.words.end());
  stage.notes.push_back(fmt::format(
      "matrices of {} rows and {} columns: {} and {}{}; places by {}; v {}{}", u.rows, u.columns,
      u_file.filename().string(), v_file.filename().string(), w ? ", " + w_file.filename().string() : "",
      x ? fmt::format("{} and {}", x_file.filename().string(), y_file.filename().string())
        : fmt::format("a grid of {:.6g} mm from ({:.6g}, {:.6g}) mm", grid.pitch, grid.first[0], grid.first[1]),
      up ? "up" : "down, turned up", spec.y_axis == YAxis::automatic ? ", the image's" : " as the settings say"));
  if (!words.empty()) stage.notes.push_back("failed points by words instead of numbers: " + quoted(words));
  std::vector<bool> failed;
  for (std::size_t k = 0; k < u.value.size(); ++k)
    failed.push_back(std::isnan(u.value[k]) || std::isnan(v.value[k]) || (w && std::isnan(w->value[k])));
  take_rows(std::move(rows), failed, stage);
  return stage;
}

}  // namespace weaveform::dic
