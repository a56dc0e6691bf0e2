// Element types of Gmsh (reference manual, "MSH file format") by what they are for a mesh of lines and shells.
#pragma once

namespace weaveform {

enum class MshShape { point, line, triangle, quadrilateral, volume, unknown };

struct MshType {
  MshShape shape = MshShape::unknown;
  int nodes = 0;    // in the file, the corners first
  int corners = 0;  // that are read; 0 of volumes
};

[[nodiscard]] constexpr MshType msh_type(long type) {
  switch (type) {
    case 15:
      return {MshShape::point, 1, 1};
    case 1:
      return {MshShape::line, 2, 2};
    case 8:
      return {MshShape::line, 3, 2};
    case 2:
      return {MshShape::triangle, 3, 3};
    case 9:
      return {MshShape::triangle, 6, 3};
    case 3:
      return {MshShape::quadrilateral, 4, 4};
    case 10:
      return {MshShape::quadrilateral, 9, 4};
    case 16:
      return {MshShape::quadrilateral, 8, 4};
    case 4:
      return {MshShape::volume, 4, 0};
    case 5:
      return {MshShape::volume, 8, 0};
    case 6:
      return {MshShape::volume, 6, 0};
    case 7:
      return {MshShape::volume, 5, 0};
    case 11:
      return {MshShape::volume, 10, 0};
    case 12:
      return {MshShape::volume, 27, 0};
    case 13:
      return {MshShape::volume, 18, 0};
    case 14:
      return {MshShape::volume, 14, 0};
    case 17:
      return {MshShape::volume, 20, 0};
    case 18:
      return {MshShape::volume, 15, 0};
    case 19:
      return {MshShape::volume, 13, 0};
    default:
      return {};
  }
}

}  // namespace weaveform
