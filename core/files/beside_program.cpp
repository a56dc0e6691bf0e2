#include "core/files/beside_program.hpp"

#include <system_error>

namespace weaveform {
namespace {

namespace fs = std::filesystem;

fs::path folder_of_program() {
  std::error_code unknown;
  return fs::read_symlink("/proc/self/exe", unknown).parent_path();
}

}  // namespace

fs::path beside_program(const std::string& name) {
  const fs::path here = folder_of_program();
  std::error_code unknown;
  for (const fs::path& place : {here / name, here / "../libexec/weaveform" / name})
    if (fs::exists(place, unknown)) return place.lexically_normal();
  return {};
}

fs::path first_place(const std::string& name) {
  return folder_of_program() / name;
}

}  // namespace weaveform
