#include "post/transfer/layered.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "core/keys/length_unit.hpp"
#include "core/vector/angle.hpp"
#include "core/vector/eigen_vector.hpp"
#include "mesher/exchange/gathered.hpp"
#include "mesher/mesh/stack.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;
using Layers = std::vector<FibreLayer>;

constexpr double thickness_step = 0.01;  // of a thickness
constexpr double same_direction = 1e-9;  // components that differ less are the same
constexpr double no_layer = 1e18;        // marks it among what groups are told apart by

std::string n20(double value) {
  return foreign::fit(value, 20);
}

std::string point(const Vector3d& a) {
  return fmt::format("{}, {}, {}", n20(a.x()), n20(a.y()), n20(a.z()));
}

Vector3d normal_of(const FibreField& field, const StateElement& element) {
  const auto x = [&](std::size_t k) { return vector_of(field.position[element.node[k]]); };
  return element.node.size() == 4 ? (x(2) - x(0)).cross(x(3) - x(1)) : (x(1) - x(0)).cross(x(2) - x(0));
}

// The layers that a shell has, in the order along its normal.
std::vector<std::size_t> order_at(const Layers& layers, std::size_t shell) {
  std::vector<std::size_t> order;
  double up = 0.0;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const StateElement& element = layers[k].field.element[shell];
    if (element.far) continue;
    order.push_back(k);
    const Vector3d above = vector_of(element.state.warp).cross(vector_of(element.state.weft));
    up += above.dot(normal_of(layers[k].field, element).normalized());
  }
  if (up < 0.0) std::reverse(order.begin(), order.end());
  return order;
}

struct LayeredGroup {
  std::vector<std::size_t> order;  // of layers
  std::vector<std::size_t> shell;  // places in the fields
};

// Directions are sorted into cubes whose diagonal is the angle, layer by layer.
std::vector<LayeredGroup> groups_of(const Layers& layers, double group_angle) {
  const double side = std::max(2.0 * std::sin(0.5 * group_angle / degrees_per_radian) / std::sqrt(3.0), same_direction);
  std::map<std::vector<double>, LayeredGroup> sorted;
  for (std::size_t s = 0; s < layers.front().field.element.size(); ++s) {
    const std::vector<std::size_t> order = order_at(layers, s);
    if (order.empty()) continue;
    std::vector<double> key = {order.front() > order.back() ? -1.0 : 1.0};
    for (const FibreLayer& layer : layers) {
      const StateElement& element = layer.field.element[s];
      for (std::size_t c = 0; c < 3; ++c) {
        key.push_back(element.far ? no_layer : std::round(element.state.warp[c] / side));
        key.push_back(element.far ? no_layer : std::round(element.state.weft[c] / side));
      }
      key.push_back(element.far ? no_layer : std::round(std::log(element.state.thickness) / thickness_step));
    }
    LayeredGroup& group = sorted[key];
    group.order = order;
    group.shell.push_back(s);
  }
  std::vector<LayeredGroup> groups;
  for (auto& [key, group] : sorted) groups.push_back(std::move(group));
  return groups;
}

// What a group's shells have in one layer on average.
struct MeanState {
  Vector3d warp = Vector3d::Zero(), weft = Vector3d::Zero();
  double thickness = 0.0;  // mm
};

MeanState mean_of(const FibreLayer& layer, const LayeredGroup& group) {
  MeanState mean;
  for (const std::size_t s : group.shell) {
    const FibreState& state = layer.field.element[s].state;
    mean.warp += vector_of(state.warp);
    mean.weft += vector_of(state.weft);
    mean.thickness += state.thickness / static_cast<double>(group.shell.size());
  }
  mean.warp.normalize();
  mean.weft.normalize();
  return mean;
}

void add_set(const Layers& layers, const std::string& name, const std::vector<std::size_t>& shells, std::string& out) {
  out += fmt::format("*ELSET, ELSET={}\n", name);
  for (std::size_t k = 0; k < shells.size(); ++k)
    out += fmt::format("{}{}", layers.front().field.element[shells[k]].number,
                       k + 1 == shells.size() ? "\n" : (k % 16 == 15 ? ",\n" : ", "));
}

void add_calculix_group(const Layers& layers, const LayeredGroup& group, std::size_t number, std::string& out) {
  const double unit = millimetres_in(layers.front().field.unit);
  const std::string set = fmt::format("LAYERS_{}", number);
  add_set(layers, set, group.shell, out);
  std::string section = fmt::format("*SHELL SECTION, ELSET={}, COMPOSITE\n", set);
  for (const std::size_t k : group.order) {
    const MeanState mean = mean_of(layers[k], group);
    const std::string name = fmt::format("WARP_{}_{}", number, deck_name(layers[k].ply));
    const Vector3d across = mean.warp.cross(mean.weft).normalized().cross(mean.warp);
    out += fmt::format("*ORIENTATION, NAME={}, SYSTEM=RECTANGULAR\n{}, {}\n", name, point(mean.warp), point(across));
    section += fmt::format("{}, , {}, {}\n", n20(mean.thickness / unit), deck_name(layers[k].material), name);
  }
  out += section;
}

std::string materials_line(const Layers& layers) {
  std::string line = "the materials: define ";
  std::vector<std::string> named;
  for (const FibreLayer& layer : layers) {
    const std::string name = deck_name(layer.material);
    if (std::find(named.begin(), named.end(), name) != named.end()) continue;
    line += fmt::format("{}*MATERIAL, NAME={}", named.empty() ? "" : ", ", name);
    named.push_back(name);
  }
  return line + " (local 1 along the warp) before this file is included";
}

std::string layers_words(const std::string& mark, const Layers& layers) {
  std::string text = fmt::format("{} Layers from the bottom up:", mark);
  for (const FibreLayer& layer : layers) text += fmt::format(" {} ({})", layer.ply, layer.material);
  return text + "\n";
}

void add_directions(const FibreLayer& layer, std::string& out) {
  const std::string ply = deck_name(layer.ply);
  out += fmt::format(
      "*DISTRIBUTION, NAME=DIRECTIONS_{}, LOCATION=ELEMENT, TABLE=DIRECTIONS\n, 1., 0., 0., 0., 1., 0.\n", ply);
  for (const StateElement& element : layer.field.element)
    if (!element.far)
      out += fmt::format("{}, {}, {}\n", element.number, point(vector_of(element.state.warp)),
                         point(vector_of(element.state.weft)));
  out += fmt::format("*ORIENTATION, NAME=WARP_{0}, SYSTEM=RECTANGULAR\nDIRECTIONS_{0}\n3, 0.\n", ply);
}

void add_thickness(const FibreLayer& layer, double unit, std::string& out) {
  out += fmt::format("*DISTRIBUTION, NAME=THICKNESS_{}, LOCATION=ELEMENT, TABLE=LENGTHS\n, {}\n", deck_name(layer.ply),
                     n20(layer.field.flat_thickness / unit));
  for (const StateElement& element : layer.field.element)
    if (!element.far) out += fmt::format("{}, {}\n", element.number, n20(element.state.thickness / unit));
}

}  // namespace

std::string deck_name(const std::string& name) {
  std::string out;
  for (const char c : name)
    out += std::isalnum(static_cast<unsigned char>(c)) != 0
               ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
               : '_';
  return out;
}

void map_onto_lowest(Layers& layers) {
  const FibreField& lowest = layers.front().field;
  ForeignMesh shells;
  shells.file = "the cells of ply '" + layers.front().ply + "'";
  shells.position = lowest.position;
  for (const StateElement& element : lowest.element) shells.shells.push_back({element.number, 0, element.node});
  for (std::size_t k = 1; k < layers.size(); ++k) layers[k].field = map_onto(layers[k].field, shells, {});
}

std::vector<FibreLayer> read_fibre_layers(ResultFolder& folder) {
  const Resolved& model = folder.model();
  Layers layers;
  for (std::size_t k = 0; k < model.ply.size(); ++k)
    layers.push_back({model.mesh.ply[k].name, model.ply[k].card.name, read_fibre_field(folder, k)});
  return layers;
}

FibreText layers_calculix(const Layers& layers, double group_angle, const std::string& written_by) {
  const std::vector<LayeredGroup> groups = groups_of(layers, group_angle);
  FibreText result;
  result.not_carried = {"the weft where a ply is sheared: local 2 of a layer is at right angles to its warp",
                        materials_line(layers),
                        "elements other than S6 and S8R: CalculiX takes composite sections for these two alone",
                        "fibre volume and mass ratios: only in csv and vtu"};
  std::string& out = result.text;
  out = fibre_header("**", layers.front().field, written_by, result.not_carried) + layers_words("**", layers);
  out += fmt::format("** {} groups of shells with one section\n", groups.size());
  for (std::size_t k = 0; k < groups.size(); ++k) add_calculix_group(layers, groups[k], k + 1, out);
  return result;
}

FibreText layers_abaqus(const Layers& layers, const std::string& written_by) {
  std::map<std::vector<std::size_t>, std::vector<std::size_t>> sections;  // by their layers in order: the shells
  for (std::size_t s = 0; s < layers.front().field.element.size(); ++s)
    if (const auto order = order_at(layers, s); !order.empty()) sections[order].push_back(s);
  FibreText result;
  result.not_carried = {"the weft where a ply is sheared: local 2 of a layer is at right angles to its warp",
                        materials_line(layers), "fibre volume and mass ratios: only in csv and vtu"};
  std::string& out = result.text;
  const double unit = millimetres_in(layers.front().field.unit);
  out = fibre_header("**", layers.front().field, written_by, result.not_carried) + layers_words("**", layers);
  out += "*DISTRIBUTION TABLE, NAME=DIRECTIONS\nCOORD3D, COORD3D\n";
  for (const FibreLayer& layer : layers) add_directions(layer, out);
  out += "*DISTRIBUTION TABLE, NAME=LENGTHS\nLENGTH\n";
  for (const FibreLayer& layer : layers) add_thickness(layer, unit, out);
  std::size_t number = 0;
  for (const auto& [order, shells] : sections) {
    const std::string set = fmt::format("LAYERS_{}", ++number);
    add_set(layers, set, shells, out);
    out += fmt::format("*SHELL SECTION, ELSET={}, COMPOSITE\n", set);
    for (const std::size_t k : order)
      out += fmt::format("THICKNESS_{0}, 3, {1}, WARP_{0}, {0}\n", deck_name(layers[k].ply),
                         deck_name(layers[k].material));
  }
  return result;
}

FibreText layers_openradioss(const Layers& layers, const std::string& written_by) {
  FibreText result;
  int number = 0, steep = 0;
  std::string blocks;
  for (const FibreLayer& layer : layers) {
    for (const std::size_t family : {0U, 1U})
      blocks += drape_block(layer.field, family, ++number,
                            fmt::format("{} of {}", family == 0 ? "warp" : "weft", layer.ply), steep);
  }
  result.not_carried = drape_not_carried(steep);
  result.text =
      fibre_header("#", layers.front().field, written_by, result.not_carried) + layers_words("#", layers) + blocks;
  return result;
}

FibreText layers_lsdyna(const Layers& layers, const std::string& written_by) {
  std::vector<std::string> materials;
  std::vector<std::size_t> material_of;
  for (const FibreLayer& layer : layers) {
    const auto known = std::find(materials.begin(), materials.end(), layer.material);
    material_of.push_back(static_cast<std::size_t>(known - materials.begin()) + 1);
    if (known == materials.end()) materials.push_back(layer.material);
  }
  const FibreField& shells = layers.front().field;
  const double unit = millimetres_in(shells.unit);
  const auto number = [&](int place) { return shells.number.empty() ? place + 1L : shells.number[place]; };
  FibreText result;
  result.not_carried = {
      "the weft where a ply is sheared: the material's second direction is at right angles to the warp",
      "fibre volume and mass ratios, distances: only in csv and vtu"};
  std::string& out = result.text;
  out = fibre_header("$", shells, written_by, result.not_carried) + layers_words("$", layers);
  for (std::size_t m = 0; m < materials.size(); ++m) out += fmt::format("$ MID {}: {}\n", m + 1, materials[m]);
  out += "*ELEMENT_SHELL_COMPOSITE\n";
  for (std::size_t s = 0; s < shells.element.size(); ++s) {
    const std::vector<std::size_t> order = order_at(layers, s);
    if (order.empty()) continue;
    const StateElement& shell = shells.element[s];
    out += fmt::format("{:>8}{:>8}", shell.number, 1);
    for (std::size_t k = 0; k < 4; ++k)
      out += fmt::format("{:>8}", number(shell.node[std::min(k, shell.node.size() - 1)]));
    out += "\n";
    const Vec3 edge = array_of(vector_of(shells.position[shell.node[1]]) - vector_of(shells.position[shell.node[0]]));
    for (std::size_t n = 0; n < order.size(); ++n) {
      const FibreLayer& layer = layers[order[n]];
      const FibreState& state = layer.field.element[s].state;
      const double angle = angle_in_plane(layer.field, layer.field.element[s], edge, state.warp).angle;
      out += fmt::format("{:>10}{:>10}{:>10}{}", material_of[order[n]], foreign::fit(state.thickness / unit, 9),
                         foreign::fit(angle * degrees_per_radian, 9),
                         n % 2 == 0 && n + 1 < order.size() ? "          " : "\n");
    }
  }
  return result;
}

FibreText layers_csv(const Layers& layers) {
  FibreText result;
  for (const FibreLayer& layer : layers) {
    const std::string text = fibre_csv(layer.field).text;
    std::size_t begin = 0;
    for (bool heading = true; begin < text.size(); heading = false) {
      const std::size_t end = text.find('\n', begin);
      const std::string line = text.substr(begin, end - begin);
      if (!heading || result.text.empty()) result.text += (heading ? "ply" : layer.ply) + "," + line + "\n";
      begin = end + 1;
    }
  }
  return result;
}

}  // namespace weaveform
