#include <cmath>
#include <string>

#include "fabric/identify/raw_table.hpp"
#include "mesher/outline/dxf_outline.hpp"
#include "mesher/outline/loops.hpp"
#include "post/dic/readers/measurement.hpp"
#include "post/dic/settings/settings.hpp"
#include "tests/fuzz/rooms.hpp"
#include "tests/fuzz/scratch_file.hpp"

namespace weaveform::fuzz {
namespace {

void table(std::string_view bytes) {
  answered([&] {
    const auto read = identify::read_raw_table(text_of(bytes), "table.csv", {});
    for (std::size_t column = 0; !read.cells.empty() && column < read.cells.front().size(); ++column)
      answered([&] { static_cast<void>(identify::numbers_of(read, column)); });
  });
}

void outline(std::string_view bytes) {
  const ScratchFile file("outline.csv", bytes);
  answered([&] {
    std::vector<std::string> complaints;
    auto loops = read_outline_csv(file.path().string(), complaints);
    static_cast<void>(sound_loops(std::move(loops), "outline.csv", complaints));
  });
}

// In inches, so that the tolerance is scaled; and with a layer chosen.
void dxf(std::string_view bytes) {
  const ScratchFile file("outline.dxf", bytes);
  for (const DxfAsked& asked : {DxfAsked{}, DxfAsked{LengthUnit::inch, {"cut"}}})
    answered([&] {
      std::vector<std::string> complaints;
      auto loops = read_dxf_outline(file.path().string(), asked, complaints).loops;
      for (const auto& loop : sound_loops(std::move(loops), "outline.dxf", complaints))
        hold(std::isfinite(signed_area(loop.point)));
    });
}

// To the questions that a file may leave open: none, those of a known format, those of any table.
const std::vector<dic::MeasurementSpec>& answers() {
  const auto told = [](const std::vector<std::string>& keys) { return dic::read_settings("", keys).measurement; };
  static const std::vector<dic::MeasurementSpec> all = {
      {},
      told({"measurement.length_unit=mm", "measurement.pixel_size=0.1", "measurement.y_axis=down"}),
      told({"measurement.format=columns", "measurement.length_unit=mm", "measurement.y_axis=up", "measurement.x=\"1\"",
            "measurement.y=\"2\"", "measurement.u=\"3\"", "measurement.v=\"4\""})};
  return all;
}

void measurement(std::string_view bytes) {
  const ScratchFile file("stage_0001.csv", bytes);
  for (const auto& told : answers()) answered([&] { static_cast<void>(dic::read_stages(file.path(), told)); });
}

// The same bytes for both components.
void matrix(std::string_view bytes) {
  const ScratchFile u("stage_0001_U[mm].csv", bytes), v("stage_0001_V[mm].csv", bytes);
  static const auto told = dic::read_settings("", {"measurement.format=matrix", "measurement.grid_pitch=1",
                                                   "measurement.grid_zeros=missing", "measurement.y_axis=up"})
                               .measurement;
  for (const auto& spec : {dic::MeasurementSpec{}, told})
    answered([&] { static_cast<void>(dic::read_stages(u.path(), spec)); });
}

}  // namespace

std::vector<Target> table_targets() {
  return {{"table", table}, {"outline", outline}, {"dxf", dxf}, {"measurement", measurement}, {"matrix", matrix}};
}

}  // namespace weaveform::fuzz
