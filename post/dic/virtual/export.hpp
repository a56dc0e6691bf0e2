// A virtual experiment: the simulation as an instrument would have measured and exported it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "post/dic/settings/settings.hpp"

namespace weaveform::dic {

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
