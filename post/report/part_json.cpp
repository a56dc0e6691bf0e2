#include "post/report/part_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "core/vector/append.hpp"
#include "mesher/mesh/stack.hpp"
#include "mesher/mesh/vtu_grid.hpp"
#include "post/report/base64.hpp"
#include "post/report/shown_part.hpp"
#include "solver/result/beside.hpp"
#include "solver/result/stack_fields.hpp"

namespace weaveform {
namespace {

using Json = nlohmann::ordered_json;

enum class Scale { sequential, diverging, categories };
enum class On { cells, nodes };

// A field of the page over the frames shown; values of shown cells or nodes, not a number where there is none.
struct Track {
  std::string name, title, unit;
  Scale scale = Scale::sequential;
  On on = On::cells;
  bool from_zero = false;
  std::vector<std::string> category = {};
  std::optional<double> limit = {};
  std::vector<std::vector<double>> frame = {};
};

const char* word_of(Scale scale) {
  return scale == Scale::sequential ? "sequential" : scale == Scale::diverging ? "diverging" : "categories";
}

std::vector<FrameFile> evenly(const std::vector<FrameFile>& frames, std::size_t count) {
  if (count >= frames.size()) return frames;
  std::vector<FrameFile> kept;
  for (std::size_t k = 0; k < count; ++k) kept.push_back(frames[k * (frames.size() - 1) / (count - 1)]);
  return kept;
}

// A shown cell says the value farthest from zero of those it stands for, so that no peak is thinned away.
std::vector<double> on_cells(const ShownPart& part, const std::vector<double>& values, double factor = 1.0) {
  std::vector<double> shown(part.cell.size());
  for (std::size_t c = 0; c < shown.size(); ++c) {
    double most = values[static_cast<std::size_t>(part.of[static_cast<std::size_t>(part.first[c])])];
    for (int k = part.first[c]; k < part.first[c + 1]; ++k) {
      const double value = values[static_cast<std::size_t>(part.of[static_cast<std::size_t>(k)])];
      if (std::abs(value) > std::abs(most)) most = value;
    }
    shown[c] = factor * most;
  }
  return shown;
}

std::vector<double> on_nodes(const ShownPart& part, const std::vector<double>& values) {
  std::vector<double> shown;
  shown.reserve(part.node.size());
  for (const int n : part.node) shown.push_back(values[static_cast<std::size_t>(n)]);
  return shown;
}

// What every result has, computed from the positions as post does.
std::vector<Track> fabric_tracks(const Resolved& model) {
  double limit = model.card.shear.valid_to_deg;  // of a stack, the least
  for (const Resolved& ply : model.ply) limit = std::min(limit, ply.card.shear.valid_to_deg);
  std::vector<Track> tracks = {
      {.name = "shear_angle", .title = "shear angle", .unit = "°", .from_zero = true, .limit = limit},
      {.name = "signed_shear_angle", .title = "shear angle with its sign", .unit = "°", .scale = Scale::diverging},
      {.name = "yarn_strain", .title = "yarn strain (mean around a cell)", .unit = "%", .scale = Scale::diverging},
      {.name = "thickness", .title = "thickness", .unit = "mm"},
      {.name = "areal_weight", .title = "areal weight over the flat fabric's", .unit = "1"},
      {.name = "folded",
       .title = "folded cells",
       .unit = "",
       .scale = Scale::categories,
       .category = {"no", "folded"}}};
  return tracks;
}

std::vector<Track> contact_tracks(const Scene& scene) {
  std::vector<std::string> tools = {"none"};
  for (const ToolSpec& tool : scene.tools) tools.push_back(tool.name);
  return {{.name = "contact_pressure", .title = "contact pressure", .unit = "MPa", .from_zero = true},
          {.name = "contact_tool",
           .title = "tool in contact",
           .unit = "",
           .scale = Scale::categories,
           .on = On::nodes,
           .category = tools},
          {.name = "friction",
           .title = "friction",
           .unit = "",
           .scale = Scale::categories,
           .on = On::nodes,
           .category = {"no contact", "sticks", "slips"}}};
}

std::vector<Track> ply_tracks() {
  return {
      {.name = "slip_path", .title = "slip between plies", .unit = "mm", .on = On::nodes, .from_zero = true},
      {.name = "ply_pressure", .title = "pressure between plies", .unit = "MPa", .on = On::nodes, .from_zero = true},
      {.name = "ply_friction",
       .title = "friction between plies",
       .unit = "",
       .scale = Scale::categories,
       .on = On::nodes,
       .category = {"no contact", "sticks", "slips"}}};
}

std::vector<double> as_numbers(const std::vector<bool>& flags) {
  return {flags.begin(), flags.end()};
}

void add_fabric(std::vector<Track>& track, const ShownPart& part, const Mesh& mesh, const CellsBeside& beside,
                const Fields& fields) {
  std::vector<double> size = fields.shear_angle;
  for (double& angle : size) angle = std::abs(angle);
  track[0].frame.push_back(on_cells(part, size, degrees_per_radian));
  track[1].frame.push_back(on_cells(part, fields.shear_angle, degrees_per_radian));
  track[2].frame.push_back(on_cells(part, mean_on_cells(beside, fields.yarn_strain, mesh.cells.size()), 100.0));
  track[3].frame.push_back(on_cells(part, fields.thickness));
  track[4].frame.push_back(on_cells(part, fields.areal_weight));
  track[5].frame.push_back(on_cells(part, as_numbers(fields.folded)));
}

std::vector<double> numbers_of(const std::vector<VtuArray>& data, const FrameFile& frame, const std::string& name,
                               std::size_t count) {
  const VtuArray* array = find_array(data, name);
  if (array == nullptr || array->size() != count)
    throw InputError(fmt::format("{}: '{}' has {} values where the mesh beside it asks for {}; solve again",
                                 frame.file.string(), name, array == nullptr ? 0 : array->size(), count));
  std::vector<double> numbers(count);
  for (std::size_t k = 0; k < count; ++k) numbers[k] = array->as_double(k);
  return numbers;
}

// Contact is the solver's and stands in the frames; its arrays on cells hold the lines' values first.
void add_contact(std::vector<Track>& track, std::size_t at, const ShownPart& part, const Mesh& mesh,
                 const FrameFile& frame) {
  const VtuGrid grid = read_vtu(
      frame.file, std::vector<std::string>{"contact_pressure_MPa", "contact_tool", "friction_state"}, "solve again");
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  std::vector<double> pressure = numbers_of(grid.cell_data, frame, "contact_pressure_MPa",
                                            static_cast<std::size_t>(mesh.yarn_count() + mesh.cells.size()));
  pressure.erase(pressure.begin(), pressure.begin() + mesh.yarn_count());
  track[at].frame.push_back(on_cells(part, pressure));
  track[at + 1].frame.push_back(on_nodes(part, numbers_of(grid.point_data, frame, "contact_tool", nodes)));
  track[at + 2].frame.push_back(on_nodes(part, numbers_of(grid.point_data, frame, "friction_state", nodes)));
}

void add_slip(std::vector<Track>& track, std::size_t at, const ShownPart& part, const Mesh& mesh,
              const FrameFile& frame) {
  const std::vector<std::string> names = {"slip_path_mm", "ply_pressure_MPa", "ply_friction_state"};
  const VtuGrid grid = read_vtu(frame.file, names, "solve again");
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  for (std::size_t k = 0; k < names.size(); ++k)
    track[at + k].frame.push_back(on_nodes(part, numbers_of(grid.point_data, frame, names[k], nodes)));
}

// The ply of each shown cell, which stands for cells of one ply only.
std::string packed_plies(const ShownPart& part, const Mesh& mesh) {
  const std::vector<int> of_cells = ply_of_cells(mesh);
  std::vector<std::uint8_t> numbers;
  for (std::size_t c = 0; c < part.cell.size(); ++c)
    numbers.push_back(static_cast<std::uint8_t>(
        of_cells[static_cast<std::size_t>(part.of[static_cast<std::size_t>(part.first[c])])]));
  return base64(numbers);
}

Json ply_names(const Scene& scene) {
  Json names = Json::array();
  for (const PlySpec& ply : scene.ply) names.push_back(ply.name);
  return names;
}

// Wrinkles are found in the last frame alone; `relief_of_nodes` of all plies.
void add_wrinkles(std::vector<Track>& track, const ShownPart& part, const Forming& forming,
                  const std::vector<double>& relief_of_nodes, std::size_t frames) {
  Track relief{.name = "wrinkle_relief",
               .title = "relief of wrinkles (last frame)",
               .unit = "mm",
               .on = On::nodes,
               .from_zero = true,
               .limit = forming.wrinkle_limits.relief(forming.flat_thickness)};
  const std::vector<double> none(part.node.size(), std::numeric_limits<double>::quiet_NaN());
  relief.frame.assign(frames, none);
  relief.frame.back() = on_nodes(part, relief_of_nodes);
  track.push_back(relief);
}

std::array<double, 2> range_of(const Track& track) {
  if (track.scale == Scale::categories) return {0.0, std::max(1.0, static_cast<double>(track.category.size()) - 1.0)};
  std::array<double, 2> range = {std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const auto& frame : track.frame)
    for (const double value : frame)
      if (std::isfinite(value)) range = {std::min(range[0], value), std::max(range[1], value)};
  if (range[0] > range[1]) return {0.0, 1.0};
  if (track.scale == Scale::diverging) {
    const double most = std::max({std::abs(range[0]), std::abs(range[1]), 1e-9});
    return {-most, most};
  }
  if (track.from_zero) range[0] = 0.0;
  // a field that is the same everywhere to rounding
  const double least = std::max(1e-9, 1e-6 * std::max(std::abs(range[0]), std::abs(range[1])));
  if (range[1] - range[0] < least) range[1] = range[0] + least;
  return range;
}

constexpr double steps_of_a_field = 65534.0;
constexpr std::uint16_t no_value = 65535;

std::string packed(const std::vector<double>& values, const std::array<double, 2>& range) {
  std::vector<std::uint16_t> numbers;
  numbers.reserve(values.size());
  for (const double value : values) {
    const double part = (value - range[0]) / (range[1] - range[0]);
    numbers.push_back(std::isfinite(part)
                          ? static_cast<std::uint16_t>(std::lround(std::clamp(part, 0.0, 1.0) * steps_of_a_field))
                          : no_value);
  }
  return base64(numbers);
}

std::string packed_positions(const ShownPart& part, const std::vector<Vec3>& position, const Vec3& origin,
                             double step) {
  std::vector<std::int16_t> numbers;
  numbers.reserve(3 * part.node.size());
  for (const int n : part.node)
    for (std::size_t c = 0; c < 3; ++c)
      numbers.push_back(static_cast<std::int16_t>(
          std::lround(std::clamp((position[static_cast<std::size_t>(n)][c] - origin[c]) / step, -32767.0, 32767.0))));
  return base64(numbers);
}

std::string packed_yarns(const std::vector<std::array<int, 2>>& yarns) {
  std::vector<std::uint32_t> numbers;
  for (const auto& [a, b] : yarns)
    numbers.insert(numbers.end(), {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
  return base64(numbers);
}

std::string packed_cells(const ShownPart& part) {
  std::vector<std::uint32_t> numbers;
  for (const auto& cell : part.cell)
    for (const int place : cell) numbers.push_back(static_cast<std::uint32_t>(place));
  return base64(numbers);
}

// Of the mesh, as mesh.vtu and messages count them; of a block the cell that is sheared most at the end.
std::string cell_numbers(const ShownPart& part, const std::vector<double>& shear_angle) {
  std::vector<std::uint32_t> numbers;
  for (std::size_t c = 0; c < part.cell.size(); ++c) {
    const auto begin = part.of.begin() + part.first[c], end = part.of.begin() + part.first[c + 1];
    numbers.push_back(static_cast<std::uint32_t>(*std::max_element(begin, end, [&](int a, int b) {
      return std::abs(shear_angle[static_cast<std::size_t>(a)]) < std::abs(shear_angle[static_cast<std::size_t>(b)]);
    })));
  }
  return base64(numbers);
}

std::size_t frame_bytes(const ShownPart& part, const std::vector<Track>& tracks) {
  std::size_t bytes = 6 * part.node.size();
  for (const Track& track : tracks) bytes += 2 * (track.on == On::cells ? part.cell.size() : part.node.size());
  return bytes;
}

std::size_t topology_bytes(const ShownPart& part) {
  return 20 * part.cell.size() + 8 * (part.yarn[0].size() + part.yarn[1].size());
}

struct Thinning {
  ShownPart part;
  int block = 1;
  std::size_t frames = 0;
};

// The smallest blocks with which `least_frames` fit, and then as many frames as do.
Thinning thinned(const Mesh& mesh, const std::vector<Track>& tracks, std::size_t frames, std::size_t most_bytes) {
  Thinning found;
  const std::size_t wanted = std::min(frames, least_frames);
  for (found.block = 1;; found.block *= 2) {
    found.part = shown_part(mesh, found.block);
    const std::size_t fixed = topology_bytes(found.part), each = frame_bytes(found.part, tracks);
    const bool fits = fixed + wanted * each <= most_bytes;
    if (!fits && found.block < 64) continue;
    found.frames = fits ? std::min(frames, (most_bytes - fixed) / each) : wanted;
    return found;
  }
}

std::string thinning_words(const Thinning& thinning, const Mesh& mesh, std::size_t all_frames) {
  std::string words;
  if (thinning.frames < all_frames) words = fmt::format("{} of {} frames are shown", thinning.frames, all_frames);
  if (thinning.block > 1)
    words += fmt::format(
        "{}the lattice of {} cells is drawn in blocks of {} x {}, each with the value farthest from zero of its cells",
        words.empty() ? "" : "; ", mesh.cells.size(), thinning.block, thinning.block);
  return words.empty() ? words : words + "; the frames' files hold all";
}

std::string label_of(const FrameFile& frame, ResultFolder& folder) {
  const double end = folder.statistics().duration_s;
  return fmt::format("{:.0f} % of the way", end > 0.0 ? 100.0 * frame.time / end : 100.0);
}

}  // namespace

PartPage part_json(ResultFolder& folder, const Summary& summary, std::size_t most_bytes) {
  const Resolved& model = folder.model();
  const Mesh& mesh = model.mesh;
  const bool has_contact = !model.scene.tools.empty();
  std::vector<Track> tracks = fabric_tracks(model);
  const std::size_t contact_at = tracks.size();
  if (has_contact)
    for (Track& track : contact_tracks(model.scene)) tracks.push_back(std::move(track));
  const std::size_t slip_at = tracks.size();
  const bool slides = model.ply.size() > 1;
  if (slides)
    for (Track& track : ply_tracks()) tracks.push_back(std::move(track));
  const Thinning thinning = thinned(mesh, tracks, folder.frames().size(), most_bytes);
  const ShownPart& part = thinning.part;

  PartPage page;
  page.frames = evenly(folder.frames(), thinning.frames);
  page.low = {1e300, 1e300, 1e300};
  page.high = {-1e300, -1e300, -1e300};
  const CellsBeside beside = cells_beside_yarns(mesh);
  std::vector<std::vector<Vec3>> positions;
  Fields end;
  for (const FrameFile& frame : page.frames) {
    positions.push_back(folder.positions(frame));
    for (const Vec3& x : positions.back())
      for (std::size_t c = 0; c < 3; ++c)
        page.low[c] = std::min(page.low[c], x[c]), page.high[c] = std::max(page.high[c], x[c]);
    end = compute_fields(model, frame.time, positions.back());
    add_fabric(tracks, part, mesh, beside, end);
    if (has_contact) add_contact(tracks, contact_at, part, mesh, frame);
    if (slides) add_slip(tracks, slip_at, part, mesh, frame);
  }
  if (summary.forming)
    add_wrinkles(tracks, part, *summary.forming, summary.forming->wrinkles.relief, page.frames.size());
  if (!summary.ply.empty() && summary.ply.front().forming) {
    std::vector<double> relief;
    for (const PlySummary& ply : summary.ply) append(relief, ply.forming->wrinkles.relief);
    add_wrinkles(tracks, part, *summary.ply.front().forming, relief, page.frames.size());
  }

  const Vec3 origin = scaled(plus(page.low, page.high), 0.5);
  double half = 1e-6;
  for (std::size_t c = 0; c < 3; ++c) half = std::max(half, 0.5 * (page.high[c] - page.low[c]));
  const double step = half / 32767.0;
  page.json = {{"node_count", part.node.size()},
               {"cell_count", part.cell.size()},
               {"thinned", thinning_words(thinning, mesh, folder.frames().size())},
               {"cells", packed_cells(part)},
               {"cell_numbers", cell_numbers(part, end.shear_angle)},
               {"plies", model.ply.empty() ? Json() : Json(packed_plies(part, mesh))},
               {"ply_names", ply_names(model.scene)},
               {"yarns", {{"warp", packed_yarns(part.yarn[0])}, {"weft", packed_yarns(part.yarn[1])}}},
               {"position", {{"origin", origin}, {"step", step}}}};
  page.json["fields"] = Json::array();
  std::vector<std::array<double, 2>> ranges;
  for (const Track& track : tracks) {
    ranges.push_back(range_of(track));
    page.json["fields"].push_back({{"name", track.name},
                                   {"title", track.title},
                                   {"unit", track.unit},
                                   {"scale", word_of(track.scale)},
                                   {"from", ranges.back()[0]},
                                   {"to", ranges.back()[1]},
                                   {"category_names", track.category},
                                   {"limit", track.limit ? Json(*track.limit) : Json(nullptr)},
                                   {"association", track.on == On::cells ? "cells" : "nodes"}});
  }
  page.json["frames"] = Json::array();
  for (std::size_t k = 0; k < page.frames.size(); ++k) {
    Json frame = {{"label", label_of(page.frames[k], folder)},
                  {"position", packed_positions(part, positions[k], origin, step)}};
    for (std::size_t t = 0; t < tracks.size(); ++t)
      frame["fields"][tracks[t].name] = packed(tracks[t].frame[k], ranges[t]);
    page.json["frames"].push_back(std::move(frame));
  }
  return page;
}

}  // namespace weaveform
