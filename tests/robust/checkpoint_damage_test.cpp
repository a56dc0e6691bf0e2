// A damaged checkpoint is an error line, wherever the damage is, and also when somebody mends the check sum.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "core/error.hpp"
#include "core/files/digest.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/scene/reader.hpp"
#include "solver/analysis/checkpoint.hpp"
#include "solver/solve.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/small_checkpoint.hpp"

namespace weaveform {
namespace {

const Identity& identity = test::small_identity;
const CheckpointSizes& sizes = test::small_sizes;

Checkpoint small() {
  Checkpoint c;
  for (auto* field : {&c.state.position, &c.state.velocity, &c.state.force})
    for (auto& component : *field) component.assign(sizes.nodes, 0.25);
  c.state.time = 0.5;
  c.state.step = 100;
  c.step = c.step_before = c.smallest_step = 0.005;
  c.step_set_by = "yarns at node 7";
  for (auto& range : c.reach.allowed) range = {-0.1, 0.1};
  c.force_before = c.displacement_before = {1.0, 2.0};
  c.next_row = 3;
  c.next_frame = 2;
  c.frame_times = {0.0, 0.4};
  c.path.stress = c.path.log_stretch = {0.5, 0.5};
  c.fabric.assign(sizes.fabric, 1.0);
  c.term_memory = {{1.0, 2.0}, {3.0}};
  c.row = {{0.0, 1.0, 2.0, 3.0}, {0.2, 1.0, 2.0, 3.0}};
  c.window.row = 1;
  c.window.impulse.assign(sizes.impulses, 0.0);
  return c;
}

Checkpoint read(const std::string& bytes, CheckSum check = CheckSum::compared) {
  return read_checkpoint(bytes, identity, sizes, "checkpoint.bin", check);
}

TEST(DamagedCheckpoint, IsRefusedWhicheverByteIsTurned) {
  const std::string good = checkpoint_bytes(small(), identity);
  EXPECT_EQ(read(good).state.step, 100);
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const char flip : {'\x01', '\x40', '\x7f'}) {
      std::string bytes = good;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      EXPECT_THROW((void)read(bytes), FileError) << "byte " << at;
    }
}

TEST(DamagedCheckpoint, IsRefusedAtEveryLengthButItsOwn) {
  const std::string good = checkpoint_bytes(small(), identity);
  for (std::size_t length = 0; length < good.size(); ++length)
    EXPECT_THROW((void)read(good.substr(0, length)), FileError) << length;
  EXPECT_THROW((void)read(good + '\0'), FileError);
  EXPECT_THROW((void)read(good + good), FileError);
}

// With the sum out of the way, what is read is either refused or fits the mesh in every length and range.
TEST(DamagedCheckpoint, FitsTheMeshOrIsRefusedWithoutTheSum) {
  const std::string good = checkpoint_bytes(small(), identity);
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const char flip : {'\x01', '\x10', '\x40', '\x7f'}) {
      std::string bytes = good;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      try {
        const Checkpoint c = read(bytes, CheckSum::ignored);
        EXPECT_EQ(c.state.position[2].size(), sizes.nodes);
        EXPECT_LE(c.row.size(), sizes.rows);
        EXPECT_TRUE(is_finite(c));
      } catch (const FileError&) {
        ++refused;
      } catch (const InputError&) {
        ++refused;  // another identity
      }
    }
  EXPECT_GT(refused, 100);
}

TEST(DamagedCheckpoint, IsRefusedForWhatCannotBe) {
  const auto refused = [](auto change) {
    Checkpoint c = small();
    change(c);
    const std::string bytes = checkpoint_bytes(c, identity);
    EXPECT_THROW((void)read(bytes), FileError);
  };
  refused([](Checkpoint& c) { c.state.position[0].resize(1); });
  refused([](Checkpoint& c) { c.state.force[1].resize(4); });
  refused([](Checkpoint& c) { c.state.velocity[1][2] = std::numeric_limits<double>::quiet_NaN(); });
  refused([](Checkpoint& c) { c.state.time = 1.5; });
  refused([](Checkpoint& c) { c.state.step = -1; });
  refused([](Checkpoint& c) { c.step = 0.0; });
  refused([](Checkpoint& c) { c.next_row = 7; });
  refused([](Checkpoint& c) { c.next_frame = 1; });
  refused([](Checkpoint& c) { c.window.row = 3; });
  refused([](Checkpoint& c) { c.window.row = -1; });
  refused([](Checkpoint& c) { c.row[1].pop_back(); });
  refused([](Checkpoint& c) { c.row.resize(9, {0.0, 0.0, 0.0, 0.0}); });
  refused([](Checkpoint& c) { c.term_memory.pop_back(); });
  refused([](Checkpoint& c) { c.term_memory[0].push_back(0.0); });
  refused([](Checkpoint& c) { c.path.stress.clear(); });
  refused([](Checkpoint& c) { c.frame_times = {0.4, 0.0}; });
  refused([](Checkpoint& c) { c.reach.allowed[0].greatest = 2.0; });
  refused([](Checkpoint& c) { c.fabric.clear(); });
}

// Found by fuzzing: it was taken as set.
TEST(DamagedCheckpoint, WithAFlagThatIsNeitherSetNorNotIsRefused) {
  std::string bytes = checkpoint_bytes(small(), identity);
  const std::string value = "[1, 2]";
  bytes.at(bytes.find(value) + value.size()) = '\x02';
  EXPECT_THROW((void)read(bytes, CheckSum::ignored), FileError);
}

TEST(Checkpoint, OfAnotherRunIsRefusedByTheNameOfWhatDiffers) {
  const std::string bytes = checkpoint_bytes(small(), {{"blank.size", "[1, 3]"}, {"card twintex-pw", "00fe", true}});
  try {
    (void)read(bytes);
    FAIL() << "taken";
  } catch (const InputError& error) {
    ASSERT_EQ(error.complaints().size(), 2U);
    EXPECT_NE(error.complaints()[0].find("blank.size: [1, 3] in the checkpoint, [1, 2] now"), std::string::npos);
    EXPECT_NE(error.complaints()[1].find("card twintex-pw: content differs"), std::string::npos);
  }
}

// Through the whole solver, with contact on triangles, whose memory holds indices.
TEST(DamagedCheckpoint, NeverBringsTheSolverDown) {
  const test::TemporaryFolder folder;
  test::write_text(
      "solid p\nfacet normal 0 0 0\nouter loop\nvertex -40 -40 0\nvertex 40 40 0\nvertex 40 -40 0\nendloop\nendfacet\n"
      "facet normal 0 0 0\nouter loop\nvertex -40 -40 0\nvertex -40 40 0\nvertex 40 40 0\nendloop\nendfacet\n"
      "endsolid p\n",
      folder.path() / "plate.stl");
  const Scene scene = read_scene_text(
      "[blank]\nsize = [70, 70]\nyarn_angle = 0\ncoarsening = 4\n[tools.plate]\nshape = \"triangles\"\nfile = "
      "\"plate.stl\"\nposition = [0, 0, 0.7]\ndirection = [0, 0, -1]\ntravel = 0.5\n[model]\ncell = \"shell\"\n"
      "[[grip]]\nname = \"left\"\nedge = \"left\"\n[analysis]\nduration = 0.001\nenergy_limit = 1\n",
      (folder.path() / "scene.toml").string());
  const Card card = load_card(scene.fabric.material);
  const Mesh mesh = build_mesh(scene, card);
  const auto file = folder.path() / "out/checkpoint.bin";
  EXPECT_THROW((void)solve(mesh, scene, card, folder.path() / "out", {.threads = 1, .quiet = true, .stop_at_step = 20}),
               Interrupted);
  const std::string good = test::read_text(file);
  constexpr std::size_t sum_at = 31, content_at = 39;
  ASSERT_EQ(std::memcmp(good.data(), "weaveform checkpoint 4\n", 23), 0);
  int ended = 0;
  for (std::size_t at = content_at; at < good.size(); at += good.size() / 97)
    for (const char flip : {'\x01', '\x40', '\x7f'}) {
      std::string bytes = good;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      const std::uint64_t sum = check_sum(std::string_view(bytes).substr(content_at));
      std::memcpy(bytes.data() + sum_at, &sum, sizeof sum);
      test::write_text(bytes, file);
      try {
        (void)solve(mesh, scene, card, folder.path() / "out",
                    {.threads = 1, .resume = true, .quiet = true, .stop_at_step = 22});
      } catch (const std::runtime_error&) {  // one of ours: files, input, physics, interrupted
        ++ended;
      }
    }
  EXPECT_GT(ended, 200);
}

}  // namespace
}  // namespace weaveform
