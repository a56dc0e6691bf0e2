// An unstructured grid out of a .vtu file as plain arrays, whoever wrote it; the only way such files are read here.
//
// VTK's reader believes what a file says of itself; damaged files make it crash, go on for ever or ask for all memory.
// It therefore works in a child process (core/guard/guarded.hpp), and what it makes of the file is looked at before it
// is used: every cell names points that are there, every array has as many values as its place asks for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace weaveform {

enum class VtuType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

template <class Value>
struct VtuTypeOf;
template <>
struct VtuTypeOf<std::uint8_t> {
  static constexpr VtuType value = VtuType::uint8;
};
template <>
struct VtuTypeOf<std::int32_t> {
  static constexpr VtuType value = VtuType::int32;
};
template <>
struct VtuTypeOf<double> {
  static constexpr VtuType value = VtuType::float64;
};

struct VtuArray {
  std::string name;
  VtuType type = VtuType::float64;
  int components = 1;
  std::size_t tuples = 0;
  std::vector<char> bytes;  // tuple after tuple

  [[nodiscard]] std::size_t size() const { return tuples * static_cast<std::size_t>(components); }
  template <class Value>
  [[nodiscard]] bool holds() const {
    return type == VtuTypeOf<Value>::value;
  }
  // Bit for bit. Only of an array that holds this type.
  template <class Value>
  [[nodiscard]] Value at(std::size_t k) const {
    Value value{};
    std::memcpy(&value, bytes.data() + k * sizeof(Value), sizeof(Value));
    return value;
  }
  [[nodiscard]] double as_double(std::size_t k) const;  // of any type
};

struct VtuGrid {
  std::vector<std::array<double, 3>> point;
  bool double_precision = false;           // of the points in the file
  std::vector<std::uint8_t> type;          // of each cell, as VTK numbers them
  std::vector<std::int64_t> offset = {0};  // cell c owns entries offset[c] .. offset[c+1]-1 of the next
  std::vector<std::int64_t> node;          // every one names a point
  std::vector<VtuArray> point_data, cell_data, field_data;  // arrays of numbers; in the file's order

  [[nodiscard]] std::size_t cells() const { return type.size(); }
};

[[nodiscard]] const VtuArray* find_array(const std::vector<VtuArray>& data, const std::string& name);

// Which point and cell arrays are read; nothing: all of them. Field data always comes whole.
using VtuSelection = std::optional<std::vector<std::string>>;

// Throws FileError (not there, not a .vtu, damaged, cut short), and InputError when the reader does not survive the
// file; both name it and end with `remedy`.
[[nodiscard]] VtuGrid read_vtu(const std::filesystem::path& file, const VtuSelection& selection,
                               const std::string& remedy);

// The bytes that the child sends, and what is made of them. Throws std::runtime_error with what does not fit.
[[nodiscard]] std::string encode_vtu(const VtuGrid& grid);
[[nodiscard]] VtuGrid decode_vtu(const std::string& bytes);

}  // namespace weaveform
