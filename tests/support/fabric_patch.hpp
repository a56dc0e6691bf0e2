// A patch of fabric with everything the mesher can make in it (lattice rows, cut cells, yarn ends), ready to load by
// hand.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/lattice/forces.hpp"
#include "solver/ply/energy.hpp"
#include "solver/result/fields.hpp"

namespace weaveform::test {

struct FabricPatch {
  Scene scene;
  Card card;
  Mesh mesh;
  PackedMesh packed;
  State state;
  std::array<TangentLaw, 2> laws;

  explicit FabricPatch(const std::string& material = "twintex-pw", double yarn_angle = 30.0,
                       std::array<double, 2> size = {60.0, 80.0}, Formulation formulation = Formulation::energy,
                       Thickness thickness = Thickness::constant_volume, Section section = Section::incompressible)
      : scene(make_scene(material, yarn_angle, size, formulation, thickness, section)),
        card(load_card(material)),
        mesh(build_mesh(scene, card)),
        packed(pack_mesh(mesh)),
        state(initial_state(packed, mesh)),
        laws(yarn_laws(card, scene.model)) {}

  static Scene make_scene(const std::string& material, double yarn_angle, std::array<double, 2> size,
                          Formulation formulation, Thickness thickness, Section section) {
    Scene scene;
    scene.fabric.material = material;
    scene.blank.yarn_angle = yarn_angle;
    scene.blank.size = size;
    scene.model.formulation = formulation;
    scene.model.thickness = thickness;
    scene.model.section = section;
    return scene;
  }

  // Moves every mesh node to map(flat position).
  void move(const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) {
    for (int n = 0; n < mesh.node_count(); ++n) {
      const auto& x = mesh.nodes.position[n];
      const Eigen::Vector3d to = map({x[0], x[1], x[2]});
      for (int c = 0; c < 3; ++c) state.position[c][packed.packed_of_mesh[n]] = to[c];
    }
  }

  // Internal force on every mesh node, N.
  [[nodiscard]] std::vector<Eigen::Vector3d> forces(int threads = 1,
                                                    Precision precision = Precision::double_precision) {
    Team team(threads);
    FabricForces fabric(packed, card, laws, scene.model, initial_state(packed, mesh), team, precision);
    fabric.compute(state);
    std::vector<Eigen::Vector3d> result;
    for (const int n : packed.packed_of_mesh)
      result.emplace_back(state.force[0][n], state.force[1][n], state.force[2][n]);
    return result;
  }

  [[nodiscard]] double energy() const {
    InternalEnergy internal(mesh, card, laws, scene.model);
    return internal(mesh_positions(packed, state));
  }

  // Unit yarn directions on the flat blank.
  [[nodiscard]] std::array<Eigen::Vector3d, 2> yarn_directions() const {
    const double angle = (scene.blank.yarn_angle + scene.blank.orientation) * 3.14159265358979323846 / 180.0;
    return {Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0),
            Eigen::Vector3d(-std::sin(angle), std::cos(angle), 0.0)};
  }
};

}  // namespace weaveform::test
