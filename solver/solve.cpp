#include "solver/solve.hpp"

#include "solver/motion/analysis.hpp"

namespace weaveform {

SolveResult solve(const Mesh& mesh, const Scene& scene, const Card& card, const std::filesystem::path& directory,
                  const SolveOptions& options) {
  return Analysis(mesh, scene, card, directory, options).run();
}

}  // namespace weaveform
