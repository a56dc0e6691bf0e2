#include "solver/state/ply_contact_state.hpp"

#include "core/vector/append.hpp"

namespace weaveform {

PlyContactState unfolded(const PlyContactState& of_part, const SymmetricPart& part) {
  PlyContactState whole;
  for (const auto& [node, planes] : part.image) {
    whole.slip.push_back(mirrored_vector(of_part.slip[node], part.mesh.symmetry.plane, planes));
    whole.slip_path.push_back(of_part.slip_path[node]);
    whole.pressure.push_back(of_part.pressure[node]);
    whole.other.push_back(of_part.other[node]);
    whole.friction.push_back(of_part.friction[node]);
  }
  return whole;
}

void append(PlyContactState& all, const PlyContactState& more) {
  append(all.slip, more.slip);
  append(all.slip_path, more.slip_path);
  append(all.pressure, more.pressure);
  append(all.other, more.other);
  append(all.friction, more.friction);
}

}  // namespace weaveform
