// The program's own cantilever (examples/cantilever_pw.toml): with a bending law of one's own, and where its tip hangs.
#pragma once

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "core/files/files.hpp"
#include "tests/support/scene_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace weaveform::test {

// mm; the mean of the last crossings along the strip, `along` it (the mesher may stop a sliver short of the outline).
struct StripTip {
  double along = 0.0, x = 0.0, drop = 0.0;
};

inline StripTip tip_of(const Solved& run) {
  const double clamp = -0.5 * run.scene.blank.size[0];
  double end = clamp;
  for (const auto& flat : run.mesh.nodes.position) end = std::max(end, flat[0]);
  StripTip tip = {.along = end - clamp};
  int count = 0;
  for (int n = 0; n < run.mesh.node_count(); ++n) {
    if (run.mesh.nodes.position[n][0] < end - 1e-6) continue;
    tip.x += run.result.position[n][0] - clamp;
    tip.drop -= run.result.position[n][2];
    ++count;
  }
  tip.x /= count;
  tip.drop /= count;
  return tip;
}

// The plain weave with other lines for `bending_out_of_plane`, and yarns a tenth as stiff, which saves steps.
class StripWithLaw {
public:
  explicit StripWithLaw(const std::string& law) {
    std::string text = read_text_file(std::string(WEAVEFORM_SOURCE_DIR) + "/fabric/cards/twintex-pw.toml");
    const auto replace = [&](const std::string& begin, const std::string& by) {
      const auto at = text.find(begin);
      text.replace(at, text.find('\n', at) - at, by);
    };
    replace("rigidity = ", "");
    replace("bending_out_of_plane = ", law);
    std::ofstream(card()) << text;
  }
  [[nodiscard]] Solved run(std::vector<std::string> overrides) const {
    for (const char* line : {"model.yarn_stiffness_scale=0.1", "model.yarn_law=\"linear\""})
      overrides.emplace_back(line);
    overrides.push_back("fabric.material=\"" + card() + "\"");
    return Solved(example("cantilever_pw", overrides));
  }

private:
  [[nodiscard]] std::string card() const { return (folder_.path() / "own_law.toml").string(); }
  TemporaryFolder folder_;
};

}  // namespace weaveform::test
