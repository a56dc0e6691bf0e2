// What a folder's run took where its scene left that to the program: a run that goes on takes the same, whatever this
// program would take by now.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesher/resolve/resolved.hpp"

namespace weaveform {

struct Record {
  std::vector<TakenSpec> taken;
  std::optional<AccuracySpec> accuracy;  // that was wanted
};

// Of DIR/scene.toml; empty when there is none.
[[nodiscard]] Record record_of(const std::filesystem::path& directory);

// The overrides and, for each key that the scene leaves open and the record has, its value.
[[nodiscard]] std::vector<std::string> with_record(const Record& record, const std::string& scene_file,
                                                   std::vector<std::string> overrides);

// The record as the model's own, where its scene has the same values.
void keep_record(const Record& record, Resolved& model);

}  // namespace weaveform
