#include "app/study/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/study/convergence_report.hpp"
#include "app/study/measure.hpp"
#include "app/study/table.hpp"
#include "app/study/work_precision.hpp"
#include "mesher/base/error.hpp"
#include "mesher/scene/reader.hpp"
#include "solver/result/chart_file.hpp"
#include "solver/result/whole_file.hpp"

namespace weaveform::study {

namespace fs = std::filesystem;

namespace {

void add_missing(std::vector<std::string>& all, const std::vector<std::string>& more) {
  for (const std::string& name : more)
    if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
}

// The table for people: settings, how it ended, measures.
std::string table_text(const Table& table, std::size_t columns) {
  std::string text = "|";
  for (const std::string& key : table.keys) text += fmt::format(" {} |", key);
  for (std::size_t m = 0; m < columns; ++m) text += fmt::format(" {} |", table.measures[m]);
  text += " solve |\n|";
  for (std::size_t c = 0; c < table.keys.size() + columns + 1; ++c) text += "---:|";
  for (const Row& row : table.row) {
    text += "\n|";
    for (const std::string& key : table.keys) {
      const Setting* setting = setting_of(row.one, key);
      text += fmt::format(" {} |", setting != nullptr ? setting->value : "");
    }
    const bool done = row.outcome && row.outcome->exit_code == 0;
    for (std::size_t m = 0; m < columns; ++m) text += fmt::format(" {} |", csv_number(row.value[m], 6));
    text += done ? fmt::format(" {:.3g} s |", row.wall) : row.outcome ? " failed |" : " not run |";
  }
  return text + "\n";
}

void count(const Table& table, Report& report) {
  for (const Row& row : table.row) {
    if (!row.outcome)
      ++report.missing;
    else
      ++(row.outcome->exit_code == 0 ? report.done : report.failed);
  }
}

// A result folder's own scene begins with the program that wrote it.
void check_versions(const Table& table, const fs::path& study_folder, Report& report) {
  std::set<std::string> versions;
  for (const Row& row : table.row) {
    if (!row.outcome || row.outcome->exit_code != 0) continue;
    const std::string scene = read_text(case_files(study_folder, row.one.name).results / "scene.toml");
    versions.insert(scene.substr(0, scene.find('\n')));
  }
  if (versions.size() > 1)
    report.complaints.push_back(
        fmt::format("{} versions of weaveform have run these cases (see cases/*/scene.toml); to compare what only the "
                    "scene changes, use a new --output folder",
                    versions.size()));
}

}  // namespace

Measures measures_of(const Study& study) {
  Measures measures;
  measures.all = study.head.measures;
  if (measures.all.empty()) {
    std::vector<std::string> overrides;
    for (const Setting& setting : study.set) overrides.push_back(setting.override_text());
    measures.all = default_measures(read_scene(scene_path(study), overrides));
  }
  measures.columns = measures.all.size();
  measures.converging = measures.charted = measures.all;
  if (study.convergence && !study.convergence->measures.empty())
    measures.converging = measures.charted = study.convergence->measures;
  if (study.work_precision && !study.work_precision->measures.empty())
    measures.charted = study.work_precision->measures;
  // A limit is known only of what converges.
  if (study.work_precision && study.work_precision->reference == "limit")
    add_missing(measures.converging, measures.charted);
  if (study.convergence) add_missing(measures.all, measures.converging);
  if (study.work_precision) add_missing(measures.all, measures.charted);
  return measures;
}

void check_measures(const Study& study, const Measures& measures, const Case& done, const fs::path& study_folder) {
  Complaints complaints(study.file.string());
  const auto lists = [](const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  for (const std::string& name : measures.all) {
    try {
      (void)measure(case_files(study_folder, done.name).results, name);
    } catch (const InputError& error) {
      const bool head = lists(study.head.measures, name);
      const bool converging = study.convergence && lists(study.convergence->measures, name);
      complaints.add(head         ? study.measures_at
                     : converging ? study.convergence_at
                                  : study.work_precision_at,
                     fmt::format("measures: {}", error.what()));
    }
  }
  complaints.throw_if_any();
}

Report write_report(const Study& study, const std::vector<Case>& cases, const fs::path& study_folder) {
  Report report;
  const Measures measures = measures_of(study);
  const Table table = collect(study, cases, measures.all, study_folder, report.complaints);
  count(table, report);
  check_versions(table, study_folder, report);
  report.answer = table_text(table, measures.columns);
  std::vector<ConvergenceOf> convergence;
  if (study.convergence) {
    convergence = convergence_of(*study.convergence, measures.converging, table);
    const std::string text = convergence_markdown(*study.convergence, convergence, table);
    write_text_whole(study_folder / "convergence.md", text);
    write_text_whole(study_folder / "convergence.csv", convergence_csv(*study.convergence, convergence, table));
    report.answer += "\n" + text;
  }
  // Before the charts, which may find the reference case unfit.
  write_text_whole(study_folder / "study.csv", to_csv(table, measures.columns));
  if (study.work_precision && report.done > 0) {
    const auto charts = work_precision_of(study, measures.charted, convergence, table, report.complaints);
    write_text_whole(study_folder / "work_precision.csv", work_precision_csv(charts, table));
    for (const WorkPrecision& one : charts) {
      write_chart(study_folder / chart_name(one.measure), work_precision_chart(one, table));
      report.answer += fmt::format("\nPareto front of {}, time against error:\n", one.measure);
      for (const WorkPoint& point : one.point)
        if (point.on_front)
          report.answer += fmt::format("- {}: {:.3g} s, {:.3g} %\n", describe(table.row[point.row].one), point.time,
                                       100.0 * point.error);
    }
  }
  return report;
}

}  // namespace weaveform::study
