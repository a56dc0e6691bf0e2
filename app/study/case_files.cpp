#include "app/study/case_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <sstream>

#include "app/study/measure.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "post/output/summary.hpp"

namespace weaveform::study {

namespace {

constexpr std::string_view complaint_mark = "error: ";

// The line with the case's files named as they lie beside each other, so that it is the same from wherever it was run.
std::string without_folder(std::string line, const std::string& name) {
  for (auto at = line.find(name); at != std::string::npos; at = line.find(name, at + name.size())) {
    const auto blank = line.rfind(' ', at);
    const auto begin = blank == std::string::npos ? 0 : blank + 1;
    line.erase(begin, at - begin);
    at = begin;
  }
  return line;
}

}  // namespace

CaseFiles case_files(const std::filesystem::path& study_folder, const std::string& name) {
  const std::filesystem::path folder = study_folder / "cases";
  return {folder / (name + ".toml"), folder / name, folder / (name + ".exit"), folder / (name + ".log"),
          folder / (name + ".walls")};
}

bool is_final(int exit_code) {
  return exit_code == static_cast<int>(ExitCode::done) || exit_code == static_cast<int>(ExitCode::input) ||
         exit_code == static_cast<int>(ExitCode::physics);
}

std::vector<double> walls_of(const CaseFiles& files) {
  std::vector<double> walls;
  if (!std::filesystem::exists(files.walls)) return walls;
  std::istringstream lines(read_text_file(files.walls));
  for (double wall = 0.0; lines >> wall;) walls.push_back(wall);
  if (!lines.eof())
    throw InputError(fmt::format("{}: not a list of times; remove it and run the study again", files.walls.string()));
  return walls;
}

double wall_of(const CaseFiles& files) {
  std::vector<double> walls = walls_of(files);
  if (walls.empty()) return measure(files.results, "wall_s");
  std::sort(walls.begin(), walls.end());
  const std::size_t half = walls.size() / 2;
  return walls.size() % 2 == 1 ? walls[half] : 0.5 * (walls[half - 1] + walls[half]);
}

std::string error_line(const std::filesystem::path& log, int exit_code) {
  if (exit_code == 0) return "";
  std::string found;
  if (std::filesystem::exists(log)) {
    std::istringstream lines(read_text_file(log));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(complaint_mark)) found = line.substr(complaint_mark.size());
  }
  if (!found.empty()) return without_folder(found, log.stem().string());
  if (exit_code > 128) return fmt::format("killed by signal {} ({})", exit_code - 128, strsignal(exit_code - 128));
  return fmt::format("ended with exit code {} and no complaint", exit_code);
}

std::optional<Outcome> outcome(const CaseFiles& files, const std::string& text) {
  if (!std::filesystem::exists(files.exit) || !std::filesystem::exists(files.scene)) return std::nullopt;
  if (read_text_file(files.scene) != text) return std::nullopt;
  const std::string content = read_text_file(files.exit);
  int code = 0;
  const auto [end, error] = std::from_chars(content.data(), content.data() + content.size(), code);
  if (error != std::errc{} || code == static_cast<int>(ExitCode::interrupted)) return std::nullopt;
  if (code == 0 && !std::filesystem::exists(files.results / file_name::summary)) return std::nullopt;
  return Outcome{code, error_line(files.log, code)};
}

}  // namespace weaveform::study
