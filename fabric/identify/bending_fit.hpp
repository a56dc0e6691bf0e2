// The moment-curvature law of a fabric along one direction (or both alike) from its specimens: their mean curve in as
// few pieces as it needs, with a confidence band.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/chart/chart.hpp"
#include "fabric/identify/bending_tests.hpp"

namespace weaveform::identify {

// The law at one curvature.
struct BendingPoint {
  double curvature = 0.0;  // 1/mm
  double moment = 0.0;     // N
  double tangent = 0.0;    // N mm
  double half_band = 0.0;  // N; of the confidence interval of the moment
  double mean = 0.0;       // N; of the specimens
  double deviation = 0.0;  // N; between them, 0 for one
  int specimens = 0;       // that reach this curvature
};

struct BendingFit {
  BendingSource source = BendingSource::moment_curvature;
  std::array<bool, 2> along = {true, true};  // warp, weft
  BentSense sense = BentSense::both;         // the side outwards; both: a law for both senses
  std::vector<BendingSpecimen> specimens;
  BendingCurve curve;                       // per width; of [[peirce]] constant
  std::vector<BendingPoint> law;            // from zero to the greatest curvature fitted
  double misfit = 0.0;                      // N; greatest distance of the law from the specimens' mean
  double freedom = 0.0;                     // degrees of freedom of the band at small curvatures
  std::optional<BendingFriction> friction;  // N per width; mean of those to and fro
  // [[peirce]]: rigidities of the specimens and the interval of their mean, N mm
  std::vector<double> rigidities;
  double rigidity = 0.0, rigidity_deviation = 0.0;
  std::array<double, 2> rigidity_band = {0.0, 0.0};
  std::string senses;  // a sentence on how the two senses compare; "" where they were not tested by themselves
  std::vector<std::string> warnings;
  [[nodiscard]] bool is_constant() const { return source == BendingSource::peirce; }
  [[nodiscard]] double first_stiffness() const { return is_constant() ? rigidity : curve.tangent.front(); }  // N mm
  [[nodiscard]] std::string name() const;  // "moment_curvature", "cantilever_warp_face": of files and headings
};

// Every kind of test in the fit file, of both directions in one where the same tests stand for both, else one for each
// direction that was tested.
//
// Specimens are the independent units: at a curvature the interval is Student's t over the curves of those that reach
// it, shapes counting as much as their own errors let them, with what the law's few pieces leave of their mean added; one
// specimen alone has its own residuals.
//
// Senses: where specimens were bent with the face outwards and others, or the same the other way, with the back, the two laws
// are made each by itself, and where they differ, on the mean over the curvatures that both reach, by more than their bands
// together, |M_face - M_back| > (b_face^2 + b_back^2)^(1/2), they are two fits one after the other, `face` and `back`; else
// one of all specimens, for both senses. Specimens of either sense count for both.
[[nodiscard]] std::vector<BendingFit> fit_bending(const FitSpec& spec);

// Which of them makes the card's law along a family (0 warp, 1 weft), by [bending_law] from; none: nothing was measured.
// Of two senses that of the face; the next is that of the back.
[[nodiscard]] std::optional<std::size_t> bending_of(const std::vector<BendingFit>& fits, const FitSpec& spec,
                                                    std::size_t family);

// The specimens and the law: for a table, a chart, the report and a script.
[[nodiscard]] std::string bending_csv(const BendingFit& fit);
[[nodiscard]] Chart bending_chart(const BendingFit& fit, double confidence);
[[nodiscard]] std::string bending_section(const BendingFit& fit, const FitSpec& spec, bool makes_card);

}  // namespace weaveform::identify
