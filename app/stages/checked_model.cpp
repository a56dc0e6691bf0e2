#include "app/stages/checked_model.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "app/stages/room.hpp"
#include "core/error.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/symmetry/find_symmetry.hpp"
#include "mesher/tools/tool.hpp"
#include "solver/bending/flexure.hpp"

namespace weaveform {

namespace fs = std::filesystem;

namespace {

// What one attempt after another complains of.
class Findings {
public:
  void file(const std::string& complaint) { lines_.push_back(complaint); }

  // True when it went well.
  template <class Attempt>
  bool attempt(Attempt attempt) {
    try {
      attempt();
      return true;
    } catch (const InputError& error) {
      for (const std::string& line : error.complaints()) input(line);
    } catch (const FileError& error) {
      lines_.emplace_back(error.what());
    } catch (const PhysicsError& error) {
      input(error.what());
    }
    return false;
  }

  void throw_if_any() const {
    if (lines_.empty()) return;
    if (only_files_) throw FileError(lines_);
    throw InputError(lines_);
  }

private:
  void input(const std::string& line) {
    only_files_ = false;
    if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
  }
  std::vector<std::string> lines_;
  bool only_files_ = true;
};

std::string no_such_file(const Scene& scene, const std::string& key, const fs::path& file) {
  return fmt::format("{}: {}: {}: no such file; correct the path, which is taken from the scene's folder", scene.file,
                     key, file.string());
}

// The scene without the tools whose files are not there, about which nothing more can be said.
Scene look_at_tool_files(const Scene& scene, Findings& found) {
  Scene rest = scene;
  std::erase_if(rest.tools, [&](const ToolSpec& tool) {
    if (tool.file.empty() || fs::exists(tool_path(tool.file, scene.file))) return false;
    found.file(no_such_file(scene, "tools." + tool.name + ".file", tool_path(tool.file, scene.file)));
    return true;
  });
  return rest;
}

bool has_outline(const Scene& scene, Findings& found) {
  if (scene.blank.outline.empty()) return true;
  const fs::path file = fs::path(scene.file).parent_path() / scene.blank.outline;
  if (fs::exists(file)) return true;
  found.file(no_such_file(scene, "blank.outline", file));
  return false;
}

void try_first_step(const Scene& scene, const Model& model) {
  Scene clean = scene;
  clean.analysis.perturbation = 0.0;  // a perturbed analysis is two
  (void)solve(model.mesh, clean, model.card, {}, {.threads = 1, .quiet = true, .most_steps = 1});
}

}  // namespace

Model checked_model(const fs::path& scene_file, const std::vector<std::string>& overrides, bool yes, Look look) {
  Model model;
  model.scene = read_scene(scene_file, overrides);
  Findings found;
  const Scene rest = look_at_tool_files(model.scene, found);
  const bool outlined = has_outline(model.scene, found);
  const bool carded = found.attempt([&] { model.card = load_card(model.scene.fabric.material, model.scene.file); });
  const bool bends = carded && found.attempt([&] { (void)choose_flexure(model.card, model.scene.model); });
  const bool meshed = carded && outlined && found.attempt([&] {
    require_memory(model.scene, model.card, yes);
    model.mesh = build_mesh(rest, model.card);
    (void)find_symmetry(rest, model.card, model.mesh);  // complains of one that is asked for in vain
  });
  if (meshed && bends && look == Look::with_first_step) found.attempt([&] { try_first_step(rest, model); });
  found.throw_if_any();
  return model;
}

}  // namespace weaveform
