// The result folder: the room that writes a file owns its format, so its readers stand here too.
//   DIR/result.pvd + frames/frame_NNNN.vtu   fields over time, for ParaView
//   DIR/history.csv                          one row per history time
//   DIR/solve.json                           what the solve cost and how far it can be trusted
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/result/fields.hpp"

namespace weaveform {

// Columns in order, first "time_s"; then NAME.displacement_mm and NAME.force_N per grip (and tool),
// NAME.shear_angle_deg, NAME.shear_angle_sd_deg, NAME.shear_angle_min_deg, NAME.shear_angle_max_deg per measure, then energies
// kinetic_energy_mJ, internal_energy_mJ, external_work_mJ, damping_work_mJ, energy_error.
struct History {
  std::vector<std::string> column;
  std::vector<std::vector<double>> row;
  [[nodiscard]] int index(const std::string& name) const;                   // -1 when absent
  [[nodiscard]] std::vector<double> values(const std::string& name) const;  // throws InputError when absent
};

struct SolveStatistics {
  int cells = 0, nodes = 0, yarns = 0;
  long steps = 0;
  double duration_s = 0.0;
  double wall_s = 0.0;               // of the time loop
  double cell_steps_per_s = 0.0;
  double step_s = 0.0;               // smallest step taken
  std::string step_set_by;           // which part set the step, e.g. "yarn (warp, node 123)"
  double damping_per_s = 0.0;        // mass-proportional damping used
  double energy_error = 0.0;         // greatest |internal + kinetic + damping - external| / greatest energy
  double kinetic_to_internal = 0.0;  // greatest ratio after the first tenth of the duration
  double damping_work_mJ = 0.0;
  double max_shear_angle_deg = 0.0;  // greatest |shear angle| in the last frame
  double max_yarn_strain = 0.0;
  int folded_cells = 0;              // greatest number at any history row
  int folded_cells_at_end = 0;
  int cells_beyond_card = 0;         // cells sheared past the range of the card's shear law in the last frame
  int threads = 1;
};

// Writes frames as they come and the .pvd index on close; an interrupted run leaves a readable index.
class FrameWriter {
public:
  FrameWriter(std::filesystem::path directory, const Mesh& mesh);
  void write(const Fields& fields);  // throws FileError
  [[nodiscard]] int count() const { return static_cast<int>(times_.size()); }

private:
  std::filesystem::path directory_;
  const Mesh& mesh_;
  std::vector<double> times_;
};

struct FrameFile {
  double time = 0.0;
  std::filesystem::path file;
};
[[nodiscard]] std::vector<FrameFile> list_frames(const std::filesystem::path& directory);  // from result.pvd
[[nodiscard]] std::vector<Vec3> read_frame_positions(const std::filesystem::path& frame);  // mm; per node

void write_history(const History& history, const std::filesystem::path& file);
[[nodiscard]] History read_history(const std::filesystem::path& file);
void write_statistics(const SolveStatistics& statistics, const std::filesystem::path& file);
[[nodiscard]] SolveStatistics read_statistics(const std::filesystem::path& file);

}  // namespace weaveform
