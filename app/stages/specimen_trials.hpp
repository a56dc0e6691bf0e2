// How `fit` runs the tests that it identifies a law from: scenes of the specimens, solved quietly in memory, and what they
// tell of the law (fabric/identify/simulated_fit.hpp).
//
// A load is the mean over both grips of a bias extension, which inertia moves in opposite ways, and of a frame that of its
// crosshead. Unless the settings say how fast, the duration is the automatic one, or as much longer as inertia needs to be
// below 1 % of the loads; it is found with the first run of a specimen.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "fabric/identify/simulated_fit.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

class SpecimenTrials {
public:
  // Throws InputError when the settings of the fit file are none of a scene.
  explicit SpecimenTrials(const identify::FitSpec& spec);

  // One curve. Throws PhysicsError when a run fails, and what making a mesh throws.
  [[nodiscard]] identify::SimulatedCurve run(const identify::SimulatedTest& test, const identify::TriedFabric& fabric,
                                             identify::TrialMesh mesh);

private:
  [[nodiscard]] Scene scene_of(const identify::SimulatedTest& test, const std::array<double, 2>& coarsening) const;

  std::string file_;
  identify::SimulationSpec how_;
  std::map<int, double> duration_;  // s; of each test, once it is known
};

}  // namespace weaveform
