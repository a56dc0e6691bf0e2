#include "post/measurement/measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "mesher/base/error.hpp"
#include "post/measurement/readers.hpp"

namespace weaveform::dic {
namespace {

namespace fs = std::filesystem;

std::string format_of(const std::vector<std::string>& heading) {
  if (names_dice(heading)) return "dice";
  if (names_aramis(heading)) return "aramis";
  if (names_pyvale(heading)) return "pyvale";
  if (names_vic(heading)) return "vic";
  return "";
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

[[noreturn]] void refuse_unknown(const PointTable& table, const MeasurementSpec& spec) {
  if (spec.format == "columns")
    throw InputError(
        fmt::format("{}: no line names the columns that [measurement] maps; which line is the heading, and "
                    "what separates its columns? correct the names or 'delimiter'",
                    table.file));
  throw InputError(
      fmt::format("{}: which program wrote this? no line names the columns of {}; correct 'format' or 'delimiter' of "
                  "[measurement], "
                  "or map the columns with format = \"columns\"",
                  table.file, spec.format == "auto" ? "ARAMIS, DICe, VIC or pyvale" : "'" + spec.format + "'"));
}

}  // namespace

std::vector<fs::path> measurement_files(const std::vector<std::string>& arguments) {
  std::vector<fs::path> files;
  for (const std::string& argument : arguments) {
    if (!fs::exists(argument)) throw FileError(fmt::format("{}: no such file or folder", argument));
    if (!fs::is_directory(argument)) {
      files.emplace_back(argument);
      continue;
    }
    std::vector<fs::path> inside;
    for (const auto& entry : fs::directory_iterator(argument)) {
      const auto ending = entry.path().extension();
      if (entry.is_regular_file() && (ending == ".txt" || ending == ".csv" || ending == ".dat"))
        inside.push_back(entry.path());
    }
    if (inside.empty())
      throw FileError(fmt::format("{}: holds no .txt, .csv or .dat file; name the measurement's files", argument));
    std::sort(inside.begin(), inside.end(), counts_before);
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

std::vector<MeasuredStage> read_stages(const fs::path& file, const MeasurementSpec& spec) {
  const bool mapped = spec.format == "columns";
  std::string format;
  const auto is_heading = [&](const std::vector<std::string>& cells) {
    if (mapped) return names_columns(cells, spec);
    format = format_of(cells);
    return !format.empty() && (spec.format == "auto" || spec.format == format);
  };
  TableHints hints{.delimiter = spec.delimiter, .decimal = spec.decimal, .columns = 0};
  if (mapped && numbered_columns(spec)) hints.columns = 4;
  const PointTable table = open_point_table(file, hints, is_heading);
  if (!table.found) refuse_unknown(table, spec);
  std::vector<MeasuredStage> stages;
  if (mapped)
    stages = read_mapped(table, spec);
  else if (format == "dice")
    stages.push_back(read_dice(table, spec));
  else if (format == "aramis")
    stages.push_back(read_aramis(table, spec));
  else if (format == "pyvale")
    stages.push_back(read_pyvale(table, spec));
  else
    stages.push_back(read_vic(table, spec));
  for (const MeasuredStage& stage : stages)
    if (std::count(stage.valid.begin(), stage.valid.end(), true) < 4)
      throw InputError(
          fmt::format("{}: fewer than 4 points are measured ({} rows without values, {} failed); is this "
                      "the right file, and 'quality' right?",
                      table.file, stage.missing, stage.failed));
  return stages;
}

}  // namespace weaveform::dic
