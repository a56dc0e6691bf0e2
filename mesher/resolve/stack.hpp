// The plies of a stack: what each of them leads to, and how they lie on each other.
#pragma once

#include "mesher/resolve/resolve.hpp"

namespace weaveform {

// Fills model.ply, model.pair and all that is the stack's own from model.scene, whose tools' files are there; goes as
// far as it can, like resolve().
void resolve_stack(Resolved& model, Findings& found, const ResolveChecks& checks, ResolveTo to);

// The same around the stack's mesh as it is there. Throws InputError when that is not of the scene's plies.
void resolve_stack_around(Resolved& model);

// mm; between the middle planes of a ply and the next above: half of each thickness, and the gap.
[[nodiscard]] double distance_between(const Resolved& model, std::size_t lower);

// The stack's mesh from those of its plies.
void join_plies(Resolved& model);

// The planes of all plies, and with them the stack's.
void mirror_stack(Resolved& model);

}  // namespace weaveform
