// What a mesh that is a half or a quarter of a symmetric whole knows of the rest: its mirror planes.
//
// An element cut by a plane keeps the nodes beyond it; they are images of nodes on this side. An element that is its
// own image (it lies in a plane or across it) has half its section or area, and a node in a plane half its mass, so
// that the energies, masses and forces of the whole are parts() times those of the mesh, and the stable step is the
// same. MeshYarns::yarns stays the number of yarns in the whole.
//
// A force that looks at neighbours (bending) finds them as in a whole mesh when the part was cut with `run_on`
// (cut_part.hpp). What it computes about a node counts by node_share.
#pragma once

#include <array>
#include <vector>

namespace weaveform {

struct SymmetryPlane {
  std::array<double, 3> point = {0.0, 0.0, 0.0};   // mm
  std::array<double, 3> normal = {1.0, 0.0, 0.0};  // unit; the mesh lies on the side it points to
};

// x of `node` = image of x of `of` in every plane whose bit is set; `of` is no image itself. Either may stand in a tie:
// `of` as one that follows others, `node` as one that is followed.
struct MirrorImage {
  int node = 0;
  int of = 0;
  unsigned planes = 0;
};

struct MeshSymmetry {
  std::vector<SymmetryPlane> plane;         // none: the mesh is the whole; two stand at right angles
  std::vector<std::vector<int>> on_plane;   // per plane, rising: the nodes in it, which do not leave it
  std::vector<MirrorImage> image;           // nodes beyond a plane
  std::vector<int> whole_node;              // the number each node has in the whole mesh
  std::vector<std::vector<int>> set_image;  // per plane: the number of the set that each of Mesh::sets is mirrored onto
  // The whole is this many times the mesh.
  [[nodiscard]] int parts() const { return 1 << plane.size(); }
};

// Per node: 1, 1/2 in a plane, 1/4 in two, 0 for an image.
[[nodiscard]] std::vector<double> node_share(const MeshSymmetry& symmetry, int node_count);

// v - 2 (v.n) n, and the same for a place.
[[nodiscard]] std::array<double, 3> mirrored_vector(const std::array<double, 3>& v, const SymmetryPlane& plane);
[[nodiscard]] std::array<double, 3> mirrored_point(const std::array<double, 3>& x, const SymmetryPlane& plane);
// In every plane whose bit is set.
[[nodiscard]] std::array<double, 3> mirrored_vector(std::array<double, 3> v, const std::vector<SymmetryPlane>& plane,
                                                    unsigned which);
// Rows of the matrix that does that.
[[nodiscard]] std::array<std::array<double, 3>, 3> reflection(const std::vector<SymmetryPlane>& plane, unsigned which);

}  // namespace weaveform
