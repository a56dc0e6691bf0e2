#include "mesher/exchange/abaqus/inp_types.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace weaveform {

namespace {

struct Base {
  std::string_view name;
  InpType type;
};

// What is left of a name without the letters that say how an element is integrated or what else it solves for. Plane
// and axisymmetric elements too: meshes of no analysis yet are written as these (Gmsh: CPS4, meshio: CAX4P).
constexpr std::array bases = {
    Base{"T2D2", {InpShape::line, 2}},
    Base{"T3D2", {InpShape::line, 2}},
    Base{"B21", {InpShape::line, 2}},
    Base{"B23", {InpShape::line, 2}},
    Base{"B31", {InpShape::line, 2}},
    Base{"B33", {InpShape::line, 2}},
    Base{"PIPE21", {InpShape::line, 2}},
    Base{"PIPE31", {InpShape::line, 2}},
    Base{"R2D2", {InpShape::line, 2}},
    Base{"RB3D2", {InpShape::line, 2}},
    Base{"M3D3", {InpShape::triangle, 3}},
    Base{"SFM3D3", {InpShape::triangle, 3}},
    Base{"R3D3", {InpShape::triangle, 3}},
    Base{"S3", {InpShape::triangle, 3}},
    Base{"STRI3", {InpShape::triangle, 3}},
    Base{"DS3", {InpShape::triangle, 3}},
    Base{"CPS3", {InpShape::triangle, 3}},
    Base{"CPE3", {InpShape::triangle, 3}},
    Base{"CAX3", {InpShape::triangle, 3}},
    Base{"CPEG3", {InpShape::triangle, 3}},
    Base{"CAX6", {InpShape::triangle, 6}},
    Base{"CAX4", {InpShape::quadrilateral, 4}},
    Base{"CPEG4", {InpShape::quadrilateral, 4}},
    Base{"CAX8", {InpShape::quadrilateral, 8}},
    Base{"DC2D3", {InpShape::triangle, 3}},
    Base{"M3D6", {InpShape::triangle, 6}},
    Base{"SFM3D6", {InpShape::triangle, 6}},
    Base{"S6", {InpShape::triangle, 6}},
    Base{"STRI65", {InpShape::triangle, 6}},
    Base{"DS6", {InpShape::triangle, 6}},
    Base{"CPS6", {InpShape::triangle, 6}},
    Base{"CPE6", {InpShape::triangle, 6}},
    Base{"M3D4", {InpShape::quadrilateral, 4}},
    Base{"SFM3D4", {InpShape::quadrilateral, 4}},
    Base{"R3D4", {InpShape::quadrilateral, 4}},
    Base{"S4", {InpShape::quadrilateral, 4}},
    Base{"S4R5", {InpShape::quadrilateral, 4}},
    Base{"DS4", {InpShape::quadrilateral, 4}},
    Base{"CPS4", {InpShape::quadrilateral, 4}},
    Base{"CPE4", {InpShape::quadrilateral, 4}},
    Base{"DC2D4", {InpShape::quadrilateral, 4}},
    Base{"M3D8", {InpShape::quadrilateral, 8}},
    Base{"SFM3D8", {InpShape::quadrilateral, 8}},
    Base{"S8", {InpShape::quadrilateral, 8}},
    Base{"S8R5", {InpShape::quadrilateral, 8}},
    Base{"DS8", {InpShape::quadrilateral, 8}},
    Base{"CPS8", {InpShape::quadrilateral, 8}},
    Base{"CPE8", {InpShape::quadrilateral, 8}},
    Base{"M3D9", {InpShape::quadrilateral, 9}},
    Base{"S9R5", {InpShape::quadrilateral, 9}},
};

constexpr std::array<std::string_view, 24> others = {
    "MASS", "ROTARYI", "HEATCAP", "SPRING", "DASHPOT", "CONN", "GAP",   "ITS", "JOINT",  "DCOUP", "DGAP", "COH",
    "C3D",  "DC3D",    "AC",      "SC6",    "SC8",     "CSS8", "CIN3D", "F3D", "SPHERE", "PC3D",  "PD3D", "FRAME"};

// Letters that may follow the name: reduced integration (R), small strain (S), warping (W), hybrid (H), incompatible
// modes (I), modified (M), open section (OS), coupled with temperature (T), pore pressure (P), electricity (E).
bool is_variant(std::string_view letters) {
  return letters.size() <= 4 && std::all_of(letters.begin(), letters.end(), [](char c) {
           return std::string_view("RSWHIMOTPE").find(c) != std::string_view::npos;
         });
}

}  // namespace

InpType inp_type(const std::string& name) {
  for (const Base& base : bases)
    if (name.rfind(base.name, 0) == 0 && is_variant(std::string_view(name).substr(base.name.size()))) return base.type;
  if (name.size() > 1 && name[0] == 'U' && std::isdigit(static_cast<unsigned char>(name[1])) != 0)
    return {InpShape::other, 0};  // a user's own
  for (const auto& start : others)
    if (name.rfind(start, 0) == 0) return {InpShape::other, 0};
  return {};
}

}  // namespace weaveform
