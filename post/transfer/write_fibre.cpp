#include "post/transfer/write_fibre.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkLongArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "core/keys/length_unit.hpp"
#include "core/vector/angle.hpp"
#include "mesher/exchange/gathered.hpp"
#include "mesher/mesh/vtk_file.hpp"

namespace weaveform {

namespace {

std::string n20(double value) {
  return foreign::fit(value, 20);
}

}  // namespace

std::string fibre_header(const std::string& mark, const FibreField& field, const std::string& written_by,
                         const std::vector<std::string>& not_carried) {
  std::string text = fmt::format("{0} Written by {1}\n{0} Fibre directions of {2}; {3} shells; lengths in {4}\n", mark,
                                 written_by, field.source, field.element.size(), name_of(field.unit));
  if (field.greatest_distance > 0.0)
    text += fmt::format("{} Distance from the formed fabric: greatest {:.6g} mm, mean {:.6g} mm\n", mark,
                        field.greatest_distance, field.mean_distance);
  if (field.far > 0)
    text += fmt::format("{} {} shells lie farther than {:.6g} mm from it: they are not in this file\n", mark, field.far,
                        field.within);
  text += fmt::format("{} Not carried by this format, or carried in part:\n", mark);
  for (const auto& line : not_carried) text += fmt::format("{}  - {}\n", mark, line);
  return text;
}

namespace {

void add_distribution(const std::string& name, const FibreField& field, bool weft, std::string& out) {
  out += fmt::format("*DISTRIBUTION, NAME={}, LOCATION=ELEMENT, TABLE=DIRECTIONS\n, 1., 0., 0., 0., 1., 0.\n", name);
  for (const auto& element : field.element) {
    if (element.far) continue;
    const Vec3& a = weft ? element.state.weft : element.state.warp;
    Vec3 b = weft ? element.state.warp : element.state.weft;
    if (weft)  // so that 1, 2 and the normal keep their sense
      for (double& c : b) c = -c;
    out += fmt::format("{}, {}, {}, {}, {}, {}, {}\n", element.number, n20(a[0]), n20(a[1]), n20(a[2]), n20(b[0]),
                       n20(b[1]), n20(b[2]));
  }
  out += fmt::format("*ORIENTATION, NAME=FIBRE_{}, SYSTEM=RECTANGULAR\n{}\n3, 0.\n", weft ? "WEFT" : "WARP", name);
}

}  // namespace

FibreText orientation_abaqus(const FibreField& field, const std::string& written_by) {
  FibreText result;
  result.not_carried = {"shear angle: between FIBRE_WARP's and FIBRE_WEFT's local 1; as a number only in csv and vtu",
                        "fibre volume and mass ratios: only in csv and vtu"};
  std::string& out = result.text;
  const double unit = millimetres_in(field.unit);
  out = fibre_header("**", field, written_by, result.not_carried);
  out += "*DISTRIBUTION TABLE, NAME=DIRECTIONS\nCOORD3D, COORD3D\n";
  add_distribution("WARP_DIRECTIONS", field, false, out);
  add_distribution("WEFT_DIRECTIONS", field, true, out);
  out += "*DISTRIBUTION TABLE, NAME=LENGTHS\nLENGTH\n";
  out += fmt::format("*DISTRIBUTION, NAME=THICKNESS, LOCATION=ELEMENT, TABLE=LENGTHS\n, {}\n",
                     n20(field.flat_thickness / unit));
  for (const auto& element : field.element)
    if (!element.far) out += fmt::format("{}, {}\n", element.number, n20(element.state.thickness / unit));
  return result;
}

PlaneAngle angle_in_plane(const FibreField& field, const StateElement& element, const Vec3& reference,
                          const Vec3& direction) {
  using Eigen::Vector3d;
  const auto x = [&](std::size_t k) -> Vector3d {
    const Vec3& p = field.position[element.node[k]];
    return {p[0], p[1], p[2]};
  };
  const Vector3d normal =
      (element.node.size() == 4 ? (x(2) - x(0)).cross(x(3) - x(1)) : (x(1) - x(0)).cross(x(2) - x(0))).normalized();
  const Vector3d r(reference[0], reference[1], reference[2]), d(direction[0], direction[1], direction[2]);
  const Vector3d base = r - r.dot(normal) * normal;
  const double least = std::sin(5.0 / degrees_per_radian);
  return {std::atan2(normal.dot(base.cross(d)), base.dot(d)), base.norm() >= least};
}

std::string drape_block(const FibreField& field, std::size_t family, int number, const std::string& title, int& steep) {
  const Vec3& flat = field.flat_direction[family];
  std::string text = fmt::format(
      "# Angle from the projection of ({:.6g}, {:.6g}, {:.6g}) into the shell: the ply's reference direction\n"
      "/DRAPE/{}\n{}\n#Entity  Entity_ID            Thinning         theta_drape\n",
      flat[0], flat[1], flat[2], number, title);
  for (const auto& element : field.element) {
    if (element.far) continue;
    const PlaneAngle found =
        angle_in_plane(field, element, flat, family == 0 ? element.state.warp : element.state.weft);
    if (!found.good) ++steep;
    text += fmt::format("{:<10}{:>10}{:>20}{:>20}\n", element.node.size() == 4 ? "SHELL" : "SH3N", element.number,
                        foreign::fit(element.state.thickness / field.flat_thickness, 19),
                        foreign::fit(found.angle * degrees_per_radian, 19));
  }
  return text;
}

std::vector<std::string> drape_not_carried(int steep) {
  std::vector<std::string> lines = {"fibre volume and mass ratios, distances: only in csv and vtu"};
  if (steep > 0)
    lines.push_back(
        fmt::format("{} angles are poor: the flat direction is within 5 deg of the shell's "
                    "normal there; take the directions from csv or vtu",
                    steep));
  return lines;
}

FibreText drape_openradioss(const FibreField& field, const std::string& written_by) {
  int steep = 0;
  const std::string blocks = drape_block(field, 0, 1, "warp", steep) + drape_block(field, 1, 2, "weft", steep);
  FibreText result;
  result.not_carried = drape_not_carried(steep);
  result.text = fibre_header("#", field, written_by, result.not_carried) + blocks;
  return result;
}

namespace {

// Of a shell far from the fabric: no fabric, so zeros.
FibreState state_or_nothing(const StateElement& element) {
  return element.far ? FibreState{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0, 0.0, 0.0, 0.0} : element.state;
}

}  // namespace

FibreText fibre_csv(const FibreField& field) {
  FibreText result;
  result.text =
      "element,x_mm,y_mm,z_mm,warp_x,warp_y,warp_z,weft_x,weft_y,weft_z,shear_angle_deg,thickness_mm,"
      "fibre_volume_ratio,fibre_mass_ratio,distance_mm,on_fabric\n";
  for (const auto& element : field.element) {
    const FibreState s = state_or_nothing(element);
    result.text +=
        fmt::format("{},{},{},{},{}\n", element.number, fmt::join(element.centre, ","), fmt::join(s.warp, ","),
                    fmt::join(s.weft, ","),
                    fmt::format("{},{},{},{},{},{}", s.shear_angle * degrees_per_radian, s.thickness,
                                s.fibre_volume_ratio, s.fibre_mass_ratio, element.distance, element.far ? 0 : 1));
  }
  return result;
}

void write_fibre_vtu(const FibreField& field, const std::filesystem::path& file) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& x : field.position) points->InsertNextPoint(x.data());
  grid->SetPoints(points);
  vtkNew<vtkLongArray> number;
  number->SetName("element");
  const auto array = [&](const char* name, int components) {
    auto made = vtkSmartPointer<vtkDoubleArray>::New();
    made->SetName(name);
    made->SetNumberOfComponents(components);
    return made;
  };
  const auto warp = array("warp_direction", 3), weft = array("weft_direction", 3), angle = array("shear_angle_deg", 1),
             thickness = array("thickness_mm", 1), volume = array("fibre_volume_ratio", 1),
             mass = array("fibre_mass_ratio", 1), distance = array("distance_mm", 1), on_fabric = array("on_fabric", 1);
  for (const auto& element : field.element) {
    vtkIdType ids[4] = {};
    for (std::size_t k = 0; k < element.node.size(); ++k) ids[k] = element.node[k];
    grid->InsertNextCell(element.node.size() == 4 ? VTK_QUAD : VTK_TRIANGLE,
                         static_cast<vtkIdType>(element.node.size()), ids);
    const FibreState s = state_or_nothing(element);
    number->InsertNextValue(element.number);
    warp->InsertNextTuple(s.warp.data());
    weft->InsertNextTuple(s.weft.data());
    angle->InsertNextValue(s.shear_angle * degrees_per_radian);
    thickness->InsertNextValue(s.thickness);
    volume->InsertNextValue(s.fibre_volume_ratio);
    mass->InsertNextValue(s.fibre_mass_ratio);
    distance->InsertNextValue(element.distance);
    on_fabric->InsertNextValue(element.far ? 0.0 : 1.0);
  }
  grid->GetCellData()->AddArray(number);
  for (const auto& data : {warp, weft, angle, thickness, volume, mass, distance, on_fabric})
    grid->GetCellData()->AddArray(data);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  write_vtk_whole(file, *writer);
}

}  // namespace weaveform
