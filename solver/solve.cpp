#include "solver/solve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/files/files.hpp"
#include "mesher/symmetry/cut_part.hpp"
#include "mesher/tools/tool.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/interrupt.hpp"
#include "solver/bending/flexure.hpp"

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

constexpr const char* checkpoint_name = "checkpoint.bin";
constexpr const char* clean_checkpoint_name = "checkpoint_clean.bin";  // of the run that a perturbed one is set beside

// Folded cells can carry nearly the right load, so a perturbed start is judged by positions, against the clean run.
void compare_with_clean_run(const Mesh& mesh, const Scene& scene, const Card& card, const std::vector<Tool>& tools,
                            const std::filesystem::path& directory, const SolveOptions& options, SolveResult& result) {
  Scene clean = scene;
  clean.analysis.perturbation = 0.0;
  SolveOptions quiet = options;
  quiet.quiet = true;
  quiet.stop_at_step = 0;
  if (!directory.empty()) quiet.checkpoint_file = directory / clean_checkpoint_name;
  quiet.resume = options.resume && std::filesystem::exists(quiet.checkpoint_file);
  const SolveResult reference =
      Analysis({.whole = mesh, .scene = clean, .card = card, .tools = tools}, {}, quiet).run();
  auto& s = result.statistics;
  s.perturbation_distance_mm = farthest(result.position, reference.position);
  s.perturbation_returned = s.folded_cells_at_end == reference.statistics.folded_cells_at_end &&
                            s.perturbation_distance_mm < returned_share * std::min(mesh.spacing[0], mesh.spacing[1]);
}

// What the run ended with is on the disk before the checkpoints go.
void close_run(const SolveStatistics& statistics, const std::filesystem::path& directory) {
  write_statistics(statistics, directory / "solve.json");
  for (const char* name : {"history.csv", "solve.json", "."}) settle_on_disk(directory / name);
  for (const char* name : {checkpoint_name, clean_checkpoint_name}) std::filesystem::remove(directory / name);
}

// The fabric with analysis.mass_scale times its mass; loading.cpp and gravity.cpp leave it out again, for durations are
// chosen by the real mass and weight is the real weight.
Mesh heavier(Mesh mesh, double mass_scale) {
  for (double& mass : mesh.nodes.mass) mass *= mass_scale;
  return mesh;
}

}  // namespace

SolveResult solve(const Mesh& real, const Scene& scene, const Card& card, const std::filesystem::path& directory,
                  const SolveOptions& options) {
  std::optional<Mesh> scaled;
  if (scene.analysis.mass_scale != 1.0) scaled = heavier(real, scene.analysis.mass_scale);
  const Mesh& mesh = scaled ? *scaled : real;
  const InterruptWatch interrupt;
  const std::vector<Tool> tools = make_tools(scene, mesh);
  std::optional<SymmetricPart> part;
  if (const Symmetry symmetry = find_symmetry(scene, card, mesh); !symmetry.plane.empty())
    part = cut_part(mesh, symmetry, choose_flexure(card, scene.model).bends_yarns);
  SolveResult result =
      Analysis({.whole = mesh, .part = part ? &*part : nullptr, .scene = scene, .card = card, .tools = tools},
               directory, options)
          .run();
  if (scene.analysis.perturbation > 0.0) compare_with_clean_run(mesh, scene, card, tools, directory, options, result);
  if (!directory.empty()) close_run(result.statistics, directory);
  return result;
}

bool has_checkpoint(const std::filesystem::path& directory) {
  return std::filesystem::exists(directory / checkpoint_name);
}

bool is_finished(const std::filesystem::path& directory) {
  const auto file = directory / "solve.json";
  return !has_checkpoint(directory) && std::filesystem::exists(file) && read_statistics(file).finished;
}

}  // namespace weaveform
