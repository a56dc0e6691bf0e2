#include "solver/result/result_folder.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/resolve/resolve.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/scene_copy.hpp"
#include "mesher/scene/taken.hpp"
#include "solver/result/file_names.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

constexpr const char* by_meshing = "weaveform mesh SCENE --output DIR";
constexpr const char* by_solving = "weaveform solve DIR";
constexpr double rounding = 1.0 + 1e-12;  // of times

fs::path present(const fs::path& directory, const char* name, const char* made_by) {
  fs::path file = directory / name;
  if (!fs::is_regular_file(file))
    throw FileError(fmt::format("{}: no such file; make it with '{}'", file.string(), made_by));
  return file;
}

}  // namespace

const Scene& ResultFolder::scene() {
  if (!has_scene_) model_.scene = read_scene(present(directory_, file_name::scene, by_meshing));
  if (leaves_open(model_.scene))
    throw InputError(
        fmt::format("{}: mesh or elements are \"auto\", and its mesh was made of one choice of them; make it "
                    "again with 'weaveform mesh'",
                    model_.scene.file));
  has_scene_ = true;
  return model_.scene;
}

const Card& ResultFolder::card() {
  if (!has_card_) model_.card = load_card(scene().fabric.material, scene().file);
  has_card_ = true;
  return model_.card;
}

const Mesh& ResultFolder::mesh() {
  if (!has_mesh_) model_.mesh = read_mesh(present(directory_, file_name::mesh, by_meshing));
  has_mesh_ = true;
  return model_.mesh;
}

const Resolved& ResultFolder::model() {
  if (is_resolved_) return model_;
  (void)card();
  (void)mesh();
  model_ = resolve_around(std::move(model_.scene), std::move(model_.card), std::move(model_.mesh));
  is_resolved_ = true;
  return model_;
}

const SolveStatistics& ResultFolder::statistics() {
  if (!statistics_) statistics_ = read_statistics(present(directory_, file_name::statistics, by_solving));
  return *statistics_;
}

bool ResultFolder::unfinished() {
  return fs::exists(directory_ / file_name::statistics) && !statistics().finished;
}

const std::vector<FrameFile>& ResultFolder::frames() {
  if (frames_) return *frames_;
  (void)present(directory_, file_name::index, by_solving);
  std::vector<FrameFile> frames = list_frames(directory_);
  if (unfinished())  // killed between a frame and its statistics
    std::erase_if(frames, [&](const FrameFile& frame) { return frame.time > rounding * statistics().time_s; });
  if (frames.empty())
    throw InputError(fmt::format("{}: lists no frame; solve again", (directory_ / file_name::index).string()));
  return frames_.emplace(std::move(frames));
}

std::vector<Vec3> ResultFolder::positions(const FrameFile& frame) {
  std::vector<Vec3> position = read_frame_positions(frame.file);
  if (static_cast<int>(position.size()) != mesh().node_count())
    throw InputError(fmt::format("{}: {} nodes, but {} has {}; the folder mixes two runs, solve again",
                                 frame.file.string(), position.size(), file_name::mesh, mesh().node_count()));
  return position;
}

const History& ResultFolder::history() {
  if (history_) return *history_;
  const fs::path file = present(directory_, file_name::history, by_solving);
  if (!unfinished()) return history_.emplace(read_history(file));
  History history = read_history(file, HistoryEnd::may_be_torn);
  const double last = frames().back().time;
  std::erase_if(history.row, [&](const auto& row) { return row.front() > rounding * last; });
  if (history.row.empty())
    throw FileError(fmt::format("{}: the run was stopped before its first row; go on with --resume", file.string()));
  return history_.emplace(std::move(history));
}

}  // namespace weaveform
