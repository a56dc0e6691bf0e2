// What a run is: the values of its scene, and digests of everything that the scene leads to. A checkpoint goes on only
// in a run of the same identity, and where the two differ it is said by name.
#pragma once

#include <string>
#include <vector>

#include "mesher/resolve/resolved.hpp"

namespace weaveform {

struct IdentityItem {
  std::string name;      // "tools.punch.friction", or "tool file punch.stl"
  std::string value;     // as in a scene; of a content, its digest
  bool content = false;  // value is a digest, which tells nobody anything
  bool operator==(const IdentityItem&) const = default;
};
using Identity = std::vector<IdentityItem>;

// Of a run of `program` (its version line). Keys that change no bit of the history (output.contour_step,
// output.checkpoint_minutes, analysis.energy_limit), the record of what was taken (its values are the scene's) and the
// places of files are left out. Of a tool's file the
// triangles count as well, for it may take in others or be meshed in another way. A tool's or outline's file that is
// not there counts as unknown. Throws FileError.
[[nodiscard]] Identity identity_of(const Resolved& model, const std::string& program);

// One line for each item that differs: "tools.punch.friction: 0.3 in the checkpoint, 0 now", "tool file punch.stl:
// content differs". `there` names the place of the older values.
[[nodiscard]] std::vector<std::string> differences(const Identity& older, const Identity& now,
                                                   const std::string& there = "the checkpoint");

// Of the scene's values alone, for the same comparison.
[[nodiscard]] Identity scene_identity(const Scene& scene);

// For solve.json and summary.json.
[[nodiscard]] std::string digest_of(const Identity& identity);
[[nodiscard]] std::string mesh_digest(const Mesh& mesh);

}  // namespace weaveform
