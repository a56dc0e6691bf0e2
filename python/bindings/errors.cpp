#include "errors.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "core/error.hpp"

namespace weaveform::inside {
namespace {

namespace py = pybind11;

void raise(const char* kind, const std::vector<std::string>& lines) {
  const py::object error = py::module_::import("weaveform.errors").attr(kind);
  PyErr_SetObject(error.ptr(), error(lines).ptr());
}

}  // namespace

void pass_errors_on() {
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise("InputError", error.complaints());
    } catch (const FileError& error) {
      raise("FileError", error.complaints());
    } catch (const PhysicsError& error) {
      raise("PhysicsError", {error.what()});
    } catch (const Interrupted& error) {
      raise("Interrupted", {error.what()});
    }
  });
}

}  // namespace weaveform::inside
