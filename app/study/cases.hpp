// The cases of a study: every combination of its axes, each a complete scene.
#pragma once

#include <string>
#include <vector>

#include "app/study/study_spec.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform::study {

struct Case {
  std::string name;   // of its files in DIR/cases: 16 hexadecimal digits that follow from the text alone
  std::string text;   // the complete scene, with the digests of files it leads to: what the case is
  Settings settings;  // of the varied keys, in the order of the axes
  std::string series = {};
};

// The value a case gives a key; nullptr when its axis leaves the key out in this case.
[[nodiscard]] const Setting* setting_of(const Case& one, const std::string& key);

// "blank.coarsening=4 model.formulation=energy"
[[nodiscard]] std::string describe(const Case& one);

// Every case, in the order of the product, the last axis varying fastest. Equal scenes keep one name. Throws InputError
// with all complaints, those about a value at its place in the study file; FileError.
[[nodiscard]] std::vector<Case> expand(const Study& study);

// The product of the axes; the case of each variant of the scene, whose text is given so that all are of one scene,
// whatever becomes of its file. Throw as `expand` does.
[[nodiscard]] std::vector<Variant> combinations(const Study& study);
[[nodiscard]] std::vector<Case> cases_of(const Study& study, const std::string& scene_text,
                                         const std::vector<Variant>& variants);

// What a case is and is called, from its scene: reads the files that the scene leads to. Throws FileError.
[[nodiscard]] std::string case_text(const Scene& scene);
[[nodiscard]] std::string case_name(const std::string& text);

}  // namespace weaveform::study
