#include <fmt/format.h>
#include <vtkCellType.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "mesher/mesh/mesh_format.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/mesh/vtu_grid.hpp"

namespace weaveform {

namespace {

using mesh_format::flat_name;
using mesh_format::ply_prefix;
using mesh_format::set_prefix;
using Data = std::vector<VtuArray>;

constexpr const char* remedy = "make it again with 'weaveform mesh'";

// Collects what a file lacks, so that it can be said all at once.
struct Wanted {
  std::filesystem::path file;
  std::vector<std::string> complaints;

  void complain(const std::string& what) {
    complaints.push_back(fmt::format("{}: {}; write the mesh again with 'weaveform mesh'", file.string(), what));
  }
  // The array of that name, type and shape; null (and a complaint) when there is none.
  template <class Value>
  const VtuArray* array(const Data& data, const std::string& name, int components, std::size_t tuples) {
    const VtuArray* found = find_array(data, name);
    if (found == nullptr || !found->holds<Value>() || found->components != components || found->tuples != tuples) {
      complain(
          fmt::format("not a Weaveform mesh: array '{}' with {} tuples of {} is missing", name, tuples, components));
      return nullptr;
    }
    return found;
  }
  void stop_if_any() const {
    if (!complaints.empty()) throw InputError(complaints);
  }
};

void get_cell_doubles(Wanted& wanted, const VtuGrid& grid, const std::string& name, std::size_t first,
                      std::size_t count, std::vector<double>& value) {
  const VtuArray* array = wanted.array<double>(grid.cell_data, name, 1, grid.cells());
  if (array == nullptr) return;
  value.resize(count);
  for (std::size_t k = 0; k < count; ++k) value[k] = array->at<double>(first + k);
}

// Tuples of an array with as many components, from tuple `first` on.
template <class Value, std::size_t size>
void get_tuples(const VtuArray* array, std::size_t first, std::size_t count,
                std::vector<std::array<Value, size>>& value) {
  if (array == nullptr) return;
  value.resize(count);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t c = 0; c < size; ++c) value[k][c] = array->at<Value>((first + k) * size + c);
}

// Yarn elements come first; their number.
std::size_t count_yarns(Wanted& wanted, const VtuGrid& grid) {
  const std::size_t count = grid.cells();
  const VtuArray* family = wanted.array<std::uint8_t>(grid.cell_data, "family", 1, count);
  wanted.stop_if_any();
  std::size_t yarns = 0;
  while (yarns < count && family->at<std::uint8_t>(yarns) != 0) ++yarns;
  for (std::size_t c = 0; c < count; ++c) {
    const bool line = grid.type[c] == VTK_LINE;
    const int value = family->at<std::uint8_t>(c);
    if (line == (c < yarns) && (value != 0) == (c < yarns) && value <= 2) continue;
    wanted.complain(
        fmt::format("not a Weaveform mesh: cell {} has family {} and is {}a line", c, value, line ? "" : "not "));
    wanted.stop_if_any();
  }
  return yarns;
}

void get_connectivity(Wanted& wanted, const VtuGrid& grid, std::size_t yarns, Mesh& mesh) {
  constexpr std::int64_t most_nodes = 6;  // of a shear cell
  const std::size_t count = grid.cells();
  mesh.cells.offset.reserve(count - yarns + 1);
  for (std::size_t c = 0; c < count; ++c) {
    const std::int64_t begin = grid.offset[c], size = grid.offset[c + 1] - begin;
    const auto node = [&](std::int64_t k) { return static_cast<int>(grid.node[static_cast<std::size_t>(begin + k)]); };
    bool twice = false;
    for (std::int64_t k = 0; k < std::min(size, most_nodes); ++k)
      for (std::int64_t m = 0; m < k; ++m) twice = twice || node(k) == node(m);
    if ((c < yarns) != (size == 2) || size < 2 || size > most_nodes || twice) {
      wanted.complain(fmt::format("cell {} has {} nodes{}", c, size, twice ? ", one of them twice" : ""));
      wanted.stop_if_any();
    }
    if (c < yarns) {
      mesh.yarns.node.push_back({node(0), node(1)});
    } else {
      for (std::int64_t k = 0; k < size; ++k) mesh.cells.node.push_back(node(k));
      mesh.cells.offset.push_back(static_cast<int>(mesh.cells.node.size()));
    }
  }
}

void get_cell_data(Wanted& wanted, const VtuGrid& grid, std::size_t yarns, Mesh& mesh) {
  const std::size_t count = grid.cells();
  const VtuArray* family = wanted.array<std::uint8_t>(grid.cell_data, "family", 1, count);
  for (std::size_t e = 0; e < yarns; ++e)
    mesh.yarns.family.push_back(family->at<std::uint8_t>(e) == 1 ? Family::warp : Family::weft);
  get_cell_doubles(wanted, grid, "rest_length_mm", 0, yarns, mesh.yarns.rest_length);
  get_cell_doubles(wanted, grid, "section_mm2", 0, yarns, mesh.yarns.section);
  get_cell_doubles(wanted, grid, "yarns", 0, yarns, mesh.yarns.yarns);
  get_cell_doubles(wanted, grid, "jaw_mm", 0, yarns, mesh.yarns.jaw);
  get_cell_doubles(wanted, grid, "softening", 0, yarns, mesh.yarns.softening);
  get_cell_doubles(wanted, grid, "area_mm2", yarns, count - yarns, mesh.cells.area);
  get_tuples(wanted.array<std::int32_t>(grid.cell_data, "lattice", 2, count), yarns, count - yarns, mesh.cells.lattice);
}

void get_nodes(Wanted& wanted, const VtuGrid& grid, Mesh& mesh) {
  const std::size_t count = grid.point.size();
  mesh.nodes.position = grid.point;
  if (const VtuArray* mass = wanted.array<double>(grid.point_data, "mass_t", 1, count)) {
    mesh.nodes.mass.resize(count);
    for (std::size_t n = 0; n < count; ++n) mesh.nodes.mass[n] = mass->at<double>(n);
  }
  get_tuples(wanted.array<std::int32_t>(grid.point_data, "crossing", 2, count), 0, count, mesh.nodes.crossing);
  if (find_array(grid.point_data, flat_name) != nullptr)
    get_tuples(wanted.array<double>(grid.point_data, flat_name, 3, count), 0, count, mesh.nodes.flat_position);
  for (const VtuArray& array : grid.point_data) {
    if (array.name.rfind(set_prefix, 0) != 0) continue;
    const VtuArray* member = wanted.array<std::uint8_t>(grid.point_data, array.name, 1, count);
    if (member == nullptr) continue;
    NodeSet set{array.name.substr(set_prefix.size()), {}};
    for (std::size_t n = 0; n < count; ++n)
      if (member->at<std::uint8_t>(n) != 0) set.node.push_back(static_cast<int>(n));
    mesh.sets.push_back(std::move(set));
  }
}

void get_field_data(Wanted& wanted, const VtuGrid& grid, Mesh& mesh) {
  const auto get_pair = [&](const VtuArray* array, auto& value) {
    if (array == nullptr) return;
    for (std::size_t k = 0; k < 2; ++k) value[k] = array->at<std::decay_t<decltype(value[0])>>(k);
  };
  get_pair(wanted.array<double>(grid.field_data, "spacing_mm", 2, 1), mesh.spacing);
  get_pair(wanted.array<std::int32_t>(grid.field_data, "lattice_size", 2, 1), mesh.lattice_size);
  if (const VtuArray* thickness = wanted.array<double>(grid.field_data, "thickness_mm", 1, 1))
    mesh.thickness = thickness->at<double>(0);
  const std::size_t entries = mesh.cells.node.size();
  get_tuples(wanted.array<double>(grid.field_data, "coefficient_per_mm", 2, entries), 0, entries,
             mesh.cells.coefficient);
}

void get_ties(Wanted& wanted, const VtuGrid& grid, Mesh& mesh) {
  const VtuArray* corner = wanted.array<std::int32_t>(grid.field_data, "frame_corner", 4, 1);
  const VtuArray* before = find_array(grid.field_data, "tie_node");  // of versions without a count
  std::size_t ties = before == nullptr ? 0 : before->tuples;
  if (before == nullptr || find_array(grid.field_data, "tie_count") != nullptr) {
    const VtuArray* count = wanted.array<std::int32_t>(grid.field_data, "tie_count", 1, 1);
    wanted.stop_if_any();
    ties = static_cast<std::size_t>(std::max(count->at<std::int32_t>(0), 0));
  }
  const VtuArray *node = nullptr, *share = nullptr;
  if (ties > 0) {
    node = wanted.array<std::int32_t>(grid.field_data, "tie_node", 3, ties);
    share = wanted.array<double>(grid.field_data, "tie_share", 1, ties);
    wanted.stop_if_any();
  }
  for (std::size_t k = 0; k < mesh.frame.corner.size(); ++k) mesh.frame.corner[k] = corner->at<std::int32_t>(k);
  const auto points = static_cast<int>(grid.point.size());
  const auto valid = [points](int n) { return n >= 0 && n < points; };
  bool all_valid = !mesh.frame.present() || std::all_of(mesh.frame.corner.begin(), mesh.frame.corner.end(), valid);
  for (std::size_t k = 0; k < ties; ++k) {
    const std::array<int, 3> n = {node->at<std::int32_t>(3 * k), node->at<std::int32_t>(3 * k + 1),
                                  node->at<std::int32_t>(3 * k + 2)};
    all_valid = all_valid && valid(n[0]) && valid(n[1]) && valid(n[2]) && n[0] != n[1] && n[0] != n[2];
    mesh.tie.push_back({n[0], {n[1], n[2]}, share->at<double>(k)});
  }
  if (!all_valid) wanted.complain("a tie or the shear frame names a point that is not there, or a tie its own node");
}

void get_frames(Wanted& wanted, const VtuGrid& grid, std::vector<MeshPly>& plies) {
  if (find_array(grid.field_data, "plies_frame_corner") == nullptr) return;
  const VtuArray* corner = wanted.array<std::int32_t>(grid.field_data, "plies_frame_corner", 4, plies.size());
  wanted.stop_if_any();
  for (std::size_t k = 0; k < plies.size(); ++k)
    for (std::size_t c = 0; c < 4; ++c) plies[k].frame.corner[c] = corner->at<std::int32_t>(4 * k + c);
}

// The plies of a stack, whose names stand in the names of arrays.
void get_plies(Wanted& wanted, const VtuGrid& grid, Mesh& mesh) {
  const VtuArray* begins = find_array(grid.field_data, "plies_first");
  if (begins == nullptr) return;
  const std::size_t count = begins->tuples;
  begins = wanted.array<std::int32_t>(grid.field_data, "plies_first", 5, count);
  const VtuArray* spacing = wanted.array<double>(grid.field_data, "plies_spacing_mm", 2, count);
  const VtuArray* size = wanted.array<std::int32_t>(grid.field_data, "plies_lattice_size", 2, count);
  const VtuArray* thickness = wanted.array<double>(grid.field_data, "plies_thickness_mm", 1, count);
  wanted.stop_if_any();
  for (std::size_t k = 0; k < count; ++k)
    mesh.ply.push_back({.name = "",
                        .first_node = begins->at<std::int32_t>(5 * k),
                        .first_yarn = begins->at<std::int32_t>(5 * k + 1),
                        .first_cell = begins->at<std::int32_t>(5 * k + 2),
                        .first_tie = begins->at<std::int32_t>(5 * k + 3),
                        .first_row = begins->at<std::int32_t>(5 * k + 4),
                        .spacing = {spacing->at<double>(2 * k), spacing->at<double>(2 * k + 1)},
                        .lattice_size = {size->at<std::int32_t>(2 * k), size->at<std::int32_t>(2 * k + 1)},
                        .thickness = thickness->at<double>(k),
                        .frame = {}});
  get_frames(wanted, grid, mesh.ply);
  for (const VtuArray& array : grid.field_data) {
    if (!array.name.starts_with(ply_prefix) || array.size() != 1 || !array.holds<std::int32_t>()) continue;
    const int number = array.at<std::int32_t>(0);
    if (number >= 0 && number < static_cast<int>(count)) mesh.ply[number].name = array.name.substr(ply_prefix.size());
  }
  for (const MeshPly& ply : mesh.ply)
    if (ply.name.empty()) wanted.complain("not a Weaveform mesh: a ply has no name");
}

VtuGrid read_grid(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw FileError(fmt::format("{}: no such file; make it with 'weaveform mesh'", file.string()));
  return read_vtu(file, std::nullopt, remedy);
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& file) {
  return mesh_of(read_grid(file), file);
}

Mesh mesh_of(const VtuGrid& grid, const std::filesystem::path& file) {
  Wanted wanted{file, {}};
  Mesh mesh;
  const std::size_t yarns = count_yarns(wanted, grid);
  get_connectivity(wanted, grid, yarns, mesh);
  get_cell_data(wanted, grid, yarns, mesh);
  get_nodes(wanted, grid, mesh);
  get_field_data(wanted, grid, mesh);
  get_ties(wanted, grid, mesh);
  get_plies(wanted, grid, mesh);
  wanted.stop_if_any();
  const std::string wrong = mesh.check();
  if (!wrong.empty()) wanted.complain(wrong);
  wanted.stop_if_any();
  return mesh;
}

}  // namespace weaveform
