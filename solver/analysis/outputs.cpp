#include "solver/analysis/outputs.hpp"

#include <algorithm>
#include <numeric>

#include "core/vector/append.hpp"
#include "solver/bending/flexure.hpp"
#include "solver/result/file_names.hpp"

namespace weaveform {
namespace {

std::vector<std::string> tool_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& tool : scene.tools) names.push_back(tool.name);
  return names;
}

const std::vector<ToolReading>& readings(const World& world) {
  static const std::vector<ToolReading> none;
  return world.tools() != nullptr ? world.tools()->readings() : none;
}

std::vector<BlankPlane> planes_of(const World& world) {
  std::vector<BlankPlane> planes;
  for (std::size_t k = 0; k < world.size(); ++k) planes.push_back(blank_plane(world.ply(k).whole()));
  return planes;
}

// Of the plies of a stack, whose greatest angle is shown, all; of a single one those of its measures.
std::vector<std::vector<int>> cells_looked_at(const World& world, bool is_stack, const std::vector<Probe>& probes) {
  std::vector<std::vector<int>> cells(world.size());
  if (is_stack)
    for (std::size_t k = 0; k < world.size(); ++k) {
      cells[k].resize(world.ply(k).whole().cells.size());
      std::iota(cells[k].begin(), cells[k].end(), 0);
    }
  else
    for (const Probe& probe : probes) append(cells.front(), probe.cell);
  return cells;
}

ContactState whole_contact_state(const Ply& ply, const Contact& contact) {
  ContactState state = contact.contact_state(ply.state());
  if (ply.part() == nullptr) return state;
  const auto share = node_share(ply.mesh().symmetry, ply.mesh().node_count());
  std::vector<int> source;
  std::vector<double> factor;
  for (const auto& image : ply.part()->image) {
    source.push_back(image.node);
    factor.push_back(1.0 / share[image.node]);
  }
  return unfolded(state, source, factor);
}

}  // namespace

// Sums are those of all parts.
std::vector<PairReading> whole_pairs(const World& world) {
  if (world.ply_contact() == nullptr) return {};
  std::vector<PairReading> pairs = world.ply_contact()->pairs();
  for (PairReading& pair : pairs)
    for (double* sum :
         {&pair.area, &pair.force, &pair.friction_force, &pair.stored, &pair.friction_work, &pair.damping_work})
      *sum *= world.parts();
  return pairs;
}

Outputs::Outputs(const Resolved& model, const World& world, std::filesystem::path directory)
    : scene_(model.scene),
      whole_(model.mesh),
      directory_(std::move(directory)),
      plane_(planes_of(world)),
      grips_(world),
      recorder_(grips_.grips(), make_probes(model), world.duration(), scene_.output.history),
      row_schedule_(world.duration(), scene_.output.history),
      frame_schedule_(world.duration(), scene_.output.frames) {
  for (std::size_t k = 0; k < model.plies(); ++k)
    if (has_friction(choose_flexure(model.of_ply(k).card, model.of_ply(k).scene))) {
      recorder_.record_bending_friction();
      break;
    }
  if (scene_.frame)
    recorder_.evaluate_frame({scene_.frame->length, model.of_ply(0).scene.blank.size[0]},
                             static_cast<int>(grips_.grips().size()) - 1);
  if (!scene_.tools.empty()) recorder_.record_tools(scene_.tools);
  looked_at_ = cells_looked_at(world, !whole_.ply.empty(), recorder_.probes());
  if (!whole_.ply.empty()) recorder_.record_plies(whole_.cells, whole_.ply);
}

// The frames and the index follow the mesh's number of nodes; files of the run before stay until the checkpoint is
// read.
void Outputs::open_files() {
  if (directory_.empty()) return;
  frames_ = std::make_unique<FrameWriter>(directory_, whole_, frame_times_, tool_names(scene_));
  history_file_ =
      std::make_unique<HistoryFile>(directory_ / file_name::history, recorder_.history(), recorder_.closed_rows());
}

// Of a frame everything, with what the contacts show; of a row what it shows.
Fields Outputs::fields_of_ply(const World& world, std::size_t number, bool frame_due) const {
  const Ply& ply = world.ply(number);
  const double time = world.time();
  const auto position = ply.whole_positions();
  // the last row's are what a run ends with
  Fields fields = frame_due || world.finished()
                      ? compute_fields(ply.whole(), ply.card(), ply.model(), time, position)
                      : compute_row_fields(ply.whole(), plane_[number], time, position, looked_at_[number]);
  if (!frame_due) return fields;
  if (world.contact(number) != nullptr) fields.contact = whole_contact_state(ply, *world.contact(number));
  if (world.ply_contact() != nullptr) {
    fields.between = world.ply_contact()->state_of(static_cast<int>(number));
    if (ply.part() != nullptr) fields.between = unfolded(*fields.between, *ply.part());
  }
  return fields;
}

bool Outputs::look(const World& world) {
  const double time = world.time();
  const bool row_due = row_schedule_.due(time), frame_due = frame_schedule_.due(time);
  std::vector<Fields> of_ply(world.size());
  world.team().run(static_cast<int>(world.size()), [&](int k) { of_ply[k] = fields_of_ply(world, k, frame_due); });
  fields_ = std::move(of_ply.front());
  for (std::size_t k = 1; k < world.size(); ++k) append(fields_, of_ply[k]);
  if (row_due) {
    row_schedule_.advance(time);
    row_open_ = true;
  }
  if (!frame_due) return false;
  frame_schedule_.advance(time);
  if (!frames_) return false;
  frames_->write(fields_);
  frame_times_ = frames_->times();
  return true;
}

void Outputs::record_forces(World& world, double time) {
  recorder_.add_forces(time, world.kick(), grips_.forces(world), readings(world));
}

// The row's forces follow when their window closes; this step's open the next window when it is later than that.
void Outputs::close_row(const World& world) {
  row_open_ = false;
  recorder_.add_row(fields_.time, grips_.displacements(world), fields_, world.balance(), readings(world),
                    whole_pairs(world));
}

void Outputs::append_rows() {
  if (history_file_) history_file_->append(recorder_.history(), recorder_.closed_rows());
}

void Outputs::finish() {
  recorder_.finish();
  settle();
  write_history_file();
}

void Outputs::write_history_file() const {
  if (!directory_.empty()) write_history(recorder_.history(), directory_ / file_name::history);
}

void Outputs::settle() {
  if (frames_) frames_->settle();
}

void Outputs::archive(Archive& archive) {
  archive.list("times of frames", frame_times_, 0, static_cast<std::size_t>(scene_.output.frames) + 1, not_negative);
  if (!std::is_sorted(frame_times_.begin(), frame_times_.end())) throw DamagedState{"frames out of order"};
  recorder_.archive(archive);
  row_schedule_.archive(archive, recorder_.history().row.size());
  frame_schedule_.archive(archive, frame_times_.size());
}

}  // namespace weaveform
