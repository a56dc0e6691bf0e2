// What the scene showed of itself before the run stays true after it.
#include "mesher/scene/idle.hpp"
#include "post/trust/borders.hpp"

namespace weaveform {

void warn_of_idle_scene(const FinishedRun& run, Warnings& warnings) {
  for (std::string& line : idle_parts(run.scene)) warnings.push_back(std::move(line));
}

}  // namespace weaveform
