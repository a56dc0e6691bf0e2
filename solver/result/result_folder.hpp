// A result folder, opened. It knows what lies where (each name stands with who writes it: mesher/scene/scene_copy.hpp,
// mesher/mesh/mesh_io.hpp, file_names.hpp), reads each thing when it is first asked for, and keeps it.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "mesher/resolve/resolved.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

// Not for two threads at once. What is asked for throws FileError when its file is not there, with the command that
// makes it, or cannot be read, and InputError when it is damaged.
class ResultFolder {
public:
  explicit ResultFolder(std::filesystem::path directory) : directory_(std::move(directory)) {}
  // Of a process that knows already what the folder's scene, card and mesh lead to.
  ResultFolder(std::filesystem::path directory, Resolved model)
      : directory_(std::move(directory)),
        has_scene_(true),
        has_card_(true),
        has_mesh_(true),
        is_resolved_(true),
        model_(std::move(model)) {}

  [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }

  [[nodiscard]] const Scene& scene();
  [[nodiscard]] const Card& card();
  [[nodiscard]] const Mesh& mesh();
  // With outline, tools and symmetry, found when first asked for (resolve_around, which says what else is thrown).
  [[nodiscard]] const Resolved& model();

  // The solve's. Of a run that is not finished, history and frames go to the time of its statistics; what the file of a
  // running or killed one holds beyond, and a torn line at its end, are left out.
  [[nodiscard]] const SolveStatistics& statistics();
  [[nodiscard]] const History& history();
  [[nodiscard]] const std::vector<FrameFile>& frames();               // one at least
  [[nodiscard]] std::vector<Vec3> positions(const FrameFile& frame);  // mm; as many as the mesh has nodes

private:
  [[nodiscard]] bool unfinished();  // what an older program left without statistics counts as finished

  std::filesystem::path directory_;
  bool has_scene_ = false, has_card_ = false, has_mesh_ = false, is_resolved_ = false;
  Resolved model_;
  std::optional<SolveStatistics> statistics_;
  std::optional<History> history_;
  std::optional<std::vector<FrameFile>> frames_;
};

}  // namespace weaveform
