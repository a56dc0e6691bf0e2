#include "tests/fuzz/targets.hpp"

#include "tests/fuzz/rooms.hpp"

namespace weaveform::fuzz {

const std::vector<Target>& targets() {
  static const std::vector<Target> all = [] {
    std::vector<Target> together;
    for (const auto& room : {scene_targets(), table_targets(), geometry_targets(), result_targets()})
      together.insert(together.end(), room.begin(), room.end());
    return together;
  }();
  return all;
}

}  // namespace weaveform::fuzz
