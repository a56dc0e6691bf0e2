#include "app/study/references.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "core/keys/nearest_name.hpp"

namespace weaveform::study {

namespace {

using References = std::vector<std::optional<Reference>>;

bool fits(const Case& one, const Variant& pick) {
  const auto has = [&](const Setting& wanted) {
    const Setting* setting = setting_of(one, wanted.key);
    if (setting == nullptr) return false;
    return setting->number && wanted.number ? *setting->number == *wanted.number : setting->value == wanted.value;
  };
  return (pick.series.empty() || pick.series == one.series) &&
         std::all_of(pick.settings.begin(), pick.settings.end(), has);
}

[[noreturn]] void complain(const Study& study, const Variant& pick, const std::string& what) {
  Complaints complaints(study.file.string());
  complaints.add(pick.settings.empty() ? study.work_precision_at : pick.settings.front().where, what);
  complaints.throw_if_any();
  throw InputError(what);
}

const ReferenceValue* value_of(const std::vector<ReferenceValue>& values, const std::string& measure) {
  const auto found =
      std::find_if(values.begin(), values.end(), [&](const auto& one) { return one.measure == measure; });
  return found == values.end() ? nullptr : &*found;
}

double uncertainty_of(const Study& study, const std::string& measure) {
  const ReferenceValue* given = value_of(study.reference.uncertainty, measure);
  return given != nullptr ? *given->number : 0.0;
}

// The one case that fits [work_precision.case].
std::size_t reference_row(const Study& study, const Table& table) {
  const Variant& pick = study.reference.reference_case;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < table.row.size(); ++i)
    if (fits(table.row[i].one, pick)) found.push_back(i);
  const auto other_case = [&](std::size_t i) { return table.row[i].one.name != table.row[found[0]].one.name; };
  if (found.empty() || std::any_of(found.begin(), found.end(), other_case))
    complain(
        study, pick,
        fmt::format("[work_precision.case] picks {} cases; give the varied keys so that it picks one", found.size()));
  if (!is_done(table.row[found[0]]))
    complain(study, pick, "[work_precision.case] picks a case that is not done; choose another, see study.csv");
  return found[0];
}

References to_case(const Study& study, const std::string& measure, const Table& table) {
  References all(table.row.size());
  const Row& row = table.row[reference_row(study, table)];
  const Reference reference{row.value[column_of(table, measure)], uncertainty_of(study, measure)};
  for (std::size_t i = 0; i < all.size(); ++i)
    if (table.row[i].one.name != row.one.name && is_done(table.row[i])) all[i] = reference;
  return all;
}

References to_values(const Study& study, const std::string& measure, const Table& table) {
  References all(table.row.size());
  const ReferenceValue* given = value_of(study.reference.value, measure);
  for (std::size_t i = 0; given != nullptr && i < all.size(); ++i) {
    if (!is_done(table.row[i])) continue;
    const double value = given->number ? *given->number : table.row[i].value[column_of(table, given->other)];
    all[i] = Reference{value, uncertainty_of(study, measure)};
  }
  return all;
}

// What is known of a group's limit, and what is to be said about it.
std::optional<Reference> limit_of(const ConvergenceOf& group, std::vector<std::string>& complaints) {
  const std::string begin =
      fmt::format("work precision of {}{}{}: ", group.measure, group.group.empty() ? "" : " ", group.group);
  if (!group.refinement) {
    complaints.push_back(begin + "no limit to compare with (fewer than three levels)");
    return std::nullopt;
  }
  const Refinement& found = *group.refinement;
  const Trend trend = found.finest.trend;
  if (found.checked ? !found.agreed : trend != Trend::monotone && trend != Trend::unchanging)
    complaints.push_back(begin + fmt::format("{}; {:.6g} stands for the limit, uncertain by {:.3g}",
                                             found.checked ? "the levels do not agree on a limit" : trend_words(trend),
                                             found.limit, found.uncertainty));
  return Reference{found.limit, found.uncertainty};
}

References to_own_limits(const std::string& key, const std::string& measure,
                         const std::vector<ConvergenceOf>& convergence, const Table& table,
                         std::vector<std::string>& complaints) {
  References all(table.row.size());
  std::set<std::string> refined;
  for (const ConvergenceOf& group : convergence) {
    if (group.measure != measure) continue;
    refined.insert(group.group);
    const auto reference = limit_of(group, complaints);
    for (const LevelRow& level : group.level) all[level.row] = reference;
  }
  const auto alone = std::count_if(table.row.begin(), table.row.end(), [&](const Row& row) {
    return is_done(row) && !refined.contains(group_of(row.one, key));
  });
  if (alone > 0)
    complaints.push_back(
        fmt::format("work precision of {}: {} cases are in no refinement series and have no limit of "
                    "their own; [work_precision.limit_of] judges them by that of a series",
                    measure, alone));
  return all;
}

References to_limit_of(const Study& study, const std::string& measure, const std::vector<ConvergenceOf>& convergence,
                       const Table& table, std::vector<std::string>& complaints) {
  const Variant& pick = *study.reference.limit_of;
  std::vector<const ConvergenceOf*> found;
  for (const ConvergenceOf& group : convergence) {
    // Single cases beside a refinement series are groups too, of one level.
    if (group.measure == measure && group.refinement && fits(table.row[group.level.front().row].one, pick))
      found.push_back(&group);
  }
  if (found.size() != 1)
    complain(study, pick,
             fmt::format("[work_precision.limit_of] picks {} convergence groups of three levels or more; give the "
                         "varied keys so that it picks one",
                         found.size()));
  References all(table.row.size());
  const auto reference = limit_of(*found.front(), complaints);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (is_done(table.row[i])) all[i] = reference;
  return all;
}

}  // namespace

std::vector<std::optional<Reference>> references(const Study& study, const std::string& measure,
                                                 const std::vector<ConvergenceOf>& convergence, const Table& table,
                                                 std::vector<std::string>& complaints) {
  if (study.work_precision->reference == ErrorReference::one_case) return to_case(study, measure, table);
  if (study.work_precision->reference == ErrorReference::value) return to_values(study, measure, table);
  if (study.reference.limit_of) return to_limit_of(study, measure, convergence, table, complaints);
  return to_own_limits(study.convergence->key, measure, convergence, table, complaints);
}

void check_reference_measures(const Study& study, const std::vector<std::string>& charted) {
  Complaints complaints(study.file.string());
  const auto check = [&](const std::string& measure, const toml::source_region& where, const char* table) {
    if (std::find(charted.begin(), charted.end(), measure) == charted.end())
      complaints.add(where, fmt::format("{}: '{}' is not charted{}", table, measure, did_you_mean(measure, charted)));
  };
  for (const auto& value : study.reference.value) check(value.measure, value.where, "[work_precision.value]");
  for (const auto& value : study.reference.uncertainty)
    check(value.measure, value.where, "[work_precision.uncertainty]");
  for (const std::string& measure : study.work_precision->absolute)
    check(measure, study.work_precision_at, "[work_precision] absolute");
  if (study.work_precision->reference == ErrorReference::value)
    for (const std::string& measure : charted)
      if (value_of(study.reference.value, measure) == nullptr)
        complaints.add(study.work_precision_at,
                       fmt::format("[work_precision.value] does not say what '{}' should be; add it, or list the "
                                   "measures to be charted",
                                   measure));
  complaints.throw_if_any();
}

}  // namespace weaveform::study
