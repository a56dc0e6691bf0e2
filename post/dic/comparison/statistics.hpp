// Numbers of a comparison over all points and over zones.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "post/dic/comparison/stage.hpp"

namespace weaveform::dic {

// Parts of the flat blank: A, B and C of a bias extension, then the boxes of the settings. A point may lie in several.
struct Zones {
  std::vector<std::string> name;
  std::vector<std::vector<int>> point;  // of each zone
};
[[nodiscard]] Zones zones_of_points(const Scene& scene, const std::vector<ZoneSpec>& boxes,
                                    const std::vector<Vec2>& points);

inline constexpr std::array<double, 5> percentiles = {5.0, 25.0, 50.0, 75.0, 95.0};

struct FieldStatistics {
  std::string name;
  int points = 0;
  double measured = 0.0, levelled = 0.0, raw = 0.0;        // rad; means
  double mean = 0.0, rms = 0.0, sd = 0.0;                  // rad; of the difference
  double greatest = 0.0;                                   // rad; difference largest in size, with its sign
  Vec2 greatest_at = {0.0, 0.0};                           // mm; where
  std::array<double, percentiles.size()> percentile = {};  // rad; of the difference
  double noise = 0.0;       // rad; rms of the points' standard uncertainties: what the difference is if nothing differs
  double mean_noise = 0.0;  // rad; standard uncertainty of `mean`, neighbouring windows sharing their points
  double within = 0.0;      // 1; part of the points that agree within `coverage` standard uncertainties
  double correlation = 0.0;  // 1; of measured and levelled (Pearson)
  double slope = 0.0;        // 1; of measured over levelled, least squares
};

// Over these points (those with a difference count).
[[nodiscard]] FieldStatistics field_statistics(const std::string& name, const StageFields& fields,
                                               const std::vector<int>& points, double coverage,
                                               const YarnDirections& yarns);

// The whole field agrees when the difference is at the noise's level: rms at most 1.25 times the noise and no zone's
// mean further off than 4 of its standard uncertainties.
struct Verdict {
  bool agrees = false;
  std::string words;
};
[[nodiscard]] Verdict judge(const FieldStatistics& all, const std::vector<FieldStatistics>& zones);

}  // namespace weaveform::dic
