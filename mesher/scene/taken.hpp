// What a scene leaves to the program ("auto" of blank.coarsening, model.yarn and model.cell, a duration that
// analysis.inertia asks for, and with it the speed of tools that travel), and the record of what was taken, which goes
// with the scene into the result folder.
#pragma once

#include <string>
#include <vector>

#include "mesher/scene/scene.hpp"

namespace weaveform {

inline constexpr const char* duration_key = "analysis.duration";  // taken by the program: app/stages/chosen_duration

// 1; analysis.inertia of a scene whose tools travel and that has duration = "auto" in so many words, but no inertia.
inline constexpr double inertia_of_auto = 0.01;

// "tools.NAME.speed", which is taken with the duration.
[[nodiscard]] std::string speed_key(const std::string& tool);

// Whether mesh or elements of any ply are still open (mesher/automatic takes them).
[[nodiscard]] bool leaves_open(const Scene& scene);
[[nodiscard]] bool leaves_open(const BlankSpec& blank, const ModelSpec& model);

// Whether this key of a record is open.
[[nodiscard]] bool leaves_open(const Scene& scene, const std::string& key);

// The entry about `key`; null when there is none.
[[nodiscard]] const TakenSpec* find_taken(const Scene& scene, const std::string& key);

// Leaves out entries whose key has another value by now, for that was given by hand.
void drop_overruled(Scene& scene);

// Of a scene cut out of a stack (ply_scene.hpp): entries of [[ply]] under the keys of a scene of one ply, and back.
[[nodiscard]] std::vector<TakenSpec> taken_of_ply(const std::vector<TakenSpec>& taken, const std::string& ply);
[[nodiscard]] TakenSpec of_stack(TakenSpec taken, const std::string& ply);

// "blank.coarsening = [1.6, 1.6]: why"; then, where something is missed, a line in the words of a warning.
[[nodiscard]] std::vector<std::string> taken_lines(const Scene& scene);
[[nodiscard]] std::vector<std::string> missed_lines(const Scene& scene);

// "KEY=VALUE" for --set, of the entries that `scene` leaves open.
[[nodiscard]] std::vector<std::string> as_overrides(const std::vector<TakenSpec>& taken, const Scene& scene);

}  // namespace weaveform
