// Fibres do not shorten, and a yarn under compression gives way sideways. What a model lets it shorten instead is its
// compression modulus' choice, and takes shear away from the fabric: on the hemisphere of the examples the punch force
// is 0.9 % short of its limit of stiff yarns where yarns shorten by 0.8 % at most, 1.8 % at 1.7 %, 2.7 % at 2.9 %
// and 3.7 % at 6.9 % (docs/stability.md).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "post/trust/borders.hpp"

namespace weaveform {
namespace {

constexpr double most_shortening = 0.02;  // 1; true strain: 2 % of the force

}  // namespace

void warn_of_compressed_yarns(const FinishedRun& run, Warnings& warnings) {
  const ModelSpec& model = run.scene.model;
  const std::vector<double>& strain = run.end.yarn_strain;
  // a seatbelt alone is asked to bear nothing
  if (strain.empty() || (model.yarn == YarnElement::seatbelt && model.partner == SeatbeltPartner::none)) return;
  const auto least = std::min_element(strain.begin(), strain.end());
  if (*least >= -most_shortening) return;
  const auto element = static_cast<std::size_t>(least - strain.begin());
  const std::size_t family = run.mesh.yarns.family[element] == Family::warp ? 0 : 1;
  const double modulus =
      yarn_laws(run.card, model)[family].tangent(*least);  // MPa; of this law, scaled as the run had it
  warnings.push_back(
      fmt::format("yarns shorten by up to {:.2g} % at the end ({} between nodes {} and {}), where real ones would give "
                  "way sideways: beyond {:g} % loads and angles fall short by about as much; raise "
                  "model.compression_modulus (here {:.3g} MPa) in that proportion, up to a quarter of the tensile "
                  "modulus it costs no time",
                  100.0 * -std::expm1(*least), family == 0 ? "warp" : "weft", run.mesh.yarns.node[element][0],
                  run.mesh.yarns.node[element][1], 100.0 * most_shortening, modulus));
}

}  // namespace weaveform
