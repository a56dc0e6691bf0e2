#include "post/dic/virtual/export.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/keys/key_value.hpp"
#include "post/dic/virtual/facet.hpp"
#include "post/dic/virtual/noise.hpp"
#include "post/dic/virtual/rigid_motion.hpp"
#include "post/dic/virtual/simulation.hpp"
#include "post/dic/virtual/strain_window.hpp"

namespace weaveform::dic {
namespace {

namespace fs = std::filesystem;

// The instrument with lengths that are whole pixels.
struct Camera {
  double pixel = 0.1;       // mm
  int facet = 0, step = 0;  // px
  int window = 5;           // points
  [[nodiscard]] double facet_size() const { return facet * pixel; }
  [[nodiscard]] double step_size() const { return step * pixel; }
};

Camera camera_of(const Settings& settings) {
  const InstrumentSpec& spec = settings.instrument;
  if (!spec.facet_size)
    throw InputError(
        "how large is a facet on the specimen, in mm? set facet_size of [instrument], e.g. --set "
        "instrument.facet_size=4 (0 for none)");
  if (!spec.step && !(*spec.facet_size > 0.0))
    throw InputError("facets of size 0 need a step: set step of [instrument]");
  Camera camera;
  camera.pixel = settings.virtual_dic.pixel_size;
  camera.facet = static_cast<int>(std::lround(*spec.facet_size / camera.pixel));
  camera.step = std::max(1, static_cast<int>(std::lround(spec.step.value_or(0.5 * *spec.facet_size) / camera.pixel)));
  if (spec.window) camera.window = static_cast<int>(*spec.window);
  return camera;
}

// Measurement to blank; the settings say where the blank lies in the measurement.
RigidMotion to_blank(const VirtualSpec& spec) {
  RigidMotion motion;
  motion.angle = -spec.rotation * std::numbers::pi / 180.0;
  const Vec2 turned = motion.turned(spec.shift);
  motion.shift = {-turned[0], -turned[1]};
  return motion;
}

struct FacetGrid {
  std::vector<Vec2> measured, blank;  // mm
  Neighbours neighbours;
  Sampling facets;
};

FacetGrid make_grid(const FlatMesh& flat, const Camera& camera, const VirtualSpec& spec) {
  const RigidMotion motion = to_blank(spec);
  const auto box = flat.extent();
  const double reach = 0.5 * std::hypot(box[2] - box[0], box[3] - box[1]), step = camera.step_size();
  std::vector<Vec2> measured, blank;
  const auto from = [&](double centre) { return static_cast<long>(std::floor((centre - reach) / step)); };
  const auto to = [&](double centre) { return static_cast<long>(std::ceil((centre + reach) / step)); };
  if ((to(spec.shift[0]) - from(spec.shift[0])) * (to(spec.shift[1]) - from(spec.shift[1])) > 20'000'000)
    throw InputError("step of [instrument] gives more than 20 million facets; choose a greater one");
  for (long j = from(spec.shift[1]); j <= to(spec.shift[1]); ++j)
    for (long i = from(spec.shift[0]); i <= to(spec.shift[0]); ++i) {
      const Vec2 at = {static_cast<double>(i) * step, static_cast<double>(j) * step};
      const Vec2 placed = motion.moved(at);
      const bool clear = placed[0] >= box[0] + spec.margin && placed[0] <= box[2] - spec.margin &&
                         placed[1] >= box[1] + spec.margin && placed[1] <= box[3] - spec.margin;
      if (!clear) continue;
      measured.push_back(at);
      blank.push_back(placed);
    }
  const Sampling sampling = sample_facets(flat, blank, camera.facet_size(), 1.0 - 1e-9, motion.angle);
  FacetGrid grid;
  for (std::size_t i = 0; i < blank.size(); ++i) {
    if (!sampling.found(i)) continue;
    grid.measured.push_back(measured[i]);
    grid.blank.push_back(blank[i]);
    for (int k = sampling.offset[i]; k < sampling.offset[i + 1]; ++k) {
      grid.facets.node.push_back(sampling.node[k]);
      grid.facets.weight.push_back(sampling.weight[k]);
    }
    grid.facets.offset.push_back(static_cast<int>(grid.facets.node.size()));
  }
  if (grid.measured.size() < 8)
    throw InputError(
        fmt::format("facets of {} mm at {} mm of step leave only {} points on the fabric; choose smaller ones",
                    camera.facet_size(), step, grid.measured.size()));
  grid.neighbours = find_neighbours(grid.measured, step, camera.window);
  return grid;
}

enum class Fate { measured, failed, dropped };

struct VirtualStage {
  int number = 1;
  double travel = 0.0, force = 0.0;
  std::vector<Vec3> displacement;  // mm; in the measurement's frame, with noise
  std::vector<Fate> fate;
};

VirtualStage make_stage(const FacetGrid& grid, const SimulatedState& state, const VirtualSpec& spec, int number) {
  VirtualStage stage{number, state.travel, state.force, {}, {}};
  const double angle = spec.rotation * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
  for (std::size_t i = 0; i < grid.measured.size(); ++i) {
    const NoiseKey key = {static_cast<std::uint64_t>(spec.seed), static_cast<std::uint64_t>(number), i};
    const Vec3 u = grid.facets.value(i, state.displacement);
    stage.displacement.push_back(
        {c * u[0] - s * u[1] + spec.noise * normal(key, 0), s * u[0] + c * u[1] + spec.noise * normal(key, 1), u[2]});
    const double chance = uniform(key, 2);
    stage.fate.push_back(chance < spec.drop               ? Fate::dropped
                         : chance < spec.drop + spec.fail ? Fate::failed
                                                          : Fate::measured);
    // A failed correlation still gives numbers, wrong ones.
    if (stage.fate.back() == Fate::failed)
      for (std::size_t k = 0; k < 2; ++k) stage.displacement.back()[k] += 40.0 * (uniform(key, 3 + k) - 0.5);
  }
  return stage;
}

// Green-Lagrange strains xx, yy, xy of the window, as such files carry them; nothing here ever reads them.
Vec3 strains_at(const FacetGrid& grid, const VirtualStage& stage, const std::vector<bool>& valid, std::size_t i) {
  const WindowFit fit = fit_window(grid.measured, grid.neighbours, i, valid, stage.displacement, 0.5);
  if (!fit.good) return {0.0, 0.0, 0.0};
  const Eigen::Matrix2d h = fit.gradient.topRows<2>();
  const Eigen::Matrix2d e = 0.5 * (h + h.transpose() + h.transpose() * h);
  return {e(0, 0), e(1, 1), e(0, 1)};
}

std::vector<bool> valid_points(const VirtualStage& stage) {
  std::vector<bool> valid;
  for (const Fate fate : stage.fate) valid.push_back(fate == Fate::measured);
  return valid;
}

std::string aramis_text(const FacetGrid& grid, const VirtualStage& stage, const Camera& camera, bool decimal_comma) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  const std::string rule = "#" + std::string(99, '#') + "\n";
  fmt::format_to(out, "# Process data:\n# specimen                      : virtual, by weaveform\n{}", rule);
  fmt::format_to(out, "# stage data:\n# facet_size                    : {:.1f}\n", static_cast<double>(camera.facet));
  fmt::format_to(out, "# facet_distance                : {:.1f}\n", static_cast<double>(camera.step));
  fmt::format_to(out, "# current_stage_index           : {0}\n# current_stage_name            : Stage {0}\n",
                 stage.number);
  fmt::format_to(out, "# reference_stage_index         : 0\n{}# SIGNALS:\n", rule);
  fmt::format_to(out, "# force                         : value_element       : {}\n", stage.force);
  fmt::format_to(out, "# displacement                  : value_element       : {}\n{}", stage.travel, rule);
  fmt::format_to(
      out,
      "#        ID;         x_undef [mm];         y_undef [mm];         z_undef [mm];               u [mm];    "
      "           v [mm];               w [mm];             epsx [%];             epsy [%];            epsxy "
      "[1];           epseqv [%]\n");
  const auto valid = valid_points(stage);
  fmt::memory_buffer row;
  for (std::size_t i = 0; i < grid.measured.size(); ++i) {
    if (stage.fate[i] == Fate::dropped) continue;
    row.clear();
    const auto put = std::back_inserter(row);
    fmt::format_to(put, FMT_COMPILE("{:10};{:21.10f};{:21.10f};{:21.10f}"), i + 1, grid.measured[i][0],
                   grid.measured[i][1], 0.0);
    if (stage.fate[i] == Fate::failed) {
      for (int k = 0; k < 7; ++k) fmt::format_to(put, ";");
    } else {
      const Vec3 e = strains_at(grid, stage, valid, i);
      // von Mises, at constant volume: sqrt(2/3 e:e) with e_zz = -(e_xx + e_yy).
      const double equivalent = std::sqrt(4.0 / 3.0 * (e[0] * e[0] + e[0] * e[1] + e[1] * e[1] + e[2] * e[2]));
      const Vec3& u = stage.displacement[i];
      fmt::format_to(put, FMT_COMPILE(";{:21.12f};{:21.12f};{:21.12f};{:21.12f};{:21.12f};{:21.12f};{:21.12f}"), u[0],
                     u[1], u[2], 100.0 * e[0], 100.0 * e[1], e[2], 100.0 * equivalent);
    }
    if (decimal_comma) std::replace(row.begin(), row.end(), '.', ',');
    text.append(row.data(), row.data() + row.size());
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

std::string dice_text(const FacetGrid& grid, const VirtualStage& stage, const Camera& camera, char delimiter) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "***\n*** virtual experiment by weaveform in the form of a DICe solution file\n***\n");
  fmt::format_to(out, "*** Subset size: {}\n*** Step size: x {} y {} (-1 implies not regular grid)\n", camera.facet,
                 camera.step, camera.step);
  fmt::format_to(out, "*** Strain window size in pixels: {} (only first strain post-processor is reported)\n",
                 camera.step * (camera.window - 1));
  fmt::format_to(out,
                 "*** Coordinates given with (0,0) as upper left corner of image, x positive right, y positive "
                 "down\n***\n");
  const std::string d(1, delimiter);
  std::string heading;
  for (const char* name : {"SUBSET_ID", "COORDINATE_X", "COORDINATE_Y", "DISPLACEMENT_X", "DISPLACEMENT_Y",
                           "VSG_STRAIN_XX", "VSG_STRAIN_YY", "VSG_STRAIN_XY", "SIGMA", "GAMMA", "MATCH"})
    heading += (heading.empty() ? "" : d) + name;
  fmt::format_to(out, "{}\n", heading);
  const auto valid = valid_points(stage);
  for (std::size_t i = 0; i < grid.measured.size(); ++i) {
    if (stage.fate[i] == Fate::dropped) continue;
    const bool failed = stage.fate[i] == Fate::failed;
    const Vec3& u = stage.displacement[i];
    const Vec3 e = failed ? Vec3{0.0, 0.0, 0.0} : strains_at(grid, stage, valid, i);
    // y down: positions, displacements and the shear strain change their sign.
    fmt::format_to(out, FMT_COMPILE("{}"), i);
    for (const double value :
         {grid.measured[i][0] / camera.pixel, -grid.measured[i][1] / camera.pixel, u[0] / camera.pixel,
          -u[1] / camera.pixel, e[0], e[1], -e[2], failed ? -1.0 : 5e-3, failed ? 0.9 : 3e-3, failed ? -1.0 : 0.0}) {
      text.push_back(delimiter);
      fmt::format_to(out, FMT_COMPILE("{:.4E}"), value);
    }
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

std::string settings_text(MeasurementFormat format, const Settings& settings, const Camera& camera,
                          const std::vector<double>& travel) {
  std::string text =
      "# What a comparison must be told about the files in stages/. Written by weaveform post "
      "virtual.\n\n[measurement]\n";
  text += fmt::format("format = \"{}\"\n", name_of(format));
  if (format == MeasurementFormat::dice)
    text += fmt::format("pixel_size = {}  # mm\ndelimiter = {}\n", camera.pixel,
                        *toml_text(settings.virtual_dic.delimiter));
  text += fmt::format(
      "\n[instrument]\nfacet_size = {:.10g}  # mm\nstep = {:.10g}  # mm\nwindow = {}  # points\n{}\n",
      camera.facet_size(), camera.step_size(), camera.window,
      settings.instrument.ply.empty() ? "" : fmt::format("ply = {}\n", *toml_text(settings.instrument.ply)));
  text += fmt::format("[stages]\ndisplacement = {}  # mm\n", *toml_text(travel));
  if (!settings.stages.grip.empty()) text += fmt::format("grip = {}\n", *toml_text(settings.stages.grip));
  text += "\n[load]\nfile = \"loads.csv\"\ndisplacement_column = \"displacement_mm\"\nforce_column = \"force_N\"\n";
  return text;
}

}  // namespace

VirtualMeasurement export_virtual(const fs::path& result, MeasurementFormat format, const Settings& settings,
                                  const fs::path& output) {
  const Camera camera = camera_of(settings);
  const Simulation simulation(result, settings.stages.grip, settings.instrument.ply);
  const VirtualSpec& spec = settings.virtual_dic;
  const std::size_t last = simulation.frame_count() - 1;
  const std::size_t count = spec.stages > 0 ? static_cast<std::size_t>(spec.stages) : last;
  if (count > last)
    throw InputError(
        fmt::format("stages of [virtual] is {}, but the simulation has {} frames after the start; run it "
                    "with a greater output.frames",
                    count, last));
  const FacetGrid grid = make_grid(simulation.flat(), camera, spec);

  VirtualMeasurement measurement;
  measurement.points = grid.measured.size();
  std::vector<double> travel;
  std::string loads = "displacement_mm,force_N\n";
  remove_files(output, virtual_files());
  for (std::size_t k = 1; k <= count; ++k) {
    const SimulatedState state = simulation.at_frame((k * last + count - 1) / count);
    const VirtualStage stage = make_stage(grid, state, spec, static_cast<int>(k));
    measurement.files.push_back(output / file_name::stages / fmt::format("stage_{:03}.txt", k));
    write_text_whole(measurement.files.back(), format == MeasurementFormat::aramis
                                                   ? aramis_text(grid, stage, camera, spec.decimal_comma)
                                                   : dice_text(grid, stage, camera, spec.delimiter.front()));
    travel.push_back(state.travel);
  }
  for (std::size_t i = 0; i < simulation.travel().size(); ++i)
    loads += fmt::format("{},{}\n", simulation.travel()[i], simulation.force()[i]);
  write_text_whole(output / file_name::loads, loads);
  measurement.settings = output / file_name::settings;
  write_text_whole(measurement.settings, settings_text(format, settings, camera, travel));
  return measurement;
}

}  // namespace weaveform::dic
