// The targets of each kind of input, and what they share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "fabric/card/card.hpp"
#include "mesher/scene/reader.hpp"
#include "tests/fuzz/targets.hpp"

namespace weaveform::fuzz {

[[nodiscard]] std::vector<Target> scene_targets();     // what a person writes
[[nodiscard]] std::vector<Target> table_targets();     // rows of numbers, measured or our own
[[nodiscard]] std::vector<Target> geometry_targets();  // surfaces, meshes, scripts
[[nodiscard]] std::vector<Target> result_targets();    // what a run leaves behind

template <class Read>
void answered(const Read& read) {
  try {
    read();
  } catch (const InputError&) {
  } catch (const FileError&) {
  }
}

// What must hold for every input that was taken; else this one is a finding.
inline void hold(bool so) {
  if (!so) __builtin_trap();
}

inline std::string text_of(std::string_view bytes) {
  return {bytes.begin(), bytes.end()};
}

inline const Scene& plain_scene() {
  static const Scene scene = read_scene_text("[fabric]\nmaterial = \"twintex-pw\"\n", "scene.toml");
  return scene;
}

inline const Card& plain_card() {
  static const Card card = load_card("twintex-pw", "");
  return card;
}

}  // namespace weaveform::fuzz
