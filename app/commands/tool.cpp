// weaveform tool FILE: what a tool's surface is and what is wrong with it, by place; and as STL, STEP or BREP for
// others.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/output_folder.hpp"
#include "mesher/base/files.hpp"
#include "mesher/scene/scene.hpp"
#include "mesher/tools/cad.hpp"
#include "mesher/tools/stl.hpp"
#include "mesher/tools/triangle_report.hpp"

namespace weaveform {

namespace {

struct ToolArguments {
  std::string file;
  std::string output;
  bool force = false;
  double chord_tolerance = ToolSpec{}.chord_tolerance;
};

std::string stl_text(const TriangleList& list) {
  std::string text = "solid Written by weaveform\n";
  for (const auto& t : list.triangle) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int n : t)
      text += fmt::format("vertex {} {} {}\n", list.point[n][0], list.point[n][1], list.point[n][2]);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid Written by weaveform\n";
}

std::string describe_surface(const ToolArguments& arguments, const TriangleReport& report, double chord_error) {
  std::string text =
      fmt::format("{}: {} triangles in {} piece{}, {:.6g} x {:.6g} x {:.6g} mm, area {:.6g} mm2, {}", arguments.file,
                  report.triangles, report.pieces, report.pieces == 1 ? "" : "s", report.high[0] - report.low[0],
                  report.high[1] - report.low[1], report.high[2] - report.low[2], report.area,
                  report.closed ? fmt::format("closed, volume {:.6g} mm3", report.volume)
                                : fmt::format("open, {} borders", report.borders.size()));
  if (is_cad_file(arguments.file)) text += fmt::format("; within {:.3g} mm of the true surface", chord_error);
  return text + "\n" + describe_faults(report);
}

void look_at_tool(const ToolArguments& arguments) {
  const std::filesystem::path file = arguments.file, output = arguments.output;
  CadSurface surface;
  if (is_cad_file(file)) {
    surface = read_cad(file, arguments.chord_tolerance);
    surface.list = turned_alike(surface.list, {0.0, 0.0, 1e6});  // open ones look up
  } else {
    surface.list = read_stl(file);
  }
  print_answer(describe_surface(arguments, inspect(surface.list), surface.chord_error));
  if (output.empty()) return;
  require_writable(output, {file}, arguments.force);
  if (output.extension() == ".stl")
    write_text_whole(output, stl_text(surface.list));
  else
    write_whole(output, [&](const std::filesystem::path& temporary) {
      // Gmsh goes by the name's ending
      const std::filesystem::path named = temporary.string() + output.extension().string();
      convert_cad(file, named);
      std::filesystem::rename(named, temporary);
    });
}

}  // namespace

void add_tool_command(CLI::App& program) {
  auto* command =
      program.add_subcommand("tool", "Size of a tool's surface (STL, STEP, IGES, BREP, .geo) and its faults");
  const auto arguments = std::make_shared<ToolArguments>();
  command->add_option("FILE", arguments->file, "STL or CAD file")->required();
  add_trust_argument(*command);
  command->add_option("--chord-tolerance", arguments->chord_tolerance, "mm; of triangles made from CAD")
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output, "Write it as .stl, or CAD as .step or .brep");
  add_force_argument(*command, arguments->force);
  command->callback([arguments] { look_at_tool(*arguments); });
}

}  // namespace weaveform
