#include "solver/ply/energy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace weaveform {
namespace {

constexpr double table_end = 4.0;          // log shear strain; 87.9 deg
constexpr double table_step = 1.0 / 2048;  // Hermite error of order step^4/384 * w'''' : below 1e-12 of w

// Four-point Gauss rule on [-1, 1] (Abramowitz & Stegun 1964, table 25.4).
constexpr std::array<double, 4> gauss_point = {-0.861136311594053, -0.339981043584856, 0.339981043584856,
                                               0.861136311594053};
constexpr std::array<double, 4> gauss_weight = {0.347854845137454, 0.652145154862546, 0.652145154862546,
                                                0.347854845137454};

template <class Function>
double integrate(double from, double to, int intervals, const Function& function) {
  double sum = 0.0;
  const double width = (to - from) / intervals;
  for (int n = 0; n < intervals; ++n)
    for (int g = 0; g < 4; ++g)
      sum += 0.5 * width * gauss_weight[g] * function(from + width * (n + 0.5 * (1.0 + gauss_point[g])));
  return sum;
}

// mJ per reference volume of a yarn at true strain e. With a constant section the integrand s exp(e) is smooth between
// the joints of the law, so each piece is integrated by itself.
double yarn_energy(const TangentLaw& law, double strain, bool constant_section) {
  if (!constant_section) return law.energy(strain);
  const auto integrand = [&](double e) { return law.stress(e) * std::exp(e); };
  const double end = std::max(strain, 0.0);
  double energy = 0.0, from = std::min(strain, 0.0);
  const auto integrate_to = [&](double joint) {
    const double to = std::min(joint, end);
    if (to <= from) return;
    energy += integrate(from, to, 4, integrand);
    from = to;
  };
  integrate_to(law.pieces().front().from);
  for (const auto& piece : law.pieces()) integrate_to(piece.to);
  integrate_to(end);
  return strain < 0.0 ? -energy : energy;
}

}  // namespace

ShearPotential::ShearPotential(const ShearCard& card, bool constant_thickness)
    : card_(card), constant_thickness_(constant_thickness) {
  const int count = static_cast<int>(table_end / table_step) + 1;
  value_.assign(count, 0.0);
  for (int n = 0; n < count; ++n) slope_.push_back(slope(n * table_step));
  for (int n = 1; n < count; ++n)
    value_[n] =
        value_[n - 1] + integrate((n - 1) * table_step, n * table_step, 1, [this](double g) { return slope(g); });
}

double ShearPotential::slope(double log_strain) const {
  // d(sin gamma)/d(gamma_L) = 1 - tanh^2 = cos^2 gamma
  const double s = std::tanh(log_strain);
  const double cosine_squared = 1.0 - s * s;
  return shear_stress(card_, log_strain) * cosine_squared * (constant_thickness_ ? std::sqrt(cosine_squared) : 1.0);
}

double ShearPotential::operator()(double sin_gamma) const {
  if (std::isnan(sin_gamma)) return sin_gamma;  // an unstable run: the balance says so, no table does
  const double log_strain = std::min(std::atanh(std::min(std::abs(sin_gamma), 1.0 - 1e-12)), table_end - 1e-9);
  const int n = std::min(static_cast<int>(log_strain / table_step), static_cast<int>(value_.size()) - 2);
  const double t = log_strain / table_step - n;
  const double slope0 = slope_[n] * table_step, slope1 = slope_[n + 1] * table_step;
  const double rise = value_[n + 1] - value_[n];
  // cubic Hermite through both values and slopes
  return value_[n] + t * (slope0 + t * ((3.0 * rise - 2.0 * slope0 - slope1) + t * (slope0 + slope1 - 2.0 * rise)));
}

InternalEnergy::InternalEnergy(const Mesh& mesh, const Card& card, const std::array<TangentLaw, 2>& yarn_laws,
                               const ModelSpec& model)
    : mesh_(mesh),
      card_(card),
      yarn_laws_(yarn_laws),
      model_(model),
      potential_(card.shear, model.thickness == Thickness::constant) {}

double InternalEnergy::of_yarns(const std::vector<Vec3>& position) const {
  const MeshYarns& yarns = mesh_.yarns;
  const bool constant_section = model_.section == Section::constant;
  double energy = 0.0;
  for (int e = 0; e < mesh_.yarn_count(); ++e) {
    const auto [a, b] = yarns.node[e];
    const double jaw = yarns.jaw[e], rest = yarns.rest_length[e] + jaw;
    const double strain = std::log((plain_length(minus(position[b], position[a])) + jaw) / rest);
    const TangentLaw& law = yarn_laws_[yarns.family[e] == Family::warp ? 0 : 1];
    energy += yarns.section[e] * yarns.softening[e] * rest * yarn_energy(law, strain, constant_section);
  }
  return energy;
}

double InternalEnergy::of_cells(const std::vector<Vec3>& position) {
  const MeshCells& cells = mesh_.cells;
  const bool path_needed = model_.formulation == Formulation::contravariant;
  const bool first_call = path_.stress.empty();
  if (path_needed && first_call) {
    path_.stress.assign(cells.size(), 0.0);
    path_.log_stretch.assign(cells.size(), 0.0);
  }
  double energy = 0.0;
  for (int c = 0; c < cells.size(); ++c) {
    Vec3 g1{}, g2{};
    for (int a = cells.offset[c]; a < cells.offset[c + 1]; ++a)
      for (int k = 0; k < 3; ++k) {
        g1[k] += cells.coefficient[a][0] * position[cells.node[a]][k];
        g2[k] += cells.coefficient[a][1] * position[cells.node[a]][k];
      }
    const double stretch = std::sqrt(dot(g1, g1) * dot(g2, g2));  // |g1||g2|
    const double s = dot(g1, g2) / stretch;
    const double volume = cells.area[c] * mesh_.thickness;
    energy += volume * potential_(s);
    if (!path_needed) continue;
    const double thinning = model_.thickness == Thickness::constant ? std::sqrt(std::max(0.0, 1.0 - s * s)) : 1.0;
    const double stress =
        volume * thinning * shear_stress(card_.shear, std::atanh(std::clamp(s, -1.0 + 1e-12, 1.0 - 1e-12))) * s;
    const double log_stretch = std::log(stretch);
    if (!first_call) path_.work += 0.5 * (stress + path_.stress[c]) * (log_stretch - path_.log_stretch[c]);
    path_.stress[c] = stress;
    path_.log_stretch[c] = log_stretch;
  }
  return energy;
}

double InternalEnergy::operator()(const std::vector<Vec3>& position, double cell_work) {
  const double of_all_yarns = of_yarns(position);
  if (model_.formulation == Formulation::incremental || model_.formulation == Formulation::side_frame)
    return of_all_yarns + cell_work;
  return of_all_yarns + of_cells(position) + path_.work;
}

void InternalEnergy::archive(Archive& archive) {
  if (model_.formulation != Formulation::contravariant) return;
  const auto cells = static_cast<std::size_t>(mesh_.cells.size());
  archive.number("a cell's work", path_.work);
  const std::size_t kept = archive.length("cell stresses", path_.stress.size(), 0, cells);
  if (kept != 0 && kept != cells) throw DamagedState{"a path of other cells"};
  for (auto* values : {&path_.stress, &path_.log_stretch}) {
    values->resize(kept);
    archive.numbers("a cell's path", *values);
  }
}

}  // namespace weaveform
