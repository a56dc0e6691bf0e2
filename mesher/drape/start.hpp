// Where a drape begins: the seed on the tool, the way of the warp there, the generator curves, as the scene's [drape]
// says.
#pragma once

#include <array>
#include <memory>

#include "mesher/drape/net.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {

struct DrapeStart {
  std::unique_ptr<DrapeSurface> surface;
  double offset = 0.0;  // mm; of the middle plane from the tool
  NetStart net;
  std::array<int, 2> crossing{};  // of the mesh's lattice; lies on the seed
};

// Throws InputError (drape.hpp).
[[nodiscard]] DrapeStart drape_start(const Scene& scene, const Mesh& mesh, const std::vector<Tool>& tools);

// The point of the flat blank (blank's frame) in the world.
[[nodiscard]] Eigen::Vector3d flat_point(const BlankSpec& blank, const std::array<double, 2>& point);

}  // namespace weaveform
