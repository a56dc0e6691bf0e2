// Whether wrinkles survive refinement: amplitude, wavelength, area and compressed fibre ("wrinkles" of summary.json) of
// the cases that differ in blank.coarsening alone, side by side, and from which coarsening on they agree within 10 %.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/study/table.hpp"

namespace weaveform::study {

// What is compared, in this order; a wavelength or amplitude that there is none of is not a number.
inline constexpr std::size_t wrinkle_measures = 4;
struct WrinkleMeasure {
  const char *name, *words;  // in "wrinkles" of summary.json; for people, with its unit
  double floor;              // differences are relative to the finest level's value, or to this where that is less
};
inline constexpr std::array<WrinkleMeasure, wrinkle_measures> wrinkle_measure = {
    {{"wavelength_mm", "wavelength, mm", 0.0},
     {"amplitude_mm", "amplitude, mm", 0.0},
     {"area_share", "area, 1", 0.01},
     {"compressed_fibre_share", "compressed fibre, 1", 0.01}}};

inline constexpr double wrinkles_agree = 0.1;  // 1; within

struct WrinkleLevel {
  std::size_t row = 0;  // of the table
  double size = 0.0;    // mm; the spacing of its mesh
  std::array<double, wrinkle_measures> value = {};
  double cells = 0.0;  // a wave
  std::string of;      // "fabric", "mesh", or "" without waves
};

struct WrinklesOf {
  std::string group;                // "model.cell=shell"; "" when nothing but the coarsening varies
  std::string ply;                  // of a stack
  std::vector<WrinkleLevel> level;  // done cases, finest first, one for each size; two or more
  // Per measure, the coarsest level that agrees with the finest as all between them do; 0: none but the finest.
  std::array<std::size_t, wrinkle_measures> agrees_from = {};
  [[nodiscard]] std::size_t all_agree_from() const;
};

// Of the groups in which any case has waves. Throws FileError, InputError (a damaged summary).
[[nodiscard]] std::vector<WrinklesOf> wrinkles_of(const Table& table, const std::filesystem::path& study_folder);

// For people (Markdown), and for scripts: wrinkles.md, wrinkles.csv, "wrinkles" of the study's JSON.
[[nodiscard]] std::string wrinkles_markdown(const std::vector<WrinklesOf>& all, const Table& table);
[[nodiscard]] std::string wrinkles_csv(const std::vector<WrinklesOf>& all, const Table& table);
[[nodiscard]] nlohmann::ordered_json wrinkles_json(const std::vector<WrinklesOf>& all, const Table& table);

}  // namespace weaveform::study
