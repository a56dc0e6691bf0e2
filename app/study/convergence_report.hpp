// What [convergence] of a study asks for: each measure over the refined key, apart for every combination of the others.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/study/table.hpp"
#include "post/convergence/convergence.hpp"

namespace weaveform::study {

struct LevelRow {
  std::size_t row = 0;  // of the table
  double size = 0.0;
};

struct ConvergenceOf {
  std::string group;  // "model.formulation=energy"; "" when nothing but the refined key varies
  std::string measure;
  std::vector<LevelRow> level;           // done cases, finest first, one for each size
  std::optional<Refinement> refinement;  // none with fewer than three levels
};

// Settings of the keys other than `key`, as text: cases of equal text differ in `key` alone.
[[nodiscard]] std::string group_of(const Case& one, const std::string& key);

// Of the groups that have the refined key at two values or more, in the order of the table.
[[nodiscard]] std::vector<ConvergenceOf> convergence_of(const ConvergenceSpec& spec,
                                                        const std::vector<std::string>& measures, const Table& table);

// For people (Markdown) and for scripts: convergence.md, convergence.csv.
[[nodiscard]] std::string convergence_markdown(const ConvergenceSpec& spec, const std::vector<ConvergenceOf>& all,
                                               const Table& table);
[[nodiscard]] std::string convergence_csv(const ConvergenceSpec& spec, const std::vector<ConvergenceOf>& all,
                                          const Table& table);

// For scripts that read one answer: "key" and "measures", each with its group, levels (finest first), "trend", "order",
// "limit", "limit_uncertainty", "agreed" and the "cheapest_case" within the "tolerance"; null where there are too few
// levels.
[[nodiscard]] nlohmann::ordered_json convergence_json(const ConvergenceSpec& spec,
                                                      const std::vector<ConvergenceOf>& all, const Table& table);

// "order 1.98; limit 9.01 within 0.02; ..." of one refinement, with how far it can be trusted.
[[nodiscard]] std::string verdict(const Refinement& refinement);

}  // namespace weaveform::study
