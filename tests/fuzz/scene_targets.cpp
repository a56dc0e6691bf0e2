#include <algorithm>
#include <array>
#include <string>

#include "app/study/study_spec.hpp"
#include "fabric/identify/fit_spec.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/lattice/expected_size.hpp"
#include "post/dic/settings/settings.hpp"
#include "solver/analysis/identity.hpp"
#include "tests/fuzz/rooms.hpp"
#include "tests/fuzz/scratch_file.hpp"

namespace weaveform::fuzz {
namespace {

// A scene that was taken echoes itself, and the echo is the same scene.
void scene(std::string_view bytes) {
  answered([&] {
    const Scene read = read_scene_text(text_of(bytes), "scene.toml");
    const std::string echo = scene_to_toml(read);
    hold(scene_to_toml(read_scene_text(echo, "echo.toml")) == echo);
  });
}

// The first line is a value given on the command line to the scene that follows.
struct ValueAndScene {
  std::string value, scene;
};
ValueAndScene split(std::string_view bytes) {
  const auto end = std::find(bytes.begin(), bytes.end(), '\n');
  return {{bytes.begin(), end}, {end, bytes.end()}};
}

void override_value(std::string_view bytes) {
  const ValueAndScene given = split(bytes);
  answered([&] { static_cast<void>(read_scene_text(given.scene, "scene.toml", {given.value})); });
}

// With and without that value: two scenes have one digest exactly when nothing differs by name.
void identity(std::string_view bytes) {
  const ValueAndScene given = split(bytes);
  answered([&] {
    const Identity plain = scene_identity(read_scene_text(given.scene, "scene.toml"));
    hold(differences(plain, plain).empty());
    const Identity other = scene_identity(read_scene_text(given.scene, "scene.toml", {given.value}));
    hold(differences(plain, other).empty() == (digest_of(plain) == digest_of(other)));
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

// The mesh of a blank without files, where it is small: as large as was said before, and sound.
void blank(std::string_view bytes) {
  constexpr double most_cells = 3000.0, most_crossings = 30000.0;
  answered([&] {
    Scene read = read_scene_text(text_of(bytes), "scene.toml");
    if (read.blank.shape == BlankShape::file) return;
    read.tools.clear();
    read.drape.reset();
    const ExpectedSize size = expected_size(read.blank, plain_card(), read_blank_outline(read));
    if (!(size.cells < most_cells && size.crossings < most_crossings)) return;
    const Mesh mesh = build_flat_mesh(read, plain_card());
    hold(mesh.check().empty());
    hold(static_cast<double>(mesh.cells.size()) < 4.0 * most_cells);
  });
}

}  // namespace

std::vector<Target> scene_targets() {
  return {{"scene", scene}, {"override", override_value},   {"identity", identity}, {"card", card}, {"fit", fit},
          {"study", study}, {"dic_settings", dic_settings}, {"blank", blank}};
}

}  // namespace weaveform::fuzz
