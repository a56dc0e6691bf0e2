// What `weaveform drape` leaves: the drape as a result in itself.
//   drape.vtu         the cells and yarn elements that have a place: cell data shear_angle_deg and its size
//                     absolute_shear_angle_deg, folded, extrapolated, family; point data flat_position_mm
//   flat_pattern.csv  outline of the draped part of the blank, flat (mesher/drape/flat_pattern.hpp)
//   drape.json        cells, greatest angle, what is wrong and where, rate, warnings
// Of a stack drape.vtu has all plies, with `ply` as cell and point data, drape.json "plies" by name beside the sums, and
// each ply's flat pattern lies in plies/NAME.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/files/owned_files.hpp"
#include "fabric/card/card.hpp"
#include "mesher/drape/drape.hpp"
#include "post/output/ply_folder.hpp"

namespace weaveform {

namespace file_name {
inline constexpr const char *drape = "drape.vtu", *flat_pattern = "flat_pattern.csv", *drape_numbers = "drape.json";
}

[[nodiscard]] inline FileNames drape_files() {
  return joined({{file_name::drape, file_name::flat_pattern, file_name::drape_numbers},
                 in_ply_folders({file_name::flat_pattern})});
}

// A blank and how it was draped: the flat mesh, and the tools at the distance at which it lies on them.
struct DrapedBlank {
  std::string ply;  // of a stack: its name
  const Scene& scene;
  const Mesh& mesh;
  const Card& card;
  const std::vector<Tool>& tools;
  const Drape& drape;
  double off_tool = 0.0;  // mm; of its middle plane
};

struct DrapeSummary {
  int cells = 0, cells_placed = 0, folded_cells = 0, unreachable_crossings = 0, cells_beyond_card = 0;
  int extrapolated_cells = 0;  // cut by the outline where the net beyond it leaves the tool
  double max_shear_angle_deg = 0.0,
         mean_shear_angle_deg = 0.0;  // of magnitudes, placed and unfolded cells; mean by area
  double cells_per_s = 0.0;
};
[[nodiscard]] DrapeSummary summarise(const Mesh& mesh, const Card& card, const Drape& drape);

// One blank, or the plies of a stack from the lowest up. Gives what drape.json holds. Throws FileError.
nlohmann::ordered_json write_drape(const std::vector<DrapedBlank>& blanks, const std::filesystem::path& directory);
// A few lines for people, and what the drape says against itself.
[[nodiscard]] std::string describe_drape(const std::vector<DrapedBlank>& blanks);
[[nodiscard]] std::vector<std::string> drape_warnings(const std::vector<DrapedBlank>& blanks);

}  // namespace weaveform
