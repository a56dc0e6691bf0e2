// The rows of every table of a scene: one for each key, in the order of the echo and the reference (schema.hpp).
#pragma once

#include <vector>

#include "core/keys/key_table.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

[[nodiscard]] const std::vector<Key<FabricSpec>>& fabric_keys();
[[nodiscard]] const std::vector<Key<BlankSpec>>& blank_keys();
[[nodiscard]] const std::vector<Key<ModelSpec>>& model_keys();
[[nodiscard]] const std::vector<Key<PlySpec>>& ply_keys();
[[nodiscard]] const std::vector<Key<StackSpec>>& stack_keys();
[[nodiscard]] const std::vector<Key<PairSpec>>& pair_keys();
[[nodiscard]] const std::vector<Key<GripSpec>>& grip_keys();
[[nodiscard]] const std::vector<Key<ToolSpec>>& tool_keys();
[[nodiscard]] const std::vector<Key<DrapeSpec>>& drape_keys();
[[nodiscard]] const std::vector<Key<AnalysisSpec>>& analysis_keys();
[[nodiscard]] const std::vector<Key<FrameSpec>>& frame_keys();
[[nodiscard]] const std::vector<Key<OutputSpec>>& output_keys();
[[nodiscard]] const std::vector<Key<MeasureSpec>>& measure_keys();
[[nodiscard]] const std::vector<Key<AccuracySpec>>& accuracy_keys();
[[nodiscard]] const std::vector<Key<TakenSpec>>& taken_keys();

}  // namespace weaveform
