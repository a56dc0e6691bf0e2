// The borders of a study for people and scripts: border.md, border.csv, border.svg.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/study/border_run.hpp"
#include "core/chart/chart.hpp"

namespace weaveform::study {

[[nodiscard]] bool border_is_found(const BorderGroup& group);

// "model.yarn=beam: no border between 0.9 and 3: ..."
[[nodiscard]] std::string border_group_complaint(const BorderGroup& group);

// A row for each group: its keys, `key`, `holds` and `fails` (the last values on either side; empty where there is no
// border), `failure` (how the nearest failing case failed), `caught` (whether that run itself said so: error, warning,
// no), `cases` run, `complaint` (why there is no border).
[[nodiscard]] std::string border_csv(const Study& study, const std::vector<BorderGroup>& groups);
[[nodiscard]] std::string border_markdown(const Study& study, const std::vector<BorderGroup>& groups);

// "key" and "groups", with the fields of border.csv; null where there is no border.
[[nodiscard]] nlohmann::ordered_json border_json(const Study& study, const std::vector<BorderGroup>& groups);

// The border over the one varied key that is numeric, from `holds` to `fails`, a series for each combination of the
// others; none when not exactly one key is numeric, or no border is found. Axes over more than a decade are
// logarithmic.
[[nodiscard]] std::optional<Chart> border_chart(const Study& study, const std::vector<BorderGroup>& groups);

}  // namespace weaveform::study
