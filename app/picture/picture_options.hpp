// What `weaveform render` is asked for: the same words for the command and for the program that draws.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace weaveform {

struct PictureArguments {
  std::string directory, output;
  std::string field = "absolute_shear_angle_deg", view = "automatic";
  std::vector<double> range;  // two, or none
  std::vector<int> size = {1200, 900};
  std::optional<int> frame;  // from 0; none: the last
  bool animate = false, without_tools = false, without_yarns = false, force = false, quiet = false;
};

void add_picture_options(CLI::App& command, PictureArguments& arguments);

}  // namespace weaveform
