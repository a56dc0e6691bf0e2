#include "app/study/border_run.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/keys/key_value.hpp"
#include "post/output/summary.hpp"

namespace weaveform::study {

namespace fs = std::filesystem;

namespace {

class Borders {
public:
  Borders(const Study& study, fs::path study_folder)
      : study_(study),
        folder_(std::move(study_folder)),
        scene_text_(read_text_file(scene_path(study))),
        variants_(combinations(study)) {}

  [[nodiscard]] const std::vector<Variant>& variants() const { return variants_; }

  // The search of a group as far as its cases have ended; `known` decides whether an ended case counts.
  template <class Known>
  [[nodiscard]] BorderGroup search(const Variant& variant, const Known& known) {
    BorderGroup group{variant, {}, {}, {}};
    group.search = search_border(*study_.border, [&](double value) -> std::optional<bool> {
      const Case& one = at(variant, value);
      const auto ended = outcome(case_files(folder_, one.name), one.text);
      if (!ended || !known(one, *ended)) return std::nullopt;
      return judgement(variant, one, *ended).holds;
    });
    for (const double value : group.search.tried) group.tried.push_back(at(variant, value));
    if (group.search.wanted.empty() && group.search.complaint.empty()) {
      const Case& one = at(variant, group.search.fails);
      group.failing = judgement(variant, one, *outcome(case_files(folder_, one.name), one.text));
    }
    return group;
  }

  [[nodiscard]] const Case& at(const Variant& variant, double value) {
    Variant whole = variant;
    whole.settings.push_back({study_.border->key, *toml_text(value), value, study_.border->where});
    const std::string key = describe({"", "", whole.settings, ""}) + "\n" + whole.series;
    auto found = cases_.find(key);
    if (found == cases_.end()) found = cases_.emplace(key, cases_of(study_, scene_text_, {whole}).front()).first;
    return found->second;
  }

private:
  Judgement judgement(const Variant& variant, const Case& one, const Outcome& ended) {
    const auto known = judged_.find(one.name);
    if (known != judged_.end()) return known->second;
    const fs::path holds_results = case_files(folder_, at(variant, study_.border->holds).name).results;
    // Until the case at that end is done nothing can be compared with it, nor is there a border.
    const bool comparable = !needs_holds_end(*study_.border) || fs::exists(holds_results / file_name::summary);
    if (!comparable && ended.exit_code == 0) return {};
    return judged_[one.name] = judge(study_, ended, case_files(folder_, one.name).results, holds_results);
  }

  const Study& study_;
  fs::path folder_;
  std::string scene_text_;
  std::vector<Variant> variants_;
  std::map<std::string, Case> cases_;
  std::map<std::string, Judgement> judged_;  // by the case's name, once it has ended: they need not be read again
};

// Wrong input and trouble with files are not what the method fails by.
void stop_at_trouble(const Case& one, const Outcome& ended) {
  const std::string line = fmt::format("{}: {}", describe(one), ended.error);
  if (ended.exit_code == static_cast<int>(ExitCode::input)) throw InputError(line);
  if (ended.exit_code == static_cast<int>(ExitCode::files)) throw FileError(line);
}

}  // namespace

std::vector<Case> border_ends(const Study& study) {
  std::vector<Variant> ends;
  for (const Variant& variant : combinations(study)) {
    for (const double value : {study.border->holds, study.border->fails}) {
      ends.push_back(variant);
      ends.back().settings.push_back({study.border->key, *toml_text(value), value, study.border->where});
    }
  }
  return cases_of(study, read_text_file(scene_path(study)), ends);
}

int run_borders(const Study& study, const fs::path& study_folder, const RunOptions& options) {
  Borders borders(study, study_folder);
  std::set<std::string> given;
  const auto known = [&](const Case& one, const Outcome& ended) {
    const bool new_here = given.contains(one.name);
    if (new_here || ended.exit_code == static_cast<int>(ExitCode::input)) stop_at_trouble(one, ended);
    const bool again = ended.exit_code == static_cast<int>(ExitCode::files) || (options.retry && ended.exit_code != 0);
    return new_here || !again;
  };
  const Wanted wanted = [&] {
    std::vector<Case> all;
    for (const Variant& variant : borders.variants())
      for (const double value : borders.search(variant, known).search.wanted) {
        const Case& one = borders.at(variant, value);
        if (!given.insert(one.name).second) continue;
        fs::remove(case_files(study_folder, one.name).exit);  // how it ended before counts no more
        all.push_back(one);
      }
    return all;
  };
  return run_wanted(wanted, study_folder, options);
}

std::vector<BorderGroup> find_borders(const Study& study, const fs::path& study_folder) {
  Borders borders(study, study_folder);
  const auto known = [](const Case&, const Outcome& ended) {
    return ended.exit_code != static_cast<int>(ExitCode::input) && ended.exit_code != static_cast<int>(ExitCode::files);
  };
  std::vector<BorderGroup> groups;
  for (const Variant& variant : borders.variants()) groups.push_back(borders.search(variant, known));
  return groups;
}

}  // namespace weaveform::study
