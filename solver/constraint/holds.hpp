// The grips that hold one ply, and what they feel and do as the analysis goes.
#pragma once

#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/constraint/grips.hpp"
#include "solver/state/archive.hpp"
#include "solver/state/packed.hpp"

namespace weaveform {

class Holds {
public:
  // `mesh` is what is solved. Throws what make_grips throws.
  Holds(const Scene& scene, const Mesh& mesh, const PackedMesh& packed);

  [[nodiscard]] std::vector<Grip>& grips() { return grips_; }
  [[nodiscard]] const std::vector<Grip>& grips() const { return grips_; }
  // mm; per grip, at the beginning and the end of the step at hand: travel times the smooth step.
  void set_displacements(double part, double part_after);
  [[nodiscard]] const std::vector<double>& displacement() const { return displacement_; }
  [[nodiscard]] const std::vector<double>& displacement_after() const { return displacement_after_; }
  // N; per grip, along its motion, at the beginning of the step: notes them, and their work since the step before.
  void note_forces(const std::vector<double>& force);
  // N; the same of the whole: a grip is held by its own nodes and by those of its images, each over its part.
  [[nodiscard]] const std::vector<double>& whole_forces();
  [[nodiscard]] double work() const { return work_; }  // mJ; so far, on what is solved
  void archive(Archive& archive);

private:
  void find_images(const Mesh& mesh);

  std::vector<Grip> grips_;
  std::vector<std::vector<int>> image_;  // per mirror plane: the grip that each is mirrored onto
  std::vector<double> displacement_, displacement_after_, displacement_before_;  // mm
  std::vector<double> force_, force_before_, whole_force_, one_side_;            // N
  double work_ = 0.0;                                                            // mJ
};

}  // namespace weaveform
