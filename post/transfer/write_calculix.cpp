// CalculiX 2.20 takes a distribution of orientations for solid elements only and says nothing of it for shells, which
// are then isotropic in effect; an orientation named by the shell section itself it reads for all its shells.
#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/keys/length_unit.hpp"
#include "core/vector/angle.hpp"
#include "core/vector/eigen_vector.hpp"
#include "mesher/exchange/gathered.hpp"
#include "post/transfer/write_fibre.hpp"

namespace weaveform {

namespace {

using Eigen::Vector3d;

constexpr double thickness_step = 0.01;  // of a thickness
constexpr double same_direction = 1e-9;  // components that differ less are the same

struct Group {
  std::vector<const StateElement*> element;
  Vector3d warp = Vector3d::Zero(), weft = Vector3d::Zero();  // means
  double thickness = 0.0;                                     // mm; mean
};

std::vector<Group> mean_groups(const std::map<std::array<long, 7>, Group>& sorted) {
  std::vector<Group> groups;
  for (const auto& [key, of_key] : sorted) {
    Group group = of_key;
    const auto count = static_cast<double>(group.element.size());
    for (const StateElement* element : group.element) {
      group.warp += vector_of(element->state.warp) / count;
      group.weft += vector_of(element->state.weft) / count;
      group.thickness += element->state.thickness / count;
    }
    group.warp.normalize();
    group.weft.normalize();
    groups.push_back(std::move(group));
  }
  return groups;
}

// Directions are sorted into cubes whose diagonal is the angle, so that no two of one cube are farther apart.
std::vector<Group> groups_of(const FibreField& field, double group_angle) {
  const double side = std::max(2.0 * std::sin(0.5 * group_angle / degrees_per_radian) / std::sqrt(3.0), same_direction);
  std::map<std::array<long, 7>, Group> sorted;
  for (const auto& element : field.element) {
    if (element.far) continue;
    std::array<long, 7> key{};
    for (std::size_t c = 0; c < 3; ++c) {
      // the middle of a cube is at 0, for directions along an axis scatter about it
      key[c] = std::lround(element.state.warp[c] / side);
      key[3 + c] = std::lround(element.state.weft[c] / side);
    }
    key[6] = std::lround(std::log(element.state.thickness) / thickness_step);
    sorted[key].element.push_back(&element);
  }
  return mean_groups(sorted);
}

double greatest_deviation(const std::vector<Group>& groups) {
  double worst = 0.0;
  for (const Group& group : groups)
    for (const StateElement* element : group.element)
      for (const auto& [mean, own] : {std::pair{group.warp, vector_of(element->state.warp)},
                                      std::pair{group.weft, vector_of(element->state.weft)}})
        worst = std::max(worst, std::atan2(mean.cross(own).norm(), mean.dot(own)) * degrees_per_radian);
  return worst;
}

// CalculiX cuts a number after 20 characters, its exponent too.
std::string point(const Vector3d& a) {
  return fmt::format("{}, {}, {}", foreign::fit(a.x(), 20), foreign::fit(a.y(), 20), foreign::fit(a.z(), 20));
}

void add_group(const Group& group, std::size_t number, double unit, std::string& out) {
  const Vector3d normal = group.warp.cross(group.weft).normalized();
  out += fmt::format("*ELSET, ELSET=FIBRE_{}\n", number);
  for (std::size_t k = 0; k < group.element.size(); ++k)
    out += fmt::format("{}{}", group.element[k]->number,
                       k + 1 == group.element.size() ? "\n" : (k % 16 == 15 ? ",\n" : ", "));
  for (const auto& [name, along] : {std::pair{"WARP", group.warp}, std::pair{"WEFT", group.weft}})
    out += fmt::format("*ORIENTATION, NAME={}_{}, SYSTEM=RECTANGULAR\n{}, {}\n", name, number, point(along),
                       point(normal.cross(along)));
  out += fmt::format("*SHELL SECTION, ELSET=FIBRE_{0}, MATERIAL=FABRIC, ORIENTATION=WARP_{0}\n{1}\n", number,
                     foreign::fit(group.thickness / unit, 20));
}

}  // namespace

FibreText orientation_calculix(const FibreField& field, double group_angle, const std::string& written_by) {
  const std::vector<Group> groups = groups_of(field, group_angle);
  FibreText result;
  result.not_carried = {
      "the weft where the fabric is sheared: local 2 is at right angles to the warp. WEFT_n has its direction, for a "
      "*SHELL SECTION, COMPOSITE of two plies, which CalculiX takes for S6 and S8R",
      "the material: define *MATERIAL, NAME=FABRIC (local 1 along the warp) before this file is included",
      "fibre volume and mass ratios: only in csv and vtu"};
  std::string& out = result.text;
  out = fibre_header("**", field, written_by, result.not_carried);
  out += fmt::format(
      "** {} groups of shells with one section; {:.3g} deg at most from a shell's own direction to its "
      "group's\n",
      groups.size(), greatest_deviation(groups));
  for (std::size_t k = 0; k < groups.size(); ++k) add_group(groups[k], k + 1, millimetres_in(field.unit), out);
  return result;
}

}  // namespace weaveform
