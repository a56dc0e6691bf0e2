// What every format writes, gathered once from scene, card and mesh: groups of yarn elements with one section, cells as
// triangles and quadrilaterals, motions in world axes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform::foreign {

// Yarn elements of one family whose sections, masses and reach into jaws agree to 1e-9 (relative). Of a softened end
// the section is the softened one, which is the same force; a tied free end carries nothing and gets idle_share of its
// section.
struct YarnGroup {
  std::string name;  // "warp_1", ...; "warp_idle_1", ...
  std::size_t family = 0;
  double section = 0.0;        // mm^2; that bears
  double whole_section = 0.0;  // mm^2; that weighs: of all yarns the element stands for
  double jaw_stretch = 1.0;    // 1; (L0 + jaw)/L0, the length that strains against the element's own
  bool idle = false;
  std::vector<int> element;
};
inline constexpr double idle_share = 1e-6;
// Shells carry no mass here (the yarns have it all), yet explicit codes want a density.
inline constexpr double shell_mass_share = 1e-3;

struct Shell {
  std::array<int, 4> node = {-1, -1, -1, -1};  // counter-clockwise; [3] = -1: a triangle
  int cell = 0;
  [[nodiscard]] int size() const { return node[3] < 0 ? 3 : 4; }
};

struct Motion {
  std::string set;                                    // name of the node set
  std::array<std::optional<double>, 3> displacement;  // mm; per world axis at the end; none: free
  [[nodiscard]] bool holds_all() const { return displacement[0] && displacement[1] && displacement[2]; }
};

// A pin-jointed member of a shear frame, between two of its corners.
struct FrameMember {
  std::array<int, 2> node = {0, 0};
};

struct ToolMotion {
  Tool tool;
  const ToolSpec* spec = nullptr;
  std::array<double, 3> travel = {0.0, 0.0, 0.0};  // mm
};

struct Gathered {
  const Scene& scene;
  const Card& card;
  const Mesh& mesh;
  double duration = 0.0;  // s
  std::string written_by;
  std::vector<YarnGroup> yarns;
  std::vector<Shell> shells;  // in the order of the cells
  std::vector<NodeSet> sets;  // the mesh's; of a shear frame also frame_corners, frame_base and its grip
  std::vector<Motion> grips;  // of a shear frame its base and the pulled corner
  std::vector<FrameMember> members;
  std::vector<ToolMotion> tools;
  std::array<std::array<double, 3>, 2> direction = {};                     // unit; warp and weft on the flat blank
  std::vector<std::string> not_carried;                                    // by any of the formats
  [[nodiscard]] int first_shell() const { return mesh.yarn_count() + 1; }  // its number
  // The number after the last shell, from which further elements (members, springs, tools) count.
  [[nodiscard]] int first_extra() const { return first_shell() + static_cast<int>(shells.size()); }
  [[nodiscard]] int set_number(const std::string& name) const;  // from 1, as in `sets`; 0: none
  [[nodiscard]] double yarn_density(std::size_t family) const;  // tonne/mm^3
  [[nodiscard]] double shell_density() const;                   // tonne/mm^3
  [[nodiscard]] double member_section() const;                  // mm^2
  [[nodiscard]] double member_density() const;                  // tonne/mm^3; with frame.mass_scale
  // mm^4; EI/E of all yarns of the group as beams of the card's linear modulus, for bending in the fabric's plane and
  // out of it. Throws InputError where neither scene nor card says how they bend.
  [[nodiscard]] std::array<double, 2> second_moments(const YarnGroup& group) const;
  // A node beside a yarn element in the fabric's plane, which says how a beam's section lies; -1: there is none.
  [[nodiscard]] int node_beside(int element) const;
};

// Cells as the writers cut them: three and four nodes as they are, five as 4 + 3, six as 4 + 4.
[[nodiscard]] std::vector<Shell> shells_of(const MeshCells& cells);

[[nodiscard]] Gathered gather(const Scene& scene, const Card& card, const Mesh& mesh, const std::vector<Tool>& tools,
                              double duration, const std::string& written_by);

// One constant of a user material with what it is.
struct Constant {
  double value = 0.0;
  std::string what;
};
// Tension law of a family: flags, compression, then piece by piece.
[[nodiscard]] std::vector<Constant> yarn_constants(const Gathered& model, std::size_t family);
[[nodiscard]] std::vector<Constant> shear_constants(const Gathered& model);
// Adds to the line that begins with `begin`, or puts another in its place, where a format does better than most.
void amend(std::vector<std::string>& lost, const std::string& begin, const std::string& addition);
void replace(std::vector<std::string>& lost, const std::string& begin, const std::string& line);
// How a shear frame is written by the formats that write it.
void list_frame(const Gathered& model, std::vector<std::string>& lost);
void list_coupling(const Gathered& model, std::vector<std::string>& lost);
// What user materials leave to their routine, and what their constants do not say.
void list_user_materials(const Gathered& model, std::vector<std::string>& lost);
// Way of a grip or tool as a part of its travel at a part s in [0, 1] of the duration.
[[nodiscard]] double smooth_way(double s);
[[nodiscard]] double tool_way(const ToolSpec& tool, double s);

// The number in at most `width` characters, with as many digits as that leaves; 0 digits lost when it fits exactly.
[[nodiscard]] std::string fit(double value, std::size_t width);
// Letters, digits and '_' only, beginning with a letter, for codes that ask it of names.
[[nodiscard]] std::string plain_name(const std::string& name);
// "<mark> text" line by line: who wrote it, units, numbering and what is not carried.
[[nodiscard]] std::string header(const Gathered& model, const std::string& mark,
                                 const std::vector<std::string>& not_carried);

}  // namespace weaveform::foreign
