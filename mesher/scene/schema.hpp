// Every key a scene may hold: one row each. Reader, echo, --set and docs/scene.md all follow these rows.
// A new key is a member in scene.hpp and one row in its _keys.cpp; a new table is a list of rows and a line in
// scene_tables().
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/keys/key_table.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

struct SceneTable {
  std::string name;    // "blank"
  bool many = false;   // [[grip]]: a list of tables, each with a name
  bool named = false;  // [tools.NAME]: a table of tables
  std::string doc;
  std::vector<KeyInfo> keys = {};
  std::function<void(const toml::node&, Scene&, Complaints&)> read = {};
  std::function<std::string(const Scene&)> write = {};
};

// In the order of the echo and the reference.
[[nodiscard]] const std::vector<SceneTable>& scene_tables();

}  // namespace weaveform
