// A damaged checkpoint is an error line, wherever the damage is, and also when somebody mends the check sum.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/files/digest.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/scene/reader.hpp"
#include "solver/analysis/checkpoint.hpp"
#include "solver/solve.hpp"
#include "tests/support/contact_scene.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/small_world.hpp"

namespace weaveform {
namespace {

const Identity identity = {{"blank.size", "[1, 2]"}, {"card twintex-pw", "00ff", true}};
// A state with a member of every kind.
struct Kept {
  double time = 0.5;
  std::int64_t step = 100;
  bool started = true;
  std::string set_by = "yarns at node 7";
  std::vector<double> position = {0.25, 0.5, 0.75}, frames = {0.0, 0.4};
  std::vector<int> hint = {0, 1};

  void archive(Archive& archive) {
    archive.number("a time", time, {0.0, 1.0});
    archive.count("a number of steps", step, 0, 1000);
    archive.flag("a flag", started);
    archive.text("what set the step", set_by);
    archive.numbers("a position", position);
    archive.list("times of frames", frames, 0, 3, not_negative);
    archive.indices("a triangle", hint, 0, 5);
  }
};

std::string bytes_of(Kept kept, const Identity& of_run = identity) {
  return checkpoint_bytes(of_run, [&](Archive& archive) { kept.archive(archive); });
}

Kept read(const std::string& bytes, CheckSum check = CheckSum::compared) {
  Kept kept;
  read_checkpoint(
      bytes, identity, [&](Archive& archive) { kept.archive(archive); }, "checkpoint.bin", check);
  return kept;
}

TEST(DamagedCheckpoint, IsRefusedWhicheverByteIsTurned) {
  const std::string good = bytes_of({});
  EXPECT_EQ(read(good).step, 100);
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const char flip : {'\x01', '\x40', '\x7f'}) {
      std::string bytes = good;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      EXPECT_THROW((void)read(bytes), FileError) << "byte " << at;
    }
}

TEST(DamagedCheckpoint, IsRefusedAtEveryLengthButItsOwn) {
  const std::string good = bytes_of({});
  for (std::size_t length = 0; length < good.size(); ++length)
    EXPECT_THROW((void)read(good.substr(0, length)), FileError) << length;
  EXPECT_THROW((void)read(good + '\0'), FileError);
  EXPECT_THROW((void)read(good + good), FileError);
}

// With the sum out of the way, what is read is either refused or fits the state in every length and range.
TEST(DamagedCheckpoint, FitsTheStateOrIsRefusedWithoutTheSum) {
  const std::string good = bytes_of({});
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const char flip : {'\x01', '\x10', '\x40', '\x7f'}) {
      std::string bytes = good;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      try {
        Kept kept = read(bytes, CheckSum::ignored);
        EXPECT_EQ(kept.position.size(), 3U);
        EXPECT_LE(kept.frames.size(), 3U);
        EXPECT_EQ(unsound_member([&](Archive& archive) { kept.archive(archive); }), "");
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
    Kept kept;
    change(kept);
    EXPECT_THROW((void)read(bytes_of(kept)), FileError);
  };
  refused([](Kept& kept) { kept.time = 1.5; });
  refused([](Kept& kept) { kept.time = std::numeric_limits<double>::quiet_NaN(); });
  refused([](Kept& kept) { kept.step = -1; });
  refused([](Kept& kept) { kept.position.pop_back(); });
  refused([](Kept& kept) { kept.position.push_back(0.0); });
  refused([](Kept& kept) { kept.position[1] = std::numeric_limits<double>::infinity(); });
  refused([](Kept& kept) { kept.frames.assign(4, 0.1); });
  refused([](Kept& kept) { kept.frames[0] = -0.1; });
  refused([](Kept& kept) { kept.hint[1] = 6; });
  refused([](Kept& kept) { kept.set_by.assign(1 << 17, 'x'); });
}

// Found by fuzzing: it was taken as set.
TEST(DamagedCheckpoint, WithAFlagThatIsNeitherSetNorNotIsRefused) {
  std::string bytes = bytes_of({});
  const std::string value = "[1, 2]";
  bytes.at(bytes.find(value) + value.size()) = '\x02';
  EXPECT_THROW((void)read(bytes, CheckSum::ignored), FileError);
}

// What a world keeps says itself what it cannot be.
TEST(DamagedCheckpoint, OfAWorldIsRefusedForWhatCannotBe) {
  test::SmallWorld world({test::drawing()});
  world.run(20);
  const std::string good = state_bytes(*world);
  const auto refused = [&](auto change) {
    test::SmallWorld other({test::drawing()});
    other.run(20);
    change(other->ply(0).state());
    const std::string bytes = state_bytes(*other);
    StateReader reader(bytes);
    EXPECT_THROW(world->archive(reader), DamagedState);
    EXPECT_NE(bytes, good);
  };
  refused([](State& state) { state.position[0].pop_back(); });
  refused([](State& state) { state.velocity[1][2] = std::numeric_limits<double>::quiet_NaN(); });
  refused([](State& state) { state.force[2][1] = std::numeric_limits<double>::infinity(); });
  refused([](State& state) { state.time = 100.0; });
  refused([](State& state) { state.step = -1; });
}

TEST(Checkpoint, OfAnotherRunIsRefusedByTheNameOfWhatDiffers) {
  const std::string bytes = bytes_of({}, {{"blank.size", "[1, 3]"}, {"card twintex-pw", "00fe", true}});
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
  constexpr std::size_t sum_at = 32, content_at = 40;
  ASSERT_EQ(std::memcmp(good.data(), "weaveform checkpoint 10\n", 24), 0);
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
