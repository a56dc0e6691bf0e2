#include "mesher/outline/dxf_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/files/text_words.hpp"
#include "core/keys/length_unit.hpp"
#include "mesher/outline/dxf_curves.hpp"
#include "mesher/outline/join_curves.hpp"
#include "mesher/tools/triangle_list.hpp"

namespace weaveform {
namespace {

constexpr std::uintmax_t most_bytes = 500'000'000;
constexpr double joined = 0.01;          // mm; how near two curves' ends must lie,
constexpr double joined_of_size = 1e-3;  // and in parts of the outline's extent

std::map<std::string, int> layers_of(const std::vector<DxfCurve>& curves) {
  std::map<std::string, int> layers;
  for (const auto& curve : curves) ++layers[curve.layer];
  return layers;
}

std::string listed(const std::map<std::string, int>& layers) {
  std::string text;
  for (const auto& [name, count] : layers)
    text += fmt::format("{}'{}' ({} curve{})", text.empty() ? "" : ", ", name, count, count == 1 ? "" : "s");
  return text;
}

std::vector<DxfCurve> chosen(std::vector<DxfCurve> curves, const std::vector<std::string>& layers,
                             const std::string& file, std::vector<std::string>& complaints) {
  if (layers.empty()) return curves;
  const auto there = layers_of(curves);
  std::set<std::string> wanted;
  for (const auto& layer : layers) {
    wanted.insert(upper(layer));
    if (std::none_of(there.begin(), there.end(), [&](const auto& known) { return upper(known.first) == upper(layer); }))
      complaints.push_back(fmt::format("{}: no curve on layer '{}' (blank.outline_layers); there are {}", file, layer,
                                       there.empty() ? "none at all" : listed(there)));
  }
  curves.erase(std::remove_if(curves.begin(), curves.end(),
                              [&](const DxfCurve& curve) { return wanted.count(upper(curve.layer)) == 0; }),
               curves.end());
  return curves;
}

// mm
std::vector<OutlineCurve> scaled(const std::vector<DxfCurve>& curves, double unit, const std::string& file) {
  std::vector<OutlineCurve> result;
  for (const auto& curve : curves) {
    OutlineCurve line{{}, fmt::format("{}:{}", file, curve.line)};
    for (const auto& p : curve.point) {
      line.point.push_back({unit * p[0], unit * p[1]});
      for (const double x : line.point.back())
        if (!(std::abs(x) <= farthest_corner))
          throw InputError(fmt::format("{}: a curve runs to {:.4g} mm; lengths of an outline are within {:g} mm",
                                       line.place, x, farthest_corner));
    }
    result.push_back(std::move(line));
  }
  return result;
}

double extent_of(const std::vector<OutlineCurve>& curves) {
  std::array<double, 2> low = {1e300, 1e300}, high = {-1e300, -1e300};
  for (const auto& curve : curves)
    for (const auto& p : curve.point)
      for (std::size_t c = 0; c < 2; ++c) {
        low[c] = std::min(low[c], p[c]);
        high[c] = std::max(high[c], p[c]);
      }
  return curves.empty() ? 0.0 : std::max(high[0] - low[0], high[1] - low[1]);
}

void note(const DxfDrawing& drawing, const DxfCurves& curves, const DxfAsked& asked, DxfOutline& outline) {
  if (!asked.unit && !drawing.unit)
    outline.notes.push_back(drawing.file +
                            ": names no unit ($INSUNITS); taken for mm. Set blank.outline_unit to say it");
  const auto layers = layers_of(curves.curve);
  if (asked.layers.empty() && layers.size() > 1)
    outline.notes.push_back(
        fmt::format("{}: the curves of all layers bound the blank: {}. Set blank.outline_layers to "
                    "take some of them",
                    drawing.file, listed(layers)));
}

}  // namespace

bool is_dxf_file(const std::string& file) {
  const std::string ending = upper(std::filesystem::path(file).extension().string());
  return ending == ".DXF" || ending == ".DWG";
}

DxfOutline read_dxf_outline(const std::string& file, const DxfAsked& asked, std::vector<std::string>& complaints) {
  const std::string text = read_text_file(file, most_bytes);
  const DxfDrawing drawing = read_drawing(text, file);
  const double unit = asked.unit ? millimetres_in(asked.unit) : drawing.unit.value_or(1.0);
  DxfCurves curves = curves_of(drawing, asked.chord_tolerance / unit);
  DxfOutline outline;
  note(drawing, curves, asked, outline);
  const std::size_t before = complaints.size();
  complaints.insert(complaints.end(), curves.complaints.begin(), curves.complaints.end());
  const auto layers = layers_of(curves.curve);
  const std::vector<DxfCurve> wanted = chosen(std::move(curves.curve), asked.layers, file, complaints);
  if (complaints.size() > before) return outline;
  if (wanted.empty()) {
    complaints.push_back(file +
                         ": no curve in it; an outline is of lines, arcs, polylines, circles, ellipses, splines");
    return outline;
  }
  const std::vector<OutlineCurve> lines = scaled(wanted, unit, file);
  outline.loops = join_curves(lines, std::min(joined, joined_of_size * extent_of(lines)), file, complaints);
  if (complaints.size() > before && asked.layers.empty() && layers.size() > 1)
    complaints.push_back(
        fmt::format("{}: it has curves on the layers {}; say with blank.outline_layers which of them are "
                    "the outline",
                    file, listed(layers)));
  return outline;
}

}  // namespace weaveform
