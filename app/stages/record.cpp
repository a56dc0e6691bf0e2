#include "app/stages/record.hpp"

#include "mesher/scene/reader.hpp"
#include "mesher/scene/scene_copy.hpp"
#include "mesher/scene/taken.hpp"

namespace weaveform {

namespace fs = std::filesystem;

Record record_of(const fs::path& directory) {
  const fs::path copy = directory / file_name::scene;
  if (!fs::exists(copy)) return {};
  const Scene scene = read_scene(copy);
  return {scene.taken, scene.accuracy};
}

std::vector<std::string> with_record(const Record& record, const std::string& scene_file,
                                     std::vector<std::string> overrides) {
  if (record.taken.empty()) return overrides;
  for (const std::string& line : as_overrides(record.taken, read_scene(scene_file, overrides)))
    overrides.push_back(line);
  return overrides;
}

void keep_record(const Record& record, Resolved& model) {
  if (record.taken.empty()) return;
  model.scene.taken = record.taken;
  if (!model.scene.accuracy) model.scene.accuracy = record.accuracy;
  drop_overruled(model.scene);
  for (std::size_t k = 0; k < model.ply.size(); ++k)
    model.ply[k].scene.taken = taken_of_ply(model.scene.taken, model.scene.ply[k].name);
}

}  // namespace weaveform
