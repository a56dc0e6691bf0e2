#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include "app/study/measure.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/mesh/vtu_grid.hpp"
#include "solver/analysis/checkpoint.hpp"
#include "solver/result/result.hpp"
#include "tests/fuzz/rooms.hpp"
#include "tests/fuzz/scratch_file.hpp"
#include "tests/support/contact_scene.hpp"
#include "tests/support/small_world.hpp"

namespace weaveform::fuzz {
namespace {

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

// What the child that reads .vtu files sends, should it have been taken over, and a mesh of what passes.
void vtu_bytes(std::string_view bytes) {
  VtuGrid grid;
  try {
    grid = decode_vtu(text_of(bytes));
  } catch (const std::runtime_error&) {
    return;
  }
  for (const auto* data : {&grid.point_data, &grid.cell_data, &grid.field_data})
    for (const VtuArray& array : *data)
      for (std::size_t k = 0; k < array.size(); ++k) static_cast<void>(array.as_double(k));
  answered([&] { static_cast<void>(mesh_of(grid, "mesh.vtu")); });
}

const Identity of_this_run = {{"blank.size", "[1, 2]"}, {"card twintex-pw", "00ff", true}};
// A world with every kind of member: shells, cells with a history, contact on a plane.
test::SmallWorld& world() {
  static test::SmallWorld of_run = [] {
    Scene scene = test::contact_scene({40.0, 40.0}, 2.5);
    scene.model.cell = CellElement::shell;
    scene.model.formulation = Formulation::incremental;
    scene.tools = {test::make_tool_spec("plate", ToolShape::plane)};
    return test::SmallWorld({scene});
  }();
  return of_run;
}

void archive_world(Archive& archive) {
  world()->archive(archive);
}

// Of a file of this run: all before the state.
const std::string& head() {
  static const std::string bytes = checkpoint_bytes(of_this_run, [](Archive&) {});
  return bytes;
}

// As a forger would mend it: the size is that of its bytes, the identity that of the run.
std::string forged(std::string_view body) {
  std::string bytes = head();
  bytes += body;
  const std::uint64_t size = bytes.size();
  std::memcpy(bytes.data() + head().find('\n') + 1, &size, sizeof size);
  return bytes;
}

// The bytes as a whole file, or as what follows its identity. What is taken is sound and written as it was read.
void checkpoint(std::string_view bytes) {
  answered([&] {
    const std::string file = bytes.starts_with("weaveform") ? text_of(bytes) : forged(bytes);
    read_checkpoint(file, of_this_run, archive_world, "checkpoint.bin", CheckSum::ignored);
    hold(unsound_member(archive_world).empty());
    hold(file.ends_with(checkpoint_bytes(of_this_run, archive_world).substr(head().size())));
  });
}

}  // namespace

std::vector<Target> result_targets() {
  return {{"history", history},         {"statistics", statistics}, {"measure", measure},
          {"frame_index", frame_index}, {"vtu_bytes", vtu_bytes},   {"checkpoint", checkpoint}};
}

}  // namespace weaveform::fuzz
