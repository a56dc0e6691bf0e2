// A virtual experiment: the simulation as an instrument would have measured and exported it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/files/owned_files.hpp"
#include "post/dic/settings/settings.hpp"

namespace weaveform::dic {

namespace file_name {
inline constexpr const char *stages = "stages", *loads = "loads.csv", *settings = "settings.toml";
inline constexpr const char* default_virtual = "virtual";  // the folder below the result's
}  // namespace file_name

[[nodiscard]] inline FileNames virtual_files() {
  return {std::string(file_name::stages) + "/stage_###.txt", file_name::loads, file_name::settings};
}

struct VirtualMeasurement {
  std::vector<std::filesystem::path> files;  // one for each stage
  std::filesystem::path settings;            // for `weaveform post compare --settings`
  std::size_t points = 0;                    // of the grid
};

// Writes DIR/stages/stage_NNN.txt in `format` (aramis or dice), DIR/loads.csv (travel and load, as a machine
// records them) and DIR/settings.toml (what a comparison must be told about these files). The grid and its facets lie
// along the axes of the measurement; facets that are not wholly on the fabric are left out. Throws InputError,
// FileError.
VirtualMeasurement export_virtual(const std::filesystem::path& result, MeasurementFormat format,
                                  const Settings& settings, const std::filesystem::path& output);

}  // namespace weaveform::dic
