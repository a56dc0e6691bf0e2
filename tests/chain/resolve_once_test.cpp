// A run works out once what its scene leads to: tools from CAD are meshed once, and every stage takes the same ones.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "app/stages/checked_model.hpp"
#include "app/stages/stages.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/tools/geo_script.hpp"
#include "mesher/tools/gmsh_session.hpp"
#include "solver/analysis/identity.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

// Counts the readings of each CAD file. Trusted scripts are read anew whenever they are asked for: nothing hides how
// often that is.
class CountedReadings {
public:
  CountedReadings() {
    trust_geo_scripts(true);
    watch_cad_reading([this](const fs::path& file, double fraction) {
      if (fraction >= 1.0) ++count_[file.filename().string()];
    });
  }
  ~CountedReadings() {
    watch_cad_reading({});
    trust_geo_scripts(false);
  }
  CountedReadings(const CountedReadings&) = delete;
  CountedReadings& operator=(const CountedReadings&) = delete;
  [[nodiscard]] const std::map<std::string, int>& count() const { return count_; }

private:
  std::map<std::string, int> count_;
};

const fs::path box = fs::path(WEAVEFORM_SOURCE_DIR) / "examples/cad_box.toml";
const std::vector<std::string> coarse = {"blank.coarsening=8", "analysis.duration=0.008", "output.frames=1"};
const std::map<std::string, int> once = {{"box_die.geo", 1}, {"box_punch.geo", 1}};

TEST(ResolveOnce, ARunFromSceneToAnswersMeshesEachToolOnce) {
  const test::TemporaryFolder folder;
  const CountedReadings readings;
  Resolved model = checked_model(box, coarse, false, Look::with_first_step);
  (void)require_room(model, folder.path(), false);
  (void)early_warnings(model);
  const TriangleSurface* punch = model.tools.back().surface.get();
  ResultFolder result = write_model(std::move(model), folder.path(), {});
  solve_folder(result, {.threads = 1, .quiet = true}, {}, false);
  (void)post_process(result);
  EXPECT_EQ(readings.count(), once);
  EXPECT_EQ(result.model().tools.back().surface.get(), punch);
}

TEST(ResolveOnce, AFolderIsResolvedOnceByEachProcessAndOnlyForWhoNeedsTheTools) {
  const test::TemporaryFolder folder;
  Resolved model = checked_model(box, coarse, false, Look::for_first_complaint);
  solve_folder(*std::make_unique<ResultFolder>(write_model(std::move(model), folder.path(), {})),
               {.threads = 1, .quiet = true}, {}, true);
  const CountedReadings readings;
  ResultFolder later(folder.path());
  EXPECT_GT(later.mesh().cells.size(), 0);
  EXPECT_FALSE(later.history().row.empty());
  EXPECT_TRUE(readings.count().empty()) << "a comparison or an export of directions needs no tool";
  (void)post_process(later);
  (void)later.model();
  EXPECT_EQ(readings.count(), once);
}

TEST(ResolveOnce, WhatTheDiskGivesBackIsWhatWasResolved) {
  const test::TemporaryFolder folder;
  const Resolved model = checked_model(fs::path(WEAVEFORM_SOURCE_DIR) / "examples/drape_hemisphere.toml",
                                       {"blank.coarsening=6"}, false, Look::for_first_complaint);
  ResultFolder kept = write_model(model, folder.path(), {});
  ResultFolder read(folder.path());
  EXPECT_TRUE(differences(identity_of(kept.model(), "x"), identity_of(read.model(), "x")).empty());
  EXPECT_EQ(read.model().symmetry.word(), kept.model().symmetry.word());
  EXPECT_EQ(scene_to_toml(read.scene()), scene_to_toml(kept.scene()));
}

// Each tool complains for itself, whatever the others do.
TEST(ResolveOnce, EveryToolThatCannotBeMadeIsNamed) {
  const test::TemporaryFolder folder;
  for (const char* name : {"one.stl", "two.stl"})
    test::write_text("solid nothing\nendsolid nothing\n", folder.path() / name);
  test::write_text(test::tiny_scene() + R"(
[tools.first]
shape = "triangles"
file = "one.stl"
[tools.second]
shape = "triangles"
file = "two.stl"
)",
                   folder.path() / "scene.toml");
  try {
    (void)checked_model(folder.path() / "scene.toml", {}, false, Look::with_first_step);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.complaints().size(), 2U) << error.what();
  }
}

}  // namespace
}  // namespace weaveform
