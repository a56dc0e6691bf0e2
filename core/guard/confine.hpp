// What a process gives up before it looks at a file that nobody vouches for.
#pragma once

#include <filesystem>

namespace weaveform {

// From here on this process starts no program or process, opens no file for writing, makes, renames or removes none,
// opens no connection, and traces or signals nobody else: such calls fail with EPERM. Cannot be undone. By a filter of
// system calls (seccomp; Linux on x86-64 and aarch64). Returns whether it is in place; where the kernel has none, the
// limits of core/guard/guarded.hpp are all there is.
//
// With a `writable_folder` files can be written there, and nowhere else where the kernel has Landlock (5.13 and later).
bool confine_process(const std::filesystem::path& writable_folder = {});

}  // namespace weaveform
