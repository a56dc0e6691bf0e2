#include "solver/analysis/steered.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "solver/analysis/prepare.hpp"

namespace weaveform {

Steered::Steered(Resolved model, int threads)
    : model_(model.scene.analysis.mass_scale != 1.0 ? with_scaled_mass(std::move(model)) : std::move(model)),
      analysis_(std::make_unique<Analysis>(model_, parts_to_solve(model_), std::filesystem::path(),
                                           SolveOptions{.threads = threads, .quiet = true})),
      load_(world().size(), nullptr) {
  for (std::size_t k = 0; k < world().size(); ++k) world().ply(k).leave_plane();  // its caller may
}

void Steered::step() {
  if (!failure_.empty()) throw PhysicsError(failure_);
  if (ended_) throw Interrupted("the run is at its end; there are no further steps");
  try {
    take_step();
  } catch (const PhysicsError& error) {
    failure_ = error.what();
    throw;
  }
}

// The last call of step_on() moves nothing: it shows the end itself, so that it belongs to the step before.
void Steered::take_step() {
  if (begun_)
    analysis_->renew_forces();
  else
    analysis_->open();
  begun_ = true;
  (void)analysis_->step_on();
  if (!world().finished()) return;
  analysis_->renew_forces();
  (void)analysis_->step_on();
  end();
}

void Steered::end() {
  if (ended_) return;
  ended_ = true;
  (void)analysis_->close();
}

// At the end the window of forces may be that of a row which never came.
std::size_t Steered::closed_rows() const {
  return std::min(static_cast<std::size_t>(analysis_->closed_rows()), history().row.size());
}

std::vector<Vec3>& Steered::load(std::size_t ply) {
  if (load_[ply] == nullptr) {
    auto load = std::make_unique<NodalLoad>(world().ply(ply).packed());
    load_[ply] = load.get();
    world().ply(ply).add(std::move(load));
  }
  return load_[ply]->force();
}

}  // namespace weaveform
