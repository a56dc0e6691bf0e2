// An example scene with its card and mesh, written for another code.
#pragma once

#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/exchange/export.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform::test {

struct ExportedExample {
  static constexpr double duration = 0.5;  // s
  Scene scene;
  Card card;
  Mesh mesh;
  explicit ExportedExample(const std::vector<std::string>& overrides, const std::string& example = "bias_extension_pw")
      : scene(read_scene(std::string(WEAVEFORM_SOURCE_DIR) + "/examples/" + example + ".toml", overrides)),
        card(load_card(scene.fabric.material, scene.file)),
        mesh(build_mesh(scene, card)) {}
  [[nodiscard]] ExportedMesh written(MeshFormat format, const ExportOptions& options = {}) const {
    return export_mesh(format, scene, card, mesh, make_tools(scene, mesh), duration, "test", options);
  }
};

}  // namespace weaveform::test
