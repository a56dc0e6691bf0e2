// Contact of plies with each other: pressure, friction and slip between the faces of a stack.
//
// Every node of a ply meets the middle surfaces of the others, between their nodes as well (bilinear cells, triangles
// where the outline cuts them). With the node's own normal n, its foot y on the other surface is where the line along n
// meets it; r = x - y, and the depth is p = (t_a + t_b)/2 - |r|. Both plies' nodes do so, each with a share of the whole
// (ply_law.hpp), so that neither is master. What a node feels, its foot feels with the opposite sign, through the four
// nodes of its cell; the couple of friction, r x T, is returned by forces along r on the same four, so that forces and
// moments of a pair sum to zero to rounding.
//
// Friction holds an anchor in the other ply's material: its coordinates in the lattice of yarns. A node that slides
// takes its anchor along over any number of cells.
//
// Sums go in a fixed order: the same bits for any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/vector/vector.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/contact/sheared_thickness.hpp"
#include "solver/ply/ply.hpp"
#include "solver/state/actor.hpp"
#include "solver/state/archive.hpp"
#include "solver/state/contact_state.hpp"
#include "solver/state/ply_contact_state.hpp"
#include "solver/state/team.hpp"

namespace weaveform {

// What acts between two plies.
struct PairLaw {
  double friction = 0.0;  // 1; Coulomb's mu
  // Beside Coulomb: slip path (mm, from 0, rising) and the shear stress (MPa, >= 0) that resists it there; constant
  // beyond the last. None: nothing.
  std::vector<std::array<double, 2>> shear_law;
  // Approach of the middle planes from (t_a + t_b)/2 (mm, from 0, rising) and pressure (MPa, from 0, rising); its last
  // slope beyond the last. None: penalty springs (rigid plies, as near as the step allows).
  std::vector<std::array<double, 2>> compaction;
  bool operator==(const PairLaw&) const = default;
};

// All must outlive the contact.
struct PlyContactSetup {
  std::vector<Ply*> plies;                           // bottom to top, two at least
  std::vector<std::string> names;                    // for messages; none: "ply 1", ...
  std::function<PairLaw(int lower, int upper)> law;  // of each pair, neighbours or not; numbers from 0
  double frequency = 0.0;                            // 1/s; omega of the springs (contact_frequency, contact.hpp)
  // How each ply thickens as it shears, null where it does not; none: no ply does. Their owner has them look before
  // add_forces and adds their forces after it (sheared_thickness.hpp).
  std::vector<ShearedThickness*> sheared = {};
  Team& team;
};

// One pair, of what is solved (a part of the whole where that is symmetric), at the last add_forces. Only pairs that
// have touched have numbers above zero.
struct PairReading {
  int lower = 0, upper = 0;        // numbers of the plies, from 0
  double area = 0.0;               // mm^2; of what touches
  double force = 0.0;              // N; sum of the normal forces
  double friction_force = 0.0;     // N; sum of the sizes of the tangential ones
  double depth = 0.0;              // mm; greatest now
  double greatest_depth = 0.0;     // mm; so far
  double greatest_slip = 0.0;      // mm; longest slip path of a node, so far
  double mean_slip = 0.0;          // mm; of the slip paths, over the area that touches
  double pressure = 0.0;           // MPa; greatest now
  double greatest_pressure = 0.0;  // MPa; so far
  double stored = 0.0;             // mJ; in the springs
  double friction_work = 0.0;      // mJ; lost so far
  double damping_work = 0.0;       // mJ; likewise
};

class PlyContact {
public:
  // Throws InputError when plies start inside each other (with place and depth), when laws are no laws, or when plies
  // have the same place and no order.
  explicit PlyContact(const PlyContactSetup& setup);
  ~PlyContact();
  PlyContact(const PlyContact&) = delete;
  PlyContact& operator=(const PlyContact&) = delete;

  // After every ply's own forces and before they are given on to what nodes follow (Ply::give_on_forces): adds to each
  // ply's state().force. Throws PhysicsError when a node has gone through another ply: deeper than the thinner of the
  // two.
  void add_forces();

  // mJ; at the last add_forces.
  [[nodiscard]] StoredEnergy stored_energy() const;
  [[nodiscard]] EnergyFlow energy_flow() const;
  // Adds, per mesh node of a ply, the springs' row sums (N/mm), of pairs that have pressed each other (nothing before:
  // plies that do not touch have the step they have alone). `fabric_frequency` as in Actor.
  void add_stiffness_bound(int ply, double fabric_frequency, std::vector<double>& bound) const;
  // Whether a pair has come to touch since the bound was last asked for: the step must be renewed at once.
  [[nodiscard]] bool passes_bound() const;
  void renew_bound();  // from now on the bound has all pairs that have pressed each other
  void archive(Archive& archive);

  // Every pair, lower first: (0, 1), (0, 2), ..., (1, 2), ...
  [[nodiscard]] std::vector<PairReading> pairs() const;
  [[nodiscard]] PlyContactState state_of(int ply) const;
  [[nodiscard]] double greatest_depth() const;  // mm; so far, of all pairs
  [[nodiscard]] double friction_work() const;   // mJ; so far, of all pairs
  [[nodiscard]] double damping_work() const;    // mJ; likewise
  [[nodiscard]] double wall_s() const;          // spent in add_forces by this program

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace weaveform
