// The readers of what frames.cpp writes.
#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/files/bytes.hpp"
#include "core/files/files.hpp"
#include "core/guard/guarded.hpp"
#include "mesher/mesh/vtk_messages.hpp"
#include "mesher/mesh/vtu_grid.hpp"
#include "solver/result/file_names.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

InputError not_an_index(const fs::path& file, const std::string& what) {
  return InputError(fmt::format("{}: not an index of frames ({}); solve again", file.string(), what));
}

double time_of(vtkXMLDataElement& entry, const fs::path& file) {
  const char* text = entry.GetAttribute("timestep");
  double time = 0.0;
  const std::string_view digits = text == nullptr ? "" : text;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), time);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(time))
    throw not_an_index(file, fmt::format("timestep '{}' is no number", digits));
  return time;
}

InputError not_a_frame(const fs::path& frame, const std::string& what) {
  return InputError(fmt::format("{}: not a Weaveform frame ({}); solve again", frame.string(), what));
}

// Reads the points and the one array asked for ("" for none), in point or cell data.
VtuGrid read_grid(const fs::path& frame, const std::string& array) {
  if (!fs::is_regular_file(frame))
    throw FileError(fmt::format("{}: no such frame; solve again, or choose another result folder", frame.string()));
  try {
    return read_vtu(frame, std::vector<std::string>{array}, "solve again");
  } catch (const FileError& damage) {
    throw InputError(damage.what());
  }
}

// What the index says, as the child sends it: times and names.
std::string parsed_index(const std::string& content, const fs::path& file) {
  std::istringstream text(content);
  vtkNew<vtkXMLDataParser> parser;
  const VtkMessages complaints;
  parser->SetStream(&text);
  if (parser->Parse() == 0 || complaints.count() > 0 || parser->GetRootElement() == nullptr)
    throw not_an_index(file, "the XML is broken");
  vtkXMLDataElement* collection = parser->GetRootElement()->FindNestedElementWithName("Collection");
  if (collection == nullptr) throw not_an_index(file, "no <Collection>");
  ByteWriter bytes;
  for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
    vtkXMLDataElement& entry = *collection->GetNestedElement(k);
    const char* name = entry.GetAttribute("file");
    if (name == nullptr) throw not_an_index(file, "an entry names no file");
    bytes.value(time_of(entry, file));
    bytes.text(name);
  }
  return bytes.take();
}

// Frames lie in the result folder, wherever that is; an index that leads elsewhere is not ours.
fs::path frame_path(const fs::path& directory, const std::string& name, const fs::path& file) {
  const fs::path path = name;
  if (path.empty() || path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end())
    throw not_an_index(file, fmt::format("'{}' is no file of this folder", name));
  return directory / path;
}

}  // namespace

std::vector<FrameFile> list_frames(const fs::path& directory) {
  const fs::path file = directory / file_name::index;
  const std::string content = read_text_file(file);
  const Guard guard{.file = file.string(),
                    .what = "VTK's XML parser",
                    .remedy = "solve again",
                    .seconds = 3.0 + static_cast<double>(content.size()) / 1e6,
                    .gigabytes = 1.0};
  const std::string bytes = run_guarded(guard, [&] { return parsed_index(content, file); });
  std::vector<FrameFile> frames;
  try {
    for (ByteReader reader(bytes); !reader.at_end();) {
      const auto time = reader.value<double>();
      frames.push_back({time, frame_path(directory, reader.text(), file)});
    }
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& damage) {
    throw not_an_index(file, damage.what());
  }
  return frames;
}

std::vector<Vec3> read_frame_positions(const fs::path& frame) {
  VtuGrid grid = read_grid(frame, "");
  if (!grid.double_precision) throw not_a_frame(frame, "its points are not in double precision");
  for (std::size_t n = 0; n < grid.point.size(); ++n)
    for (const double x : grid.point[n])
      if (!std::isfinite(x)) throw not_a_frame(frame, fmt::format("node {} lies at {}", n, x));
  return std::move(grid.point);
}

std::vector<Vec3> read_frame_positions(const fs::path& frame, const Mesh& mesh) {
  std::vector<Vec3> position = read_frame_positions(frame);
  if (position.size() != mesh.nodes.position.size())
    throw not_a_frame(
        frame, fmt::format("it has {} nodes and the mesh beside it {}", position.size(), mesh.nodes.position.size()));
  return position;
}

std::vector<double> read_frame_array(const fs::path& frame, const std::string& name) {
  const VtuGrid grid = read_grid(frame, name);
  for (const auto* data : {&grid.cell_data, &grid.point_data, &grid.field_data}) {
    const VtuArray* array = find_array(*data, name);
    if (array == nullptr) continue;
    std::vector<double> values(array->size());
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = array->as_double(k);
    return values;
  }
  throw not_a_frame(frame, fmt::format("no array '{}'", name));
}

}  // namespace weaveform
