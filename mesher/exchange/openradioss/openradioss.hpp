// OpenRadioss input, block format 2021: fields of 10 columns for integers, 20 for reals. The layouts follow the
// starter's own reader, hm_cfg_files/config/CFG/radioss2021 of OpenRadioss (of 2023-24) and the older folders that it
// takes what it does not have from:
//   /PROP/SPRING radioss140/PROP/prop_p4_spring.cfg       /PROP/SPR_GENE radioss2018/PROP/prop_p8_spr_gene.cfg
//   /PROP/SH_FABR radioss2021/PROP/prop_p16_sh_fabr.cfg   /MAT/FABR_A    radioss2017/MAT/matl58_fabr_a.cfg
//   /INTER/TYPE7 radioss2020/INTER/inter_type7.cfg        /RBODY         radioss2020/RBODY/rbody.cfg
//   /CLOAD, /GRAV, /IMPDISP radioss51/LOADS
#pragma once

#include <string>
#include <vector>

#include "mesher/exchange/export.hpp"
#include "mesher/exchange/gathered.hpp"
#include "mesher/exchange/laws.hpp"
#include "mesher/exchange/ties.hpp"
#include "mesher/exchange/tool_mesh.hpp"

namespace weaveform::foreign::radioss {

[[nodiscard]] std::string i10(long value);
[[nodiscard]] std::string r20(double value);
[[nodiscard]] std::string blank(std::size_t columns);

// Functions, by number; a tool's way is first_way + its place among the tools.
enum Function { smooth_step = 1, warp_law, weft_law, shear_law, member_law, constant, rise, first_way = 11 };
// Materials, by number.
enum Material { warp = 1, weft, fabric, idle_warp, idle_weft, rigid };

// What is written and under which numbers.
struct Deck {
  const Gathered& model;
  Materials materials = Materials::built_in;
  FreeTies ties;
  std::vector<ToolMesh> tool;  // as model.tools

  // Parts and properties: the yarn groups from 1, then these.
  [[nodiscard]] int cell_part() const { return static_cast<int>(model.yarns.size()) + 1; }
  [[nodiscard]] int member_part() const { return cell_part() + 1; }
  [[nodiscard]] int follower_part() const { return cell_part() + 2; }
  [[nodiscard]] int tool_part(std::size_t k) const { return cell_part() + 3 + static_cast<int>(k); }
  // Groups of nodes: the sets from 1, then all nodes of the fabric, then two for every tool.
  [[nodiscard]] int all_nodes() const { return static_cast<int>(model.sets.size()) + 1; }
  [[nodiscard]] int main_group(std::size_t k) const { return all_nodes() + 1 + 2 * static_cast<int>(k); }
  [[nodiscard]] int surface_group(std::size_t k) const { return main_group(k) + 1; }
  // Nodes: the mesh's, the followers', then of every tool the one that moves it and those of its shells.
  [[nodiscard]] int main_node(std::size_t k) const;
  // Elements: yarns, shells, members, followers' springs, then the tools' shells.
  [[nodiscard]] int first_follower_spring() const {
    return model.first_extra() + static_cast<int>(model.members.size());
  }
  [[nodiscard]] int first_tool_shell(std::size_t k) const;
  // Springs with the law's table instead of bars or beams.
  [[nodiscard]] bool yarns_are_springs() const {
    return materials == Materials::built_in && model.scene.model.yarn != YarnElement::beam;
  }
};

// t over the angle to 85 deg, made to rise throughout: the starter refuses a fabric whose shear curve falls anywhere
// (error 1583, mat058/law58_upd.F). `changed` is what that took at angles that the card's law is meant for.
[[nodiscard]] Points shear_points(const Gathered& model, double& changed);

void add_points(int function, const std::string& title, const Points& points, std::string& out);
void add_group(int group, const std::string& title, const std::vector<int>& numbers, std::string& out);

// Properties, materials and the functions of the laws (openradioss_laws.cpp).
void add_parts(const Deck& deck, std::string& out);
void add_materials(const Deck& deck, std::string& out);
void add_law_functions(const Deck& deck, std::string& out);

// Ties, grips, weight, tools, histories (openradioss_loads.cpp).
void add_ties(const Deck& deck, std::string& out);
void add_loads(const Deck& deck, std::vector<std::string>& lost, std::string& out);
void add_histories(const Deck& deck, std::string& out);

[[nodiscard]] std::string engine_file(const Deck& deck, const std::string& run_name);

}  // namespace weaveform::foreign::radioss
