// NumPy arrays over memory that is there, and over copies of what is computed.
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <cstring>
#include <vector>

namespace weaveform::inside {

namespace py = pybind11;

enum class Access { read, write };

// Views: no copy. `owner` is kept for as long as the array or a view of it is.
[[nodiscard]] py::array view(double* values, std::size_t count, const py::object& owner, Access access);
[[nodiscard]] py::array view(const int* values, std::size_t count, const py::object& owner);
[[nodiscard]] py::array view(std::vector<std::array<double, 3>>& rows, const py::object& owner);

// Copies, of the vectors' own types.
template <class T>
[[nodiscard]] py::array copied(const std::vector<T>& values) {
  py::array_t<T> array(static_cast<py::ssize_t>(values.size()));
  for (std::size_t k = 0; k < values.size(); ++k) array.mutable_data()[k] = values[k];
  return array;
}
template <class T, std::size_t N>
[[nodiscard]] py::array copied(const std::vector<std::array<T, N>>& rows) {
  py::array_t<T> array({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(N)});
  if (!rows.empty()) std::memcpy(array.mutable_data(), rows.data(), rows.size() * sizeof(rows.front()));
  return array;
}

}  // namespace weaveform::inside
