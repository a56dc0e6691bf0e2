#include "solver/solve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesher/symmetry/cut_part.hpp"
#include "solver/bending/flexure.hpp"
#include "solver/motion/analysis.hpp"

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
void compare_with_clean_run(const Mesh& mesh, const Scene& scene, const Card& card, const SolveOptions& options,
                            SolveResult& result) {
  Scene clean = scene;
  clean.analysis.perturbation = 0.0;
  SolveOptions quiet = options;
  quiet.quiet = true;
  quiet.resume = false;
  const SolveResult reference = Analysis(mesh, nullptr, clean, card, {}, quiet).run();
  auto& s = result.statistics;
  s.perturbation_distance_mm = farthest(result.position, reference.position);
  s.perturbation_returned = s.folded_cells_at_end == reference.statistics.folded_cells_at_end &&
                            s.perturbation_distance_mm < returned_share * std::min(mesh.spacing[0], mesh.spacing[1]);
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
  std::optional<SymmetricPart> part;
  if (const Symmetry symmetry = find_symmetry(scene, card, mesh); !symmetry.plane.empty())
    part = cut_part(mesh, symmetry, choose_flexure(card, scene.model).bends_yarns);
  SolveResult result = Analysis(mesh, part ? &*part : nullptr, scene, card, directory, options).run();
  if (scene.analysis.perturbation > 0.0) {
    compare_with_clean_run(mesh, scene, card, options, result);
    if (!directory.empty()) write_statistics(result.statistics, directory / "solve.json");
  }
  return result;
}

}  // namespace weaveform
