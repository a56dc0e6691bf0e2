// One explicit analysis from its first to its last step: the time loop over a world, and who watches it.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "mesher/resolve/resolved.hpp"
#include "solver/analysis/checkpoint.hpp"
#include "solver/analysis/checkpoint_clock.hpp"
#include "solver/analysis/options.hpp"
#include "solver/analysis/outputs.hpp"
#include "solver/analysis/verdict.hpp"
#include "solver/analysis/world.hpp"
#include "solver/state/pace.hpp"

namespace weaveform {

class Analysis {
public:
  // Of all plies of the model, which must outlive the analysis. Of each ply its part is solved where there are `parts`
  // (parts_to_solve); results are those of the whole all the same.
  Analysis(const Resolved& model, std::vector<SymmetricPart> parts, std::filesystem::path directory,
           const SolveOptions& options);
  SolveResult run();

  // The pieces of run(), for who steps by himself (solver/analysis/steered.hpp). The start, or the checkpoint's state:
  void open();
  // A step with the forces at hand, and what is shown of its beginning. False: that was the last, and the clock and
  // positions stayed.
  bool step_on();
  // Forces for the next step, at the present positions.
  void renew_forces();
  // After the last step, whichever that was.
  SolveResult close();
  [[nodiscard]] World& world() { return world_; }
  [[nodiscard]] const History& history() const { return outputs_.history(); }
  [[nodiscard]] int closed_rows() const { return outputs_.closed_rows(); }

private:
  // Everything that has a state, in one order for all who keep it.
  void archive(Archive& archive);
  void begin();
  void resume();
  void keep_pace();
  void renew_step();
  void refuse_long_step() const;
  void check_state();
  void look_around();
  void open_outputs();
  void step(bool last);
  void close_outputs();
  [[nodiscard]] bool stops_here() const;
  [[nodiscard]] bool goes_on_plainly() const;
  void pass_on();
  [[nodiscard]] bool stop_asked() const;
  [[nodiscard]] bool checkpoint_due() const;
  void look_at_checkpoint();
  void leave_checkpoint();
  void report_progress();

  [[nodiscard]] const Identity& identity();
  [[nodiscard]] ArchiveState all_state();
  [[nodiscard]] double wall() const;           // s; so far
  [[nodiscard]] double contact_wall() const;   // s; of it, in contact
  [[nodiscard]] SolveStatistics statistics();  // of the last row or frame
  [[nodiscard]] WorldSetup world_setup();
  [[nodiscard]] int cells_solved() const;
  [[nodiscard]] std::string what_to_do() const;
  [[nodiscard]] bool is_hasty() const;
  [[noreturn]] void fail(const std::string& what) const;

  const Resolved& model_;
  const Mesh& whole_;
  const Scene& scene_;
  std::vector<SymmetricPart> parts_;  // of each ply, or none
  std::filesystem::path directory_;
  SolveOptions options_;
  Team team_;
  PaceKeeper pace_{team_};
  Loading loading_;
  World world_;
  Outputs outputs_;
  Verdict verdict_;
  std::filesystem::path checkpoint_file_;  // empty: none is left
  CheckpointClock clock_;
  Identity identity_;                                     // found when first asked for
  std::int64_t checked_step_ = -1;                        // the last whose state was looked at
  double wall_before_ = 0.0, contact_wall_before_ = 0.0;  // s; of the runs before this one was resumed
  std::chrono::steady_clock::time_point started_;
};

}  // namespace weaveform
