// What OpenCASCADE does for us. It is in a module of its own, weaveform-opencascade.so, which is loaded when CAD is first
// read and not when the program starts: OpenCASCADE costs each start 30 ms of processor time, six times what all
// else takes, and most runs read no CAD.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "mesher/tools/cad.hpp"
#include "mesher/tools/gmsh_session.hpp"

namespace weaveform {

// All in a guarded child only (core/guard/guarded.hpp). They throw InputError with OpenCASCADE's words when nothing comes
// of the file at `path`, whose format is given whatever its name.
struct OpenCascade {
  // Messages name `file`.
  CadSurface (*surface)(CadFormat format, const std::filesystem::path& path, double chord_tolerance,
                        const std::string& file);
  // Written anew as another format; false when OpenCASCADE cannot.
  bool (*rewrite)(CadFormat format, const std::filesystem::path& path, CadFormat to,
                  const std::filesystem::path& written);
  // Passes on a const TopoDS_Shape*, with faces that lie side by side sewn.
  void (*pass_on)(CadFormat format, const std::filesystem::path& path,
                  const std::function<void(const void* shape)>& take);
};

// The module; it stays loaded. Throws FileError when it cannot be.
[[nodiscard]] const OpenCascade& opencascade();

// How the module's work reaches the guard of the child that it works in: what is linked to the module is not that.
struct GuardSigns {
  void (*reading_is_done)() = [] {};
  void (*progress)(double fraction) = [](double /*any*/) {};
};

// The module's only symbol: `signs` are kept. Its number changes with anything in this header, so that a program does not
// take the module of another version.
inline constexpr const char* opencascade_entry = "weaveform_opencascade_1";
using OpenCascadeEntry = const OpenCascade* (*)(const GuardSigns& signs);

}  // namespace weaveform
