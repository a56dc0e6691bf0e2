// A study's table made up: cases whose order and limit are known.
#pragma once

#include <cmath>
#include <string>

#include "app/study/convergence_report.hpp"

namespace weaveform::study {

// f = limit + h^order at sizes 1, 2, 4, 8, costing 1/h^3 s.
inline void add_levels(Table& table, const std::string& law, double limit, double order) {
  for (const double h : {8.0, 4.0, 2.0, 1.0}) {
    Case one{
        law + std::to_string(static_cast<int>(h)),
        "",
        {{"model.yarn_law", law, std::nullopt, {}}, {"blank.coarsening", std::to_string(static_cast<int>(h)), h, {}}}};
    table.row.push_back({one, Outcome{0, ""}, {limit + std::pow(h, order)}, h, std::pow(h, -3.0)});
  }
}

// Rows 0 to 3: law "card", order 1, limit 100; rows 4 to 7: law "linear", order 2, limit 200.
inline Table two_laws() {
  Table table{{"model.yarn_law", "blank.coarsening"}, {"force"}, {}};
  add_levels(table, "card", 100.0, 1.0);
  add_levels(table, "linear", 200.0, 2.0);
  return table;
}

inline const ConvergenceSpec by_coarsening{.key = "blank.coarsening", .measures = {}};

}  // namespace weaveform::study
