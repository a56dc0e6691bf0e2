// Keys of what is wanted where something is left to the program, and of what it took.
#include "mesher/scene/scene_keys.hpp"

namespace weaveform {

const std::vector<Key<AccuracySpec>>& accuracy_keys() {
  static const std::vector<Key<AccuracySpec>> keys = {
      key<&AccuracySpec::force>(
          {.name = "force",
           .unit = "1",
           .limits = between(1e-4, 0.5),
           .doc = "error that the mesh may have in the loads of grips and tools at the end, as a share of them"}),
      key<&AccuracySpec::angle>({.name = "angle",
                                 .unit = "deg",
                                 .limits = between(0.01, 45),
                                 .doc = "error that it may have in a shear angle, the mean over some 20 mm"}),
  };
  return keys;
}

const std::vector<Key<TakenSpec>>& taken_keys() {
  static const std::vector<Key<TakenSpec>> keys = {
      key<&TakenSpec::key>(
          {.name = "key",
           .required = true,
           .doc = "the key that was left open, `blank.coarsening`, `ply.NAME.cell`, `analysis.duration`"}),
      key<&TakenSpec::value>({.name = "value", .required = true, .doc = "what it was given, as text"}),
      key<&TakenSpec::why>({.name = "why", .doc = "the reason, one line"}),
      key<&TakenSpec::missed>({.name = "missed", .doc = "what was wanted and is not reached with it"}),
  };
  return keys;
}

}  // namespace weaveform
