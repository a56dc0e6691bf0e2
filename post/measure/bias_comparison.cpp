#include "post/measure/bias_comparison.hpp"

#include <cmath>

#include "core/vector/angle.hpp"

namespace weaveform {

namespace {

constexpr int table_rows = 6;

// Travel of the grips apart at each history row: both may move, each counted out of the specimen.
std::vector<double> travel_apart(const BiasSpecimen& specimen, const History& history) {
  std::vector<double> travel(history.row.size(), 0.0);
  for (std::size_t g = 0; g < 2; ++g) {
    const std::vector<double> moved = history.values(specimen.grip[g] + ".displacement_mm");
    for (std::size_t r = 0; r < travel.size(); ++r) travel[r] += specimen.outward[g] * moved[r];
  }
  return travel;
}

// History rows nearest to even parts of the final travel, each once, the last one always.
std::vector<std::size_t> rows_to_show(const std::vector<double>& travel) {
  std::vector<std::size_t> shown;
  if (travel.empty()) return shown;
  for (int part = 1; part < table_rows; ++part) {
    const double wanted = travel.back() * part / table_rows;
    std::size_t nearest = 0;
    for (std::size_t r = 1; r < travel.size(); ++r)
      if (std::abs(travel[r] - wanted) < std::abs(travel[nearest] - wanted)) nearest = r;
    const bool new_row = shown.empty() ? nearest > 0 : nearest > shown.back();
    if (new_row && nearest + 1 < travel.size()) shown.push_back(nearest);
  }
  shown.push_back(travel.size() - 1);
  return shown;
}

// Yarns at +45 or at -45 deg give the same test with the angle's sign reversed.
double sign_of(const BiasZoneAngles& zones) {
  return zones.simulated[0].mean < 0.0 ? -1.0 : 1.0;
}

}  // namespace

BiasComparison compare_bias_extension(const BiasSpecimen& specimen, const Scene& scene,
                                      const std::vector<BiasPly>& plies, const History& history) {
  BiasComparison comparison;
  comparison.specimen = specimen;
  for (const BiasPly& ply : plies)
    comparison.zones.push_back(
        {angles_by_zone(ply.mesh.cells, zones_of_cells(ply.mesh, ply.scene.blank, specimen), ply.end.shear_angle), {}});

  const std::vector<double> travel = travel_apart(specimen, history);
  for (const std::size_t r : rows_to_show(travel)) {
    BiasRow row;
    row.travel = travel[r];
    row.ideal_angle = sign_of(comparison.zones.front()) * kinematic_shear_angle(specimen, travel[r]);
    for (const BiasPly& ply : plies)
      row.ideal_load +=
          inextensible_bias_load(specimen, ply.card.shear, ply.card.thickness, ply.scene.model.thickness, travel[r]);
    for (std::size_t g = 0; g < 2; ++g)
      row.load[g] = specimen.outward[g] * history.values(specimen.grip[g] + ".force_N")[r];
    for (const MeasureSpec& measure : scene.measure)
      row.measured_angle.push_back(degree * history.values(measure.name + ".shear_angle_deg")[r]);
    comparison.row.push_back(row);
  }
  const double angle = comparison.row.empty() ? 0.0 : kinematic_shear_angle(specimen, comparison.row.back().travel);
  for (BiasZoneAngles& zones : comparison.zones) {
    const double its = sign_of(zones) * angle;
    zones.ideal = {its, 0.5 * its, 0.0};
  }
  return comparison;
}

}  // namespace weaveform
