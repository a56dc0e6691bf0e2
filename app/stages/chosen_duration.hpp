// The duration of a scene that says how much of the loads inertia may be (analysis.inertia) and leaves the duration to the
// program: trials on coarser meshes, for the share goes with 1/duration^2 (post/trust/inertia.hpp) and depends little on
// the mesh. Tools that travel without a `speed` of their own then get one too: the course that starts and stops gently
// (post/trust/gentle_course.hpp), unless it takes longer than the smooth step by more than a tenth.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "mesher/resolve/resolved.hpp"

namespace weaveform {

using SpeedTable = std::vector<std::vector<double>>;  // [part of the duration, relative speed], as ToolSpec::speed

struct ChosenDuration {
  double duration = 0.0;  // s; rounded up to three digits
  double share = 0.0;     // 1; of the last trial, scaled to this duration
  int trials = 0;
  std::vector<int> cells;               // of the trials' meshes
  std::vector<std::string> tools = {};  // that get the speed below; none: all have their own, or the smooth step
  SpeedTable speed = {};
  double smooth_duration = 0.0;  // s; that the smooth step would take in place of it
};

// Whoever asked for trials stopped them before a duration was chosen.
class TrialsStopped : public Interrupted {
public:
  explicit TrialsStopped(double so_far) : Interrupted("trials for analysis.duration stopped"), so_far_(so_far) {}
  // s; as the last trial that ended had it, of one of the courses and meshes; 0 where none ended.
  [[nodiscard]] double so_far() const { return so_far_; }

private:
  double so_far_;
};

// None when the scene does not ask for it: without analysis.inertia, or with a duration or loading_speed of its own.
// `stop` is asked after every step of a trial. Throws InputError when nothing moves that could be slower, or what the
// scene itself throws, PhysicsError when no trial comes to its end, TrialsStopped.
[[nodiscard]] std::optional<ChosenDuration> choose_duration(const std::string& scene_file,
                                                            const std::vector<std::string>& overrides,
                                                            const std::function<bool()>& stop = {});

// The same of a model whose mesh is given, one from another code: trials on that mesh, two to four times the run's own
// work. Of these, stopped ones throw Interrupted.
[[nodiscard]] std::optional<ChosenDuration> choose_duration(const Resolved& model,
                                                            const std::function<bool()>& stop = {});

// Where one was chosen: duration and speeds as the scene's own, on record in scene.taken; or as more overrides.
void set_duration(Resolved& model, const std::optional<ChosenDuration>& chosen);
[[nodiscard]] std::vector<std::string> with_duration(std::vector<std::string> overrides,
                                                     const std::optional<ChosenDuration>& chosen);

}  // namespace weaveform
