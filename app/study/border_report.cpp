#include "app/study/border_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "app/study/table.hpp"
#include "core/json/toml_json.hpp"

namespace weaveform::study {

namespace {

std::vector<std::string> group_keys(const Study& study) {
  std::vector<std::string> keys = varied_keys(study);
  keys.pop_back();  // the bisected one
  return keys;
}

const Setting* setting_of(const Variant& variant, const std::string& key) {
  for (const Setting& setting : variant.settings)
    if (setting.key == key) return &setting;
  return nullptr;
}

std::string value_in(const BorderGroup& group, const std::string& key) {
  const Setting* setting = setting_of(group.variant, key);
  return setting != nullptr ? plain_value(setting->value) : "";
}

std::string complaint_of(const BorderGroup& group) {
  return group.search.wanted.empty() ? group.search.complaint : "not run to the end";
}

// The varied key with two values or more, all of them numbers; "" when there is none or several.
std::string numeric_key(const Study& study, const std::vector<BorderGroup>& groups) {
  std::string found;
  for (const std::string& key : group_keys(study)) {
    std::set<double> values;
    bool numbers = true;
    for (const BorderGroup& group : groups) {
      const Setting* setting = setting_of(group.variant, key);
      numbers = numbers && setting != nullptr && setting->number.has_value();
      if (numbers) values.insert(*setting->number);
    }
    if (!numbers || values.size() < 2) continue;
    if (!found.empty()) return "";
    found = key;
  }
  return found;
}

std::string label_without(const BorderGroup& group, const std::string& key) {
  std::string label = group.variant.series;
  for (const Setting& setting : group.variant.settings) {
    if (setting.key == key) continue;
    label += fmt::format("{}{}", label.empty() ? "" : ", ", plain_value(setting.value));
  }
  return label.empty() ? "border" : label;
}

struct BorderPoint {
  double x, holds, fails, between;
};

AxisScale scale_of(double least, double greatest) {
  return least > 0.0 && greatest >= 10.0 * least ? AxisScale::logarithmic : AxisScale::linear;
}

void set_scales(Chart& chart, const std::map<std::string, std::vector<BorderPoint>>& series) {
  std::vector<double> x, y;
  for (const auto& [label, points] : series)
    for (const BorderPoint& point : points) {
      x.push_back(point.x);
      y.insert(y.end(), {point.holds, point.fails});
    }
  const auto [x_least, x_most] = std::minmax_element(x.begin(), x.end());
  const auto [y_least, y_most] = std::minmax_element(y.begin(), y.end());
  chart.x.scale = scale_of(*x_least, *x_most);
  chart.y.scale = scale_of(*y_least, *y_most);
}

}  // namespace

bool border_is_found(const BorderGroup& group) {
  return group.search.wanted.empty() && group.search.complaint.empty();
}

std::string border_group_complaint(const BorderGroup& group) {
  const std::string which = group.variant.settings.empty() ? "" : describe({"", "", group.variant.settings, ""}) + ": ";
  return which + complaint_of(group);
}

std::string border_csv(const Study& study, const std::vector<BorderGroup>& groups) {
  const std::vector<std::string> keys = group_keys(study);
  std::string text;
  for (const std::string& key : keys) text += csv_field(key) + ",";
  text += "key,holds,fails,failure,caught,cases,complaint\n";
  for (const BorderGroup& group : groups) {
    for (const std::string& key : keys) text += csv_field(value_in(group, key)) + ",";
    const bool found = border_is_found(group);
    text += csv_field(study.border->key);
    add_field(text, found ? csv_number(group.search.holds) : "");
    add_field(text, found ? csv_number(group.search.fails) : "");
    add_field(text, csv_field(group.failing.reason));
    add_field(text, found ? group.failing.caught : "");
    add_field(text, std::to_string(group.tried.size() - group.search.wanted.size()));
    add_field(text, csv_field(complaint_of(group)));
    text += "\n";
  }
  return text;
}

std::string border_markdown(const Study& study, const std::vector<BorderGroup>& groups) {
  const std::vector<std::string> keys = group_keys(study);
  std::string text = fmt::format("Border over {}\n\n|", study.border->key), rule = "|";
  for (const std::string& key : keys) {
    text += fmt::format(" {} |", key);
    rule += "---:|";
  }
  text += " holds | fails | how it failed | caught |\n" + rule + "---:|---:|---|---|\n";
  for (const BorderGroup& group : groups) {
    text += "|";
    for (const std::string& key : keys) text += fmt::format(" {} |", value_in(group, key));
    if (border_is_found(group))
      text += fmt::format(" {:g} | {:g} | {} | {} |\n", group.search.holds, group.search.fails, group.failing.reason,
                          group.failing.caught);
    else
      text += fmt::format(" | | {} | |\n", complaint_of(group));
  }
  return text;
}

nlohmann::ordered_json border_json(const Study& study, const std::vector<BorderGroup>& groups) {
  using Json = nlohmann::ordered_json;
  Json json = {{"key", study.border->key}, {"groups", Json::array()}};
  for (const BorderGroup& group : groups) {
    Json settings = Json::object();
    for (const Setting& setting : group.variant.settings) settings[setting.key] = toml_value_json(setting.value);
    const bool found = border_is_found(group);
    json["groups"].push_back({{"settings", settings},
                              {"holds", found ? Json(group.search.holds) : Json(nullptr)},
                              {"fails", found ? Json(group.search.fails) : Json(nullptr)},
                              {"failure", group.failing.reason},
                              {"caught", found ? Json(group.failing.caught) : Json(nullptr)},
                              {"cases", group.tried.size() - group.search.wanted.size()},
                              {"complaint", complaint_of(group)}});
  }
  return json;
}

std::optional<Chart> border_chart(const Study& study, const std::vector<BorderGroup>& groups) {
  const std::string key = numeric_key(study, groups);
  std::map<std::string, std::vector<BorderPoint>> series;
  for (const BorderGroup& group : groups) {
    if (key.empty() || !border_is_found(group)) continue;
    const auto& [holds, fails] = std::pair(group.search.holds, group.search.fails);
    series[label_without(group, key)].push_back(
        {*setting_of(group.variant, key)->number, holds, fails, border_between(*study.border, holds, fails)});
  }
  if (series.empty()) return std::nullopt;
  Chart chart;
  chart.title = "Border over " + study.border->key;
  chart.x.title = key;
  chart.y.title = study.border->key;
  set_scales(chart, series);
  for (auto& [label, points] : series) {
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
    const int colour = static_cast<int>(chart.series.size());
    ChartSeries line{.label = label, .colour = colour};
    ChartBand band{.colour = colour};
    for (const BorderPoint& point : points) {
      line.x.push_back(point.x);
      line.y.push_back(point.between);
      band.x.push_back(point.x);
      band.low.push_back(std::min(point.holds, point.fails));
      band.high.push_back(std::max(point.holds, point.fails));
    }
    chart.series.push_back(line);
    chart.bands.push_back(band);
  }
  return chart;
}

}  // namespace weaveform::study
