// mesh.vtu: the only reader and writer of the mesh's file. Lines and polygons in one grid; cell data `family` selects
// warp (1), weft (2) and cells (0) in ParaView; everything the solver needs is stored, doubles bit by bit.
#pragma once

#include <filesystem>

#include "mesher/mesh/mesh.hpp"

namespace weaveform {

struct VtuGrid;  // vtu_grid.hpp

namespace file_name {
inline constexpr const char* mesh = "mesh.vtu";
}

// Written to a temporary name and renamed, so whole or not at all. Throws FileError.
void write_mesh(const Mesh& mesh, const std::filesystem::path& file);
// Reads what write_mesh wrote, bit for bit. Throws FileError (unreadable) or InputError (not a Weaveform mesh: what is
// missing).
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file);
// What it makes of the grid in the file, which messages name. Throws InputError.
[[nodiscard]] Mesh mesh_of(const VtuGrid& grid, const std::filesystem::path& file);

}  // namespace weaveform
