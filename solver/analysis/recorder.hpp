// Fills the history while the analysis runs. Grip forces of an explicit run carry the yarns' vibrations, so a row's
// force is the mean over the time from half a row before to half a row after it (the impulse over the time), not an
// instant's value.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fabric/trellis/shear_frame.hpp"
#include "solver/analysis/balance.hpp"
#include "solver/constraint/grips.hpp"
#include "solver/contact/ply_contact.hpp"
#include "solver/result/probe.hpp"
#include "solver/result/result.hpp"
#include "solver/state/archive.hpp"
#include "solver/state/tool_reading.hpp"

namespace weaveform {

class Recorder {
public:
  Recorder(const std::vector<Grip>& grips, std::vector<Probe> probes, double duration, int rows);

  // With friction in bending, each row also has what it lost so far, bending_friction_work_mJ.
  void record_bending_friction();

  // With a shear frame, each row also says the frame's angle (Eq. 12) and the normalised shear force (Eq. 13) that the
  // test's evaluation gives from the travel and load of grip number `pulled`.
  void evaluate_frame(const ShearFrame& frame, int pulled);

  // With tools, each row also has their displacement, and as means like the grips' forces: the force of the tool on the
  // fabric along its motion (of a tool at rest along its axis), contact area, and the force's components x, y, z.
  void record_tools(const std::vector<ToolSpec>& tools);

  // Of a stack, each row also says of every ply its greatest |shear angle|, and of every pair of plies that is recorded
  // (recorded_pairs) how it touches and slides.
  void record_plies(const MeshCells& cells, const std::vector<MeshPly>& plies);

  // Adds the grips' forces (N, along their directions) and the tools' readings over `kick` seconds around `time`.
  void add_forces(double time, double kick, const std::vector<double>& force,
                  const std::vector<ToolReading>& tools = {});
  // Appends the row of `time`; its forces are filled in when their window closes.
  void add_row(double time, const std::vector<double>& displacement, const Fields& fields, const EnergyBalance& balance,
               const std::vector<ToolReading>& tools = {}, const std::vector<PairReading>& pairs = {});
  // Closes the last window.
  void finish();

  [[nodiscard]] const std::vector<Probe>& probes() const { return probes_; }
  [[nodiscard]] const History& history() const { return history_; }
  // Rows from the first that nothing will change any more.
  [[nodiscard]] int closed_rows() const { return window_.row; }
  void archive(Archive& archive);

private:
  struct Window {
    double elapsed = 0.0;         // s
    std::vector<double> impulse;  // N s; of the grips, then of each tool: force, area (mm^2 s), x, y, z
    int row = 0;                  // the row this window belongs to
  };
  void close_window();
  void add_plies(const Fields& fields, const std::vector<PairReading>& pairs, std::vector<double>& row) const;
  int grip_count_;
  int tool_count_ = 0, tool_column_ = 0;
  std::vector<Probe> probes_;
  double duration_;
  int rows_;
  std::optional<ShearFrame> frame_;
  int pulled_ = 0;
  int frame_column_ = 0;
  std::optional<std::size_t> friction_column_;
  History history_;
  Window window_;
  std::vector<int> first_cell_;            // of each ply of a stack, and the number of cells
  std::vector<std::array<int, 2>> pairs_;  // recorded
  int ply_column_ = 0;
};

// The pairs whose columns history.csv has: all of up to eight plies, of more the neighbours.
[[nodiscard]] std::vector<std::array<int, 2>> recorded_pairs(int plies);

}  // namespace weaveform
