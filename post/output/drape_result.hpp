// What `weaveform drape` leaves: the drape as a result in itself.
//   drape.vtu         the cells and yarn elements that have a place: cell data shear_angle_deg and its size
//                     absolute_shear_angle_deg, folded, extrapolated, family; point data flat_position_mm
//   flat_pattern.csv  outline of the draped part of the blank, flat (mesher/drape/flat_pattern.hpp)
//   drape.json        cells, greatest angle, what is wrong and where, rate, warnings
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/files/owned_files.hpp"
#include "fabric/card/card.hpp"
#include "mesher/drape/drape.hpp"

namespace weaveform {

namespace file_name {
inline constexpr const char *drape = "drape.vtu", *flat_pattern = "flat_pattern.csv", *drape_numbers = "drape.json";
}

[[nodiscard]] inline FileNames drape_files() {
  return {file_name::drape, file_name::flat_pattern, file_name::drape_numbers};
}

struct DrapeSummary {
  int cells = 0, cells_placed = 0, folded_cells = 0, unreachable_crossings = 0, cells_beyond_card = 0;
  int extrapolated_cells = 0;  // cut by the outline where the net beyond it leaves the tool
  double max_shear_angle_deg = 0.0,
         mean_shear_angle_deg = 0.0;  // of magnitudes, placed and unfolded cells; mean by area
  double cells_per_s = 0.0;
};
[[nodiscard]] DrapeSummary summarise(const Mesh& mesh, const Card& card, const Drape& drape);

// drape.json, as a document. `mesh` flat.
[[nodiscard]] nlohmann::ordered_json drape_json(const Scene& scene, const Mesh& mesh, const Card& card,
                                                const std::vector<Tool>& tools, const Drape& drape);
// Gives what drape.json holds. `mesh` flat. Throws FileError.
nlohmann::ordered_json write_drape(const Scene& scene, const Mesh& mesh, const Card& card,
                                   const std::vector<Tool>& tools, const Drape& drape,
                                   const std::filesystem::path& directory);
// A few lines for people, and what the drape says against itself.
[[nodiscard]] std::string describe_drape(const Mesh& mesh, const Card& card, const Drape& drape);
[[nodiscard]] std::vector<std::string> drape_warnings(const Mesh& mesh, const Card& card, const Drape& drape);

}  // namespace weaveform
