// What an analysis shows as it goes: rows of history and frames, each at its times. It looks at the world and changes
// nothing there.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mesher/resolve/resolved.hpp"
#include "solver/analysis/recorder.hpp"
#include "solver/analysis/schedule.hpp"
#include "solver/analysis/whole_grips.hpp"
#include "solver/analysis/world.hpp"
#include "solver/result/history_file.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

// What the plies of a world do to each other, of the whole.
[[nodiscard]] std::vector<PairReading> whole_pairs(const World& world);

class Outputs {
public:
  // Of all plies of the world. An empty `directory` writes nothing.
  Outputs(const Resolved& model, const World& world, std::filesystem::path directory);

  // Begins the files, or goes on with them after an archive was read.
  void open_files();

  [[nodiscard]] bool due(double time) const { return row_schedule_.due(time) || frame_schedule_.due(time); }
  // At a time that is due, before the step: fields of the moment, and the frame, if it is due. Returns whether one was
  // written.
  bool look(const World& world);
  // After each step, which began at `time`: forces at its beginning.
  void record_forces(World& world, double time);
  [[nodiscard]] bool row_open() const { return row_open_; }
  // After the step, when the energies of its beginning are known.
  void close_row(const World& world);
  // Rows that nothing will change any more go to the file.
  void append_rows();
  // The end of the run; history.csv is whole.
  void finish();
  // Whether a frame is on its way to its file, by a thread of its own.
  [[nodiscard]] bool writes_beside() const { return frames_ && frames_->is_writing(); }
  // Also of a run that fails.
  void write_history_file() const;
  // Waits until the frames written are on the disk.
  void settle();

  [[nodiscard]] const Fields& fields() const { return fields_; }  // of the last look
  [[nodiscard]] const History& history() const { return recorder_.history(); }
  [[nodiscard]] int closed_rows() const { return recorder_.closed_rows(); }  // that nothing will change any more
  void archive(Archive& archive);

private:
  [[nodiscard]] Fields fields_of_ply(const World& world, std::size_t ply, bool frame_due) const;

  const Scene& scene_;
  const Mesh& whole_;  // of all plies
  std::filesystem::path directory_;
  std::vector<BlankPlane> plane_;            // per ply
  std::vector<std::vector<int>> looked_at_;  // per ply, cells whose shear angles a row shows
  WholeGrips grips_;
  Recorder recorder_;
  Schedule row_schedule_, frame_schedule_;
  std::unique_ptr<FrameWriter> frames_;
  std::unique_ptr<HistoryFile> history_file_;
  std::vector<double> frame_times_;  // s; of the frames written
  Fields fields_;
  bool row_open_ = false;
};

}  // namespace weaveform
