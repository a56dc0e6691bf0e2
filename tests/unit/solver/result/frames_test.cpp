#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "core/error.hpp"
#include "solver/result/result.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/solver/lattice/trellis.hpp"

namespace weaveform {
namespace {

const std::vector<std::string> arrays = {
    "shear_angle_deg", "family",          "warp_direction", "weft_direction", "yarn_strain",       "yarn_force_N",
    "folded",          "displacement_mm", "TimeValue",      "thickness_mm",   "areal_weight_ratio"};

// Angles and positions with no short decimal form, so that a loss of bits would show.
Fields uneven_fields(const Mesh& mesh, double time) {
  std::vector<Vec3> position = test::trellis(mesh, 0.4 + time);
  for (std::size_t n = 0; n < position.size(); ++n) position[n][2] = std::sin(1.0 + static_cast<double>(n)) / 3.0;
  return compute_fields(mesh, test::small_card(), {}, time, position);
}

TEST(Frames, PositionsComeBackBitForBit) {
  const test::TemporaryFolder folder;
  const Mesh mesh = test::lattice(7, 5, 4.92);
  const Fields fields = uneven_fields(mesh, 1.0 / 3.0);
  FrameWriter writer(folder.path(), mesh);
  writer.write(fields);
  writer.settle();
  EXPECT_EQ(read_frame_positions(folder.path() / "frames/frame_0000.vtu"), fields.position);
}

TEST(Frames, EveryArrayIsThereAndHoldsNumbersOnly) {
  const test::TemporaryFolder folder;
  const Mesh mesh = test::lattice(4, 3, 5.0);
  std::vector<Vec3> position = mesh.nodes.position;
  // One cell collapsed to a point: its directions are undefined, and still nothing in the file may be NaN.
  for (const int node : {0, 1, 4, 5}) position[node] = {1.0, 1.0, 0.0};
  FrameWriter writer(folder.path(), mesh);
  Fields fields = compute_fields(mesh, test::small_card(), {}, 0.0, position);
  std::replace_if(
      fields.yarn_force.begin(), fields.yarn_force.end(), [](double f) { return !std::isfinite(f); }, 0.0);
  std::replace_if(
      fields.yarn_strain.begin(), fields.yarn_strain.end(), [](double e) { return !std::isfinite(e); }, 0.0);
  writer.write(fields);
  writer.settle();
  for (const std::string& name : arrays)
    for (const double value : read_frame_array(folder.path() / "frames/frame_0000.vtu", name))
      EXPECT_TRUE(std::isfinite(value)) << name;
}

TEST(Frames, LinesStandBeforePolygonsInTheMeshOrder) {
  const test::TemporaryFolder folder;
  const Mesh mesh = test::lattice(3, 3, 5.0);
  const Fields fields = uneven_fields(mesh, 0.0);
  FrameWriter writer(folder.path(), mesh);
  writer.write(fields);
  writer.settle();
  const auto frame = folder.path() / "frames/frame_0000.vtu";
  const std::vector<double> family = read_frame_array(frame, "family");
  const std::vector<double> strain = read_frame_array(frame, "yarn_strain");
  const std::vector<double> angle = read_frame_array(frame, "shear_angle_deg");
  const std::vector<double> warp = read_frame_array(frame, "warp_direction");
  ASSERT_EQ(family.size(), static_cast<std::size_t>(mesh.yarn_count() + mesh.cells.size()));
  for (int yarn = 0; yarn < mesh.yarn_count(); ++yarn) {
    const bool is_warp = mesh.yarns.family[yarn] == Family::warp;
    EXPECT_EQ(family[yarn], is_warp ? 1.0 : 2.0);
    EXPECT_EQ(strain[yarn], fields.yarn_strain[yarn]);
    const double length = std::hypot(warp[3 * yarn], warp[3 * yarn + 1], warp[3 * yarn + 2]);
    EXPECT_NEAR(length, is_warp ? 1.0 : 0.0, 1e-6);  // single precision
  }
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    EXPECT_EQ(family[mesh.yarn_count() + cell], 0.0);
    EXPECT_DOUBLE_EQ(angle[mesh.yarn_count() + cell], fields.shear_angle[cell] * 180.0 / std::numbers::pi);
  }
}

TEST(Frames, LinesCarryTheMeanAngleOfTheCellsBeside) {
  const test::TemporaryFolder folder;
  const Mesh mesh = test::lattice(3, 2, 5.0);  // two cells, with one weft element between them
  Fields fields = compute_fields(mesh, test::small_card(), {}, 0.0, mesh.nodes.position);
  fields.shear_angle = {0.1, 0.4};
  FrameWriter writer(folder.path(), mesh);
  writer.write(fields);
  writer.settle();
  const std::vector<double> angle = read_frame_array(folder.path() / "frames/frame_0000.vtu", "shear_angle_deg");
  for (int yarn = 0; yarn < mesh.yarn_count(); ++yarn) {
    const double middle =
        0.5 * (mesh.nodes.position[mesh.yarns.node[yarn][0]][0] + mesh.nodes.position[mesh.yarns.node[yarn][1]][0]);
    const double expected = middle < 5.0 ? 0.1 : middle > 5.0 ? 0.4 : 0.25;
    EXPECT_NEAR(angle[yarn], expected * 180.0 / std::numbers::pi, 1e-12) << "yarn " << yarn;
  }
}

TEST(Frames, IndexListsEveryFrameWithItsExactTimeOnceItIsSettled) {
  const test::TemporaryFolder folder;
  const Mesh mesh = test::lattice(3, 3, 5.0);
  FrameWriter writer(folder.path(), mesh);
  const std::vector<double> times = {0.0, 0.1, 1.0 / 3.0};
  for (std::size_t k = 0; k < times.size(); ++k) {
    writer.write(uneven_fields(mesh, times[k]));
    writer.settle();
    const std::vector<FrameFile> frames = list_frames(folder.path());
    ASSERT_EQ(frames.size(), k + 1);
    EXPECT_EQ(frames[k].time, times[k]);
    EXPECT_TRUE(std::filesystem::exists(frames[k].file));
    EXPECT_EQ(read_frame_array(frames[k].file, "TimeValue").at(0), times[k]);
  }
}

TEST(Frames, ResumedRunKeepsTheFramesBeforeItsCheckpointAndANewRunNone) {
  const test::TemporaryFolder folder;
  const Mesh mesh = test::lattice(3, 3, 5.0);
  {
    FrameWriter writer(folder.path(), mesh);
    for (const double time : {0.0, 0.1, 0.2}) writer.write(uneven_fields(mesh, time));
  }
  FrameWriter resumed(folder.path(), mesh, {0.0, 0.1});
  EXPECT_EQ(resumed.count(), 2);
  EXPECT_EQ(list_frames(folder.path()).size(), 2U);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "frames/frame_0002.vtu"));
  resumed.write(uneven_fields(mesh, 0.25));
  resumed.settle();
  EXPECT_EQ(list_frames(folder.path()).back().time, 0.25);
  EXPECT_THROW(FrameWriter(folder.path(), mesh, {0.0, 0.1, 0.25, 0.3}), FileError);
  const FrameWriter anew(folder.path(), mesh);
  EXPECT_EQ(test::files_in(folder.path()), 0);
}

TEST(Frames, FullDiskIsAFileErrorAndLeavesTheLastGoodFrame) {
  const test::TemporaryFolder folder;
  const Mesh mesh = test::lattice(30, 30, 5.0);
  FrameWriter writer(folder.path(), mesh);
  writer.write(uneven_fields(mesh, 0.0));
  writer.settle();
  {
    const test::FullDisk full(4096);
    writer.write(uneven_fields(mesh, 0.1));
    EXPECT_THROW(writer.settle(), FileError);
  }
  EXPECT_EQ(list_frames(folder.path()).size(), 1U);
  EXPECT_EQ(test::files_in(folder.path()), 2);  // result.pvd and one frame; nothing half written
  EXPECT_EQ(read_frame_positions(folder.path() / "frames/frame_0000.vtu"), uneven_fields(mesh, 0.0).position);
}

// A frame is packed while the caller goes on: what it was given may change at once, and its error comes with the next.
TEST(Frames, WhatAFrameWasGivenMayChangeWhileItIsWritten) {
  const test::TemporaryFolder folder;
  const Mesh mesh = test::lattice(60, 60, 5.0);
  FrameWriter writer(folder.path(), mesh);
  Fields fields = uneven_fields(mesh, 0.0);
  const std::vector<Vec3> given = fields.position;
  writer.write(fields);
  fields.position.assign(fields.position.size(), {7.0, 7.0, 7.0});
  writer.settle();
  EXPECT_EQ(read_frame_positions(folder.path() / "frames/frame_0000.vtu"), given);
  {
    const test::FullDisk full(4096);
    writer.write(uneven_fields(mesh, 0.1));
    EXPECT_THROW(writer.write(uneven_fields(mesh, 0.2)), FileError);
  }
}

TEST(Frames, DamagedFilesAreInputErrorsAndMissingOnesFileErrors) {
  const test::TemporaryFolder folder;
  const Mesh mesh = test::lattice(20, 20, 5.0);
  EXPECT_THROW((void)list_frames(folder.path()), FileError);
  EXPECT_THROW((void)read_frame_positions(folder.path() / "frames/frame_0000.vtu"), FileError);
  FrameWriter writer(folder.path(), mesh);
  writer.write(uneven_fields(mesh, 0.0));
  writer.settle();
  const auto frame = folder.path() / "frames/frame_0000.vtu";
  std::filesystem::resize_file(frame, std::filesystem::file_size(frame) / 2);
  EXPECT_THROW((void)read_frame_positions(frame), InputError);
  std::ofstream(folder.path() / "result.pvd") << "<VTKFile><Collection>";
  EXPECT_THROW((void)list_frames(folder.path()), InputError);
}

}  // namespace
}  // namespace weaveform
