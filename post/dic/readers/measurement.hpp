// A measured point field, whatever program wrote it: reference positions and displacements in mm, x to the right, y up.
// Readers (one file each: aramis, dice, vic, pyvale, opencorr, matchid, matrix, columns) know a format by all its
// columns, turn the program's conventions into this one and say what they did; what the file does not decide and the
// user has not stated is asked (question.hpp). Strain columns are never read.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/files/csv_format.hpp"
#include "post/dic/readers/choices.hpp"
#include "post/dic/readers/question.hpp"
#include "solver/result/fields.hpp"

namespace weaveform::dic {

// [measurement] of the settings file (settings.hpp says what each key means).
struct MeasurementSpec {
  MeasurementFormat format = MeasurementFormat::automatic;
  std::string delimiter = "auto";  // "auto", "comma", "semicolon", "tab", "space", or one character
  DecimalSign decimal = DecimalSign::automatic;
  MeasuredUnit length_unit = MeasuredUnit::automatic;
  std::optional<double> pixel_size;  // mm per pixel
  YAxis y_axis = YAxis::automatic;
  PositionOf position = PositionOf::reference;  // columns
  std::string x, y, z, u, v, w;                 // columns: names, or numbers from 1
  std::string quality;  // columns: a point is valid when quality_least <= quality <= quality_greatest
  std::optional<double> quality_least, quality_greatest;
  std::string stage_column;  // columns: tells the stages of one file apart
  // matrix: from point to point in pixels, or in mm; of the first column and row in pixels; what zeros are
  std::optional<double> grid_step, grid_pitch;
  std::array<double, 2> grid_first = {0.0, 0.0};
  GridZeros grid_zeros = GridZeros::automatic;
  std::string displacement_signal, force_signal;                // aramis: names among the header's signals
  double displacement_factor = 1.0, displacement_offset = 0.0;  // crosshead: factor * signal + offset, mm
  double force_factor = 1.0;                                    // N per unit of the signal
};

// The columns that format = "columns" is told, by their keys; keys left out are not among them.
using NamedColumn = std::pair<const char*, const std::string*>;
[[nodiscard]] std::vector<NamedColumn> columns_asked(const MeasurementSpec& spec);

struct MeasuredStage {
  std::string label;                          // the file's name, with the stage's own name when the file gives one
  std::optional<double> displacement, force;  // mm, N; of the crosshead, from the header's signals
  std::optional<double> facet_size;           // mm; of the instrument, when the header tells
  std::optional<int> window;                  // points across the strain window, when the header tells
  double header_facet = 0.0,
         header_step = 0.0;                     // pixels; as the header gives them (0: not), scaled by the points' step
  std::vector<Vec3> reference;                  // mm; x right, y up; z = 0 in two dimensions
  std::vector<Vec3> displacement_field;         // mm; not a number where there is none
  std::vector<std::array<double, 4>> gradient;  // F11 F12 F21 F22 instead of displacements (pyvale's strain files)
  std::vector<bool> valid;
  int missing = 0, failed = 0;     // rows without a position or displacement; rows whose correlation failed
  std::vector<std::string> notes;  // what was decided and why, for the report
  Questions questions;             // open ones: the numbers mean nothing until they are answered
  [[nodiscard]] std::size_t size() const { return reference.size(); }
};

// A folder stands for its .txt, .csv and .dat files in the order of the numbers in their names; of the matrices of one
// stage, one file stands for all. Throws FileError.
[[nodiscard]] std::vector<std::filesystem::path> measurement_files(const std::vector<std::string>& arguments);

// The stage, or with `stage_column` the stages, of a file. Throws FileError; InputError, also with the open questions.
[[nodiscard]] std::vector<MeasuredStage> read_stages(const std::filesystem::path& file, const MeasurementSpec& spec);
// The same with the open questions in the stages instead.
[[nodiscard]] std::vector<MeasuredStage> read_stages_asking(const std::filesystem::path& file,
                                                            const MeasurementSpec& spec);

}  // namespace weaveform::dic
