#include "tests/fuzz/targets.hpp"

#include <algorithm>
#include <string>

#include "app/study/measure.hpp"
#include "app/study/study_spec.hpp"
#include "mesher/base/error.hpp"
#include "mesher/import/foreign_mesh.hpp"
#include "mesher/import/import.hpp"
#include "mesher/material/card.hpp"
#include "mesher/material/identify/fit_spec.hpp"
#include "mesher/material/identify/raw_table.hpp"
#include "mesher/outline/loops.hpp"
#include "mesher/scene/reader.hpp"
#include "post/dic_settings/settings.hpp"
#include "post/measurement/measurement.hpp"
#include "solver/result/result.hpp"
#include "tests/fuzz/scratch_file.hpp"

namespace weaveform::fuzz {
namespace {

template <class Read>
void answered(const Read& read) {
  try {
    read();
  } catch (const InputError&) {
  } catch (const FileError&) {
  }
}

std::string text_of(std::string_view bytes) {
  return {bytes.begin(), bytes.end()};
}

// A scene that was taken echoes itself, and the echo is the same scene.
void scene(std::string_view bytes) {
  answered([&] {
    const Scene read = read_scene_text(text_of(bytes), "scene.toml");
    const std::string echo = scene_to_toml(read);
    if (scene_to_toml(read_scene_text(echo, "echo.toml")) != echo) __builtin_trap();
  });
}

// The first line is a value given on the command line to the scene that follows.
void override_value(std::string_view bytes) {
  answered([&] {
    const auto end = std::find(bytes.begin(), bytes.end(), '\n');
    const std::string value(bytes.begin(), end), rest(end, bytes.end());
    static_cast<void>(read_scene_text(rest, "scene.toml", {value}));
  });
}

void card(std::string_view bytes) {
  answered([&] { static_cast<void>(read_card_text(text_of(bytes), "card.toml")); });
}

void fit(std::string_view bytes) {
  answered([&] { static_cast<void>(identify::read_fit_text(text_of(bytes), "fit.toml")); });
}

void study(std::string_view bytes) {
  answered([&] { static_cast<void>(study::read_study_text(text_of(bytes), "study.toml")); });
}

void dic_settings(std::string_view bytes) {
  const ScratchFile file("settings.toml", bytes);
  answered([&] { static_cast<void>(dic::read_settings(file.path().string(), {})); });
}

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

void history(std::string_view bytes) {
  const ScratchFile file("history.csv", bytes);
  answered([&] {
    const History read = read_history(file.path());
    for (const auto& name : read.column) static_cast<void>(read.values(name));
  });
}

void statistics(std::string_view bytes) {
  const ScratchFile file("solve.json", bytes);
  answered([&] { static_cast<void>(read_statistics(file.path())); });
}

// The same bytes as the summary and the history of a case, asked for by names that lead into both.
void measure(std::string_view bytes) {
  const ScratchFile summary("summary.json", bytes), rows("history.csv", bytes);
  const auto& folder = ScratchFile::folder();
  answered([&] { static_cast<void>(study::warnings_of(folder)); });
  for (const char* name : {"max_shear_angle_deg", "grips.top.force_N", "travel.0.travel_mm", "last(top.force_N)"})
    answered([&] { static_cast<void>(study::measure(folder, name)); });
}

void frame_index(std::string_view bytes) {
  const ScratchFile file("result.pvd", bytes);
  answered([&] { static_cast<void>(list_frames(ScratchFile::folder())); });
}

const Scene& plain_scene() {
  static const Scene scene = read_scene_text("[fabric]\nmaterial = \"twintex-pw\"\n", "scene.toml");
  return scene;
}

const Card& plain_card() {
  static const Card card = load_card("twintex-pw", "");
  return card;
}

void foreign(const std::filesystem::path& file) {
  answered([&] {
    const ForeignMesh read = read_foreign_mesh(file);
    static_cast<void>(tool_surface(read, "punch"));
    answered([&] { static_cast<void>(import_own(read)); });
    answered([&] { static_cast<void>(import_foreign(read, plain_scene(), plain_card())); });
  });
}

void abaqus(std::string_view bytes) {
  const ScratchFile file("mesh.inp", bytes);
  foreign(file.path());
}

void gmsh_mesh(std::string_view bytes) {
  const ScratchFile file("mesh.msh", bytes);
  foreign(file.path());
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

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {
      {"scene", scene},
      {"override", override_value},
      {"card", card},
      {"fit", fit},
      {"study", study},
      {"dic_settings", dic_settings},
      {"table", table},
      {"outline", outline},
      {"history", history},
      {"statistics", statistics},
      {"measure", measure},
      {"frame_index", frame_index},
      {"abaqus", abaqus},
      {"gmsh_mesh", gmsh_mesh},
      {"measurement", measurement},
  };
  return all;
}

}  // namespace weaveform::fuzz
