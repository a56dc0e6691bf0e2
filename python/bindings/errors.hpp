// Weaveform's exceptions as those of the Python package (weaveform/errors.py).
#pragma once

namespace weaveform::inside {

// From now on what is thrown to Python is InputError, PhysicsError, FileError or Interrupted of weaveform.errors, each
// with its lines. What Python knows itself (out of memory, a wrong argument) stays what it is.
void pass_errors_on();

}  // namespace weaveform::inside
