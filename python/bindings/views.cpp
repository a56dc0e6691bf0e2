#include "views.hpp"

namespace weaveform::inside {
namespace {

py::array with_access(py::array array, Access access) {
  if (access == Access::read) array.attr("setflags")(py::arg("write") = false);
  return array;
}

}  // namespace

py::array view(double* values, std::size_t count, const py::object& owner, Access access) {
  return with_access(py::array_t<double>(static_cast<py::ssize_t>(count), values, owner), access);
}

py::array view(const int* values, std::size_t count, const py::object& owner) {
  return with_access(py::array_t<int>(static_cast<py::ssize_t>(count), values, owner), Access::read);
}

py::array view(std::vector<std::array<double, 3>>& rows, const py::object& owner) {
  return py::array_t<double>({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}}, rows.data()->data(), owner);
}

}  // namespace weaveform::inside
