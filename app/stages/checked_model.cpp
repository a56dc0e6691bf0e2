#include "app/stages/checked_model.hpp"

#include <memory>

#include "app/stages/room.hpp"
#include "solver/bending/flexure.hpp"
#include "solver/coupling/coupled_lattice.hpp"
#include "solver/solve.hpp"

namespace weaveform {

Resolved checked_model(const std::filesystem::path& scene_file, const std::vector<std::string>& overrides, bool yes,
                       Look look, ResolveTo to) {
  Findings found(look == Look::for_first_complaint ? Findings::Want::first : Findings::Want::all);
  const ResolveChecks checks{
      .of_card =
          [](const Scene& scene, const Card& card) {
            require_coupling(card, scene.model);
            refuse_friction_in_impulses(choose_flexure(card, scene), scene.analysis.bending_every);
          },
      .of_size = [yes, bytes = std::make_shared<double>(0.0)](
                     const Scene& scene, const Card& card,
                     const BlankOutline& outline) { *bytes = require_memory(scene, card, outline, yes, *bytes); }};
  Resolved model = resolve(scene_file, overrides, found, checks, to);
  if (look == Look::with_first_step && model.mesh.cells.size() > 0)
    found.attempt([&] {
      // a perturbed analysis is two
      (void)solve(without_perturbation(model), {}, {.threads = 1, .quiet = true, .most_steps = 1});
    });
  found.throw_if_any();
  return model;
}

}  // namespace weaveform
