// A scene meshed and solved in memory, for the tests that look at histories.
#pragma once

#include <string>
#include <vector>

#include "mesher/lattice/build.hpp"
#include "mesher/scene/reader.hpp"
#include "solver/solve.hpp"

namespace weaveform::test {

inline Scene example(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return read_scene(std::string(WEAVEFORM_SOURCE_DIR) + "/examples/" + name + ".toml", overrides);
}

// The course of the hemisphere's punch with which what tests compare with was measured (bench/stability).
inline const std::string late_punch = "tools.punch.speed=[[0,0],[0.5,0.15],[0.75,1],[0.9,1],[1,0]]";

struct Solved {
  Scene scene;
  Card card;
  Mesh mesh;
  SolveResult result;

  explicit Solved(const Scene& the_scene)
      : scene(the_scene),
        card(load_card(scene.fabric.material, scene.file)),
        mesh(build_mesh(scene, card)),
        result(solve(mesh, scene, card, {}, {.threads = 1, .resume = false, .quiet = true})) {}

  [[nodiscard]] std::array<double, 2> extent() const { return blank_extent(scene.blank, read_blank_outline(scene)); }
  [[nodiscard]] double last(const std::string& column) const { return result.history.values(column).back(); }
};

}  // namespace weaveform::test
