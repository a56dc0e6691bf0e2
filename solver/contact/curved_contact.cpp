#include "solver/contact/curved_contact.hpp"

#include <algorithm>
#include <numeric>

#include "solver/constraint/grips.hpp"

namespace weaveform {
namespace {

constexpr double greatest_kink = 2.5;  // rad; as chord_kernel.cpp has the kink of chords that lie on each other
constexpr double per_kink_and_length = 1.0 / 24.0;

}  // namespace

CurvedContact::CurvedContact(const Mesh& mesh, const PackedMesh& packed, double onset)
    : stride_(packed.stride), onset_(onset) {
  for (int f = 0; f < 2; ++f) {
    before_[f].resize(packed.nodes);
    std::iota(before_[f].begin(), before_[f].end(), 0);
    after_[f] = before_[f];
    length_[f].assign(packed.nodes, 0.0);
  }
  std::array<std::vector<double>, 2> length_before = {std::vector<double>(packed.nodes, 0.0),
                                                      std::vector<double>(packed.nodes, 0.0)};
  std::array<std::vector<double>, 2> length_after = length_before;
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto [a, b] = mesh.yarns.node[e];
    // free yarn ends follow their crossing: no chord of theirs bears anything
    if (mesh.nodes.crossing[a][0] < 0 || mesh.nodes.crossing[b][0] < 0) continue;
    const int f = mesh.yarns.family[e] == Family::warp ? 0 : 1, pa = packed.packed_of_mesh[a],
              pb = packed.packed_of_mesh[b];
    after_[f][pa] = pb;
    length_after[f][pa] = mesh.yarns.rest_length[e];
    before_[f][pb] = pa;
    length_before[f][pb] = mesh.yarns.rest_length[e];
  }
  for (int f = 0; f < 2; ++f)
    for (int n = 0; n < packed.nodes; ++n) {
      if (length_before[f][n] == 0.0 || length_after[f][n] == 0.0) continue;
      length_[f][n] = 0.5 * (length_before[f][n] + length_after[f][n]);
      greatest_lift_ = std::max(greatest_lift_, length_[f][n] * greatest_kink * per_kink_and_length);
    }
  for (int first = 0; first < packed.nodes; first += group_nodes) {
    const int last = std::min(first + group_nodes, packed.nodes);
    bool even = first >= packed.stride && last + packed.stride <= packed.nodes;
    for (int n = first; n < last && even; ++n)
      for (int f = 0; f < 2; ++f) {
        const int step = f == 0 ? 1 : packed.stride;
        even = even && (length_[f][n] == 0.0 || (before_[f][n] == n - step && after_[f][n] == n + step));
      }
    even_.push_back(even ? 1 : 0);
  }
}

CurvedContact::Memory CurvedContact::new_memory() const {
  return {Doubles(before_[0].size(), 0.0), Doubles(before_[0].size(), 0.0)};
}

void CurvedContact::archive(Memory& memory, Archive& archive) {
  archive.numbers("a lift", memory.lift);
  archive.numbers("a contact's normal force", memory.normal);
}

void CurvedContact::find_turns(const State& state, int first, int count, unsigned wanted, ChordTurns& turns) const {
  const ChordLattice lattice = {.x = {state.position[0].data(), state.position[1].data(), state.position[2].data()},
                                .before = {before_[0].data(), before_[1].data()},
                                .after = {after_[0].data(), after_[1].data()},
                                .even = even_.data(),
                                .stride = stride_};
  chord_turns(lattice, first, count, wanted, turns);
}

void CurvedContact::lift_groups(const ChordTurns& turns, double time, int first, int count, const ContactGroups& groups,
                                double friction, Distances& distances, ChordTerms& terms) const {
  const double part = onset_ > 0.0 ? smooth_step(std::min(time / onset_, 1.0)) : 1.0;
  chord_terms(turns, {length_[0].data() + first, length_[1].data() + first}, count, groups, friction, part, distances,
              terms);
}

}  // namespace weaveform
