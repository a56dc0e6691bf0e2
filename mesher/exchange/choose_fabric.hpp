// Which lines and shells of a foreign mesh are the fabric's.
#pragma once

#include <string>
#include <vector>

#include "mesher/exchange/foreign_mesh.hpp"

namespace weaveform {

struct FabricElements {
  std::vector<const ForeignElement*> yarn, cell;
  std::vector<bool> in_warp;       // per yarn: in an element set named `warp`; all false when there is none
  bool warp_named = false;         // such a set is there
  std::vector<std::string> notes;  // what was left out
};

// Lines are yarns, unless the element sets `warp` and `weft` say which; shells are cells, but those named like one of
// `tools` (shells_named). Of a file with several instances the fabric is the one, or that of the one part, with both;
// `part` names it where there are more, and nothing is said of the parts and instances in `others`. Throws InputError
// when there is none, or more than one and no name.
[[nodiscard]] FabricElements choose_fabric(const ForeignMesh& file, const std::vector<std::string>& tools,
                                           const std::string& part, const std::vector<std::string>& others);

}  // namespace weaveform
