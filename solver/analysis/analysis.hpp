// One explicit analysis from its first to its last step.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mesher/resolve/resolved.hpp"
#include "mesher/symmetry/cut_part.hpp"
#include "solver/analysis/checkpoint.hpp"
#include "solver/analysis/checkpoint_clock.hpp"
#include "solver/analysis/loading.hpp"
#include "solver/analysis/options.hpp"
#include "solver/analysis/recorder.hpp"
#include "solver/analysis/schedule.hpp"
#include "solver/bending/lattice_bending.hpp"
#include "solver/bending/shell.hpp"
#include "solver/constraint/grips.hpp"
#include "solver/constraint/mirror_planes.hpp"
#include "solver/constraint/picture_frame.hpp"
#include "solver/constraint/ties.hpp"
#include "solver/contact/contact.hpp"
#include "solver/lattice/forces.hpp"
#include "solver/ply/critical_step.hpp"
#include "solver/ply/motion.hpp"
#include "solver/ply/reach.hpp"
#include "solver/ply/torn_yarns.hpp"
#include "solver/result/file_names.hpp"
#include "solver/result/history_file.hpp"
#include "solver/state/force_term.hpp"

namespace weaveform {

class Analysis {
public:
  // Of model.mesh, the whole. `part` of it is solved when given; results are those of the whole all the same. Keeps
  // references to both.
  Analysis(const Resolved& model, const SymmetricPart* part, std::filesystem::path directory,
           const SolveOptions& options);
  SolveResult run();

private:
  // The loop, in the order of the theory: step length, outputs due, motion, forces.
  void renew_step();
  void watch_reach();
  void compute_forces();
  void follow();
  [[nodiscard]] double stored_energy(const std::vector<Vec3>& position);
  void close_balance(double kinetic);
  void set_viscous_time(double beta);
  void open_outputs();
  void close_row();
  void move(bool last);
  void check_state();
  void check_positions() const;
  void check_yarns() const;
  [[nodiscard]] const std::vector<ToolReading>& tool_readings() const;
  void find_grip_images();
  [[nodiscard]] const std::vector<double>& whole_grip_forces();
  [[nodiscard]] std::vector<std::string> tool_names() const;
  [[nodiscard]] ContactState whole_contact_state() const;
  [[nodiscard]] double travelled() const;
  [[nodiscard]] bool finished() const { return state_.time >= duration_ * (1.0 - 1e-12); }

  void add_terms();
  void perturb();
  void resume();
  void open_result_files(std::vector<double> frame_times);
  void look_at_checkpoint();
  void leave_checkpoint();
  [[nodiscard]] Checkpoint checkpoint() const;
  [[nodiscard]] CheckpointSizes checkpoint_sizes() const;
  void recall(Checkpoint checkpoint);
  void report_progress();
  [[nodiscard]] const Identity& identity();
  [[nodiscard]] double wall() const;
  [[nodiscard]] SolveStatistics statistics();
  [[nodiscard]] SolveResult result();
  [[nodiscard]] std::string what_to_do() const;
  [[nodiscard]] bool is_hasty() const;
  [[noreturn]] void fail(const std::string& what) const;

  const Resolved& model_;
  const Mesh& whole_;
  const SymmetricPart* part_;  // null when the whole is solved
  const Mesh& mesh_;           // what is solved
  const int parts_;            // the whole is this many times what is solved
  const Scene& scene_;
  const Card& card_;
  std::filesystem::path directory_;
  SolveOptions options_;
  Team team_;

  std::array<TangentLaw, 2> yarn_laws_;
  PackedMesh packed_;
  std::unique_ptr<Ties> ties_;             // null when no node follows others, or a rigid frame moves them all
  std::unique_ptr<MirrorPlanes> mirrors_;  // null when the whole is solved
  State state_;
  std::vector<Grip> grips_;
  FabricForces forces_;
  std::vector<std::unique_ptr<ForceTerm>> terms_;
  const LatticeBending* bending_ = nullptr;  // one of the terms, when anything bends without unknowns
  const Shell* shell_ = nullptr;             // one of the terms, when the cells are shells
  const Contact* contact_ = nullptr;         // one of the terms, when the scene has tools
  CriticalStep critical_step_;
  InternalEnergy internal_energy_;
  Loading loading_;
  double duration_;
  Motion motion_;
  BlankPlane plane_;  // of the whole
  Recorder recorder_;
  Schedule row_schedule_, frame_schedule_;
  std::unique_ptr<FrameWriter> frames_;
  std::unique_ptr<HistoryFile> history_file_;
  std::filesystem::path checkpoint_file_;  // empty: none is left
  CheckpointClock clock_;
  Identity identity_;  // found when first asked for

  std::vector<std::vector<int>> grip_image_;     // per mirror plane: the grip that each is mirrored onto
  EnergyBalance balance_;                        // of the whole
  double grip_work_ = 0.0, damping_work_ = 0.0;  // mJ; of what is solved
  Reach reach_;
  YarnLimits yarn_limits_;
  long checked_step_ = -1;                           // the last whose state was looked at
  std::array<double, 2> yarn_modulus_ = {0.0, 0.0};  // MPa; that the step is stable with, of each family
  StableStep stable_;
  double step_ = 0.0, step_before_ = 0.0, smallest_step_ = 0.0;  // s
  double viscous_time_ = 0.0;                                    // s; beta of yarn.hpp
  std::string step_set_by_;
  bool row_open_ = false;
  Fields fields_;                                         // of the open row or frame
  std::vector<double> displacement_, displacement_next_;  // mm; per grip
  std::vector<double> grip_force_, grip_force_before_;    // N; per grip, along its direction
  std::vector<double> whole_grip_force_, one_side_;       // N; the same of the whole, and on the way there
  std::vector<double> grip_displacement_before_;          // mm; at the step before
  double damping_power_before_ = 0.0;                     // mJ/s
  double worst_error_ = 0.0, worst_ratio_ = 0.0;
  int folded_ = 0;
  double wall_before_ = 0.0;  // s; of the runs before this one was resumed
  std::chrono::steady_clock::time_point started_;
};

}  // namespace weaveform
