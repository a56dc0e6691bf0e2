#include "post/dic/comparison/stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/missing.hpp"
#include "post/dic/virtual/facet.hpp"
#include "post/dic/virtual/point_bins.hpp"

namespace weaveform::dic {
namespace {

std::vector<Vec2> plane_points(const std::vector<Vec3>& points) {
  std::vector<Vec2> plane;
  plane.reserve(points.size());
  for (const Vec3& p : points) plane.push_back({p[0], p[1]});
  return plane;
}

// Displacements in the blank's frame: from the placed reference to the placed current position.
std::vector<Vec3> placed_displacements(const MeasuredStage& stage, const PointSet& points, const RigidMotion& current) {
  std::vector<Vec3> result(stage.size());
  for (std::size_t i = 0; i < stage.size(); ++i) {
    const Vec3 &p = stage.reference[i], &u = stage.displacement_field[i];
    const Vec2 now = current.moved({p[0] + u[0], p[1] + u[1]});
    result[i] = {now[0] - points.point[i][0], now[1] - points.point[i][1], u[2]};
  }
  return result;
}

// F of the measurement turned into the blank's frame, as grad u.
Eigen::Matrix<double, 3, 2> placed_gradient(const std::array<double, 4>& f, const RigidMotion& placement) {
  const double c = std::cos(placement.angle), s = std::sin(placement.angle);
  Eigen::Matrix2d turn, measured;
  turn << c, -s, s, c;
  measured << f[0], f[1], f[2], f[3];
  Eigen::Matrix<double, 3, 2> gradient = Eigen::Matrix<double, 3, 2>::Zero();
  gradient.topRows<2>() = turn * measured * turn.transpose() - Eigen::Matrix2d::Identity();
  return gradient;
}

// Median scatter of measured minus simulated displacements about the planes of the strain windows: what the model has
// of curvature drops out, and points where it fails do not move a median.
double estimated_uncertainty(const PointSet& points, const StageFields& fields, const Instrument& instrument) {
  std::vector<Vec3> difference(fields.valid.size());
  for (std::size_t i = 0; i < difference.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      difference[i][k] = fields.measured_displacement[i][k] - fields.levelled_displacement[i][k];
  std::vector<double> variance;
  const std::size_t stride = std::max<std::size_t>(1, difference.size() / 5000);  // a sample does
  for (std::size_t i = 0; i < difference.size(); i += stride) {
    const WindowFit fit = fit_window(points.point, points.neighbours, i, fields.valid, difference, instrument.fill);
    if (fit.good && fit.count > 4) variance.push_back(fit.scatter * fit.scatter);
  }
  if (variance.empty()) return 0.0;
  const auto middle = variance.begin() + static_cast<std::ptrdiff_t>(variance.size() / 2);
  std::nth_element(variance.begin(), middle, variance.end());
  // The median of a chi-squared variable with f degrees of freedom is f (1 - 2/(9 f))^3 (Wilson & Hilferty 1931).
  const double freedom = 2.0 * std::max(1.0, static_cast<double>(points.neighbours.full) - 3.0);
  return std::sqrt(*middle / std::pow(1.0 - 2.0 / (9.0 * freedom), 3));
}

}  // namespace

void ask_instrument(const InstrumentSpec& spec, const MeasuredStage& stage, Questions& questions) {
  if (!spec.facet_size && !(stage.header_facet > 0.0 && stage.header_step > 0.0))
    ask(questions, {fmt::format("{}: how large is a facet (subset) on the specimen, in mm, 0 for none? the header does "
                                "not tell;",
                                stage.label),
                    "instrument.facet_size", "2"});
  if (!stage.gradient.empty() && !spec.window)
    ask(questions, {fmt::format("{}: over how many points across were its deformation gradients fitted? the file does "
                                "not tell;",
                                stage.label),
                    "instrument.window", "5"});
}

Instrument settle_instrument(const InstrumentSpec& spec, const MeasuredStage& stage) {
  Questions questions;
  ask_instrument(spec, stage, questions);
  throw_if_asked(questions);
  Instrument instrument;
  instrument.fill = spec.fill;
  instrument.uncertainty = spec.uncertainty;
  instrument.step = spec.step ? *spec.step : typical_step(plane_points(stage.reference));
  if (!(instrument.step > 0.0))
    throw InputError(fmt::format("{}: all points lie at one place; is this the right file?", stage.label));
  instrument.origin = spec.step ? "step as given" : "step: the points' median distance";
  if (spec.facet_size) {
    instrument.facet_size = *spec.facet_size;
    instrument.origin += ", facet as given";
  } else {
    instrument.facet_size = stage.header_facet / stage.header_step * instrument.step;
    instrument.origin += fmt::format(", facet: header's {} px at {} px of step", stage.header_facet, stage.header_step);
  }
  instrument.window = spec.window ? static_cast<int>(*spec.window) : stage.window.value_or(5);
  instrument.origin += spec.window    ? ", window as given"
                       : stage.window ? ", window: header's"
                                      : ", window: 5 by default";
  return instrument;
}

std::shared_ptr<const PointSet> make_points(const MeasuredStage& stage, const RigidMotion& placement,
                                            const Simulation& simulation, const Instrument& instrument,
                                            std::shared_ptr<const PointSet> before) {
  if (before && before->measured == stage.reference && before->placement.angle == placement.angle &&
      before->placement.shift == placement.shift)
    return before;
  auto points = std::make_shared<PointSet>();
  points->measured = stage.reference;
  points->placement = placement;
  for (const Vec3& p : stage.reference) points->point.push_back(placement.moved({p[0], p[1]}));
  // Windows and facets lie along the image's axes.
  points->neighbours = find_neighbours(plane_points(stage.reference), instrument.step, instrument.window);
  points->facets =
      sample_facets(simulation.flat(), points->point, instrument.facet_size, instrument.fill, placement.angle);
  for (const Vec2& p : points->point) points->cell.push_back(simulation.flat().cell_at(p));
  return points;
}

StageFields compare_stage(const MeasuredStage& stage, const RigidMotion& current,
                          std::shared_ptr<const PointSet> points, const Simulation& simulation,
                          const SimulatedState& state, const Instrument& instrument) {
  const std::size_t count = stage.size();
  StageFields fields;
  fields.valid.resize(count);
  fields.levelled_displacement.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    fields.valid[i] = stage.valid[i] && points->facets.found(i);
    fields.levelled_displacement[i] = points->facets.value(i, state.displacement);
  }
  for (auto* angle : {&fields.measured, &fields.levelled, &fields.raw, &fields.difference, &fields.uncertainty})
    angle->assign(count, missing);
  for (std::size_t i = 0; i < count; ++i)
    if (points->cell[i] >= 0) fields.raw[i] = state.shear_angle[static_cast<std::size_t>(points->cell[i])];

  const YarnDirections yarns = yarn_directions(simulation.scene().blank);
  const bool gradients = !stage.gradient.empty();
  fields.measured_displacement = gradients ? std::vector<Vec3>(count, Vec3{missing, missing, missing})
                                           : placed_displacements(stage, *points, current);
  fields.components = std::any_of(stage.displacement_field.begin(), stage.displacement_field.end(),
                                  [](const Vec3& u) { return u[2] != 0.0 && std::isfinite(u[2]); })
                          ? 3
                          : 2;
  fields.displacement_uncertainty = missing;
  if (!gradients) {
    fields.fit.resize(count);
    fields.estimated = !instrument.uncertainty;
    fields.displacement_uncertainty =
        instrument.uncertainty ? *instrument.uncertainty : estimated_uncertainty(*points, fields, instrument);
    // What rounding leaves in files of ten digits is no measure of agreement.
    fields.displacement_uncertainty = std::max(fields.displacement_uncertainty, 1e-6 * instrument.step);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!fields.valid[i]) continue;
    const WindowFit simulated =
        fit_window(points->point, points->neighbours, i, fields.valid, fields.levelled_displacement, instrument.fill);
    if (!simulated.good) continue;
    fields.levelled[i] = shear_angle(simulated.gradient, yarns);
    if (gradients) {
      fields.measured[i] = shear_angle(placed_gradient(stage.gradient[i], points->placement), yarns);
    } else {
      fields.fit[i] =
          fit_window(points->point, points->neighbours, i, fields.valid, fields.measured_displacement, instrument.fill);
      fields.measured[i] = shear_angle(fields.fit[i].gradient, yarns);
      fields.uncertainty[i] = angle_uncertainty(fields.fit[i], angle_sensitivity(fields.fit[i].gradient, yarns),
                                                fields.displacement_uncertainty, fields.components);
    }
    fields.difference[i] = fields.measured[i] - fields.levelled[i];
  }
  fields.points = std::move(points);
  return fields;
}

struct FieldAt::Bins {
  PointBins bins;
};

FieldAt::FieldAt(const std::vector<Vec2>& points, double step)
    : points_(points), step_(step), bins_(std::make_unique<Bins>(Bins{PointBins(points, 1.1 * step)})) {}
FieldAt::~FieldAt() = default;

double FieldAt::operator()(const Vec2& place, const std::vector<double>& field) const {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  std::array<bool, 4> quadrant = {};
  int count = 0;
  bins_->bins.within(place, 1.1 * step_, [&](int j) {
    if (!std::isfinite(field[j])) return;
    const Eigen::Vector3d row(1.0, points_[j][0] - place[0], points_[j][1] - place[1]);
    normal += row * row.transpose();
    right += field[j] * row;
    quadrant[(row[1] < 0.0 ? 1U : 0U) + (row[2] < 0.0 ? 2U : 0U)] = true;
    ++count;
  });
  if (count < 3 || std::count(quadrant.begin(), quadrant.end(), true) < 3) return missing;
  const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
  if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-9)) return missing;
  return solver.solve(right)[0];
}

void average_mirror_images(FieldSymmetry symmetry, const BlankSpec& blank, const Instrument& instrument,
                           StageFields& fields) {
  if (symmetry == FieldSymmetry::none) return;
  // A mirror takes yarns at 45 deg to its axis into one another and keeps their angle; yarns along the axes it turns so
  // that the shear angle changes its sign; any other yarns are not symmetric.
  const double turn = std::remainder(blank.yarn_angle, 90.0);
  double sign = 1.0;
  if (symmetry != FieldSymmetry::rotation) {
    if (std::abs(turn) < 1e-6)
      sign = -1.0;
    else if (std::abs(std::abs(turn) - 45.0) > 1e-6)
      throw InputError(
          fmt::format("symmetry of [comparison] is '{}', but yarns at {} deg have no such mirror image; use "
                      "\"rotation\" or \"none\"",
                      name_of(symmetry), blank.yarn_angle));
  }
  struct Image {
    double x, y, sign;
  };
  std::vector<Image> images = {{1.0, 1.0, 1.0}};
  if (symmetry == FieldSymmetry::x || symmetry == FieldSymmetry::xy) images.push_back({-1.0, 1.0, sign});
  if (symmetry == FieldSymmetry::y || symmetry == FieldSymmetry::xy) images.push_back({1.0, -1.0, sign});
  if (symmetry == FieldSymmetry::rotation || symmetry == FieldSymmetry::xy) images.push_back({-1.0, -1.0, 1.0});

  const auto& point = fields.points->point;
  const FieldAt at(point, instrument.step);
  const auto averaged = [&](const std::vector<double>& field, std::vector<int>* counts) {
    std::vector<double> mean(field.size(), missing);
    for (std::size_t i = 0; i < field.size(); ++i) {
      if (!std::isfinite(field[i])) continue;
      double sum = 0.0;
      int count = 0;
      for (const Image& image : images) {
        const bool itself = image.x > 0.0 && image.y > 0.0;
        const double value = itself ? field[i] : at({image.x * point[i][0], image.y * point[i][1]}, field);
        if (!std::isfinite(value)) continue;
        sum += image.sign * value;
        ++count;
      }
      mean[i] = sum / count;
      if (counts != nullptr) (*counts)[i] = count;
    }
    return mean;
  };
  std::vector<int> counts(point.size(), 1);
  fields.measured = averaged(fields.measured, &counts);
  fields.levelled = averaged(fields.levelled, nullptr);
  fields.raw = averaged(fields.raw, nullptr);
  for (std::size_t i = 0; i < point.size(); ++i) {
    fields.difference[i] = fields.measured[i] - fields.levelled[i];
    fields.uncertainty[i] /= std::sqrt(counts[i]);
  }
}

}  // namespace weaveform::dic
