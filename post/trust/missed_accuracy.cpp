// What was wanted and is not reached by the mesh and elements that were taken for it (mesher/automatic).
#include "core/vector/append.hpp"
#include "mesher/scene/taken.hpp"
#include "post/trust/borders.hpp"

namespace weaveform {

void warn_of_missed_accuracy(const FinishedRun& run, Warnings& warnings) {
  append(warnings, missed_lines(run.scene));
}

}  // namespace weaveform
