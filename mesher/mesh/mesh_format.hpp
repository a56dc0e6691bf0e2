// What the writer and the reader of mesh.vtu share: the file's layout, and an ear for VTK's errors.
#pragma once

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace weaveform::mesh_format {

// Layout of mesh.vtu. Grid cells: first the yarn elements, then the shear cells; a cell array holds 0 where its
// quantity has no meaning. Points: the nodes.
//   cell data    family (0 shear cell, 1 warp, 2 weft), rest_length_mm, section_mm2, yarns, jaw_mm, softening,
//                area_mm2, lattice (i, j)
//   point data   mass_t, crossing (i, j), flat_position_mm (of a blank that starts draped only), and one array of 0 and
//   1 per node set, named with the prefix below field data   spacing_mm, lattice_size, thickness_mm, coefficient_per_mm
//   (two per entry of the shear cells'
//                connectivity), tie_count, tie_node (node, the two it follows) and tie_share where there are any,
//                frame_corner (4 nodes, -1: no frame)
// Of a stack also
//   cell, point  ply, its number from 0, the lowest, on
//   field data   plies_first (per ply: its first node, yarn element, cell, tie and lattice row), plies_spacing_mm,
//                plies_lattice_size, plies_thickness_mm (per ply), plies_frame_corner (per ply, as frame_corner; in a
//                shear frame only), and for each ply one array ply_NAME, its number
inline const std::string set_prefix = "set_";
inline const std::string flat_name = "flat_position_mm";
inline const std::string ply_prefix = "ply_";
inline constexpr const char* ply_name = "ply";

// Only the closing tag proves that all of a file is there.
inline bool ends_with_closing_tag(const std::filesystem::path& file) {
  const std::string tag = "</VTKFile>";
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return false;
  const std::streamoff length = std::min<std::streamoff>(in.tellg(), 64);
  in.seekg(-length, std::ios::end);
  std::string tail(static_cast<std::size_t>(length), '\0');
  in.read(tail.data(), length);
  return in.gcount() == length && tail.find(tag) != std::string::npos;
}

// VTK speaks of its errors to observers only; this one keeps the first.
class ErrorListener {
public:
  explicit ErrorListener(vtkAlgorithm* source) {
    callback_->SetClientData(this);
    callback_->SetCallback([](vtkObject*, unsigned long, void* self, void* text) {
      auto& message = static_cast<ErrorListener*>(self)->message_;
      if (message.empty() && text != nullptr) message = static_cast<const char*>(text);
    });
    source->AddObserver("ErrorEvent", callback_);
    source->GetExecutive()->AddObserver("ErrorEvent", callback_);
  }
  [[nodiscard]] bool heard() const { return !message_.empty(); }

private:
  vtkNew<vtkCallbackCommand> callback_;
  std::string message_;
};

}  // namespace weaveform::mesh_format
