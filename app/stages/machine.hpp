// What the machine has left for this process.
#pragma once

#include <filesystem>

namespace weaveform {

// bytes; the least of what the system says is available, what the process's control group leaves it, and what the limit
// on its address space does. Infinite where nothing can be learnt.
[[nodiscard]] double available_memory();

// bytes; free on the disk of `path`, or of its nearest ancestor that exists. Infinite where nothing can be learnt.
[[nodiscard]] double available_disk(const std::filesystem::path& path);

}  // namespace weaveform
