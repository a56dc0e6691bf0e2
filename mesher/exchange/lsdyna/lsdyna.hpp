// LS-DYNA keyword file in the standard fixed columns: nodes I8, 3E16; elements I8; all other cards eight fields of 10.
// The layouts of *MAT_FABRIC and others follow hm_cfg_files/config/CFG/Keyword971_R11.1 and Keyword971 of OpenRadioss,
// which reads such decks.
#pragma once

#include <string>
#include <vector>

#include "mesher/exchange/export.hpp"
#include "mesher/exchange/gathered.hpp"
#include "mesher/exchange/laws.hpp"
#include "mesher/exchange/ties.hpp"
#include "mesher/exchange/tool_mesh.hpp"

namespace weaveform::foreign::lsdyna {

// One card of fields 10 wide, right-justified.
class Card10 {
public:
  explicit Card10(std::string& out) : out_(out) {}
  ~Card10() { out_ += "\n"; }
  Card10(const Card10&) = delete;
  Card10& operator=(const Card10&) = delete;
  Card10& i(long value);
  Card10& r(double value);

private:
  std::string& out_;
};

// Curves, by number; a tool's way is first_way + its place among the tools; a spring's or seatbelt's law is that of
// its material.
enum Curve { smooth_step = 1, shear_law, member_law, constant, rise, first_way = 11 };
// Materials, by number; springs and seatbelts have one for every part, from these on.
enum Material {
  warp = 1,
  weft,
  fabric,
  idle_warp,
  idle_weft,
  member,
  follower,
  rigid,
  seatbelts = 100,
  springs = 1000
};

// Elements of one part: a group of yarns, and for springs, whose curves are over millimetres, of one length.
struct YarnPart {
  const YarnGroup* group = nullptr;
  std::string name;
  double rest = 0.0;  // mm; of springs
  std::vector<int> element;
};

enum class LineElement { spring, beam, truss, seatbelt };

struct Deck {
  const Gathered& model;
  Materials materials = Materials::built_in;
  FreeTies ties;
  std::vector<ToolMesh> tool;  // as model.tools; without shells: written as a rigid wall
  std::vector<YarnPart> yarns;

  [[nodiscard]] LineElement yarn_element() const;
  // Parts and sections: the yarns' from 1, then these.
  [[nodiscard]] int cell_part() const { return static_cast<int>(yarns.size()) + 1; }
  [[nodiscard]] int member_part() const { return cell_part() + 1; }
  [[nodiscard]] int follower_part() const { return cell_part() + 2; }
  [[nodiscard]] int tool_part(std::size_t k) const { return cell_part() + 3 + static_cast<int>(k); }
  // Node sets: as in the model from 1, then all nodes of the fabric.
  [[nodiscard]] int all_nodes() const { return static_cast<int>(model.sets.size()) + 1; }
  // Nodes: the mesh's, the followers', the tools'.
  [[nodiscard]] int first_tool_node(std::size_t k) const;
  // Elements: yarns, shells, members, followers' springs, tools' shells, masses.
  [[nodiscard]] int first_follower_spring() const {
    return model.first_extra() + static_cast<int>(model.members.size());
  }
  [[nodiscard]] int first_tool_shell(std::size_t k) const;
};

[[nodiscard]] std::vector<YarnPart> yarn_parts(const Gathered& model, LineElement element);

void add_curve(int curve, const std::string& what, const Points& points, std::string& out);

// Parts, sections, materials and the curves of the laws (lsdyna_laws.cpp).
void add_parts(const Deck& deck, std::string& out);
void add_materials(const Deck& deck, std::vector<std::string>& lost, std::string& out);

// Grips, weight, tools, control and output (lsdyna_loads.cpp).
[[nodiscard]] bool is_rigid_wall(const ToolMotion& motion);
void add_loads(const Deck& deck, std::vector<std::string>& lost, std::string& out);
void add_control(const Deck& deck, std::string& out);

}  // namespace weaveform::foreign::lsdyna
