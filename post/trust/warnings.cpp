#include "post/trust/warnings.hpp"

#include "post/trust/borders.hpp"

namespace weaveform {

std::vector<std::string> warnings(const FinishedRun& run) {
  Warnings all;
  warn_of_coarse_on_tools(run, all);
  warn_of_fast_loading(run, all);
  warn_of_folds_of_the_mesh(run, all);
  warn_of_unsteady_tools(run, all);
  return all;
}

}  // namespace weaveform
