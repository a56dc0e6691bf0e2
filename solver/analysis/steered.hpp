// An analysis that its caller steps, and may act on between steps: his own stopping rule, his own load
// (python/bindings). The steps are those of solve(), bit for bit, as long as nobody acts. It writes no files.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesher/resolve/resolved.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/ply/nodal_load.hpp"

namespace weaveform {

class Steered {
public:
  // Throws what solve() throws before its first step.
  Steered(Resolved model, int threads);
  Steered(const Steered&) = delete;
  Steered& operator=(const Steered&) = delete;

  // One step. Afterwards positions and time are those of its end, velocities of its middle; forces, energies and the
  // readings of grips and tools of its beginning, which after the last step is the end of the run. Forces are computed
  // as a step begins: what the caller changed in positions, velocities (Ply::state()) or load() counts in it. Throws
  // PhysicsError, then and ever after; Interrupted when the run is at its end.
  void step();
  // Ends the run where it stands: the history is then whole up to there.
  void end();
  [[nodiscard]] bool ended() const { return ended_; }  // by its duration, or by end()

  [[nodiscard]] const Resolved& model() const { return model_; }
  [[nodiscard]] World& world() { return analysis_->world(); }
  [[nodiscard]] const History& history() const { return analysis_->history(); }
  // Rows from the first whose forces, means over half a row before and after, are known; all at the end.
  [[nodiscard]] std::size_t closed_rows() const;
  // N; forces on the nodes of a ply (Ply::mesh()) that the caller sets and that act until he sets others. Where mirror
  // planes are (Ply::part()), each acts on all images of its node. A ply has none before the first call for it. The
  // stable step knows nothing of forces that hang on positions: those of a spring of stiffness k alone on a mass m are
  // stable below 2 sqrt(m/k).
  [[nodiscard]] std::vector<Vec3>& load(std::size_t ply = 0);

private:
  void take_step();

  Resolved model_;
  std::unique_ptr<Analysis> analysis_;
  std::vector<NodalLoad*> load_;  // of each ply, which owns it; null: none
  bool begun_ = false, ended_ = false;
  std::string failure_;
};

}  // namespace weaveform
