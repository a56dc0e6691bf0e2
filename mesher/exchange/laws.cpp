#include "mesher/exchange/laws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weaveform::foreign {

namespace {

constexpr double shortest_strain = -0.69, longest_strain = 0.1;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

struct Tolerance {
  double relative = 0.0, absolute = 0.0;
};

using Law = std::function<double(double)>;

bool is_straight(const Law& f, const std::array<double, 2>& a, double to, const Tolerance& tolerance) {
  const double end = f(to);
  for (const double part : {0.25, 0.5, 0.75}) {
    const double value = f(a[0] + part * (to - a[0]));
    const double error = std::abs(value - (a[1] + part * (end - a[1])));
    if (error > std::max(tolerance.absolute, tolerance.relative * std::abs(value))) return false;
  }
  return true;
}

// Goes from point to point, each as far from the last as the chord between them stays close.
void march(const Law& f, double to, const Tolerance& tolerance, Points& points) {
  double step = to - points.back()[0];
  const double least = 1e-5 * step;
  while (points.back()[0] < to) {
    const double from = points.back()[0];
    step = std::min(1.5 * step, to - from);
    while (step > least && !is_straight(f, points.back(), from + step, tolerance)) step *= 0.8;
    const double next = to - (from + step) < 0.3 * step ? to : from + step;  // no sliver at the end
    points.push_back({next, f(next)});
  }
}

Points points_within(const Law& f, const std::vector<double>& knots, const Tolerance& tolerance) {
  Points points = {{knots.front(), f(knots.front())}};
  for (std::size_t k = 1; k < knots.size(); ++k) march(f, knots[k], tolerance, points);
  return points;
}

bool compresses(const ModelSpec& model) {
  return model.yarn != YarnElement::seatbelt || model.partner == SeatbeltPartner::compression;
}

double slack_of(const YarnCard& yarn, const ModelSpec& model) {
  if (model.yarn_law != YarnLaw::slack) return 0.0;
  return model.slack.value_or(std::log1p(yarn.crimp));
}

void add_corners(const TangentLaw& law, double sign, std::vector<double>& knots) {
  for (const auto& piece : law.pieces())
    for (const double end : {piece.from, piece.to})
      if (std::isfinite(end)) knots.push_back(sign * end);
}

// Sorted, within [low, high], with both ends and zero, none twice.
std::vector<double> tidy(std::vector<double> knots, double low, double high) {
  knots.insert(knots.end(), {low, 0.0, high});
  std::sort(knots.begin(), knots.end());
  std::vector<double> kept;
  for (const double knot : knots)
    if (knot >= low && knot <= high && (kept.empty() || knot - kept.back() > 1e-9)) kept.push_back(knot);
  return kept;
}

// The law's volume per flat volume, where the element of the other code keeps V0.
double volume_share(const Gathered& model, double sine) {
  return model.scene.model.thickness == Thickness::constant ? std::sqrt(std::max(0.0, 1.0 - sine * sine)) : 1.0;
}

}  // namespace

Points points_of(const Law& f, const std::vector<double>& knots, double absolute) {
  return points_within(f, knots, {table_error, absolute});
}

Points fitted_points(const Law& f, const std::vector<double>& knots, double absolute, std::size_t most) {
  Tolerance tolerance{table_error, absolute};
  Points points = points_within(f, knots, tolerance);
  while (points.size() > most) {
    tolerance = {1.2 * tolerance.relative, 1.2 * tolerance.absolute};
    points = points_within(f, knots, tolerance);
  }
  // The mean of f - line over each chord, by Simpson's rule, is taken out in equal parts at its two ends.
  Points fitted = points;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const double a = points[k][0], b = points[k + 1][0];
    double mean = 0.0;
    for (const double part : {0.25, 0.5, 0.75})
      mean += (part == 0.5 ? 2.0 : 4.0) / 12.0 *
              (f(a + part * (b - a)) - points[k][1] - part * (points[k + 1][1] - points[k][1]));
    const bool first_is_knot = std::find(knots.begin(), knots.end(), a) != knots.end();
    const bool last_is_knot = std::find(knots.begin(), knots.end(), b) != knots.end();
    if (!first_is_knot) fitted[k][1] += 0.5 * mean;
    if (!last_is_knot) fitted[k + 1][1] += 0.5 * mean;
  }
  return fitted;
}

double yarn_stress(const Gathered& model, std::size_t family, double strain) {
  const YarnCard& yarn = model.card.yarn[family];
  const ModelSpec& spec = model.scene.model;
  const double scale = spec.yarn_stiffness_scale;
  if (strain >= 0.0) {
    if (spec.yarn_law == YarnLaw::card) return scale * yarn.tension.stress(strain);
    return scale * yarn.linear_modulus * std::max(0.0, strain - slack_of(yarn, spec));
  }
  if (!compresses(spec)) return 0.0;
  if (spec.compression_modulus) return scale * *spec.compression_modulus * strain;
  if (yarn.compression.pieces().empty()) return scale * yarn.compression_modulus * strain;
  return -scale * yarn.compression.stress(-strain);
}

std::vector<double> yarn_knots(const Gathered& model, std::size_t family, double shortest) {
  const YarnCard& yarn = model.card.yarn[family];
  std::vector<double> knots = {slack_of(yarn, model.scene.model)};
  add_corners(yarn.tension, 1.0, knots);
  add_corners(yarn.compression, -1.0, knots);
  const double torn = std::isfinite(yarn.tearing_strain) ? 1.5 * yarn.tearing_strain : 0.0;
  return tidy(knots, shortest, std::max(longest_strain, torn));
}

double yarn_force_per_section(const Gathered& model, std::size_t family, double engineering_strain) {
  const double stress = yarn_stress(model, family, std::log1p(engineering_strain));
  return model.scene.model.section == Section::incompressible ? stress / (1.0 + engineering_strain) : stress;
}

double yarn_stiffness(const Gathered& model, std::size_t family) {
  const YarnCard& yarn = model.card.yarn[family];
  const double high = yarn_knots(model, family, 0.0).back();
  double stiffest = yarn.linear_modulus;
  if (model.scene.model.yarn_law == YarnLaw::card) stiffest = std::max(stiffest, yarn.tension.stiffest(0.0, high));
  return stiffest * model.scene.model.yarn_stiffness_scale;
}

Points yarn_points(const Gathered& model, std::size_t family) {
  std::vector<double> knots = yarn_knots(model, family, shortest_strain);
  for (double& knot : knots) knot = std::expm1(knot);
  const auto law = [&](double x) { return yarn_force_per_section(model, family, x); };
  return points_of(law, knots, 1e-11 * yarn_stiffness(model, family));
}

double fibre_modulus(const Gathered& model) {
  constexpr double share = 1e-3;
  return std::max(1e-6, share * std::abs(shear_tangent(model.card.shear, 0.0)));
}

HoldingSpring holding_spring(const Gathered& model) {
  const double spacing = std::min(model.mesh.spacing[0], model.mesh.spacing[1]);
  double stiffness = 0.0, square_of_step = 0.0;
  for (const auto& group : model.yarns) {
    const double modulus = yarn_stiffness(model, group.family);
    stiffness = std::max(stiffness, group.section * modulus / spacing);
    square_of_step = std::max(square_of_step, 4.0 * model.yarn_density(group.family) * spacing * spacing / modulus);
  }
  if (!model.members.empty())
    stiffness = std::max(stiffness, model.scene.frame->modulus * model.member_section() / model.scene.frame->length);
  return {stiffness, stiffness * square_of_step * model.scene.analysis.mass_scale};
}

double contact_stiffness(const Gathered& model) {
  constexpr double share = 0.05;
  double stiffest = 0.0;
  for (const auto& group : model.yarns)
    stiffest = std::max(stiffest, group.section * yarn_stiffness(model, group.family) /
                                      std::min(model.mesh.spacing[0], model.mesh.spacing[1]));
  return share * 4.0 * stiffest;
}

double tool_mass(const Gathered& model, const ToolMotion& motion) {
  if (motion.spec->mass) return *motion.spec->mass;
  double mass = 0.0;
  for (const double m : model.mesh.nodes.mass) mass += m;
  return mass * model.scene.analysis.mass_scale;
}

double cell_stress(const Gathered& model, double sine) {
  const double s = std::clamp(sine, -1.0 + 1e-12, 1.0 - 1e-12);
  return volume_share(model, s) * shear_stress(model.card.shear, std::atanh(s));
}

std::vector<double> cell_knots(const Gathered& model, double greatest) {
  std::vector<double> knots;
  for (const double sign : {-1.0, 1.0}) add_corners(model.card.shear.tangent, sign, knots);
  for (double& knot : knots) knot = std::tanh(knot);
  const double most = std::sin(radians(greatest));
  return tidy(knots, -most, most);
}

double make_rising(Points& points, double within) {
  const auto origin = std::find_if(points.begin(), points.end(), [](const auto& point) { return point[0] >= 0.0; });
  const auto middle = static_cast<std::size_t>(origin - points.begin());
  double steepest = 0.0, greatest = 0.0;
  for (std::size_t k = 1; k < points.size(); ++k)
    steepest = std::max(steepest, (points[k][1] - points[k - 1][1]) / (points[k][0] - points[k - 1][0]));
  const double least = 1e-6 * steepest;
  const auto keep = [&](std::size_t k, std::size_t inner, double sign) {
    const double bound = points[inner][1] + least * (points[k][0] - points[inner][0]);
    if (sign * (points[k][1] - bound) >= 0.0) return;
    if (std::abs(points[k][0]) <= within) greatest = std::max(greatest, std::abs(bound - points[k][1]));
    points[k][1] = bound;
  };
  for (std::size_t k = middle + 1; k < points.size(); ++k) keep(k, k - 1, 1.0);
  for (std::size_t k = middle; k > 0; --k) keep(k - 1, k, -1.0);
  return greatest;
}

Points cell_points_by_angle(const Gathered& model, double greatest) {
  std::vector<double> knots = cell_knots(model, greatest);
  for (double& knot : knots) knot = std::asin(knot) / radians(1.0);
  const auto law = [&](double degrees) {
    return std::cos(radians(degrees)) * cell_stress(model, std::sin(radians(degrees)));
  };
  return points_of(law, knots, 1e-5 * std::abs(law(30.0)));
}

double far_angle(const Gathered& model) {
  return std::clamp(model.card.shear.valid_to_deg + 15.0, 75.0, 85.0);
}

Points cell_points_by_sine(const Gathered& model, double greatest) {
  const auto law = [&](double sine) { return cell_stress(model, sine); };
  return points_of(law, cell_knots(model, greatest), 1e-5 * std::abs(law(0.5)));
}

Points rise_of_forces(double duration) {
  constexpr double part = 0.03;
  Points points;
  for (int k = 0; k <= 20; ++k) points.push_back({part * duration * k / 20.0, smooth_way(k / 20.0)});
  points.push_back({duration, 1.0});
  return points;
}

Points member_points(double modulus) {
  const auto law = [&](double x) { return modulus * std::log1p(x) / (1.0 + x); };
  return points_of(law, {-0.1, 0.0, 0.1}, 1e-9 * modulus);
}

}  // namespace weaveform::foreign
