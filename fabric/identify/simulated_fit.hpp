// The shear law for which the simulated test gives the measured load: identification through simulation. Nothing is
// simulated here, for this room knows no solver; who calls hands in how a test is run (app/stages/specimen_trials.hpp).
//
// What one run tells of the law. In equilibrium at a travel x of the crosshead the specimen's stored energy is least,
//   U(x) = min_u [ U_yarns(u, x) + sum_c V_c W(s_c) ] ,   W(s) = integral of stress d(sin gamma) ,
// and the load is F = dU/dx. At a minimum the energy changes with a parameter p of the law as if nothing moved, so
//   dF/dp = d/dx sum_c V_c dW/dp(s_c(x)) = sum_c V_c dstress/dp(g_c) d|s_c|/dx ,   g_c = atanh |s_c| :
// how the stress at every strain counts in the load can be read off the cells' shear along one run, whatever the
// number of parameters. The three zones of the closed form are the same sum for inextensible yarns. So a round is
//   load of the law sought = simulated load + sum over strains of weight (stress sought - stress of the round) ,
// linear in the law's coefficients, and solved by the fit that makes laws of closed forms (shear_fit.hpp), with its
// forms, its positive tangent and its bands: Gauss-Newton's method with the exact derivative. A factor on the crimp that
// the yarns' decrimping law is made from (decrimping.hpp) has its derivative likewise, from the yarns' stored energy.
#pragma once

#include <array>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/chart/chart.hpp"
#include "fabric/identify/fit_spec.hpp"
#include "fabric/identify/shear_fit.hpp"

namespace weaveform::identify {

// A test of one geometry. Its loads are asked for as means over windows of the travel, in rising order.
struct SimulatedTest {
  int number = 0;  // of the geometry, among those of a fit
  std::variant<BiasRectangle, ShearFrame> specimen;
  std::vector<std::array<double, 2>> window;  // mm; travel from, to
};

// Rounds begin on cells of up to twice the size.
enum class TrialMesh { coarse, fine };

struct SimulatedLoad {
  double load = 0.0;                 // N; mean over the window
  double angle = 0.0;                // rad; of the specimen's middle, at the middle of the window
  std::vector<StressWeight> weight;  // mm^2; d load / d stress at those strains
  double decrimping = 0.0;           // N; d load / d factor on the crimp, where it is asked for
};

struct SimulatedCurve {
  std::vector<SimulatedLoad> at;  // the windows
  int runs = 0;                   // that this took
  int cells = 0;
  std::array<double, 2> coarsening = {1.0, 1.0};  // for warp and weft
  double duration = 0.0;                          // s
  double inertia = 0.0;                           // 1; share of the loads that is inertia (post/trust/inertia.hpp)
};

// The fabric that is tried; `decrimped`, where the derivative by the factor is asked for: with factors smaller and
// greater by `step`.
struct TriedFabric {
  Card card;
  std::optional<std::array<Card, 2>> decrimped;
  double step = 0.0;
};

struct Simulation {
  std::function<SimulatedCurve(const SimulatedTest&, const TriedFabric&, TrialMesh)> run;
  std::function<void(const std::string&)> tell = {};  // a line after each round
};

struct SimulationRound {
  TrialMesh mesh = TrialMesh::coarse;
  double misfit = 0.0;  // root mean square of measured less simulated, in the observations' unit
  double change = 0.0;  // 1; of the law that follows, of its greatest stress
  double factor = 1.0;  // on the crimp
};

struct Decrimping {
  double factor = 1.0;  // on the crimp
  std::array<double, 2> band = {1.0, 1.0};
};

struct SimulatedFit {
  ShearFit fit;  // of the last linearised loads
  std::vector<SimulatedTest> test;
  std::vector<std::size_t> test_of;               // of each specimen
  std::vector<std::vector<double>> begun, ended;  // per specimen: simulated values with the closed form's law and, on
                                                  // the fine mesh, with the one found
  std::vector<SimulatedCurve> last;               // of each test, with the law found
  std::vector<SimulationRound> round;
  int runs = 0;
  bool converged = false;       // the law came to rest on both meshes
  double misfit = 0.0;          // with the law found, as of a round
  double greatest_value = 0.0;  // of the measured ones
  double mesh_change = 0.0;     // 1; of the law from the coarse mesh to the fine one, of its greatest stress
  std::optional<Decrimping> decrimping;
  std::vector<std::string> warnings;
};

// The card with the yarns' decrimping laws made from `factor` times their crimp.
[[nodiscard]] Card with_decrimping(Card card, double factor);

// `closed` is what the closed form makes of the same tests, whose law the rounds begin with; `card` the fabric otherwise.
// Throws what simulation.run throws, and InputError when the specimens are hardly sheared.
[[nodiscard]] SimulatedFit fit_simulated(const ShearFit& closed, const FitSpec& spec, const Card& card,
                                         const Simulation& simulation);

// For the report, a script, tables and charts. `unit` of the values: "MPa" of frames, "N" of bias extensions.
[[nodiscard]] std::string simulation_section(const SimulatedFit& found, const std::string& unit);
[[nodiscard]] nlohmann::ordered_json simulation_json(const SimulatedFit& found);
[[nodiscard]] std::string simulated_law_csv(const ShearFit& fit);
[[nodiscard]] std::string simulated_load_csv(const SimulatedFit& found, const std::string& unit);
[[nodiscard]] Chart simulated_load_chart(const SimulatedFit& found, const std::string& unit);

}  // namespace weaveform::identify
