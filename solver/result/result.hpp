// The result folder: the room that writes a file owns its format, so its readers stand here too.
//   DIR/result.pvd + frames/frame_NNNN.vtu   fields over time, for ParaView
//   DIR/history.csv                          one row per history time
//   DIR/solve.json                           what the solve cost and how far it can be trusted; `finished` says
//                                            whether it is that of a whole run
#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "solver/result/fields.hpp"

namespace weaveform {

// Columns in order, first "time_s"; then NAME.displacement_mm and NAME.force_N per grip,
// NAME.shear_angle_deg, NAME.shear_angle_sd_deg, NAME.shear_angle_min_deg, NAME.shear_angle_max_deg per measure, then
// energies kinetic_energy_mJ, internal_energy_mJ, external_work_mJ, damping_work_mJ, bending_energy_mJ,
// hourglass_energy_mJ, energy_error; bending_friction_work_mJ (part of damping_work_mJ) with friction in bending; frame.shear_angle_deg and frame.normalised_shear_force_N_per_mm of a shear frame;
// last NAME.displacement_mm, NAME.force_N, NAME.contact_area_mm2, NAME.force_x_N, NAME.force_y_N, NAME.force_z_N per
// tool. Forces are those on the fabric: force_N along the motion, of what is at rest along its direction or axis.
struct History {
  std::vector<std::string> column;
  std::vector<std::vector<double>> row;
  [[nodiscard]] int index(const std::string& name) const;                   // -1 when absent
  [[nodiscard]] std::vector<double> values(const std::string& name) const;  // throws InputError when absent
};

// What two plies of a stack did to each other: all neighbours, and whoever else came to touch.
struct PairStatistics {
  std::string lower, upper;         // names
  double contact_area_mm2 = 0.0;    // at the end, like all that is no greatest
  double force_N = 0.0;             // normal
  double friction_force_N = 0.0;    // sum of the sizes of what resists slip
  double max_penetration_mm = 0.0;  // so far
  double max_slip_mm = 0.0;         // longest slip path
  double mean_slip_mm = 0.0;        // over the area that ever touched
  double max_pressure_MPa = 0.0;    // so far
  double stored_energy_mJ = 0.0;
  double friction_work_mJ = 0.0;  // lost
  double damping_work_mJ = 0.0;   // lost
};

struct SolveStatistics {
  bool finished = true;  // false in the solve.json of a run under way, which is renewed with every frame
  double time_s = 0.0;   // that the numbers below are of: duration_s when finished
  std::string program;   // its version line, with the commit
  std::string scene;     // the file that the run was given
  std::string scene_digest, card_digest, mesh_digest;  // of values and of the contents of files (analysis/identity.hpp)
  int cells = 0, nodes = 0, yarns = 0;                 // of the whole blank, as in mesh.vtu
  std::string symmetry = "none";                       // "quarter", "half", or "none": the whole is solved
  int cells_solved = 0;  // the cells of that quarter or half, those cut by a mirror plane included
  long steps = 0;
  double duration_s = 0.0;
  double wall_s = 0.0;               // of the time loop
  double checkpoint_wall_s = 0.0;    // part of wall_s; since the run began or was resumed
  double cell_steps_per_s = 0.0;     // of the cells solved
  double step_s = 0.0;               // smallest step taken
  std::string step_set_by;           // which part set the step, e.g. "yarn (warp, node 123)"
  double damping_per_s = 0.0;        // mass-proportional damping used
  double energy_error = 0.0;         // greatest |internal + kinetic + damping - external| / greatest energy
  double kinetic_to_internal = 0.0;  // greatest ratio after the first tenth of the travel
  double damping_work_mJ = 0.0;
  double bending_friction_work_mJ = 0.0;  // part of damping_work_mJ
  double bending_energy_mJ = 0.0;         // stored at the end; part of the internal energy
  double hourglass_energy_mJ = 0.0;       // part of it that one point per cell would not see (shell)
  double rotary_inertia_scale = 1.0;      // greatest factor on a node's rotary inertia (shell)
  double max_shear_angle_deg = 0.0;       // greatest |shear angle| in the last frame
  double max_yarn_strain = 0.0;
  int folded_cells = 0;  // greatest number at any history row
  int folded_cells_at_end = 0;
  int cells_beyond_card = 0;       // cells sheared past the range of the card's shear law in the last frame
  double yarn_strain_error = 0.0;  // 1; greatest strain too much or too little for a yarn's force, by
                                   // model.yarn_stiffness_scale, in the last frame (strain_error.hpp)
  double added_mass_t = 0.0;       // tonne; analysis.mass_scale, frame.mass_scale; real mass taken away negative
  // A start with random node displacements (analysis.perturbation) is compared with the same scene without it:
  double perturbation_distance_mm = 0.0;  // greatest distance of a node from where the clean run left it
  bool perturbation_returned = true;      // that distance is below 1 % of the spacing and no cell is folded
  double contact_penetration = 0.0;       // 1; greatest, as a fraction of the fabric's thickness
  double friction_work_mJ = 0.0;          // part of damping_work_mJ
  double contact_damping_work_mJ = 0.0;   // part of damping_work_mJ; contact dampers and guides of pushed tools
  double contact_wall_s = 0.0;            // part of wall_s
  int threads = 1;
  std::vector<PairStatistics> pairs = {};  // of a stack
};

// Writes frames as they come; result.pvd is renewed after each, so an interrupted run leaves a readable index.
// A frame is one grid of all yarn elements (lines) and then all cells (polygons), each in the mesh's order, at the
// current positions. So that every array holds a number on every element, and a viewer may average cells to points:
//   family            0 cell, 1 warp, 2 weft
//   shear_angle_deg   cells: signed; lines: mean of the cells beside it
//   absolute_shear_angle_deg   the same without its sign; lines: mean of the cells' absolute angles
//   yarn_strain, yarn_force_N     lines: their own; cells: mean of the yarn elements around it
//   warp_direction, weft_direction  cells: unit yarn directions; lines: their own in their family's array, else 0
//   folded            cells: 1 when folded; lines: 0
//   thickness_mm, areal_weight_ratio  cells: their own; lines: mean of the cells beside it
// Points carry displacement_mm, the field data TimeValue (s). With tools also:
//   contact_tool, contact_count, contact_force_N, contact_gap_mm, friction_state   points (contact_state.hpp)
//   contact_pressure_MPa, contact_share   cells: mean pressure of its nodes, share of them that touch a tool;
//                                         lines: the same of their two nodes
//   tool_NAME    field data, one per tool: its number in contact_tool
// Of a stack also:
//   ply          points, cells and lines: the number of the ply, 0 the lowest; field data ply_NAME: each ply's number
//   slip_mm (vector), slip_path_mm, ply_pressure_MPa, other_ply, ply_friction_state
//                points: against the ply they touch, other_ply, -1 where none (solver/state/ply_contact_state.hpp)
class FrameWriter {
public:
  // Keeps a reference to the mesh. Frames of an earlier run in `directory` are removed, but for the first, of the times
  // `kept` (s), which a resumed run goes on from. Throws FileError when one of them is not there, or DIR/frames is a
  // link. With `tools`, their names, fields must hold the state of contact.
  FrameWriter(std::filesystem::path directory, const Mesh& mesh, std::vector<double> kept = {},
              const std::vector<std::string>& tools = {});
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  // Packs and writes the frame beside what the caller does next, after waiting for the one before. Throws FileError for
  // the frame before; the last one's comes from settle().
  void write(const Fields& fields);
  [[nodiscard]] bool is_writing() const;
  [[nodiscard]] int count() const { return static_cast<int>(times_.size()); }
  [[nodiscard]] const std::vector<double>& times() const {
    return times_;
  }  // s; of the frames, the last at work included
  // Waits until all frames, and their index, are on the disk. Throws FileError.
  void settle();

private:
  struct Grid;  // the frame as VTK holds it; topology built once
  void write_last() const;
  void write_index() const;

  std::filesystem::path directory_;
  const Mesh& mesh_;
  std::vector<double> times_;  // s
  std::size_t settled_ = 0;    // frames known to be on the disk
  std::unique_ptr<Grid> grid_;
  std::future<void> at_work_;  // the last frame, until it is in its file; grid_ and times_ are its until then
};

struct FrameFile {
  double time = 0.0;
  std::filesystem::path file;
};
[[nodiscard]] std::vector<FrameFile> list_frames(const std::filesystem::path& directory);  // from result.pvd
// mm; per node, all of them finite. Throws FileError (not there), InputError (damaged, or not of this mesh).
[[nodiscard]] std::vector<Vec3> read_frame_positions(const std::filesystem::path& frame);
[[nodiscard]] std::vector<Vec3> read_frame_positions(const std::filesystem::path& frame, const Mesh& mesh);
// An array of a frame by name (cell, point or field data), tuple after tuple. Throws InputError when it is not there.
[[nodiscard]] std::vector<double> read_frame_array(const std::filesystem::path& frame, const std::string& name);

void write_history(const History& history, const std::filesystem::path& file);
// Heading and rows [first, last) as write_history writes them, and the rows alone.
[[nodiscard]] std::string history_text(const History& history, int first, int last);
[[nodiscard]] std::string history_rows_text(const History& history, int first, int last);
// A run that was killed while it wrote may leave a part of a line at the end, which then is left out.
enum class HistoryEnd { whole, may_be_torn };
[[nodiscard]] History read_history(const std::filesystem::path& file, HistoryEnd end = HistoryEnd::whole);
void write_statistics(const SolveStatistics& statistics, const std::filesystem::path& file);
[[nodiscard]] SolveStatistics read_statistics(const std::filesystem::path& file);

}  // namespace weaveform
