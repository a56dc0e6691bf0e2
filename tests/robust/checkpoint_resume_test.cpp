// A run that is stopped and goes on, again and again, ends with the bits of one that never stopped, whatever the scene
// has: contact, bending, histories, symmetry, ties, weight, other numbers of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/scene/reader.hpp"
#include "solver/solve.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

struct Case {
  std::string name;
  std::string scene;
};

// A patch that is pulled askew, so that every cell shears and yarns stretch.
std::string pulled(const std::string& more, const std::string& blank = "coarsening = 5\n") {
  return "[blank]\nsize = [115.0, 161.0]\nyarn_angle = 45.0\n" + blank +
         "[[grip]]\nname = \"bottom\"\nedge = \"bottom\"\n[[grip]]\nname = \"top\"\nedge = \"top\"\ntravel = 12.0\n"
         "[output]\nframes = 3\nhistory = 60\n" +
         more;
}

std::string pressed(const std::string& punch, const std::string& more) {
  return "[blank]\nsize = [120.0, 120.0]\nyarn_angle = 0.0\ncoarsening = 5\n"
         "[tools.binder]\nshape = \"ring\"\naxis = [0, 0, -1]\nopening_radius = 30\nforce = 50\nfriction = 0.3\n"
         "[tools.die]\nshape = \"ring\"\nopening_radius = 30\nfillet_radius = 8\nfriction = 0.3\n"
         "[tools.punch]\ntravel = 6.0\nfriction = 0.2\n" +
         punch + "[output]\nframes = 3\nhistory = 60\n" + more;
}

const std::string sphere = "shape = \"sphere\"\nradius = 20\n";
const std::string fast = "loading_speed = 600\nenergy_limit = 1.0\n";

const std::vector<Case> cases = {
    {"truss", pulled("")},
    {"whole", pulled("[model]\nsymmetry = \"none\"\n")},
    {"incremental", pulled("[model]\nformulation = \"incremental\"\n")},
    {"side_frame", pulled("[model]\nformulation = \"side-frame\"\n")},
    {"contravariant", pulled("[model]\nformulation = \"contravariant\"\n")},
    {"beam", pulled("[model]\nyarn = \"beam\"\n[analysis]\nbending_every = 7\n")},
    {"rotation_free", pulled("[model]\ncell = \"rotation-free\"\n[analysis]\ngravity = [0, 0, -9810]\n")},
    {"shell", pulled("[model]\ncell = \"shell\"\n[analysis]\ngravity = [0, 0, -9810]\n")},
    {"beam_friction", pulled("[model]\nyarn = \"beam\"\nbending_friction = [2.0, 0.002]\n")},
    {"shell_friction",
     pulled("[model]\ncell = \"shell\"\nbending_friction = [2.0, 0.002]\n[analysis]\ngravity = [0, 0, "
            "-9810]\n")},
    {"seatbelt", pulled("[model]\nyarn = \"seatbelt\"\npartner = \"compression\"\n")},
    {"reached", pulled("[analysis]\nstep_bound = \"reached\"\n")},
    {"single", pulled("[analysis]\nprecision = \"single\"\n")},
    {"mass_scaled", pulled("[analysis]\nmass_scale = 3.0\n")},
    {"perturbed", pulled("[analysis]\nperturbation = 0.05\n")},
    {"deformable_frame",
     "[blank]\nsize = [60, 60]\nyarn_angle = 0\norientation = 45\ncoarsening = 4\n[model]\nyarn_law = \"linear\"\n"
     "[frame]\nlength = 108\ntravel = 10\nmass_scale = 0.05\n[analysis]\nduration = 0.02\nenergy_limit = 1.0\n"
     "[output]\nframes = 3\nhistory = 60\n"},
    {"rigid_frame",
     "[blank]\nsize = [60, 60]\nyarn_angle = 0\norientation = 45\ncoarsening = 4\n"
     "[frame]\nlength = 108\ntravel = 10\nrigid = true\n[analysis]\nduration = 0.02\nenergy_limit = 1.0\n"
     "[output]\nframes = 3\nhistory = 60\n"},
    {"pressed_quarter", pressed(sphere, "[analysis]\n" + fast)},
    {"pressed_shell", pressed(sphere, "[model]\ncell = \"shell\"\nsymmetry = \"none\"\n[analysis]\n" + fast)},
    {"pressed_by_triangles", pressed("shape = \"triangles\"\nfile = \"punch.stl\"\ndirection = [0, 0, -1]\n"
                                     "position = [0.3, 0.2, 1.0]\n",
                                     "[analysis]\n" + fast)},
    {"pressed_incremental",
     pressed(sphere, "[model]\nformulation = \"incremental\"\nsymmetry = \"half\"\n[analysis]\n" + fast)},
    {"draped",
     "[blank]\nsize = [60.0, 60.0]\nyarn_angle = 0.0\ncoarsening = 3\nfit = \"none\"\n[tools.dome]\nshape = "
     "\"sphere\"\n"
     "axis = [0, 0, -1]\nradius = 60\nposition = [0, 0, -60]\n[drape]\ntool = \"dome\"\n[[grip]]\nname = \"left\"\n"
     "edge = \"left\"\n[model]\nformulation = \"incremental\"\n[analysis]\nduration = 0.01\nenergy_limit = 1.0\n"
     "[output]\nframes = 3\nhistory = 60\n"},
};

// A pyramid that looks down.
const std::string punch_stl = [] {
  const std::string corner[4] = {"-30 -30 10", "30 -30 10", "30 30 10", "-30 30 10"};
  std::string text = "solid punch\n";
  const auto face = [&](const std::string& a, const std::string& b, const std::string& c) {
    text += "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c + "\nendloop\nendfacet\n";
  };
  for (int k = 0; k < 4; ++k) face(corner[(k + 1) % 4], corner[k], "0 0 0");
  face(corner[0], corner[1], corner[2]);
  face(corner[0], corner[2], corner[3]);
  return text + "endsolid punch\n";
}();

// Without what wall clocks and threads decide.
nlohmann::json lasting(const fs::path& file) {
  nlohmann::json json = nlohmann::json::parse(test::read_text(file));
  for (const char* name : {"wall_s", "checkpoint_wall_s", "contact_wall_s", "cell_steps_per_s", "threads"})
    json.erase(name);
  return json;
}

class Resume : public testing::TestWithParam<Case> {
protected:
  void SetUp() override {
    test::write_text(punch_stl, folder_.path() / "punch.stl");
    scene_ = read_scene_text(GetParam().scene, (folder_.path() / "scene.toml").string());
    card_ = load_card(scene_.fabric.material);
    mesh_ = build_mesh(scene_, card_);
  }
  SolveResult run(const std::string& to, const SolveOptions& how) const {
    return solve(mesh_, scene_, card_, folder_.path() / to, how);
  }
  void stop_at(long step, int threads) {
    EXPECT_THROW((void)run("stopped", {.threads = threads, .resume = resume_, .quiet = true, .stop_at_step = step}),
                 Interrupted);
    EXPECT_TRUE(has_checkpoint(folder_.path() / "stopped"));
    resume_ = true;
  }
  void expect_same(const std::string& file) const {
    EXPECT_TRUE(test::read_text(folder_.path() / "whole" / file) == test::read_text(folder_.path() / "stopped" / file))
        << file;
  }

  test::TemporaryFolder folder_;
  Scene scene_;
  Card card_;
  Mesh mesh_;
  bool resume_ = false;
};

TEST_P(Resume, EndsWithTheBitsOfTheRunThatNeverStopped) {
  const long steps = run("whole", {.threads = 1, .quiet = true}).statistics.steps;
  ASSERT_GT(steps, 100);
  stop_at(1, 1);
  stop_at(2, 2);
  stop_at(steps / 4, 1);
  // one of these is followed by a row, another by a look at the step, whatever their spacing
  const long every = std::max(1L, steps / 400);
  for (long step = steps / 2; step < steps / 2 + 8 * every; step += every) stop_at(step, step % 2 == 0 ? 1 : 2);
  stop_at(std::max(steps / 500 * 500, steps / 2 + 9 * every), 1);  // and the last look at the step
  (void)run("stopped", {.threads = 1, .resume = true, .quiet = true});

  for (const std::string file : {"history.csv", "result.pvd", "frames/frame_0000.vtu", "frames/frame_0001.vtu",
                                 "frames/frame_0002.vtu", "frames/frame_0003.vtu"})
    expect_same(file);
  EXPECT_EQ(lasting(folder_.path() / "whole/solve.json"), lasting(folder_.path() / "stopped/solve.json"));
  EXPECT_FALSE(has_checkpoint(folder_.path() / "stopped")) << "a run that ended well leaves none";
  EXPECT_TRUE(is_finished(folder_.path() / "stopped"));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Resume, testing::ValuesIn(cases), [](const auto& one) { return one.param.name; });

// The run beside a perturbed one takes as long again, and is as easily killed.
TEST(ResumeOfAPerturbedRun, GoesOnInTheCleanRunBesideIt) {
  const test::TemporaryFolder folder;
  const Scene scene =
      read_scene_text(pulled("[model]\nsymmetry = \"none\"\n[analysis]\nperturbation = 0.05\n"), "scene");
  const Card card = load_card(scene.fabric.material);
  const Mesh mesh = build_mesh(scene, card);
  Scene clean = scene;
  clean.analysis.perturbation = 0.0;
  const auto whole = solve(mesh, scene, card, folder.path() / "whole", {.threads = 1, .quiet = true}).statistics;
  // stopped before its last step, as when killed in the clean run
  EXPECT_THROW((void)solve(mesh, scene, card, folder.path() / "stopped",
                           {.threads = 1, .quiet = true, .stop_at_step = whole.steps}),
               Interrupted);
  // the clean run's own checkpoint
  SolveOptions half{.threads = 1, .quiet = true, .stop_at_step = whole.steps / 2};
  half.checkpoint_file = folder.path() / "stopped/checkpoint_clean.bin";
  EXPECT_THROW((void)solve(mesh, clean, card, {}, half), Interrupted);
  const auto resumed =
      solve(mesh, scene, card, folder.path() / "stopped", {.threads = 1, .resume = true, .quiet = true}).statistics;
  EXPECT_EQ(resumed.perturbation_distance_mm, whole.perturbation_distance_mm);
  EXPECT_FALSE(fs::exists(folder.path() / "stopped/checkpoint_clean.bin"));
}

}  // namespace
}  // namespace weaveform
