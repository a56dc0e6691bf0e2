// Waves: how long and how high wrinkles are along the yarns, by how many cells, and whether their length is the
// fabric's or the mesh's (docs/wrinkles.md).
//
// Along each yarn, warp and weft by themselves, with s the length along the flat yarn and c the signed curvature out of
// the fabric's plane that it has beyond what the tools near it give (wrinkles.hpp; without tools all of it):
//   lobe        a stretch on which c has one sign; between nodes c is linear
//   amplitude   of a lobe: the greatest deflection, over the line between its ends, of the chain of chords that turn by
//               c_i l_i at its nodes, l_i half of both elements:
//                   a = max_s sum_i c_i l_i G(s, s_i) ,   G = min(s, s_i) (L - max(s, s_i))/L ,   L its length
//               Of z = a sin(2 pi s/l) it is the height of the highest node, on any mesh, however coarse.
//   half wave   a lobe as high and as bent as a wrinkle (WrinkleLimits) between two lobes of the other sign that are
//               higher than noise. Its length, from inflection to inflection, is half a wavelength.
// What lies on a tool, is taut between tools or curls at an edge has lobes, but no half waves. Along a yarn at an angle b
// to a wave's own direction, wavelengths are longer by 1/cos b.
//
// Whose they are. A chain of chords of length h and rigidity D (N mm, per width) on a foundation K (N/mm^3) under a
// load P (N/mm) has s = 2 sin(q h/2)/h in the place of the wave number q in P = D q^2 + K/q^2, so that it buckles at
//     l_h = l (pi/n)/asin(pi/n) ,   n = l/h ,   l = 2 pi (D/K)^(1/4) ,
// with the load and, for the same shortening, the slopes of the sheet: too short by 10 % at 4.5 cells a wave, by 5 % at 6,
// by 2.5 % at 8. Below n = pi there is no such wave and the chain zigzags, 2 h a wave, whatever the fabric is.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mesher/scene/scene.hpp"
#include "post/forming/wrinkles.hpp"

namespace weaveform {

// Fewer cells a wave than this, and its length is the mesh's: docs/wrinkles.md has the measurements.
inline constexpr double least_cells_per_wave = 8.0;

enum class WavesOf { nobody, fabric, mesh };  // nobody: there are none

// Means of half waves are medians, weighted by amplitude times area.
struct WaveMeasure {
  int half_waves = 0;
  double wavelength = 0.0;                       // mm; median of twice the half waves' lengths
  std::array<double, 2> quartiles = {0.0, 0.0};  // mm; of the same
  double cells = 0.0;                            // 1; median of wavelength over the element's length
  double amplitude = 0.0;                        // mm; median
  double greatest_amplitude = 0.0;               // mm
};

struct Waves {
  std::array<WaveMeasure, 2> yarn;  // along warp and weft
  WaveMeasure all;                  // of both
  double area_share = 0.0;  // 1; of the flat area, at nodes in waves: lobes as high as a wrinkle with another beside
  double unresolved_share = 0.0;  // 1; of the half waves' weight: fewer cells than least_cells_per_wave
  double compressed_share = 0.0;  // 1; of the fibre (compressed_fibre_share)
  bool bends = false;             // the model has bending stiffness

  // A model without bending gives its waves no length but the cell's.
  [[nodiscard]] WavesOf are() const {
    if (all.half_waves == 0) return WavesOf::nobody;
    return bends && all.cells >= least_cells_per_wave ? WavesOf::fabric : WavesOf::mesh;
  }
};

// 1/mm, signed; per node, along warp and weft. 0 where no yarn runs on.
using YarnCurvatures = std::array<std::vector<double>, 2>;

// Of the yarns as they are: what has to do with no tool.
[[nodiscard]] YarnCurvatures out_of_plane_curvatures(const Mesh& mesh, const std::vector<Vec3>& position);

// From those curvatures or Wrinkles::excess. Knows neither `compressed_share` nor `bends`.
[[nodiscard]] Waves find_waves(const Mesh& mesh, const YarnCurvatures& curvature, const WrinkleLimits& limits = {});

// 1; the share of all fibre (length of the flat yarns) whose strain is below -compressed_from: a sheet that bears
// compression is about to wrinkle. Less is the noise of slack yarns.
inline constexpr double compressed_from = 1e-4;
[[nodiscard]] double compressed_fibre_share(const Mesh& mesh, const std::vector<double>& yarn_strain);

// All of it, of a frame's fields; `wrinkles` where there are tools.
[[nodiscard]] Waves evaluate_waves(const ModelSpec& model, const Mesh& mesh, const Fields& fields,
                                   const Wrinkles* wrinkles);

// "wrinkles" of summary.json: "of" ("fabric", "mesh", null), "half_waves", "wavelength_mm" and its "quartiles_mm",
// "cells_per_wave" and the least of the rule, "amplitude_mm", "largest_amplitude_mm", "area_share", "unresolved_share",
// "compressed_fibre_share"; "warp" and "weft" with the first of them. null where there are no waves.
[[nodiscard]] nlohmann::ordered_json waves_json(const Waves& waves);
// A line each for the table printed at the end: the waves and whose they are; the compressed fibre, from a hundredth on.
[[nodiscard]] std::string waves_table(const Waves& waves);
// "the fabric's: 38.2 mm long ..." in a line, for people; "none" without.
[[nodiscard]] std::string waves_in_words(const Waves& waves);

}  // namespace weaveform
