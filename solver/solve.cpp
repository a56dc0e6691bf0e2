#include "solver/solve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/files/files.hpp"
#include "mesher/resolve/resolve.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/prepare.hpp"
#include "solver/result/file_names.hpp"

namespace weaveform {
namespace {

constexpr double returned_share =
    0.01;  // of the smaller spacing; a hundredth of a cell is beyond what anyone reads off

double farthest(const std::vector<Vec3>& one, const std::vector<Vec3>& other) {
  double greatest = 0.0;
  for (std::size_t n = 0; n < one.size(); ++n)
    greatest =
        std::max(greatest, std::hypot(one[n][0] - other[n][0], one[n][1] - other[n][1], one[n][2] - other[n][2]));
  return greatest;
}

// Folded cells can carry nearly the right load, so a perturbed start is judged by positions, against the clean run.
void compare_with_clean_run(const Resolved& model, const std::filesystem::path& directory, const SolveOptions& options,
                            SolveResult& result) {
  Resolved clean = model;
  clean.scene.analysis.perturbation = 0.0;
  for (Resolved& ply : clean.ply) ply.scene.analysis.perturbation = 0.0;
  SolveOptions quiet = options;
  quiet.quiet = true;
  quiet.stop_at_step = 0;
  if (!directory.empty()) quiet.checkpoint_file = directory / file_name::clean_checkpoint;
  quiet.resume = options.resume && std::filesystem::exists(quiet.checkpoint_file);
  const SolveResult reference = Analysis(clean, {}, {}, quiet).run();
  auto& s = result.statistics;
  s.perturbation_distance_mm = farthest(result.position, reference.position);
  s.perturbation_returned =
      s.folded_cells_at_end == reference.statistics.folded_cells_at_end &&
      s.perturbation_distance_mm < returned_share * std::min(model.mesh.spacing[0], model.mesh.spacing[1]);
}

// What the run ended with is on the disk before the checkpoints go.
void close_run(const SolveStatistics& statistics, const std::filesystem::path& directory) {
  write_statistics(statistics, directory / file_name::statistics);
  for (const char* name : {file_name::history, file_name::statistics, "."}) settle_on_disk(directory / name);
  for (const char* name : {file_name::checkpoint, file_name::clean_checkpoint})
    std::filesystem::remove(directory / name);
}

}  // namespace

SolveResult solve(const Resolved& real, const std::filesystem::path& directory, const SolveOptions& options) {
  std::optional<Resolved> scaled;
  if (real.scene.analysis.mass_scale != 1.0) scaled = with_scaled_mass(real);
  const Resolved& model = scaled ? *scaled : real;
  SolveResult result = Analysis(model, parts_to_solve(model), directory, options).run();
  if (model.scene.analysis.perturbation > 0.0) compare_with_clean_run(model, directory, options, result);
  if (!directory.empty()) close_run(result.statistics, directory);
  return result;
}

SolveResult solve(const Mesh& mesh, const Scene& scene, const Card& card, const std::filesystem::path& directory,
                  const SolveOptions& options) {
  return solve(resolve_around(scene, card, mesh), directory, options);
}

bool has_checkpoint(const std::filesystem::path& directory) {
  return std::filesystem::exists(directory / file_name::checkpoint);
}

bool is_finished(const std::filesystem::path& directory) {
  const auto file = directory / file_name::statistics;
  return !has_checkpoint(directory) && std::filesystem::exists(file) && read_statistics(file).finished;
}

}  // namespace weaveform
