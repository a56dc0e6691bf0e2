// One measured stage beside the simulation, on the measured points: measured, levelled (the simulation through the same
// instrument) and raw (the simulation's own) shear angle, their difference and its uncertainty.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "post/dic/registration/placement.hpp"
#include "post/dic/virtual/strain_window.hpp"

namespace weaveform::dic {

// The instrument as settled from settings and headers.
struct Instrument {
  double facet_size = 0.0;  // mm
  double step = 0.0;        // mm
  int window = 5;           // points across
  double fill = 0.5;
  std::optional<double> uncertainty;  // mm
  std::string origin;                 // where the numbers come from, in words
};

// Asks for the facet size, or the window of measured gradients, when they are unknown.
void ask_instrument(const InstrumentSpec& spec, const MeasuredStage& stage, Questions& questions);
// Throws InputError with the question when ask_instrument would ask one.
[[nodiscard]] Instrument settle_instrument(const InstrumentSpec& spec, const MeasuredStage& stage);

// What depends on the points only and is kept from stage to stage.
struct PointSet {
  std::vector<Vec3> measured;  // as in the measurement
  RigidMotion placement;
  std::vector<Vec2> point;  // mm; blank frame
  Neighbours neighbours;
  Sampling facets;
  std::vector<int> cell;  // of the mesh, -1 off the fabric
};
[[nodiscard]] std::shared_ptr<const PointSet> make_points(const MeasuredStage& stage, const RigidMotion& placement,
                                                          const Simulation& simulation, const Instrument& instrument,
                                                          std::shared_ptr<const PointSet> before);

struct StageFields {
  std::shared_ptr<const PointSet> points;
  std::vector<bool> valid;                                         // measured and seen by the virtual instrument
  std::vector<Vec3> measured_displacement, levelled_displacement;  // mm; blank frame
  std::vector<double> measured, levelled, raw;                     // rad; not a number where there is none
  std::vector<double> difference, uncertainty;  // rad; measured - levelled, and its standard uncertainty
  std::vector<WindowFit> fit;                   // of the measured displacements (empty for measured gradients)
  double displacement_uncertainty = 0.0;        // mm
  bool estimated = false;                       // ... from the scatter
  int components = 2;                           // of the displacement that were measured
};

[[nodiscard]] StageFields compare_stage(const MeasuredStage& stage, const RigidMotion& current,
                                        std::shared_ptr<const PointSet> points, const Simulation& simulation,
                                        const SimulatedState& state, const Instrument& instrument);

// Replaces the angles by their means over the mirror images (ComparisonSpec::symmetry). Throws InputError when the
// yarns do not share the symmetry.
void average_mirror_images(FieldSymmetry symmetry, const BlankSpec& blank, const Instrument& instrument,
                           StageFields& fields);

// A scalar field at any place: the least-squares plane through the points within 1.1 steps, if they are enough and lie
// around it; else not a number.
class FieldAt {
public:
  FieldAt(const std::vector<Vec2>& points, double step);
  ~FieldAt();
  [[nodiscard]] double operator()(const Vec2& place, const std::vector<double>& field) const;

private:
  struct Bins;
  const std::vector<Vec2>& points_;
  double step_;
  std::unique_ptr<Bins> bins_;
};

}  // namespace weaveform::dic
