// weaveform tool FILE: what a tool's surface is and what is wrong with it, by place; and as STL, STEP or BREP for
// others.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/stages/output_folder.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/files/text_words.hpp"
#include "core/json/json_text.hpp"
#include "core/keys/length_unit.hpp"
#include "mesher/tools/cad.hpp"
#include "mesher/tools/surface_file.hpp"
#include "mesher/tools/triangle_report.hpp"

namespace weaveform {

namespace {

struct ToolArguments {
  std::string file;
  std::string output;
  bool force = false, json = false;
  double chord_tolerance = SurfaceRequest{}.chord_tolerance;
  std::string unit;
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

// Without the dust of rounding, "-4.44e-16".
std::string corner(const std::array<double, 3>& at, double extent) {
  constexpr double dust = 1e-12;
  const auto tidy = [&](double x) { return std::abs(x) < dust * extent ? 0.0 : x; };
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", tidy(at[0]), tidy(at[1]), tidy(at[2]));
}

std::string describe_surface(const ToolArguments& arguments, const TriangleReport& report, const FileSurface& surface) {
  std::string text = fmt::format(
      "{}: {} triangles in {} piece{}, {:.6g} x {:.6g} x {:.6g} mm from {} to {}, area {:.6g} mm2, {}", arguments.file,
      report.triangles, report.pieces, report.pieces == 1 ? "" : "s", report.high[0] - report.low[0],
      report.high[1] - report.low[1], report.high[2] - report.low[2], corner(report.low, report.extent()),
      corner(report.high, report.extent()), report.area,
      report.closed ? fmt::format("closed, volume {:.6g} mm3", report.volume)
                    : fmt::format("open, {} border{}", report.rims.size(), report.rims.size() == 1 ? "" : "s"));
  if (is_cad_file(arguments.file)) text += fmt::format("; within {:.3g} mm of the true surface", surface.chord_error);
  text += "\n";
  for (const std::string& word : surface.words) text += fmt::format("warning: {}\n", word);
  return text + describe_faults(report);
}

nlohmann::ordered_json places_of(const std::vector<SurfaceFault>& faults) {
  auto list = nlohmann::ordered_json::array();
  for (const SurfaceFault& fault : faults) list.push_back({{"at_mm", fault.at}, {"size_mm", fault.size}});
  return list;
}

nlohmann::ordered_json surface_json(const ToolArguments& arguments, const TriangleReport& report,
                                    const FileSurface& surface) {
  using Json = nlohmann::ordered_json;
  return {{"file", arguments.file},
          {"triangles", report.triangles},
          {"pieces", report.pieces},
          {"low_mm", report.low},
          {"high_mm", report.high},
          {"area_mm2", report.area},
          {"closed", report.closed},
          {"volume_mm3", report.closed ? Json(report.volume) : Json(nullptr)},
          {"chord_error_mm", is_cad_file(arguments.file) ? Json(surface.chord_error) : Json(nullptr)},
          {"borders", places_of(report.rims)},
          {"faults",
           {{"gaps", places_of(report.gaps)},
            {"turned", places_of(report.turned)},
            {"degenerate", places_of(report.degenerate)},
            {"intersections", places_of(report.intersections)}}},
          {"warnings", surface.words}};
}

void look_at_tool(const ToolArguments& arguments) {
  const std::filesystem::path file = arguments.file, output = arguments.output;
  FileSurface surface =
      read_surface(file, {millimetres_in(choice_named<LengthUnit>(arguments.unit)), arguments.chord_tolerance, ""});
  const bool keeps_its_sense = surface_kind(file) == SurfaceKind::stl;
  if (!keeps_its_sense) surface.list = turned_alike(surface.list, {0.0, 0.0, 1e6});  // open ones look up
  const TriangleReport report = inspect(surface.list);
  print_answer(arguments.json ? json_text(surface_json(arguments, report, surface))
                              : describe_surface(arguments, report, surface));
  if (output.empty()) return;
  require_writable(output, {file}, arguments.force);
  const std::string ending = lower(output.extension().string());
  if (ending == ".stl") return write_text_whole(output, stl_text(surface.list));
  if (!is_cad_file(file))
    throw InputError(fmt::format("{}: {} holds triangles, which no CAD file is made of; end its name in .stl",
                                 output.string(), file.string()));
  if (choice_named<LengthUnit>(arguments.unit).value_or(LengthUnit::mm) != LengthUnit::mm)
    throw InputError(fmt::format("{}: --unit does not convert CAD; end its name in .stl", output.string()));
  convert_cad(file, output);
}

}  // namespace

void add_tool_command(CLI::App& program) {
  auto* command = program.add_subcommand(
      "tool", "Size and place of a tool's surface (STL, STEP, IGES, BREP, .geo, .msh, .inp) and its faults");
  const auto arguments = std::make_shared<ToolArguments>();
  command->add_option("FILE", arguments->file, "STL, CAD, Gmsh .msh or Abaqus .inp file")->required();
  add_trust_argument(*command);
  command->add_option("--chord-tolerance", arguments->chord_tolerance, "mm; of triangles made from CAD")
      ->capture_default_str();
  command->add_option("--unit", arguments->unit, "Of a file that names none (all but STEP and IGES); mm when left out")
      ->check(CLI::IsMember(choice_names<LengthUnit>()));
  command->add_option("-o,--output", arguments->output, "Write it as .stl, or CAD as .step or .brep");
  add_force_argument(*command, arguments->force);
  add_json_argument(*command, arguments->json);
  command->callback([arguments] { look_at_tool(*arguments); });
}

}  // namespace weaveform
