// What goes wrong with one ply of a stack says which one it is.
#pragma once

#include <cstddef>
#include <functional>

#include "mesher/resolve/resolved.hpp"

namespace weaveform {

// Runs `look`; an InputError, FileError or PhysicsError of it goes on with the ply's name before what it says:
// "scene.toml: blank.size: ..." becomes "scene.toml: ply 'top': blank.size: ...".
void of_ply(const Resolved& model, std::size_t ply, const std::function<void()>& look);

}  // namespace weaveform
