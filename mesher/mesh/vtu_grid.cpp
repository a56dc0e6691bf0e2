#include "mesher/mesh/vtu_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/files/bytes.hpp"

namespace weaveform {

namespace {

std::size_t bytes_of(VtuType type) {
  switch (type) {
    case VtuType::int8:
    case VtuType::uint8:
      return 1;
    case VtuType::int16:
    case VtuType::uint16:
      return 2;
    case VtuType::int32:
    case VtuType::uint32:
    case VtuType::float32:
      return 4;
    default:
      return 8;
  }
}

void encode(ByteWriter& bytes, const std::vector<VtuArray>& data) {
  bytes.value<std::uint64_t>(data.size());
  for (const VtuArray& array : data) {
    bytes.text(array.name);
    bytes.value(array.type);
    bytes.value(array.components);
    bytes.value<std::uint64_t>(array.tuples);
    bytes.list(array.bytes);
  }
}

VtuArray decode_array(ByteReader& bytes) {
  VtuArray array;
  array.name = bytes.text();
  array.type = bytes.value<VtuType>();
  array.components = bytes.value<int>();
  array.tuples = bytes.value<std::uint64_t>();
  array.bytes = bytes.list<char>();
  if (array.type > VtuType::float64 || array.components < 1)
    throw std::runtime_error(fmt::format("array '{}' is of no type or shape", array.name));
  const std::size_t values = array.bytes.size() / bytes_of(array.type);
  if (array.tuples > values || array.size() != values || array.size() * bytes_of(array.type) != array.bytes.size())
    throw std::runtime_error(fmt::format("array '{}' has other values than its shape asks for", array.name));
  return array;
}

// `tuples` of each, unless it is field data.
std::vector<VtuArray> decode_data(ByteReader& bytes, std::optional<std::size_t> tuples) {
  std::vector<VtuArray> data;
  for (std::size_t left = bytes.count_of(1); left > 0; --left) {
    data.push_back(decode_array(bytes));
    if (tuples && data.back().tuples != *tuples)
      throw std::runtime_error(
          fmt::format("array '{}' has {} tuples where {} belong", data.back().name, data.back().tuples, *tuples));
  }
  return data;
}

void require_sound_cells(const VtuGrid& grid) {
  if (grid.offset.size() != grid.type.size() + 1 || grid.offset.front() != 0 ||
      grid.offset.back() != static_cast<std::int64_t>(grid.node.size()) ||
      !std::is_sorted(grid.offset.begin(), grid.offset.end()))
    throw std::runtime_error("its cells' offsets do not fit their connectivity");
  const auto points = static_cast<std::int64_t>(grid.point.size());
  for (std::size_t c = 0; c < grid.cells(); ++c)
    for (std::int64_t k = grid.offset[c]; k < grid.offset[c + 1]; ++k)
      if (const std::int64_t n = grid.node[static_cast<std::size_t>(k)]; n < 0 || n >= points)
        throw std::runtime_error(fmt::format("cell {} names point {} of {}", c, n, points));
}

}  // namespace

double VtuArray::as_double(std::size_t k) const {
  switch (type) {
    case VtuType::int8:
      return at<std::int8_t>(k);
    case VtuType::uint8:
      return at<std::uint8_t>(k);
    case VtuType::int16:
      return at<std::int16_t>(k);
    case VtuType::uint16:
      return at<std::uint16_t>(k);
    case VtuType::int32:
      return at<std::int32_t>(k);
    case VtuType::uint32:
      return at<std::uint32_t>(k);
    case VtuType::int64:
      return static_cast<double>(at<std::int64_t>(k));
    case VtuType::uint64:
      return static_cast<double>(at<std::uint64_t>(k));
    case VtuType::float32:
      return at<float>(k);
    default:
      return at<double>(k);
  }
}

const VtuArray* find_array(const std::vector<VtuArray>& data, const std::string& name) {
  const auto found = std::find_if(data.begin(), data.end(), [&](const VtuArray& array) { return array.name == name; });
  return found == data.end() ? nullptr : &*found;
}

std::string encode_vtu(const VtuGrid& grid) {
  ByteWriter bytes;
  bytes.list(grid.point);
  bytes.value(grid.double_precision);
  bytes.list(grid.type);
  bytes.list(grid.offset);
  bytes.list(grid.node);
  for (const auto* data : {&grid.point_data, &grid.cell_data, &grid.field_data}) encode(bytes, *data);
  return bytes.take();
}

VtuGrid decode_vtu(const std::string& from) {
  ByteReader bytes(from);
  VtuGrid grid;
  grid.point = bytes.list<std::array<double, 3>>();
  grid.double_precision = bytes.value<char>() != 0;
  grid.type = bytes.list<std::uint8_t>();
  grid.offset = bytes.list<std::int64_t>();
  grid.node = bytes.list<std::int64_t>();
  if (grid.offset.empty()) throw std::runtime_error("no offsets");
  require_sound_cells(grid);
  grid.point_data = decode_data(bytes, grid.point.size());
  grid.cell_data = decode_data(bytes, grid.cells());
  grid.field_data = decode_data(bytes, std::nullopt);
  return grid;
}

}  // namespace weaveform
