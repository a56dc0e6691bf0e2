#include "solver/analysis/outputs.hpp"

#include <algorithm>

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

}  // namespace

Outputs::Outputs(const Resolved& model, const World& world, std::filesystem::path directory)
    : scene_(model.scene),
      ply_(world.ply(0)),
      directory_(std::move(directory)),
      plane_(blank_plane(ply_.whole())),
      recorder_(ply_.holds().grips(), make_probes(scene_, ply_.whole(), model.extent()[0]), world.duration(),
                scene_.output.history),
      row_schedule_(world.duration(), scene_.output.history),
      frame_schedule_(world.duration(), scene_.output.frames) {
  if (scene_.frame)
    recorder_.evaluate_frame({scene_.frame->length, scene_.blank.size[0]},
                             static_cast<int>(ply_.holds().grips().size()) - 1);
  if (!scene_.tools.empty()) recorder_.record_tools(scene_.tools);
}

// The frames and the index follow the mesh's number of nodes; files of the run before stay until the checkpoint is
// read.
void Outputs::open_files() {
  if (directory_.empty()) return;
  frames_ = std::make_unique<FrameWriter>(directory_, ply_.whole(), frame_times_, tool_names(scene_));
  history_file_ =
      std::make_unique<HistoryFile>(directory_ / file_name::history, recorder_.history(), recorder_.closed_rows());
}

ContactState Outputs::whole_contact_state(const World& world) const {
  ContactState state = world.contact(0)->contact_state(ply_.state());
  if (ply_.part() == nullptr) return state;
  const auto share = node_share(ply_.mesh().symmetry, ply_.mesh().node_count());
  std::vector<int> source;
  std::vector<double> factor;
  for (const auto& image : ply_.part()->image) {
    source.push_back(image.node);
    factor.push_back(1.0 / share[image.node]);
  }
  return unfolded(state, source, factor);
}

bool Outputs::look(const World& world) {
  const double time = world.time();
  const bool row_due = row_schedule_.due(time), frame_due = frame_schedule_.due(time);
  const auto position = ply_.whole_positions();
  // the last row's are what a run ends with
  fields_ = frame_due || world.finished()
                ? compute_fields(ply_.whole(), ply_.card(), ply_.model(), time, position)
                : compute_row_fields(ply_.whole(), plane_, time, position, !scene_.measure.empty());
  if (row_due) {
    row_schedule_.advance(time);
    row_open_ = true;
  }
  if (!frame_due) return false;
  frame_schedule_.advance(time);
  if (world.contact(0) != nullptr) fields_.contact = whole_contact_state(world);
  if (!frames_) return false;
  frames_->write(fields_);
  frame_times_ = frames_->times();
  return true;
}

void Outputs::record_forces(World& world, double time) {
  recorder_.add_forces(time, world.kick(), world.ply(0).holds().whole_forces(), readings(world));
}

// The row's forces follow when their window closes; this step's open the next window when it is later than that.
void Outputs::close_row(const World& world) {
  row_open_ = false;
  recorder_.add_row(fields_.time, ply_.holds().displacement(), fields_, world.balance(), readings(world));
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
