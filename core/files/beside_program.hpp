// Where the parts of the program lie that it does not hold itself.
#pragma once

#include <filesystem>
#include <string>

namespace weaveform {

// Beside the running program, where it was built; in libexec/weaveform, where it was installed. "" when in neither.
[[nodiscard]] std::filesystem::path beside_program(const std::string& name);

// Where it is first looked for, for a message.
[[nodiscard]] std::filesystem::path first_place(const std::string& name);

}  // namespace weaveform
