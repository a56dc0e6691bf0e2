// A solved result folder as the comparison needs it: the flat blank, and the state at any frame, travel or load.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesher/mesh/stack.hpp"
#include "post/dic/virtual/flat_mesh.hpp"
#include "solver/result/result_folder.hpp"

namespace weaveform::dic {

struct SimulatedState {
  double time = 0.0;                // s
  double travel = 0.0;              // mm; of the grip
  double force = 0.0;               // N
  std::vector<Vec3> displacement;   // mm; per node, blank frame
  std::vector<double> shear_angle;  // rad; per cell, the solver's own
};

class Simulation {
public:
  // `grip` names the grip or tool whose travel and load count; "": the only one that moves. `ply` names the ply of a
  // stack that the camera sees; "": the highest. Throws FileError or InputError (which file is missing, which grips or
  // plies there are).
  Simulation(const std::filesystem::path& directory, const std::string& grip, const std::string& ply = "");
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const FlatMesh& flat() const { return flat_; }
  [[nodiscard]] const std::string& grip() const { return grip_; }
  [[nodiscard]] const std::string& ply() const { return seen_.ply; }  // that is seen; "" where there is one fabric
  [[nodiscard]] std::size_t frame_count() const { return frame_.size(); }
  [[nodiscard]] double frame_travel(std::size_t frame) const { return frame_travel_[frame]; }

  // States; between frames node positions are interpolated linearly over the travel. `asked_by` begins the InputError
  // for what lies outside the run.
  [[nodiscard]] SimulatedState at_frame(std::size_t frame) const;
  [[nodiscard]] SimulatedState at_travel(double travel, const std::string& asked_by) const;
  // The load is made monotonic first (least squares, pool adjacent violators), so that its noise does not decide.
  [[nodiscard]] SimulatedState at_force(double force, const std::string& asked_by) const;

  // Load curve of the history: travel (mm) and force (N), row by row.
  [[nodiscard]] const std::vector<double>& travel() const { return travel_; }
  [[nodiscard]] const std::vector<double>& force() const { return force_; }
  [[nodiscard]] double force_at(double travel) const;

private:
  // What is seen of the result: all of it, or one ply of a stack.
  struct Seen {
    const Scene& scene;
    const Card& card;
    const Mesh& mesh;
    Range nodes;      // of the whole mesh
    std::string ply;  // its name
  };
  [[nodiscard]] static Seen seen_of(ResultFolder& folder, const std::string& ply);
  [[nodiscard]] std::vector<Vec3> positions(std::size_t frame) const;
  [[nodiscard]] SimulatedState state(const std::vector<Vec3>& world, double time, double travel) const;

  ResultFolder folder_;
  Seen seen_;
  const Scene& scene_;
  const Card& card_;
  const Mesh& mesh_;
  const History& history_;
  const std::vector<FrameFile>& frame_;
  std::string grip_;
  std::vector<double> time_, travel_, force_;  // of the history
  std::vector<double> frame_travel_;
  FlatMesh flat_;
  std::size_t whole_nodes_;
};

// Values at x of a curve given by points with rising x, held constant beyond its ends.
[[nodiscard]] double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at);

// The rising sequence nearest to y in the least-squares sense (pool adjacent violators; Ayer et al. 1955).
[[nodiscard]] std::vector<double> made_monotonic(const std::vector<double>& y);

}  // namespace weaveform::dic
