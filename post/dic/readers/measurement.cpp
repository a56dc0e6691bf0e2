#include "post/dic/readers/measurement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/error.hpp"
#include "core/files/csv.hpp"
#include "fabric/identify/table_layout.hpp"
#include "post/dic/readers/matrix_files.hpp"
#include "post/dic/readers/readers.hpp"

namespace weaveform::dic {
namespace {

namespace fs = std::filesystem;

std::optional<MeasurementFormat> format_of(const std::vector<std::string>& heading) {
  if (names_dice(heading)) return MeasurementFormat::dice;
  if (names_aramis(heading)) return MeasurementFormat::aramis;
  if (names_pyvale(heading)) return MeasurementFormat::pyvale;
  if (names_matchid(heading)) return MeasurementFormat::matchid;
  if (names_opencorr(heading)) return MeasurementFormat::opencorr;
  if (names_vic(heading)) return MeasurementFormat::vic;
  return std::nullopt;
}

// File names in the order a person counts: stage_2 before stage_10.
bool counts_before(const fs::path& a, const fs::path& b) {
  const std::string left = a.filename().string(), right = b.filename().string();
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0, j = 0;
  while (i < left.size() && j < right.size()) {
    if (digit(left[i]) && digit(right[j])) {
      std::size_t i_end = i, j_end = j;
      while (i_end < left.size() && digit(left[i_end])) ++i_end;
      while (j_end < right.size() && digit(right[j_end])) ++j_end;
      while (i < i_end && left[i] == '0') ++i;
      while (j < j_end && right[j] == '0') ++j;
      const std::string one = left.substr(i, i_end - i), other = right.substr(j, j_end - j);
      if (one.size() != other.size()) return one.size() < other.size();
      if (one != other) return one < other;
      i = i_end;
      j = j_end;
    } else {
      if (left[i] != right[j]) return left[i] < right[j];
      ++i;
      ++j;
    }
  }
  return left.size() - i < right.size() - j;
}

// The columns of a table that no reader knows, as far as they can be made out; "" when they cannot.
std::string columns_there(const PointTable& table) {
  constexpr std::size_t lines_looked_at = 60;
  std::string best;
  std::size_t most = 1;
  for (const char delimiter : {';', '\t', ',', ' '}) {
    std::vector<identify::SplitLine> lines;
    for (const std::string& line : table.header) {
      if (lines.size() == lines_looked_at) break;
      const auto first = line.find_first_not_of("# \t");
      if (first != std::string::npos)
        lines.push_back({static_cast<int>(lines.size()) + 1, csv_cells(line.substr(first), delimiter)});
    }
    try {
      const auto layout = identify::find_table(lines, delimiter, table.file);
      if (!layout.heading || layout.width <= most) continue;
      most = layout.width;
      best = fmt::format("{}", fmt::join(lines[*layout.heading].cells, "', '"));
    } catch (const InputError&) {
      continue;  // several tables: nothing to name
    }
  }
  return best.empty() ? "" : "'" + best + "'";
}

// A stage that holds only the questions.
MeasuredStage unknown_table(const PointTable& table, const MeasurementSpec& spec) {
  if (spec.format == MeasurementFormat::columns)
    throw InputError(
        fmt::format("{}: no line names the columns that [measurement] maps; which line is the heading, and "
                    "what separates its columns? correct the names or 'delimiter'",
                    table.file));
  if (spec.format != MeasurementFormat::automatic)
    throw InputError(
        fmt::format("{}: no line names the columns of '{}'; correct 'format' or 'delimiter' of "
                    "[measurement], or map the columns with format = \"columns\"",
                    table.file, name_of(spec.format)));
  MeasuredStage stage;
  stage.label = table.file;
  const std::string columns = columns_there(table);
  ask(stage.questions,
      {fmt::format(
           "{}: which program wrote this? {}ARAMIS, DICe, VIC, pyvale, OpenCorr and MatchID are known; else map "
           "its columns, by name or by number from 1, as below, and 'quality' if one tells failed points:",
           table.file, columns.empty() ? "no line names its columns; " : "its columns are " + columns + "; "),
       "measurement.format", "columns"});
  for (const auto& [key, what] : {std::pair("x", "the position along x"),
                                  {"y", "the position along y"},
                                  {"u", "the displacement along x"},
                                  {"v", "the displacement along y"}})
    ask(stage.questions, {fmt::format("{}: which column is {}?", table.file, what), fmt::format("measurement.{}", key),
                          fmt::format("NAME_OF_{}", key)});
  if (spec.length_unit == MeasuredUnit::automatic)
    ask(stage.questions,
        {fmt::format("{}: in which unit are positions and displacements, where the column names do not "
                     "say it?",
                     table.file),
         "measurement.length_unit", "mm"});
  (void)settle_up(spec, std::nullopt, table.file, "y", stage.questions);
  return stage;
}

MeasuredStage read_one(MeasurementFormat format, const PointTable& table, const MeasurementSpec& spec) {
  if (format == MeasurementFormat::dice) return read_dice(table, spec);
  if (format == MeasurementFormat::aramis) return read_aramis(table, spec);
  if (format == MeasurementFormat::pyvale) return read_pyvale(table, spec);
  if (format == MeasurementFormat::opencorr) return read_opencorr(table, spec);
  if (format == MeasurementFormat::matchid) return read_matchid(table, spec);
  return read_vic(table, spec);
}

}  // namespace

std::vector<fs::path> measurement_files(const std::vector<std::string>& arguments) {
  std::vector<fs::path> files;
  std::vector<bool> listed;
  for (const std::string& argument : arguments) {
    if (!fs::exists(argument)) throw FileError(fmt::format("{}: no such file or folder", argument));
    if (!fs::is_directory(argument)) {
      files.emplace_back(argument);
      listed.push_back(true);
      continue;
    }
    std::vector<fs::path> inside;
    for (const auto& entry : fs::directory_iterator(argument)) {
      const auto ending = entry.path().extension();
      const bool readme = entry.path().stem() == "README" || entry.path().stem() == "readme";
      if (entry.is_regular_file() && !readme && (ending == ".txt" || ending == ".csv" || ending == ".dat"))
        inside.push_back(entry.path());
    }
    if (inside.empty())
      throw FileError(fmt::format("{}: holds no .txt, .csv or .dat file; name the measurement's files", argument));
    std::sort(inside.begin(), inside.end(), counts_before);
    files.insert(files.end(), inside.begin(), inside.end());
    listed.resize(files.size(), false);
  }
  return stages_of_matrices(files, listed);
}

std::vector<MeasuredStage> read_stages_asking(const fs::path& file, const MeasurementSpec& spec) {
  const bool mapped = spec.format == MeasurementFormat::columns;
  if (spec.format == MeasurementFormat::matrix) return {read_matrix(file, spec)};
  std::optional<MeasurementFormat> format;
  const auto is_heading = [&](const std::vector<std::string>& cells) {
    if (mapped) return names_columns(cells, spec);
    format = format_of(cells);
    if (spec.format == MeasurementFormat::vic && names_vic(cells)) format = MeasurementFormat::vic;
    if (format == MeasurementFormat::vic && spec.format == MeasurementFormat::automatic && !only_vic(cells))
      format.reset();
    return format && (spec.format == MeasurementFormat::automatic || spec.format == format);
  };
  TableHints hints{.delimiter = spec.delimiter, .decimal = spec.decimal, .columns = 0};
  if (mapped && numbered_columns(spec)) hints.columns = 4;
  const PointTable table = open_point_table(file, hints, is_heading);
  if (table.found && mapped) return read_mapped(table, spec);
  if (table.found) return {read_one(*format, table, spec)};
  if (spec.format == MeasurementFormat::automatic && looks_like_matrix(table.text, spec))
    return {read_matrix(file, spec)};
  return {unknown_table(table, spec)};
}

std::vector<MeasuredStage> read_stages(const fs::path& file, const MeasurementSpec& spec) {
  auto stages = read_stages_asking(file, spec);
  for (const MeasuredStage& stage : stages) throw_if_asked(stage.questions);
  for (const MeasuredStage& stage : stages)
    if (std::count(stage.valid.begin(), stage.valid.end(), true) < 4)
      throw InputError(
          fmt::format("{}: fewer than 4 points are measured ({} rows without values, {} failed); is this "
                      "the right file, and 'quality' right?",
                      file.string(), stage.missing, stage.failed));
  return stages;
}

}  // namespace weaveform::dic
