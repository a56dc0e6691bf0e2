// What a scene shows of itself before anything is computed: parts that do nothing, and loads beyond sense.
#pragma once

#include <string>
#include <vector>

#include "mesher/scene/scene.hpp"

namespace weaveform {

// One line each, in the words of a warning: nothing moves and nothing pulls; a grip whose travel is along what it
// leaves free, or that holds nothing; fabric that nothing holds and weight pulls; a weight far from Earth's; [accuracy] where nothing is open.
[[nodiscard]] std::vector<std::string> idle_parts(const Scene& scene);

}  // namespace weaveform
