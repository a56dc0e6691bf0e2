// What a scene leaves to the program: the coarsest mesh and the cheapest elements that serve the wanted accuracy.
// docs/automatic.md has the rules, what they are from and what came of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/outline/blank_outline.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// Gives every open key of a scene of one ply its value and puts it on record in scene.taken, and what was wanted in
// scene.accuracy. What is given stays as it is. A finer wanted accuracy never gives a coarser mesh. Throws what
// make_tools throws, for the radii of tools are looked at.
void take_what_is_open(Scene& scene, const Card& card, const BlankOutline& outline);

// The same for one ply of a stack, whose `own` scene (scene_of_ply) gets it too.
void take_what_is_open(Scene& stack, std::size_t ply, Scene& own, const Card& card, const BlankOutline& outline);

// The scene of a file as resolve() has it, without a mesh. Throws what read_scene, load_card, read_blank_outline and
// make_tools throw.
[[nodiscard]] Scene read_taken_scene(const std::filesystem::path& scene_file,
                                     const std::vector<std::string>& overrides = {});

}  // namespace weaveform
