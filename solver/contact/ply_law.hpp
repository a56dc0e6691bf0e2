// The laws between two plies as the inner loop takes them.
//
// Stiffness. A node of mass m_a that touches a fabric of m_b in its place is on a spring
//   k = s omega^2 m_a m_b / (m_a + m_b)
// whose own frequency against both is sqrt(s) omega, omega a fixed share of the fabric's greatest (contact.hpp), so that
// no spring sets the step; m_b is the other fabric's mass on the node's area, but no more than one of its own nodes has.
// The tangential spring works on the node's neighbours as well, which turn its normal, by a ratio of x = reach/spacing:
//   k_t = k / ((1 + x) (1 + 2 x))
//
// Shares. The nodes of ply a carry s = t_a / (t_a + t_b) of what acts between a and b, those of b the rest. The couple of
// a node's friction goes to its own ply: T (t_a + t_b)/2 times that share is the couple that friction on a face has about
// the ply's own middle, T t_a/2.
#pragma once

#include <string>
#include <vector>

#include "solver/contact/ply_contact.hpp"
#include "solver/contact/ply_kernel.hpp"

namespace weaveform {

// Of one of two plies.
struct TouchingPly {
  double thickness = 0.0;  // mm
  double density = 0.0;    // tonne/mm^2
  double spacing = 0.0;    // mm; the smaller
  double node_mass = 0.0;  // tonne; of a node inside the fabric
};

// The tables of a pair, at even intervals; empty where there are none.
struct PairTables {
  std::vector<double> shear, pressure, pressure_energy;
  EvenTable shear_table, pressure_table, energy_table;  // of the three; valid where this is not copied
  double stiffest = 0.0;                                // MPa/mm; greatest slope of the pressure
  double softened_from = 0.0;                           // mm; beyond it the measured law is stiffer than the springs
  PairTables() = default;
  PairTables(const PairTables&) = delete;
  PairTables& operator=(const PairTables&) = delete;
};

// What is wrong with a law, in one line; "" for a sound one.
[[nodiscard]] std::string wrong_law(const PairLaw& law);

// MPa/mm; pressure over depth of the springs of both faces together.
[[nodiscard]] double spring_stiffness(const TouchingPly& a, const TouchingPly& b, double frequency);
// N/mm; of a node of `own` with this mass (tonne) and area (mm^2).
[[nodiscard]] double node_stiffness(const TouchingPly& own, const TouchingPly& other, double frequency, double mass,
                                    double area);

// A measured pressure that rises faster than the springs' would set the step: from there on it rises as they do.
void make_tables(const PairLaw& law, const TouchingPly& a, const TouchingPly& b, double frequency, PairTables& tables);

// `above`: whether the nodes lie above the surface.
[[nodiscard]] PlyPassLaw pass_law(const PairLaw& law, const PairTables& tables, const TouchingPly& own,
                                  const TouchingPly& other, bool above, double frequency);

// mm; of the middle planes at which they touch.
[[nodiscard]] double reach_of(const TouchingPly& a, const TouchingPly& b);

}  // namespace weaveform
