// The settings file of `weaveform post compare`, `virtual` and `border`: everything a comparison needs to be told, as
// plain data. schema.cpp names each key with unit, type and range; docs/dic_settings.md is made from it.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/keys/key_info.hpp"
#include "post/dic/readers/measurement.hpp"
#include "post/dic/settings/choices.hpp"

namespace weaveform::dic {

struct InstrumentSpec {
  std::optional<double> facet_size;   // mm; none: as the measurement's header says
  std::optional<double> step;         // mm; none: from the points
  std::optional<double> window;       // points across, odd; none: the header's, else 5
  std::optional<double> uncertainty;  // mm; standard deviation of a displacement; none: estimated
  double fill = 0.5;                  // 1; least part of a strain window's points that must be valid
  std::string ply;                    // of a stack, that the camera sees; "": the highest
};

struct StagesSpec {
  MatchBy match = MatchBy::automatic;
  std::vector<double> displacement;  // mm; of each stage
  std::vector<double> force;         // N; of each stage
  std::string grip;                  // whose travel and force; "": the one that is pulled
};

struct RegistrationSpec {
  RegistrationMethod method = RegistrationMethod::least_squares;
  std::vector<std::vector<double>> measured_marks, simulated_marks;  // mm; [x, y] each
  std::array<double, 2> origin = {0.0, 0.0};                         // mm; axes: the blank's centre in the measurement
  std::optional<double> angle;  // deg; the blank's x axis in the measurement, axes: exact, least squares: roughly
  SpecimenMotion motion = SpecimenMotion::fixed;  // free: the camera or specimen moved between the stages
  double reject = 4.0;                            // robust standard deviations beyond which a point is an outlier
};

struct ComparisonSpec {
  FieldSymmetry symmetry = FieldSymmetry::none;
  double coverage = 2.0;                      // standard uncertainties within which measured and levelled agree
  double contour_step = 5.0;                  // deg; isolines
  FieldsWritten fields = FieldsWritten::all;  // stages whose points are written
};

struct ZoneSpec {
  std::string name;
  std::array<double, 4> box = {0.0, 0.0, 0.0, 0.0};  // mm; xmin, ymin, xmax, ymax in the blank's frame
};

struct LineSpec {
  std::string name;
  std::array<double, 2> from = {0.0, 0.0}, to = {0.0, 0.0};  // mm; in the blank's frame
  int points = 101;
};

struct LoadSpec {
  std::string file;
  std::string displacement_column = "1", force_column = "2";
  std::string displacement_unit = "mm", force_unit = "N";
};

struct VirtualSpec {
  double noise = 0.0;  // mm; standard deviation of each displacement component
  int seed = 1;
  double drop = 0.0;      // 1; part of the points that are missing
  double fail = 0.0;      // 1; part whose correlation failed (flagged, or left empty where the format has no flag)
  double rotation = 0.0;  // deg; of the blank's x axis in the measurement
  std::array<double, 2> shift = {0.0, 0.0};  // mm; the blank's centre in the measurement
  double margin = 0.0;                       // mm; band along the fabric's edges without points
  int stages = 0;                            // evenly over the frames; 0: one for each
  double pixel_size = 0.1;                   // mm; dice
  std::string delimiter = ",";               // dice
  bool decimal_comma = false;                // aramis
};

struct Settings {
  std::string file;
  MeasurementSpec measurement;
  InstrumentSpec instrument;
  StagesSpec stages;
  RegistrationSpec registration;
  ComparisonSpec comparison;
  std::vector<ZoneSpec> zone;
  std::vector<LineSpec> line;
  LoadSpec load;
  VirtualSpec virtual_dic;
};

// Reads the file ("" for none) with "table.key=value" overrides. Throws FileError, or InputError with every complaint.
[[nodiscard]] Settings read_settings(const std::string& file, const std::vector<std::string>& overrides);

// Every key as Markdown (docs/dic_settings.md).
[[nodiscard]] std::string settings_reference_markdown();
[[nodiscard]] std::vector<KeyInfo> settings_keys();

}  // namespace weaveform::dic
