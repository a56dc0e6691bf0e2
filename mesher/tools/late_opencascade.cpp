#include <dlfcn.h>
#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files/beside_program.hpp"
#include "core/guard/guarded.hpp"
#include "mesher/tools/opencascade.hpp"

namespace weaveform {
namespace {

constexpr const char* module_name = "weaveform-opencascade.so";

FileError not_loaded(const char* why) {
  return FileError(
      fmt::format("the reader of CAD files cannot be loaded ({}); install weaveform again, or in its sources run ./dev "
                  "build, or give geometry as STL",
                  why));
}

const OpenCascade* load_module() {
  const std::string place = beside_program(module_name).string();
  // other programs that are linked with this library say where it was installed (RUNPATH; mesher/CMakeLists.txt)
  void* const module = dlopen(place.empty() ? module_name : place.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (module == nullptr) throw not_loaded(dlerror());
  const auto entry = reinterpret_cast<OpenCascadeEntry>(dlsym(module, opencascade_entry));
  if (entry == nullptr) throw not_loaded(dlerror());
  return entry({guarded_reading_is_done, guarded_progress});
}

}  // namespace

const OpenCascade& opencascade() {
  static const OpenCascade* const loaded = load_module();
  return *loaded;
}

}  // namespace weaveform
