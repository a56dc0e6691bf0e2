#include "fabric/identify/curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "fabric/identify/raw_table.hpp"
#include "fabric/identify/statistics.hpp"

namespace weaveform::identify {
namespace {

constexpr std::size_t least_points = 8;   // below, neither a slope nor its scatter can be told
constexpr double most_missing = 0.5;      // share of rows
constexpr double break_drop = 0.10;       // of the greatest load: more than noise, less than any broken yarn
constexpr double most_steps_back = 0.05;  // share of the steps up to the greatest load: noise about the start
constexpr double jump_steps = 10.0, jump_share = 0.05;  // of the usual step, of the range: what only a break does
constexpr double loop_scatter = 0.10;    // of the greatest load, median between neighbours in displacement
constexpr double negative_share = 0.05;  // of the greatest magnitude: an offset, not another sign

void keep_rows(Curve& curve, const std::vector<bool>& kept) {
  std::size_t end = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) continue;
    curve.x[end] = curve.x[i];
    curve.y[end++] = curve.y[i];
  }
  curve.x.resize(end);
  curve.y.resize(end);
}

void drop_missing(Curve& curve) {
  std::vector<bool> kept(curve.x.size());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]);
  const auto missing = std::count(kept.begin(), kept.end(), false);
  if (missing == 0) return;
  if (static_cast<double>(missing) > most_missing * static_cast<double>(kept.size()))
    throw InputError(
        fmt::format("{}: {} of {} rows have no value in one of the two columns; choose other columns or "
                    "another file",
                    curve.specimen, missing, kept.size()));
  keep_rows(curve, kept);
  curve.notes.push_back(fmt::format("{} rows without a value left out", missing));
}

// After a break the extensometer jumps, and its rows, once sorted, lie among those of the loading: so they go first,
// while the rows are in the order of recording. A jump tells the break from unloading, which is as steady as the
// loading.
void cut_recorded_break(Curve& curve, const Channel& x, const Channel& y) {
  const auto peak = static_cast<std::size_t>(std::max_element(curve.y.begin(), curve.y.end()) - curve.y.begin());
  if (peak < 2 || !(curve.y[peak] > 0.0)) return;
  std::vector<double> steps;
  for (std::size_t i = 1; i <= peak; ++i) steps.push_back(curve.x[i] - curve.x[i - 1]);
  const auto back = std::count_if(steps.begin(), steps.end(), [](double step) { return step < 0.0; });
  if (static_cast<double>(back) > most_steps_back * static_cast<double>(steps.size())) return;  // not in that order
  for (double& step : steps) step = std::abs(step);
  const double jump = std::max(jump_steps * median_of(steps), jump_share * std::abs(curve.x[peak] - curve.x.front()));
  std::size_t fallen = peak + 1;
  while (fallen < curve.y.size() && curve.y[fallen] >= (1.0 - break_drop) * curve.y[peak]) ++fallen;
  if (fallen == curve.y.size()) return;
  bool jumps = false;
  for (std::size_t i = peak + 1; i < curve.x.size(); ++i) jumps = jumps || std::abs(curve.x[i] - curve.x[i - 1]) > jump;
  if (!jumps) return;
  curve.notes.push_back(
      fmt::format("the {} falls from {:.4g} to {:.4g} and the {} jumps, as of a specimen that broke; the {} rows after "
                  "the greatest {} cut off",
                  y.name, curve.y[peak], curve.y[fallen], x.name, curve.x.size() - peak - 1, y.name));
  curve.x.resize(peak + 1);
  curve.y.resize(peak + 1);
}

void sort_rows(Curve& curve, const Channel& x) {
  if (std::is_sorted(curve.x.begin(), curve.x.end())) return;
  std::vector<std::size_t> order(curve.x.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return curve.x[a] < curve.x[b]; });
  Curve sorted = curve;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted.x[i] = curve.x[order[i]];
    sorted.y[i] = curve.y[order[i]];
  }
  curve = std::move(sorted);
  curve.notes.push_back(fmt::format("rows were not in rising order of the {}; sorted", x.name));
}

// Loading and unloading of one cycle, sorted by displacement, alternate between two branches; so do shuffled columns.
void refuse_loops(const Curve& curve, const Channel& x, const Channel& y) {
  std::vector<double> jumps;
  for (std::size_t i = 1; i < curve.y.size(); ++i) jumps.push_back(std::abs(curve.y[i] - curve.y[i - 1]));
  const double greatest = *std::max_element(curve.y.begin(), curve.y.end());
  const double typical = median_of(jumps);
  // A curve of few points may rise steeply from one to the next: count only what a monotone curve could not do.
  const double rise = greatest / static_cast<double>(jumps.size());
  if (typical > loop_scatter * greatest && typical > 3.0 * rise)
    throw InputError(
        fmt::format("{}: the {} jumps by {:.3g} between neighbouring values of the {}; is it a cyclic "
                    "test, or does one file hold several specimens? keep one loading, or name "
                    "'specimen_column'",
                    curve.specimen, y.name, typical, x.name));
}

void merge_equal(Curve& curve, const Channel& x) {
  Curve merged = curve;
  merged.x.clear();
  merged.y.clear();
  for (std::size_t i = 0; i < curve.x.size();) {
    std::size_t end = i;
    double sum = 0.0;
    while (end < curve.x.size() && curve.x[end] == curve.x[i]) sum += curve.y[end++];
    merged.x.push_back(curve.x[i]);
    merged.y.push_back(sum / static_cast<double>(end - i));
    i = end;
  }
  if (merged.x.size() < curve.x.size())
    merged.notes.push_back(fmt::format("{} rows repeat a {}; averaged", curve.x.size() - merged.x.size(), x.name));
  curve = std::move(merged);
}

void refuse_negative(const Curve& curve, const std::vector<double>& values, const Channel& channel) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  if (*least >= 0.0 || -*least <= negative_share * std::max(*greatest, -*least)) return;
  if (-*least > *greatest)
    throw InputError(
        fmt::format("{}: the {} is negative, down to {:.4g}; does the machine count the other way? then "
                    "say {}_factor = -1",
                    curve.specimen, channel.name, *least, channel.name));
  throw InputError(
      fmt::format("{}: the {} falls to {:.4g} while its greatest is {:.4g}; zero the channel or cut these "
                  "rows",
                  curve.specimen, channel.name, *least, *greatest));
}

void drop_before_start(Curve& curve, const Channel& x) {
  std::vector<bool> kept(curve.x.size());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = curve.x[i] >= 0.0;
  const auto before = std::count(kept.begin(), kept.end(), false);
  if (before == 0) return;
  keep_rows(curve, kept);
  curve.notes.push_back(fmt::format("{} rows before zero {} left out", before, x.name));
}

void cut_after_break(Curve& curve, const Channel& x, const Channel& y) {
  const auto peak = std::max_element(curve.y.begin(), curve.y.end());
  const double lowest_after = *std::min_element(peak, curve.y.end());
  if (*peak - lowest_after <= break_drop * *peak) return;
  const auto kept = static_cast<std::size_t>(peak - curve.y.begin()) + 1;
  curve.notes.push_back(
      fmt::format("the {} falls from {:.4g} to {:.4g} after {} {:.4g}, as of a specimen that broke or "
                  "slipped; the {} rows after the greatest {} cut off",
                  y.name, *peak, lowest_after, x.name, curve.x[kept - 1], curve.x.size() - kept, y.name));
  curve.x.resize(kept);
  curve.y.resize(kept);
}

void refuse_few(const Curve& curve) {
  if (curve.x.size() >= least_points) return;
  throw InputError(fmt::format("{}: only {} usable points, at least {} are needed; record more", curve.specimen,
                               curve.x.size(), least_points));
}

// Quantities whose units are mistaken for each other.
std::vector<Quantity> alike(Quantity quantity) {
  if (quantity == Quantity::moment || quantity == Quantity::moment_per_length)
    return {Quantity::moment, Quantity::moment_per_length};
  return {quantity};
}

// A heading or a row of units that names another unit than the fit file does.
void check_unit(const RawTable& table, std::size_t column, const Channel& channel) {
  for (const auto* row : {&table.heading, &table.units}) {
    if (column >= row->size()) continue;
    // of moments, a heading may say that they are per width where the fit file says they are not, and the reverse
    std::optional<std::string> named;
    bool same = true;
    for (const Quantity quantity : alike(channel.quantity)) {
      const auto found = unit_in((*row)[column], quantity);
      if (!found || (named && found->size() <= named->size())) continue;
      named = found;
      same =
          quantity == channel.quantity && unit_factor(quantity, *found) == unit_factor(channel.quantity, channel.unit);
    }
    if (named && !same)
      throw InputError(
          fmt::format("{}: the file calls the {} '{}', but {}_unit is '{}'; which is right? say {}_unit = "
                      "\"{}\", or rename the column",
                      table.file, channel.name, (*row)[column], channel.name, channel.unit, channel.name, *named));
  }
}

std::vector<double> values_of(const RawTable& table, const Channel& channel) {
  const std::size_t column = column_of(table, channel.column, channel.name + "_column");
  check_unit(table, column, channel);
  std::vector<double> values = numbers_of(table, column);
  for (double& value : values) value *= unit_factor(channel.quantity, channel.unit) * channel.factor;
  return values;
}

// Curves of a file, in the order in which its specimens first appear.
std::vector<Curve> split_specimens(const RawTable& table, const TestSpec& test, const std::string& label,
                                   const std::vector<double>& x, const std::vector<double>& y) {
  if (test.specimen_column.empty()) return {Curve{label, x, y, table.notes}};
  const std::size_t column = column_of(table, test.specimen_column, "specimen_column");
  std::vector<Curve> curves;
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::string& name = table.cells[i][column];
    const auto [found, is_new] = place.emplace(name, curves.size());
    if (is_new) curves.push_back({fmt::format("{}, specimen {}", label, name), {}, {}, table.notes});
    curves[found->second].x.push_back(x[i]);
    curves[found->second].y.push_back(y[i]);
  }
  return curves;
}

}  // namespace

Curve prepared_curve(Curve raw, const Channel& x, const Channel& y) {
  drop_missing(raw);
  refuse_few(raw);
  cut_recorded_break(raw, x, y);
  refuse_few(raw);
  refuse_negative(raw, raw.x, x);
  refuse_negative(raw, raw.y, y);
  sort_rows(raw, x);
  refuse_loops(raw, x, y);
  merge_equal(raw, x);
  drop_before_start(raw, x);
  cut_after_break(raw, x, y);
  refuse_few(raw);
  if (!(*std::max_element(raw.y.begin(), raw.y.end()) > 0.0))
    throw InputError(fmt::format("{}: the {} never rises above zero; choose another column", raw.specimen, y.name));
  return raw;
}

void for_each_specimen(const TestSpec& test, const std::filesystem::path& fit_file, const Channel& x, const Channel& y,
                       const std::function<void(Curve raw, std::size_t file)>& use) {
  std::vector<std::string> complaints;
  const auto collect = [&](const auto& action) {
    try {
      action();
    } catch (const InputError& error) {
      complaints.insert(complaints.end(), error.complaints().begin(), error.complaints().end());
    }
  };
  for (std::size_t k = 0; k < test.files.size(); ++k) {
    collect([&] {
      const auto path = fit_file.parent_path() / test.files[k];
      const RawTable table =
          read_raw_table(read_text_file(path), path.string(), {test.delimiter, test.decimal, test.skip_lines});
      const auto x_values = values_of(table, x), y_values = values_of(table, y);
      for (auto& curve : split_specimens(table, test, path.string(), x_values, y_values))
        collect([&] { use(std::move(curve), k); });
    });
  }
  if (!complaints.empty()) throw InputError(complaints);
}

std::string name_beside(const std::string& specimen, const std::filesystem::path& fit_file) {
  const std::string folder = (fit_file.parent_path() / "").string();
  return !folder.empty() && specimen.starts_with(folder) ? specimen.substr(folder.size()) : specimen;
}

Curve complete_rows(Curve raw) {
  drop_missing(raw);
  refuse_few(raw);
  return raw;
}

std::vector<Curve> load_curves(const TestSpec& test, const std::filesystem::path& fit_file, const Channel& x,
                               const Channel& y) {
  std::vector<Curve> curves;
  for_each_specimen(test, fit_file, x, y,
                    [&](Curve raw, std::size_t /*file*/) { curves.push_back(prepared_curve(std::move(raw), x, y)); });
  for (auto& curve : curves) curve.specimen = name_beside(curve.specimen, fit_file);
  return curves;
}

Channel displacement_channel(const TestSpec& test) {
  return {Quantity::length, "displacement", test.displacement_column, test.displacement_unit, test.displacement_factor};
}

Channel force_channel(const TestSpec& test) {
  return {Quantity::force, "force", test.force_column, test.force_unit, test.force_factor};
}

}  // namespace weaveform::identify
