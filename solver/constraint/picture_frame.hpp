// The shear frame (paper, Fig. 4; Eqs. 12 and 13) in the analysis: the yarns' arms end on four pinned members.
//
//   rigid       members keep their length exactly: a mechanism of one freedom, the travel d of the pulled corner.
//               With half the pulled diagonal h = (sqrt(2) L_F + d)/2 the side corners stand at +-w,
//               w = sqrt(L_F^2 - h^2). The load is the generalised force of d, F = sum of R_i . dx_i/dd over the
//               tied nodes.
//   deformable  members are trusses between the corners; tied ends share their force and mass with the member's two
//               corners (1 - share, share). The base corner is held and the pulled one moved.
#pragma once

#include <array>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/state/actor.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

struct Grip;

// The rigid frame's corners as functions of the travel.
struct FrameMechanism {
  std::array<double, 3> base = {0, 0, 0};    // mm; the corner that stays
  std::array<double, 3> along = {0, 0, 0};   // unit; from the base to the pulled corner
  std::array<double, 3> across = {0, 0, 0};  // unit; from the frame's middle to corner 1
  double length = 0.0;                       // mm; L_F
  struct Point {
    std::array<int, 2> corner = {0, 0};  // 0 .. 3
    double share = 0.0;
  };
  std::vector<Point> point;  // one per node of the grip
  struct Place {
    std::array<double, 3> position;  // mm
    std::array<double, 3> slope;     // 1; dx/d(travel)
  };
  [[nodiscard]] std::array<Place, 4> corners(double travel) const;
  [[nodiscard]] static Place on_member(const std::array<Place, 4>& corners, const Point& point);
};

// The grips of a frame: "crosshead" (the scene's name for it), and "base" when the members deform.
[[nodiscard]] std::vector<Grip> make_frame_grips(const FrameSpec& frame, const Mesh& mesh, const PackedMesh& packed);

// Members of a deformable frame: linear elastic trusses, N = E A ln(L/L0) L0/L.
class FrameMembers : public Actor {
public:
  FrameMembers(const FrameSpec& frame, const Mesh& mesh, const PackedMesh& packed);
  [[nodiscard]] std::string name() const override { return "frame members"; }
  void add_forces(State& state, double step) override;
  [[nodiscard]] StoredEnergy stored_energy() const override { return {.total = energy_}; }
  void archive(Archive& archive) override { archive.number("the frame's energy", energy_, not_negative); }
  void add_stiffness_bound(const std::vector<Vec3>& position, double fabric_frequency,
                           std::vector<double>& bound) const override;

private:
  std::array<int, 4> corner_;  // packed
  std::array<int, 4> mesh_corner_;
  double stiffness_;     // N; E A
  double length_;        // mm
  double energy_ = 0.0;  // mJ
};

}  // namespace weaveform
