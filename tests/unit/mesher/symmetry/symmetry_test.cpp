// Mirror planes: which scenes have them, what is in the way of the others, and what a half or quarter holds.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numeric>

#include "core/error.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/symmetry/cut_part.hpp"
#include "tests/support/contact_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mesher/lattice/lattice_zoo.hpp"

namespace weaveform {
namespace {

using namespace test;

Symmetry symmetry_of(const Scene& scene) {
  const Card card = load_card(scene.fabric.material);
  const Mesh mesh = build_mesh(scene, card);
  return find_symmetry(scene, card, mesh, make_tools(scene, mesh));
}

GripSpec grip_at(const std::string& edge, double travel) {
  GripSpec grip = lattice_zoo::grip_on(edge);
  grip.travel = travel;
  return grip;
}

TEST(Symmetry, DeepDrawingOfASquareBlankIsAQuarter) {
  const Symmetry symmetry = symmetry_of(drawing());
  EXPECT_EQ(symmetry.word(), "quarter");
  EXPECT_EQ(symmetry.why[0] + symmetry.why[1], "");
  EXPECT_EQ(describe(symmetry), "symmetry: a quarter of the blank is solved");
}

std::string write_tetrahedron() {
  const std::string file = test::scratch_file("tetrahedron.stl").string();
  std::ofstream out(file);
  const std::array<std::array<int, 3>, 4> facets = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  const std::array<const char*, 4> corners = {"0 0 10", "9 0 10", "0 9 10", "0 0 19"};
  out << "solid t\n";
  for (const auto& facet : facets) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const int corner : facet) out << "vertex " << corners[corner] << "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid t\n";
  return file;
}

struct Change {
  const char* name;
  std::function<void(Scene&)> make;
  const char* word;  // what is left
  const char* why;   // part of the reason, of either plane
};

TEST(Symmetry, WhatBreaksItIsNamed) {
  const std::vector<Change> changes = {
      {"tool beside x = 0",
       [](Scene& s) {
         s.tools[2].position = {{0.1, 0.0, 20.25}};
       },
       "half", "tool 'punch' stands to one side"},
      {"tool off both",
       [](Scene& s) {
         s.tools[1].position = {{0.1, -0.2, -0.25}};
       },
       "none", "tool 'die' stands to one side"},
      {"tool that leans",
       [](Scene& s) {
         s.tools[0].axis = {0.0, 0.01, -1.0}, s.tools[0].position = {{0.0, 0.0, 9.0}};
       },
       "half", "tool 'binder' stands to one side of it or leans"},
      {"tool that moves sideways",
       [](Scene& s) {
         s.tools[2].direction = {{0.1, 0.0, -1.0}};
       },
       "half", "tool 'punch' moves across it"},
      {"yarns at 30 deg", [](Scene& s) { s.blank.yarn_angle = 30.0; }, "none", "the yarns do not run along it"},
      {"lattice shifted",
       [](Scene& s) {
         s.blank.phase = {0.2, 0.0};
       },
       "half", "the yarn lattice is not symmetric"},
      {"gravity sideways",
       [](Scene& s) {
         s.analysis.gravity = {1.0, 0.0, -9810.0};
       },
       "half", "gravity pulls across it"},
      {"random start", [](Scene& s) { s.analysis.perturbation = 0.1; }, "none", "analysis.perturbation is random"},
      {"one-sided grip", [](Scene& s) { s.grip = {grip_at("left", 0.0)}; }, "half",
       "grip 'left' has none like it opposite"},
      {"boxes of unequal size",
       [](Scene& s) {
         s.grip = {grip_at("", 0.0), grip_at("", 0.0)};
         s.grip[0].name = "one", s.grip[0].box = {{-70.0, -70.0, -50.0, 70.0}};
         s.grip[1].name = "other", s.grip[1].box = {{40.0, -70.0, 70.0, 70.0}};
       },
       "half", "grip 'one' has none like it opposite"},
      {"grips of unequal travel",
       [](Scene& s) {
         s.grip = {grip_at("left", 1.0), grip_at("right", 2.0)};
       },
       "half", "grips 'left' and 'right' differ in travel"},
      {"grip that pulls sideways",
       [](Scene& s) {
         s.grip = {grip_at("top", 1.0), grip_at("bottom", 1.0)};
         for (auto& g : s.grip) g.direction = {{1.0, 0.0, 0.0}};
       },
       "half", "grip 'top' pulls across it"},
      {"grips that let different things go",
       [](Scene& s) {
         s.grip = {grip_at("left", 1.0), grip_at("right", 1.0)};
         s.grip[0].free = {Component::y};
       },
       "half", "differ in travel or freedom"},
      {"yarns at 45 deg of different families",
       [](Scene& s) {
         s.fabric.material = "twintex-tw";
         s.blank.yarn_angle = 45.0;
         s.blank.coarsening = {5.1, 2.44};  // equal spacing, different yarns
       },
       "none", "tonne, its mirror image"},
      {"yarns at 45 deg of different spacing",
       [](Scene& s) {
         s.blank.yarn_angle = 45.0, s.blank.coarsening = {3.0, 2.0};
       },
       "none", "it swaps warp and weft"},
      {"cells that bend unequally, at 45 deg",
       [](Scene& s) {
         s.blank.yarn_angle = 45.0;
         s.model.cell = CellElement::rotation_free;
         s.model.cell_bending = {{30.0, 40.0, 20.0}};
       },
       "none", "along which the cells bend differently"},
      {"shells", [](Scene& s) { s.model.cell = CellElement::shell; }, "none", "shell cells have no mirror planes"},
      {"side frames at 45 deg",
       [](Scene& s) { s.blank.yarn_angle = 45.0, s.model.formulation = Formulation::side_frame; }, "none",
       "the side frame follows the warp"},
      {"triangles",
       [](Scene& s) {
         s.tools[2].shape = ToolShape::triangles;
         s.tools[2].file = write_tetrahedron();
       },
       "none", "is made of triangles"},
  };
  for (const auto& change : changes) {
    Scene scene = drawing();
    if (std::string(change.name).find("grip") != std::string::npos) scene.tools.clear();
    change.make(scene);
    const Symmetry found = symmetry_of(scene);
    EXPECT_EQ(found.word(), change.word) << change.name << ": " << describe(found);
    EXPECT_NE(describe(found).find(change.why), std::string::npos) << change.name << ": " << describe(found);
  }
}

TEST(Symmetry, WhatDoesNotBreakItIsNot) {
  const std::vector<std::pair<const char*, std::function<void(Scene&)>>> changes = {
      {"yarns at 90 deg", [](Scene& s) { s.blank.yarn_angle = 90.0; }},
      {"balanced yarns at 45 deg", [](Scene& s) { s.blank.yarn_angle = 45.0; }},
      {"planes midway between lines",
       [](Scene& s) {
         s.blank.phase = {0.5, 0.5};
       }},
      {"unequal coarsening",
       [](Scene& s) {
         s.blank.coarsening = {3.0, 2.0};
       }},
      {"a blank turned and elsewhere",
       [](Scene& s) {
         s.blank.orientation = 30.0, s.blank.position = {7.0, -3.0, 1.0};
       }},
      {"gravity downwards",
       [](Scene& s) {
         s.analysis.gravity = {0.0, 0.0, -9810.0};
       }},
      {"a bar across",
       [](Scene& s) {
         s.tools[2].shape = ToolShape::cylinder;
         s.tools[2].axis = {1.0, 0.0, 0.0};
         s.tools[2].position = {{5.0, 0.0, 20.25}};
       }},
      {"a resting tool that points sideways",
       [](Scene& s) {
         s.tools[1].direction = {{1.0, 0.0, 0.0}};
       }},
      {"boxes alike",
       [](Scene& s) {
         s.tools.clear();
         s.grip = {grip_at("", 1.0), grip_at("", 1.0)};
         s.grip[0].name = "one", s.grip[0].box = {{-70.0, -70.0, -50.0, 70.0}};
         s.grip[1].name = "other", s.grip[1].box = {{50.0, -70.0, 70.0, 70.0}};
         s.grip[0].direction = {{-1.0, 0.0, 0.0}};
         s.grip[1].direction = {{1.0, 0.0, 0.0}};
       }},
      {"biaxial pull",
       [](Scene& s) {
         s.tools.clear();
         s.grip = {grip_at("left", 1.0), grip_at("right", 1.0), grip_at("bottom", 0.0), grip_at("top", 0.0)};
       }},
  };
  for (const auto& [name, change] : changes) {
    Scene scene = drawing();
    change(scene);
    const Symmetry found = symmetry_of(scene);
    EXPECT_EQ(found.word(), "quarter") << name << ": " << describe(found);
  }
}

TEST(Symmetry, AskedForInVainIsAnErrorThatNamesTheFirstThingInTheWay) {
  Scene scene = drawing();
  scene.tools[2].position = {{0.1, 0.0, 20.25}};
  scene.model.symmetry = SymmetryUse::half;
  EXPECT_EQ(symmetry_of(scene).word(), "half");
  scene.model.symmetry = SymmetryUse::quarter;
  try {
    (void)symmetry_of(scene);
    FAIL() << "no quarter, and no complaint";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "model.symmetry: the scene is no quarter: plane x = 0 of the blank: tool 'punch' stands to one side of "
        "it or leans across it; use \"auto\"");
  }
  scene.analysis.perturbation = 0.1;
  scene.model.symmetry = SymmetryUse::half;
  EXPECT_THROW((void)symmetry_of(scene), InputError);
  scene.model.symmetry = SymmetryUse::none;
  EXPECT_EQ(symmetry_of(scene).word(), "none");
}

TEST(Symmetry, KeyTakesAPlainFalse) {
  const std::string file = std::string(WEAVEFORM_SOURCE_DIR) + "/examples/hemisphere_pw.toml";
  EXPECT_EQ(read_scene(file, {}).model.symmetry, SymmetryUse::automatic);
  EXPECT_EQ(read_scene(file, {"model.symmetry=false"}).model.symmetry, SymmetryUse::none);
  EXPECT_EQ(read_scene(file, {"model.symmetry=quarter"}).model.symmetry, SymmetryUse::quarter);
  try {
    (void)read_scene(file, {"model.symmetry=true"});
    FAIL() << "true means nothing here";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'symmetry' is true; it must be one of 'auto'"), std::string::npos)
        << error.what();
  }
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double yarn_volume(const MeshYarns& yarns) {
  double volume = 0.0;
  for (std::size_t e = 0; e < yarns.section.size(); ++e) volume += yarns.section[e] * yarns.rest_length[e];
  return volume;
}

// Every symmetric animal of the zoo: whatever the planes cut, the parts make the whole.
TEST(SymmetricPart, PartsAddUpToTheWhole) {
  int halves = 0, quarters = 0;
  for (const auto& animal : lattice_zoo::zoo()) {
    const Mesh whole = build_mesh(animal.scene, animal.card);
    const Symmetry symmetry = find_symmetry(animal.scene, animal.card, whole, make_tools(animal.scene, whole));
    if (symmetry.plane.empty()) continue;
    (symmetry.plane.size() == 1 ? halves : quarters) += 1;
    const SymmetricPart part = cut_part(whole, symmetry);
    const double parts = part.mesh.symmetry.parts();
    EXPECT_NEAR(parts * sum(part.mesh.nodes.mass), sum(whole.nodes.mass), 1e-12 * sum(whole.nodes.mass)) << animal.name;
    EXPECT_NEAR(parts * sum(part.mesh.cells.area), sum(whole.cells.area), 1e-12 * sum(whole.cells.area)) << animal.name;
    EXPECT_NEAR(parts * yarn_volume(part.mesh.yarns), yarn_volume(whole.yarns), 1e-12 * yarn_volume(whole.yarns))
        << animal.name;
    EXPECT_EQ(unfold(part, whole, part.mesh.nodes.position), whole.nodes.position) << animal.name;
    EXPECT_LT(part.mesh.node_count(), whole.node_count()) << animal.name;
  }
  EXPECT_GE(halves, 2);
  EXPECT_GE(quarters, 20);
}

TEST(SymmetricPart, UnfoldedDisplacementsAreMirrored) {
  Scene scene = drawing();
  scene.blank.phase = {0.5, 0.0};
  const Card card = load_card(scene.fabric.material);
  const Mesh whole = build_mesh(scene, card);
  const SymmetricPart part = cut_part(whole, find_symmetry(scene, card, whole, make_tools(scene, whole)));
  // even in the one coordinate, odd in the other, as a field mirrored at x = 0 and y = 0 is
  const auto moved = [](const std::array<double, 3>& x) {
    return std::array<double, 3>{x[0] * (1.1 + 1e-4 * x[1] * x[1]), x[1] * (0.9 + 1e-4 * x[0] * x[0]),
                                 x[0] * x[0] + x[2]};
  };
  std::vector<std::array<double, 3>> position;
  for (const auto& x : part.mesh.nodes.position) position.push_back(moved(x));
  const auto unfolded = unfold(part, whole, position);
  for (int n = 0; n < whole.node_count(); ++n)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(unfolded[n][c], moved(whole.nodes.position[n])[c], 1e-9) << "node " << n;
}

}  // namespace
}  // namespace weaveform
