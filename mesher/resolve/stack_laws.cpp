#include "mesher/resolve/stack_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "core/files/csv.hpp"
#include "core/files/files.hpp"
#include "mesher/scene/ply_scene.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;
using Table = std::vector<std::array<double, 2>>;

struct ReadTable {
  std::vector<std::string> heading;  // none: the file has none
  Table row;
  std::vector<std::string> place;  // "file:line" of each
};

bool is_number(const std::string& cell) {
  return csv_number_in(cell, false).has_value();
}

ReadTable read_table(const std::string& text, const std::string& file, const std::string& what) {
  CsvReader in(text, file, {.remarks = true});
  ReadTable table;
  while (in.advance()) {
    if (in.cells().size() != 2)
      throw InputError(fmt::format("{}: {} numbers; each row is {}", in.place(), in.cells().size(), what));
    if (table.row.empty() && table.heading.empty() && !is_number(in.cells()[0]) && !is_number(in.cells()[1])) {
      table.heading = in.cells();
      continue;
    }
    table.row.push_back({in.number(0, "each row is " + what), in.number(1, "each row is " + what)});
    table.place.push_back(in.place());
  }
  if (table.row.size() < 2) throw InputError(fmt::format("{}: has fewer than two rows of {}", file, what));
  return table;
}

void require_rising(const ReadTable& table, const Table& row, std::size_t column, bool strictly, const char* what) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    const double before = k == 0 ? 0.0 : row[k - 1][column], here = row[k][column];
    const bool rises = k == 0 ? here >= 0.0 : strictly ? here > before : here >= before;
    if (!rises)
      throw InputError(fmt::format("{}: {} is {:g}{}; it must {}", table.place[k], what, here,
                                   k == 0 ? "" : fmt::format(" after {:g}", before),
                                   k == 0 ? "be 0 or more" : "rise from row to row"));
  }
}

fs::path beside_scene(const Scene& scene, const std::string& file) {
  return fs::path(scene.file).parent_path() / file;  // an absolute path stays as it is
}

std::string text_of_law(const Scene& scene, const char* key, const std::string& name) {
  const fs::path file = beside_scene(scene, name);
  if (!fs::exists(file))
    throw FileError(
        fmt::format("{}: stack.{}: {}: no such file; correct the path, which is taken from the scene's "
                    "folder",
                    scene.file, key, file.string()));
  return read_text_file(file);
}

}  // namespace

Table read_shear_law(const std::string& text, const std::string& file) {
  const ReadTable table = read_table(text, file, "slip (mm), shear stress (MPa)");
  require_rising(table, table.row, 0, true, "the slip");
  for (std::size_t k = 0; k < table.row.size(); ++k)
    if (!(table.row[k][1] >= 0.0))
      throw InputError(
          fmt::format("{}: the shear stress is {:g} MPa; it must be 0 or more", table.place[k], table.row[k][1]));
  return table.row;
}

// A thickness falls under pressure: its approach is what it has lost since the row of the least pressure.
Table read_compaction(const std::string& text, const std::string& file) {
  const ReadTable table = read_table(text, file, "approach_mm or thickness_mm, pressure_MPa");
  const bool of_thickness = !table.heading.empty() && table.heading[0] == "thickness_mm";
  const bool of_approach = !table.heading.empty() && table.heading[0] == "approach_mm";
  if ((!of_thickness && !of_approach) || table.heading[1] != "pressure_MPa")
    throw InputError(fmt::format(
        "{}: its first line must be approach_mm,pressure_MPa or thickness_mm,pressure_MPa, and say which it is", file));
  Table law = table.row;
  if (of_thickness)
    for (auto& row : law) row[0] = table.row.front()[0] - row[0];
  require_rising(table, law, 0, true, of_thickness ? "the thickness lost" : "the approach");
  require_rising(table, law, 1, false, "the pressure");
  return law;
}

ResolvedPair resolve_pair(const Scene& scene, const std::string& one, const std::string& other) {
  const PairSpec spec = pair_of(scene.stack, one, other);
  ResolvedPair pair;
  pair.friction = spec.friction.value_or(0.0);
  pair.gap = spec.gap.value_or(0.0);
  if (!spec.friction_law.empty())
    pair.shear_law = read_shear_law(text_of_law(scene, "friction_law", spec.friction_law),
                                    beside_scene(scene, spec.friction_law).string());
  if (!spec.compaction.empty())
    pair.compaction = read_compaction(text_of_law(scene, "compaction", spec.compaction),
                                      beside_scene(scene, spec.compaction).string());
  return pair;
}

std::vector<std::string> law_files(const Scene& scene) {
  std::vector<std::string> files;
  const auto take = [&](const std::string& name) {
    if (name.empty()) return;
    const std::string file = beside_scene(scene, name).string();
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  };
  take(scene.stack.friction_law);
  take(scene.stack.compaction);
  for (const PairSpec& pair : scene.stack.pair) {
    take(pair.friction_law);
    take(pair.compaction);
  }
  return files;
}

}  // namespace weaveform
