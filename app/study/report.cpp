#include "app/study/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "app/study/border_report.hpp"
#include "app/study/border_run.hpp"
#include "app/study/convergence_report.hpp"
#include "app/study/measure.hpp"
#include "app/study/references.hpp"
#include "app/study/study_page.hpp"
#include "app/study/table.hpp"
#include "app/study/work_precision.hpp"
#include "app/study/work_precision_report.hpp"
#include "app/study/wrinkle_report.hpp"
#include "core/chart/chart.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/version/version.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/scene_copy.hpp"
#include "solver/result/chart_file.hpp"

namespace weaveform::study {

namespace fs = std::filesystem;

namespace {

void add_missing(std::vector<std::string>& all, const std::vector<std::string>& more) {
  for (const std::string& name : more)
    if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
}

void count(const Table& table, Report& report) {
  for (const Row& row : table.row) {
    if (!row.outcome)
      ++report.missing;
    else
      ++(row.outcome->exit_code == 0 ? report.done : report.failed);
  }
}

void begin_json(const Study& study, const Table& table, std::size_t measure_columns, Report& report) {
  report.json = {{"study", study.file.string()},
                 {"done", report.done},
                 {"failed", report.failed},
                 {"missing", report.missing},
                 {"cases", table_json(table, measure_columns)}};
}

// A result folder's own scene begins with the program that wrote it.
void check_versions(const Table& table, const fs::path& study_folder, Report& report) {
  std::set<std::string> versions;
  for (const Row& row : table.row) {
    if (!row.outcome || row.outcome->exit_code != 0) continue;
    const std::string scene =
        read_text_file(case_files(study_folder, row.one.name).results / weaveform::file_name::scene);
    versions.insert(scene.substr(0, scene.find('\n')));
  }
  const std::string ours = fmt::format("# {}: {}", written_mark, version_line());
  if (versions.size() == 1 && *versions.begin() != ours)
    report.complaints.push_back(fmt::format(
        "these cases were run before, by another version than this one ({}): '{}'; to run them by this one, use a new "
        "--output folder",
        version_line(), *versions.begin()));
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
  if (study.work_precision && study.work_precision->reference == ErrorReference::limit)
    add_missing(measures.converging, measures.charted);
  if (study.convergence) add_missing(measures.all, measures.converging);
  if (study.work_precision) {
    check_reference_measures(study, measures.charted);
    add_missing(measures.all, measures.charted);
    for (const ReferenceValue& value : study.reference.value)
      if (!value.number) add_missing(measures.all, {value.other});
  }
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

namespace {

void write_convergence(const Study& study, const std::vector<ConvergenceOf>& convergence, const Table& table,
                       const fs::path& study_folder, Report& report, StudyPage& page) {
  const std::string text = convergence_markdown(*study.convergence, convergence, table);
  write_text_whole(study_folder / report_name::convergence, text);
  write_text_whole(study_folder / report_name::convergence_table,
                   convergence_csv(*study.convergence, convergence, table));
  report.answer += "\n" + text;
  report.json["convergence"] = convergence_json(*study.convergence, convergence, table);
  page.answers.emplace_back("Convergence", text);
}

// Where the cases differ in their coarsening, and any of them wrinkles.
void write_wrinkles(const Table& table, const fs::path& study_folder, Report& report, StudyPage& page) {
  const std::vector<WrinklesOf> wrinkles = wrinkles_of(table, study_folder);
  if (wrinkles.empty()) return;
  const std::string text = wrinkles_markdown(wrinkles, table);
  write_text_whole(study_folder / report_name::wrinkles, text);
  write_text_whole(study_folder / report_name::wrinkles_table, wrinkles_csv(wrinkles, table));
  report.answer += "\n" + text;
  report.json["wrinkles"] = wrinkles_json(wrinkles, table);
  page.answers.emplace_back("Wrinkles", text);
}

void write_work_precision(const Study& study, const Measures& measures, const std::vector<ConvergenceOf>& convergence,
                          const Table& table, const fs::path& study_folder, Report& report, StudyPage& page) {
  const auto charts = work_precision_of(study, measures.charted, convergence, table, report.complaints);
  const std::string text = work_precision_markdown(*study.work_precision, charts, table);
  write_text_whole(study_folder / report_name::work_precision_table, work_precision_csv(charts, table));
  write_text_whole(study_folder / report_name::work_precision, text);
  std::vector<std::pair<std::filesystem::path, Chart>> drawn;
  for (const WorkPrecision& one : charts) {
    page.charts.push_back(work_precision_chart(one, table));
    drawn.emplace_back(study_folder / chart_name(one.measure), page.charts.back());
  }
  write_charts(drawn);
  report.answer += "\n" + text;
  report.json["work_precision"] = work_precision_json(*study.work_precision, charts, table);
  page.answers.emplace_back("Work and precision", text);
}

}  // namespace

Report write_border_report(const Study& study, const fs::path& study_folder, bool of_cases) {
  Report report;
  StudyPage page;
  const auto groups = find_borders(study, study_folder);
  std::vector<Case> cases;
  for (const BorderGroup& group : groups) cases.insert(cases.end(), group.tried.begin(), group.tried.end());
  const Measures measures = measures_of(study);
  const Table table = collect(study, cases, measures.all, study_folder, report.complaints);
  count(table, report);
  check_versions(table, study_folder, report);
  remove_files(study_folder, report_files());
  write_text_whole(study_folder / report_name::table, to_csv(table, measures.columns));
  write_text_whole(study_folder / report_name::border_table, border_csv(study, groups));
  report.answer = border_markdown(study, groups);
  begin_json(study, table, measures.columns, report);
  report.json["border"] = border_json(study, groups);
  write_text_whole(study_folder / report_name::border, report.answer);
  page.answers.emplace_back("Border", report.answer);
  if (const auto chart = border_chart(study, groups)) {
    write_chart(study_folder / report_name::border_chart, *chart);
    page.charts.push_back(*chart);
  }
  for (const BorderGroup& group : groups) {
    if (!group.search.complaint.empty()) report.complaints.push_back(border_group_complaint(group));
    report.borders += border_is_found(group) ? 1 : 0;
  }
  if (of_cases) write_case_reports(table, study_folder);
  page.complaints = report.complaints;
  write_study_page(study, table, measures.columns, page, study_folder);
  report.json["complaints"] = report.complaints;
  return report;
}

Report write_report(const Study& study, const std::vector<Case>& cases, const fs::path& study_folder, bool of_cases) {
  Report report;
  StudyPage page;
  const Measures measures = measures_of(study);
  const Table table = collect(study, cases, measures.all, study_folder, report.complaints);
  count(table, report);
  check_versions(table, study_folder, report);
  remove_files(study_folder, report_files());
  report.answer = to_markdown(table, measures.columns);
  begin_json(study, table, measures.columns, report);
  std::vector<ConvergenceOf> convergence;
  if (study.convergence) {
    convergence = convergence_of(*study.convergence, measures.converging, table);
    write_convergence(study, convergence, table, study_folder, report, page);
  }
  write_wrinkles(table, study_folder, report, page);
  // Before the charts, which may find the reference case unfit.
  write_text_whole(study_folder / report_name::table, to_csv(table, measures.columns));
  if (study.work_precision && report.done > 0)
    write_work_precision(study, measures, convergence, table, study_folder, report, page);
  if (of_cases) write_case_reports(table, study_folder);
  page.complaints = report.complaints;
  write_study_page(study, table, measures.columns, page, study_folder);
  report.json["complaints"] = report.complaints;
  return report;
}

}  // namespace weaveform::study
