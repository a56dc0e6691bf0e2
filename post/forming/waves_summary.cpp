// Waves in numbers: for scripts and for people.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "post/forming/waves.hpp"

namespace weaveform {
namespace {

constexpr double worth_a_line = 0.01;  // 1; of the fibre compressed

// Without half waves there is no length and no height.
nlohmann::ordered_json measure_json(const WaveMeasure& measure) {
  using Json = nlohmann::ordered_json;
  const bool any = measure.half_waves > 0;
  const auto known = [&](double value) { return any ? Json(value) : Json(); };
  return {{"half_waves", measure.half_waves},
          {"wavelength_mm", known(measure.wavelength)},
          {"quartiles_mm", any ? Json(measure.quartiles) : Json()},
          {"cells_per_wave", known(measure.cells)},
          {"amplitude_mm", known(measure.amplitude)},
          {"largest_amplitude_mm", known(measure.greatest_amplitude)}};
}

}  // namespace

nlohmann::ordered_json waves_json(const Waves& waves) {
  nlohmann::ordered_json json = {{"of", nullptr}};
  if (waves.are() != WavesOf::nobody) json["of"] = waves.are() == WavesOf::fabric ? "fabric" : "mesh";
  json.update(measure_json(waves.all));
  json["least_cells_per_wave"] = least_cells_per_wave;
  json["unresolved_share"] = waves.unresolved_share;
  json["area_share"] = waves.area_share;
  json["compressed_fibre_share"] = waves.compressed_share;
  json["warp"] = measure_json(waves.yarn[0]);
  json["weft"] = measure_json(waves.yarn[1]);
  return json;
}

std::string waves_in_words(const Waves& waves) {
  if (waves.are() == WavesOf::nobody) return "none";
  const WaveMeasure& all = waves.all;
  return fmt::format(
      "the {}'s: {:.3g} mm long (half of them {:.3g} to {:.3g}) at {:.2g} cells a wave, {:.3g} mm in "
      "amplitude ({:.3g} at most)",
      waves.are() == WavesOf::fabric ? "fabric" : "mesh", all.wavelength, all.quartiles[0], all.quartiles[1], all.cells,
      all.amplitude, all.greatest_amplitude);
}

std::string waves_table(const Waves& waves) {
  std::string lines;
  if (waves.are() != WavesOf::nobody)
    lines += fmt::format("waves   {}; over {:.3g} % of the area\n", waves_in_words(waves), 100.0 * waves.area_share);
  if (waves.compressed_share >= worth_a_line)
    lines += fmt::format("fibre   {:.3g} % of it is compressed by more than {:g} %\n", 100.0 * waves.compressed_share,
                         100.0 * compressed_from);
  return lines;
}

}  // namespace weaveform
