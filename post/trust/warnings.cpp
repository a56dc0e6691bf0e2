#include "post/trust/warnings.hpp"

#include "post/trust/borders.hpp"

namespace weaveform {

std::vector<std::string> warnings(const FinishedRun& run) {
  Warnings all;
  warn_of_coarse_on_tools(run, all);
  warn_of_fast_loading(run, all);
  warn_of_folds_of_the_mesh(run, all);
  warn_of_unsteady_tools(run, all);
  warn_of_compressed_yarns(run, all);
  warn_of_energy_error(run, all);
  warn_of_folded_cells(run, all);
  warn_of_formulation(run, all);
  warn_of_idle_scene(run, all);
  warn_of_idle_tools(run, all);
  warn_of_stretch_beyond_card(run, all);
  warn_of_shear_beyond_card(run, all);
  return all;
}

}  // namespace weaveform
