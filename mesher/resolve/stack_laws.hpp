// How two plies of a stack act on each other, with what the scene's files say.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesher/scene/scene.hpp"

namespace weaveform {

struct ResolvedPair {
  double friction = 0.0;                          // 1; Coulomb
  std::vector<std::array<double, 2>> shear_law;   // slip (mm), shear stress (MPa), rising slip; none: Coulomb alone
  std::vector<std::array<double, 2>> compaction;  // approach (mm), pressure (MPa), both rising; none: faces hardly give
  double gap = 0.0;                               // mm; between their faces at the start
};

// The laws between plies `one` and `other` by name. Throws FileError (a file is not there) and InputError (it is no such
// table, with file:line:column).
[[nodiscard]] ResolvedPair resolve_pair(const Scene& scene, const std::string& one, const std::string& other);

// Rows of two numbers: slip (mm) and shear stress (MPa). A first line that holds no number is a heading. Slips rise from
// 0 or more on, stresses are 0 or more. `file` names the text in messages. Throws InputError.
[[nodiscard]] std::vector<std::array<double, 2>> read_shear_law(const std::string& text, const std::string& file);

// The same of approach_mm or thickness_mm (the heading says which) and pressure_MPa, given as approach, which rises with
// the pressure from 0 on.
[[nodiscard]] std::vector<std::array<double, 2>> read_compaction(const std::string& text, const std::string& file);

// Files that the laws of a scene name, as paths.
[[nodiscard]] std::vector<std::string> law_files(const Scene& scene);

}  // namespace weaveform
