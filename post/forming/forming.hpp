// What a formed part is judged by (docs/forming.md): for every scene with tools.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/files/owned_files.hpp"
#include "post/forming/meridian.hpp"
#include "post/forming/net_on_sphere.hpp"
#include "post/forming/outline.hpp"
#include "post/forming/punch_force.hpp"
#include "post/forming/waves.hpp"
#include "post/forming/wrinkles.hpp"

namespace weaveform {

namespace file_name {
inline constexpr const char *meridians = "meridians.csv", *meridian_chart = "meridians.svg";
inline constexpr const char *outline = "outline.csv", *outline_lines = "outline.vtp", *wrinkles = "wrinkles.vtp";
inline constexpr const char *punch_chart = "punch_force.svg", *sphere_net = "sphere_net.csv";
inline constexpr const char* sphere_net_chart = "sphere_net.svg";
}  // namespace file_name

[[nodiscard]] inline FileNames forming_files() {
  return {file_name::meridians, file_name::meridian_chart, file_name::outline,    file_name::outline_lines,
          file_name::wrinkles,  file_name::punch_chart,    file_name::sphere_net, file_name::sphere_net_chart};
}

inline constexpr std::array<double, 3> meridian_azimuths = {0.0, 45.0, 90.0};  // deg; from the warp

struct Forming {
  PartAxis axis;
  std::optional<PunchCurve> punch;      // when a tool travels
  std::optional<ForceBalance> balance;  // when tools alone hold the fabric
  std::array<std::vector<MeridianPoint>, 3> meridian;
  double greatest_angle = 0.0;                                  // rad; of a cell, with its sign
  Eigen::Vector3d greatest_angle_at = Eigen::Vector3d::Zero();  // mm; that cell's centre
  std::vector<int> outline;                                     // nodes
  DrawIn draw_in;
  WrinkleLimits wrinkle_limits;
  Wrinkles wrinkles;
  Waves waves;
  std::vector<double> gap;                                      // mm; per node, to the nearest tool
  double thinnest = 0.0, thickest = 0.0, flat_thickness = 0.0;  // mm
  std::optional<SphereNetFit> sphere_net;                       // when the scene has a spherical tool
};

// From the fields of a frame and the history; none without tools. Throws InputError when the history lacks a column.
[[nodiscard]] std::optional<Forming> evaluate_forming(const Scene& scene, const Mesh& mesh,
                                                      const std::vector<Tool>& tools, const Fields& fields,
                                                      const History& history);

// meridians.csv and .svg, outline.csv and .vtp, wrinkles.vtp; punch_force.svg with a punch; sphere_net.csv and .svg
// with a sphere. Removes those of an earlier evaluation that this one has not. Throws FileError.
void write_forming(const Forming& forming, const Mesh& mesh, const Fields& fields,
                   const std::filesystem::path& directory);

// "forming" of summary.json, and the section of the table printed at the end.
[[nodiscard]] nlohmann::ordered_json forming_json(const Forming& forming);
[[nodiscard]] std::string forming_table(const Forming& forming);
// The parts of it that are no single ply's: axis, travel and forces of the tools.
[[nodiscard]] nlohmann::ordered_json forming_loads_json(const Forming& forming);
[[nodiscard]] std::string forming_loads_table(const Forming& forming);

}  // namespace weaveform
