#include <fmt/format.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "core/files/text_words.hpp"
#include "core/keys/length_unit.hpp"
#include "core/vector/eigen_vector.hpp"
#include "mesher/exchange/foreign_mesh.hpp"
#include "mesher/mesh/vtu_grid.hpp"
#include "mesher/tools/triangle_list.hpp"
#include "post/transfer/fibre_field.hpp"

namespace weaveform {

namespace {

using Eigen::Vector3d;

// Of quadrilaterals half the cross product of the diagonals, of triangles that of two sides.
Vector3d area_vector(const std::vector<int>& node, const std::vector<Vec3>& position) {
  const auto x = [&](std::size_t k) { return vector_of(position[node[k]]); };
  return 0.5 * (node.size() == 4 ? (x(2) - x(0)).cross(x(3) - x(1)) : (x(1) - x(0)).cross(x(2) - x(0)));
}

// What is interpolated: both directions, area ratio by way of its inverse, thickness, fibre volume.
struct Nodal {
  Vector3d warp = Vector3d::Zero(), weft = Vector3d::Zero();
  double thickness = 0.0, volume = 0.0, mass = 0.0, weight = 0.0;
  void add(const Nodal& other, double w) {
    warp += w * other.warp;
    weft += w * other.weft;
    thickness += w * other.thickness;
    volume += w * other.volume;
    mass += w * other.mass;
    weight += w * other.weight;
  }
};

std::vector<Nodal> nodal_means(const FibreField& fabric) {
  std::vector<Nodal> mean(fabric.position.size());
  for (const auto& element : fabric.element) {
    const FibreState& s = element.state;
    const Nodal here{vector_of(s.warp), vector_of(s.weft), s.thickness, s.fibre_volume_ratio, s.fibre_mass_ratio, 1.0};
    const double area = area_vector(element.node, fabric.position).norm();
    for (const int n : element.node) mean[n].add(here, area);
  }
  for (auto& m : mean) {
    if (m.weight <= 0.0) continue;
    Nodal scaled;
    scaled.add(m, 1.0 / m.weight);
    m = scaled;
  }
  return mean;
}

vtkSmartPointer<vtkPolyData> surface_of(const FibreField& fabric) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& x : fabric.position) points->InsertNextPoint(x.data());
  vtkNew<vtkCellArray> cells;
  for (const auto& element : fabric.element) {
    cells->InsertNextCell(static_cast<int>(element.node.size()));
    for (const int n : element.node) cells->InsertCellPoint(n);
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(cells);
  return surface;
}

FibreState turned_into_plane(const Nodal& at, const Vector3d& normal, const std::string& where) {
  FibreState state;
  const auto in_plane = [&](const Vector3d& d) -> Vector3d { return d - d.dot(normal) * normal; };
  const Vector3d warp = in_plane(at.warp), weft = in_plane(at.weft);
  constexpr double least = 1e-3;  // of a unit vector: the element stands across the fabric
  if (warp.norm() < least || weft.norm() < least)
    throw InputError(
        fmt::format("{}: stands across the fabric, so that a yarn direction is its normal; give a mesh of "
                    "the formed surface",
                    where));
  state.warp = array_of(warp.normalized());
  state.weft = array_of(weft.normalized());
  const Vector3d a = warp.normalized(), b = weft.normalized();
  state.shear_angle = std::atan2(a.dot(b), a.cross(b).norm());
  state.thickness = at.thickness;
  state.fibre_volume_ratio = at.volume;
  state.fibre_mass_ratio = at.mass;
  return state;
}

double extent_of(const std::vector<Vec3>& position, const std::vector<int>& node) {
  Vector3d low = Vector3d::Constant(1e300), high = -low;
  for (const int n : node) {
    low = low.cwiseMin(vector_of(position[n]));
    high = high.cwiseMax(vector_of(position[n]));
  }
  return node.empty() ? 0.0 : (high - low).maxCoeff();
}

template <class Elements>
std::vector<int> nodes_of(const Elements& elements) {
  std::vector<int> nodes;
  for (const auto& element : elements) nodes.insert(nodes.end(), element.node.begin(), element.node.end());
  return nodes;
}

// mm; root of the mean area.
template <class Elements>
double mean_side(const Elements& elements, const std::vector<Vec3>& position) {
  double area = 0.0;
  for (const auto& element : elements) area += area_vector(element.node, position).norm();
  return elements.empty() ? 0.0 : std::sqrt(area / static_cast<double>(elements.size()));
}

// A part and the fabric on it are of one size; factors between units are far from that.
void check_proportion(double part, double fabric, const std::string& file) {
  constexpr double farthest = 50.0;
  if (part * farthest < fabric)
    throw InputError(
        fmt::format("{}: its shells are {:.3g} mm across and the formed fabric {:.4g} mm: is the file in "
                    "metres? Give --unit m (or cm, inch; mm if it is right)",
                    file, part, fabric));
  if (part > farthest * fabric)
    throw InputError(
        fmt::format("{}: its shells are {:.4g} mm across and the formed fabric {:.4g} mm: is it in "
                    "micrometres? Give --unit mm if it is right",
                    file, part, fabric));
}

// The structure in mm, in its own axes and where it lies in the scene.
struct Placed {
  std::vector<Vec3> own, world;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
};

Placed placed(const ForeignMesh& structure, const Onto& onto) {
  Placed result;
  const Vector3d axis = vector_of(onto.axis), origin = vector_of(onto.position);
  if (onto.angle != 0.0) {
    if (!(axis.norm() > 0.0)) throw InputError("the axis to turn about has no length; give it one");
    result.turn = Eigen::AngleAxisd(onto.angle * std::numbers::pi / 180.0, axis.normalized()).toRotationMatrix();
  }
  for (const Vec3& x : structure.position) {
    const Vector3d own = millimetres_in(onto.unit) * vector_of(x);
    result.own.push_back(array_of(own));
    result.world.push_back(array_of(result.turn * own + origin));
  }
  return result;
}

// What lies nearest in the formed fabric.
class Nearest {
public:
  explicit Nearest(const FibreField& fabric) : surface_(surface_of(fabric)), mean_(nodal_means(fabric)) {
    locator_->SetDataSet(surface_);
    locator_->BuildLocator();
  }
  // Interpolated there; `distance` (mm) is the way to it.
  [[nodiscard]] Nodal at(const Vector3d& point, double& distance) {
    double closest[3], squared = 0.0;
    vtkIdType id = -1;
    int sub = 0;
    locator_->FindClosestPoint(point.data(), closest, cell_, id, sub, squared);
    if (id < 0) throw InputError("the formed fabric has no cells to map from");
    distance = std::sqrt(squared);
    double parametric[3], weight[4] = {}, far = 0.0, on_cell[3];
    (void)cell_->EvaluatePosition(closest, on_cell, sub, parametric, far, weight);
    Nodal found;
    for (vtkIdType k = 0; k < cell_->GetNumberOfPoints(); ++k)
      found.add(mean_[static_cast<std::size_t>(cell_->GetPointId(static_cast<int>(k)))], weight[k]);
    return found;
  }

private:
  vtkSmartPointer<vtkPolyData> surface_;
  std::vector<Nodal> mean_;
  vtkNew<vtkStaticCellLocator> locator_;
  vtkNew<vtkGenericCell> cell_;
};

Vec3 turned_back(const Vec3& direction, const Eigen::Matrix3d& turn) {
  return array_of(turn.transpose() * vector_of(direction));
}

void require_near(const FibreField& result, const std::string& file) {
  if (result.far == static_cast<int>(result.element.size()))
    throw InputError(
        fmt::format("{}: no shell lies within {:.4g} mm of the formed fabric, the nearest is {:.4g} mm away; "
                    "move it with --position and --rotation, give its --unit, or allow more with --within",
                    file, result.within,
                    std::min_element(result.element.begin(), result.element.end(), [](const auto& a, const auto& b) {
                      return a.distance < b.distance;
                    })->distance));
}

}  // namespace

FibreField map_onto(const FibreField& fabric, const ForeignMesh& structure, const Onto& onto) {
  if (structure.shells.empty())
    throw InputError(fmt::format("{}: no shells (triangles, quadrilaterals) to map onto", structure.file));
  const Placed place = placed(structure, onto);
  if (!onto.unit)
    check_proportion(extent_of(place.own, nodes_of(structure.shells)),
                     extent_of(fabric.position, nodes_of(fabric.element)), structure.file);
  FibreField result;
  result.position = place.own;
  result.number = structure.number;
  result.flat_thickness = fabric.flat_thickness;
  for (std::size_t f = 0; f < 2; ++f) result.flat_direction[f] = turned_back(fabric.flat_direction[f], place.turn);
  result.source = fabric.source + ", mapped onto " + structure.file;
  result.unit = onto.unit.value_or(LengthUnit::mm);
  result.within = onto.within.value_or(
      0.5 * std::max(mean_side(structure.shells, place.own), mean_side(fabric.element, fabric.position)));
  Nearest nearest(fabric);
  double sum = 0.0;
  for (const auto& shell : structure.shells) {
    StateElement element;
    element.number = shell.number;
    element.node = shell.node;
    element.centre = centre_of(shell.node, place.own);
    const Nodal at = nearest.at(vector_of(centre_of(shell.node, place.world)), element.distance);
    element.far = element.distance > result.within;
    const Vector3d normal = area_vector(element.node, place.world);
    const std::string where = fmt::format("{}: element {}", structure.where(shell), shell.number);
    if (!(normal.norm() > 0.0)) throw InputError(where + ": has no area");
    if (!element.far) {
      element.state = turned_into_plane(at, normal.normalized(), where);
      element.state.warp = turned_back(element.state.warp, place.turn);
      element.state.weft = turned_back(element.state.weft, place.turn);
      sum += element.distance;
    }
    result.far += element.far ? 1 : 0;
    result.greatest_distance = std::max(result.greatest_distance, element.distance);
    result.element.push_back(std::move(element));
  }
  require_near(result, structure.file);
  result.mean_distance = sum / static_cast<double>(result.element.size() - static_cast<std::size_t>(result.far));
  return result;
}

namespace {

ForeignMesh read_vtu_shells(const std::filesystem::path& file) {
  const VtuGrid grid = read_vtu(file, std::vector<std::string>{}, "write it again");
  if (grid.point.empty()) throw FileError(fmt::format("{}: no points in it; write it again", file.string()));
  ForeignMesh mesh;
  mesh.file = file.string();
  mesh.position = grid.point;
  for (std::size_t n = 0; n < mesh.position.size(); ++n) {
    for (const double x : mesh.position[n])
      if (!(std::abs(x) <= farthest_corner))
        throw InputError(fmt::format("{}: point {} lies at {}; write it again in mm", mesh.file, n, x));
    mesh.number.push_back(static_cast<long>(n) + 1);
  }
  for (std::size_t c = 0; c < grid.cells(); ++c) {
    const std::int64_t nodes = grid.type[c] == VTK_TRIANGLE ? 3 : grid.type[c] == VTK_QUAD ? 4 : 0;
    if (nodes == 0) continue;
    if (grid.offset[c + 1] - grid.offset[c] != nodes)
      throw InputError(fmt::format("{}: cell {} has {} points where its type has {}; write it again", mesh.file, c,
                                   grid.offset[c + 1] - grid.offset[c], nodes));
    ForeignElement shell{static_cast<long>(c) + 1, 0, {}};
    for (std::int64_t k = grid.offset[c]; k < grid.offset[c + 1]; ++k)
      shell.node.push_back(static_cast<int>(grid.node[static_cast<std::size_t>(k)]));
    mesh.shells.push_back(std::move(shell));
  }
  return mesh;
}

// An analysis knows a shell by its number, which parts give each on their own.
void require_own_numbers(const ForeignMesh& mesh) {
  std::map<long, const ForeignElement*> seen;
  for (const auto& shell : mesh.shells) {
    const auto [other, fresh] = seen.emplace(shell.number, &shell);
    if (fresh) continue;
    throw InputError(fmt::format(
        "{}: shells of '{}' and '{}' share the number {}; say with --part NAME which part is meant", mesh.file,
        mesh.instance[other->second->instance].name, mesh.instance[shell.instance].name, shell.number));
  }
}

}  // namespace

ForeignMesh read_structural_mesh(const std::filesystem::path& file, const std::string& part) {
  const bool vtu = upper(file.extension().string()) == ".VTU";
  ForeignMesh mesh = vtu ? read_vtu_shells(file) : read_foreign_mesh(file);
  if (!part.empty()) {
    std::vector<ForeignElement> kept;
    for (const int k : shells_named(mesh, part)) kept.push_back(mesh.shells[k]);
    mesh.shells = std::move(kept);
    if (mesh.shells.empty())
      throw InputError(fmt::format("{}: no part, instance or element set with shells is named '{}'", mesh.file, part));
    mesh.element_sets.clear();  // they name places among all shells
  }
  if (mesh.shells.empty())
    throw InputError(fmt::format("{}: no shells (triangles, quadrilaterals) to map onto", mesh.file));
  require_own_numbers(mesh);
  return mesh;
}

}  // namespace weaveform
