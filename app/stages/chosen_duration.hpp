// The duration of a scene that says how much of the loads inertia may be (analysis.inertia) and leaves the duration to the
// program: trials on a coarser mesh, for the share goes with 1/duration^2 (post/trust/inertia.hpp) and depends little on
// the mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/resolve/resolved.hpp"

namespace weaveform {

struct ChosenDuration {
  double duration = 0.0;  // s; rounded up to three digits
  double share = 0.0;     // 1; of the last trial, scaled to this duration
  int cells = 0;          // of the trials' mesh
  int trials = 0;
};

// None when the scene does not ask for it: without analysis.inertia, or with a duration or loading_speed of its own.
// Throws InputError when nothing moves that could be slower, or what the scene itself throws.
[[nodiscard]] std::optional<ChosenDuration> choose_duration(const std::string& scene_file,
                                                            const std::vector<std::string>& overrides);

// Where one was chosen: the duration as the scene's own, on record in scene.taken; or as one more override.
void set_duration(Resolved& model, const std::optional<ChosenDuration>& chosen);
[[nodiscard]] std::vector<std::string> with_duration(std::vector<std::string> overrides,
                                                     const std::optional<ChosenDuration>& chosen);

}  // namespace weaveform
