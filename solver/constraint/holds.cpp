#include "solver/constraint/holds.hpp"

#include <algorithm>

#include "mesher/mesh/symmetry.hpp"

namespace weaveform {

Holds::Holds(const Scene& scene, const Mesh& mesh, const PackedMesh& packed) : grips_(make_grips(scene, mesh, packed)) {
  find_images(mesh);
  for (auto* values : {&displacement_, &displacement_after_, &displacement_before_, &force_, &force_before_})
    values->assign(grips_.size(), 0.0);
}

// Grips are node sets of their names; a grip at rest that is mirrored onto itself feels no force across the plane.
void Holds::find_images(const Mesh& mesh) {
  const auto set_of = [&](const Grip& grip) {
    return std::find_if(mesh.sets.begin(), mesh.sets.end(), [&](const NodeSet& s) { return s.name == grip.name; }) -
           mesh.sets.begin();
  };
  for (std::size_t k = 0; k < mesh.symmetry.plane.size(); ++k) {
    std::vector<int>& image = image_.emplace_back();
    for (auto& grip : grips_) {
      const std::string& name = mesh.sets[mesh.symmetry.set_image[k][set_of(grip)]].name;
      const auto found = std::find_if(grips_.begin(), grips_.end(), [&](const Grip& g) { return g.name == name; });
      image.push_back(static_cast<int>(found - grips_.begin()));
      if (found->name != grip.name || grip.travel != 0.0) continue;
      const auto turned = mirrored_vector(grip.direction, mesh.symmetry.plane[k]);
      for (int c = 0; c < 3; ++c) grip.direction[c] = 0.5 * (grip.direction[c] + turned[c]);
    }
  }
}

void Holds::set_displacements(double part, double part_after) {
  for (std::size_t g = 0; g < grips_.size(); ++g) {
    displacement_[g] = grips_[g].travel * smooth_step(part);
    displacement_after_[g] = grips_[g].travel * smooth_step(part_after);
  }
}

void Holds::note_forces(const std::vector<double>& force) {
  for (std::size_t g = 0; g < grips_.size(); ++g) {
    force_[g] = force[g];
    work_ += 0.5 * (force_before_[g] + force_[g]) * (displacement_[g] - displacement_before_[g]);
    displacement_before_[g] = displacement_[g];
    force_before_[g] = force_[g];
  }
}

const std::vector<double>& Holds::whole_forces() {
  whole_force_ = force_;
  for (const auto& image : image_) {
    one_side_ = whole_force_;
    for (std::size_t g = 0; g < one_side_.size(); ++g) whole_force_[g] += one_side_[image[g]];
  }
  return whole_force_;
}

void Holds::archive(Archive& archive) {
  archive.numbers("a grip's force", force_before_);
  archive.numbers("a grip's displacement", displacement_before_);
  archive.number("the grips' work", work_);
}

}  // namespace weaveform
