// Scene files: round trip, defaults, overrides, paths, reference.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "core/error.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/taken.hpp"
#include "tests/support/temporary_folder.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

const std::string two_grips = R"([blank]
size = [100, 200]
[[grip]]
name = "bottom"
edge = "bottom"
[[grip]]
name = "top"
edge = "top"
travel = 30
)";

// A scene in which no key has its default.
Scene unusual_scene() {
  Scene scene;
  scene.file = "s.toml";
  scene.fabric.material = "cards/a \"b\" \\ c.toml";
  scene.fabric.face = FabricFace::down;
  scene.blank = {.shape = BlankShape::rectangle,
                 .size = {0.1, 1e5 / 3},
                 .yarn_angle = -12.5,
                 .coarsening = {0.5, 2.25},
                 .phase = {0.25, -1.0 / 3},
                 .corners = {},
                 .outline = "",
                 .outline_unit = {},
                 .outline_layers = {},
                 .arm_width = {},
                 .on_roll = {},
                 .fit = LineFit::none,
                 .orientation = 30,
                 .position = {1, -2, 3e-7}};
  scene.model = {.yarn = YarnElement::beam,
                 .cell = CellElement::shell,
                 .formulation = Formulation::contravariant,
                 .thickness = Thickness::constant,
                 .section = Section::constant,
                 .yarn_law = YarnLaw::slack,
                 .slack = 0.1 / 3,
                 .yarn_stiffness_scale = 0.01,
                 .compression_modulus = 2.5,
                 .symmetry = SymmetryUse::half,
                 .yarn_bending = {{3.5, 1.0 / 7}},
                 .cell_bending = {{1, 2, 0.3}},
                 .bending_friction = {{0.04, 1.0 / 900}},
                 .transverse_shear = 0.7};
  scene.grip = {{.name = "held",
                 .edge = BlankEdge::left,
                 .box = {},
                 .travel = 0,
                 .direction = {},
                 .free = {Component::x, Component::z}},
                {.name = "pulled",
                 .edge = {},
                 .box = {{-1, -2, 3, 4.5}},
                 .travel = -12.75,
                 .direction = {{0.6, 0, 0.8}},
                 .free = {}}};
  scene.analysis = {.duration = 0.1 + 0.2,  // 0.30000000000000004: needs all 17 digits
                    .loading_speed = {},
                    .inertia = 0.03,
                    .step_factor = 0.5,
                    .step_bound = StepBound::reached,
                    .precision = Precision::single_precision,
                    .bending_every = 3,
                    .mass_scale = 2.5,
                    .contact_stiffness = 0.125,
                    .step_check = false,
                    .damping = 7,
                    .energy_limit = 0.01,
                    .perturbation = 1e-3,
                    .perturbation_seed = 42,
                    .most_hours = 36.5,
                    .most_memory = 4.5};
  scene.frame = {.length = 300.5,
                 .travel = -7,
                 .grip = "corner",
                 .rigid = true,
                 .section = 12,
                 .modulus = 1e5,
                 .density = 1e-9,
                 .mass_scale = 0.5};
  scene.accuracy = {.force = 0.03, .angle = 2.5};
  scene.taken = {{"blank.coarsening", "[0.5, 2.25]", "a \"reason\"", "something"}};
  scene.output = {.frames = 3, .history = 17, .contour_step = 2.5};
  scene.measure = {{.name = "a", .box = {{-1, -1, 1, 1}}, .relative_box = {}},
                   {.name = "b", .box = {}, .relative_box = {{-0.1, -0.1, 0.1, 0.1}}}};
  return scene;
}

TEST(Scene, EmptyFileIsTheDefaultScene) {
  Scene expected;
  expected.file = "s.toml";
  EXPECT_EQ(read_scene_text("", "s.toml"), expected);
}

TEST(Scene, EchoReadsBackToTheSameBits) {
  Scene plain;
  plain.file = "s.toml";
  for (const Scene& scene : {plain, unusual_scene()}) {
    EXPECT_EQ(read_scene_text(scene_to_toml(scene), "s.toml"), scene) << scene_to_toml(scene);
  }
}

TEST(Scene, OpenKeysAreEchoedAsAuto) {
  const std::string text = "[blank]\ncoarsening = \"auto\"\n[model]\nyarn = \"auto\"\ncell = \"auto\"\n";
  const Scene scene = read_scene_text(text, "s.toml");
  EXPECT_TRUE(scene.blank.coarsening_open && scene.model.yarn_open && scene.model.cell_open);
  EXPECT_EQ(read_scene_text(scene_to_toml(scene), "s.toml"), scene) << scene_to_toml(scene);
  const Scene given = read_scene_text(text, "s.toml", {"blank.coarsening=3", "model.yarn=beam", "model.cell=shell"});
  EXPECT_FALSE(given.blank.coarsening_open || given.model.yarn_open || given.model.cell_open);
  EXPECT_EQ(given.blank.coarsening, (std::array<double, 2>{3.0, 3.0}));
}

TEST(Scene, EchoHoldsADrawingsUnitAndLayers) {
  const std::string text =
      "[fabric]\nmaterial = \"twintex-pw\"\n[blank]\nshape = \"file\"\noutline = \"/plate.dxf\"\noutline_unit = "
      "\"inch\"\n"
      "outline_layers = [\"CUT\", \"0\"]\n";
  const Scene scene = read_scene_text(text, "s.toml");
  EXPECT_EQ(scene.blank.outline_layers, (std::vector<std::string>{"CUT", "0"}));
  EXPECT_EQ(read_scene_text(scene_to_toml(scene), "s.toml"), scene) << scene_to_toml(scene);
}

TEST(Scene, EchoHoldsEveryKeyWithAValue) {
  const std::string echo = scene_to_toml(unusual_scene());
  for (const auto& key : scene_keys()) {
    if (key.table.rfind("tools", 0) == 0) continue;  // a tool echoes the keys of its own shape
    if (key.name == "corners" || key.name.starts_with("outline") || key.name == "on_roll") continue;  // of other blanks
    if (key.table == "drape") continue;  // not together with a frame; drape_test.cpp
    if (key.table == "ply" || key.table == "stack" || key.name == "plies" || key.name == "ply")
      continue;  // not together with a frame; stack_scene_test.cpp
    EXPECT_NE(echo.find("\n" + key.name + " = "), std::string::npos) << key.name;
  }
}

TEST(Scene, ReferenceHoldsEveryKeyWithItsMeaning) {
  const std::string page = scene_reference_markdown();
  for (const auto& key : scene_keys()) {
    EXPECT_NE(page.find("| `" + key.name + "` |"), std::string::npos) << key.name;
    EXPECT_FALSE(key.doc.empty()) << key.name;
    EXPECT_FALSE(key.type.empty()) << key.name;
  }
  EXPECT_NE(page.find("| `size` | 2 numbers | mm | `[115, 230]` | > 0 and <= 100000 mm |"), std::string::npos);
}

TEST(Scene, KeysAreListedOnce) {
  std::set<std::string> seen;
  for (const auto& key : scene_keys()) EXPECT_TRUE(seen.insert(key.table + "." + key.name).second) << key.name;
}

TEST(Scene, WholeNumbersServeAsNumbers) {
  EXPECT_EQ(read_scene_text("[blank]\nyarn_angle = 30\n", "s.toml").blank.yarn_angle, 30.0);
}

TEST(Scene, CoarseningIsOneNumberOrTwo) {
  EXPECT_EQ(read_scene_text("[blank]\ncoarsening = 2\n", "s.toml").blank.coarsening, (std::array{2.0, 2.0}));
  EXPECT_EQ(read_scene_text("[blank]\ncoarsening = [1, 0.5]\n", "s.toml").blank.coarsening, (std::array{1.0, 0.5}));
}

TEST(Scene, AutoMeansNoValue) {
  const Scene scene = read_scene_text("[analysis]\nduration = \"auto\"\ndamping = 3\n", "s.toml");
  EXPECT_FALSE(scene.analysis.duration.has_value());
  EXPECT_EQ(scene.analysis.damping, 3.0);
  EXPECT_NE(scene_to_toml(scene).find("duration = \"auto\""), std::string::npos);
}

// Left out, the duration of tools is the program's quick one; "auto" in so many words is one by the share of inertia.
TEST(Scene, AutoWrittenOutAsksForAShareOfInertiaWhereToolsTravel) {
  const std::string punch = "[tools.punch]\nshape = \"sphere\"\nradius = 10\ntravel = 5\n[analysis]\n";
  const auto inertia = [&](const std::string& analysis) {
    const Scene scene = read_scene_text(punch + analysis, "s.toml");
    EXPECT_EQ(read_scene_text(scene_to_toml(scene), "s.toml"), scene) << analysis;
    return scene.analysis.inertia;
  };
  EXPECT_EQ(inertia("duration = \"auto\"\n"), inertia_of_auto);
  EXPECT_EQ(inertia("duration = \"auto\"\ninertia = 0.03\n"), 0.03);
  EXPECT_EQ(inertia("duration = \"auto\"\ninertia = \"auto\"\n"), std::nullopt);
  EXPECT_EQ(inertia(""), std::nullopt);
  EXPECT_EQ(inertia("duration = 0.1\n"), std::nullopt);
  EXPECT_EQ(read_scene_text("[analysis]\nduration = \"auto\"\n", "s.toml").analysis.inertia, std::nullopt);
}

TEST(Override, ReplacesAddsAndFindsByNameAndIndex) {
  const Scene scene =
      read_scene_text(two_grips, "s.toml",
                      {"blank.size=[50,60]", "output.frames = 3", "grip.top.travel=40", "grip.0.travel=-1.5",
                       "fabric.material=twintex-tw", "model.formulation=\"contravariant\"", "analysis.duration=auto"});
  EXPECT_EQ(scene.blank.size, (std::array{50.0, 60.0}));
  EXPECT_EQ(scene.output.frames, 3);
  EXPECT_EQ(scene.grip[1].travel, 40.0);
  EXPECT_EQ(scene.grip[0].travel, -1.5);
  EXPECT_EQ(scene.fabric.material, "twintex-tw");
  EXPECT_EQ(scene.model.formulation, Formulation::contravariant);
}

TEST(Override, LastOneWins) {
  EXPECT_EQ(read_scene_text("", "s.toml", {"blank.yarn_angle=1", "blank.yarn_angle=2"}).blank.yarn_angle, 2.0);
}

TEST(Override, ReplacesAMistakeOfTheFile) {
  EXPECT_EQ(read_scene_text("[blank]\nsize = 3\n", "s.toml", {"blank.size=[1,2]"}).blank.size, (std::array{1.0, 2.0}));
}

TEST(ScenePath, RelativeCardBecomesAbsoluteBesideTheScene) {
  Scene scene;
  scene.file = "/data/run/scene.toml";
  scene.fabric.material = "../cards/mine.toml";
  EXPECT_EQ(with_absolute_paths(scene).fabric.material, "/data/cards/mine.toml");
  scene.fabric.material = "/elsewhere/mine.toml";
  EXPECT_EQ(with_absolute_paths(scene).fabric.material, "/elsewhere/mine.toml");
  scene.fabric.material = "twintex-pw";
  EXPECT_EQ(with_absolute_paths(scene), scene);
}

TEST(SceneFile, IsReadFromDiskAndRemembered) {
  const fs::path file = test::scratch_file("scene.toml");
  std::ofstream(file) << two_grips;
  const Scene scene = read_scene(file);
  EXPECT_EQ(scene.file, file.string());
  EXPECT_EQ(scene.grip.size(), 2U);
  fs::remove(file);
  EXPECT_THROW((void)read_scene(file), FileError);
  EXPECT_THROW((void)read_scene(file.parent_path()), FileError);
}

}  // namespace
}  // namespace weaveform
