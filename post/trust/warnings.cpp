#include "post/trust/warnings.hpp"

#include <array>

#include "post/trust/borders.hpp"

namespace weaveform {
namespace {

struct Border {
  void (*look)(const FinishedRun&, Warnings&);
  WarningsOf of;
};

// In the order in which they are said.
constexpr std::array borders = {Border{warn_of_bias_extension_mesh, WarningsOf::one_ply},
                                Border{warn_of_coarse_on_tools, WarningsOf::one_ply},
                                Border{warn_of_missed_accuracy, WarningsOf::one_ply},
                                Border{warn_of_fast_loading, WarningsOf::whole_run},
                                Border{warn_of_unrest, WarningsOf::whole_run},
                                Border{warn_of_folds_of_the_mesh, WarningsOf::one_ply},
                                Border{warn_of_unsteady_tools, WarningsOf::whole_run},
                                Border{warn_of_compressed_yarns, WarningsOf::one_ply},
                                Border{warn_of_energy_error, WarningsOf::whole_run},
                                Border{warn_of_folded_cells, WarningsOf::whole_run},
                                Border{warn_of_formulation, WarningsOf::one_ply},
                                Border{warn_of_idle_scene, WarningsOf::whole_run},
                                Border{warn_of_idle_tools, WarningsOf::whole_run},
                                Border{warn_of_stretch_beyond_card, WarningsOf::one_ply},
                                Border{warn_of_shear_beyond_card, WarningsOf::one_ply}};

}  // namespace

std::vector<std::string> warnings(const FinishedRun& run, WarningsOf of) {
  Warnings all;
  for (const Border& border : borders)
    if (of == WarningsOf::all || of == border.of) border.look(run, all);
  return all;
}

}  // namespace weaveform
