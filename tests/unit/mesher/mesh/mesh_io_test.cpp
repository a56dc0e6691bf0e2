// mesh.vtu: read back bit for bit, whole or not at all, and plain words when it is not a mesh.
#include "mesher/mesh/mesh_io.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/error.hpp"
#include "tests/support/same_mesh.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mesher/lattice/lattice_zoo.hpp"

namespace weaveform {
namespace {

using namespace lattice_zoo;
namespace fs = std::filesystem;

class MeshFile : public ::testing::Test {
protected:
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
  }
  const test::TemporaryFolder own_;
  const fs::path folder_ = own_.path();
};

Mesh sample() {
  const Animal a = animal(twill(), 30.0, {6.25, 8.5}, {1.0, 1.0}, {0.1, 0.3}, true);
  return build_mesh(a.scene, a.card);
}

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(MeshFile, ReadsBackBitForBit) {
  const Mesh mesh = sample();
  write_mesh(mesh, folder_ / "mesh.vtu");
  test::expect_same_mesh(read_mesh(folder_ / "mesh.vtu"), mesh);
  EXPECT_EQ(files(), 1U);  // no temporary left
}

TEST_F(MeshFile, SameMeshGivesTheSameBytes) {
  write_mesh(sample(), folder_ / "a.vtu");
  write_mesh(sample(), folder_ / "b.vtu");
  EXPECT_EQ(contents(folder_ / "a.vtu"), contents(folder_ / "b.vtu"));
}

TEST_F(MeshFile, AFullDiskLeavesTheOldFileAndNoOther) {
  const fs::path file = folder_ / "mesh.vtu";
  std::ofstream(file) << "old";
  // The largest file this process may write stands in for a full disk, at many places in the file: write() then fails.
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit before {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const Mesh mesh = sample();
  write_mesh(mesh, folder_ / "whole.vtu");
  const auto whole = fs::file_size(folder_ / "whole.vtu");
  for (const auto room : {std::uintmax_t{0}, std::uintmax_t{1000}, whole / 2, whole - 1}) {
    struct rlimit limit = before;
    limit.rlim_cur = room;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    EXPECT_THROW(write_mesh(mesh, file), FileError) << room;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_EQ(contents(file), "old") << room;
    EXPECT_EQ(files(), 2U) << room;
  }
  std::signal(SIGXFSZ, handler);
}

TEST_F(MeshFile, AFolderThatCannotBeIsAFileError) {
  std::ofstream(folder_ / "in_the_way") << "a file";
  EXPECT_THROW(write_mesh(sample(), folder_ / "in_the_way" / "mesh.vtu"), FileError);
  EXPECT_THROW(static_cast<void>(read_mesh(folder_ / "absent.vtu")), FileError);
  EXPECT_THROW(static_cast<void>(read_mesh(folder_)), FileError);
}

TEST_F(MeshFile, GarbageAndCutFilesAreFileErrors) {
  const fs::path file = folder_ / "mesh.vtu";
  std::ofstream(file) << "not xml at all";
  EXPECT_THROW(static_cast<void>(read_mesh(file)), FileError);
  std::ofstream(file, std::ios::trunc) << "";
  EXPECT_THROW(static_cast<void>(read_mesh(file)), FileError);
  write_mesh(sample(), file);
  const auto whole = fs::file_size(file);
  for (const double part : {0.05, 0.3, 0.6, 0.9, 0.99}) {
    write_mesh(sample(), file);
    fs::resize_file(file, static_cast<std::uintmax_t>(part * static_cast<double>(whole)));
    EXPECT_THROW(static_cast<void>(read_mesh(file)), FileError) << part;
  }
}

TEST_F(MeshFile, AForeignGridIsAnInputErrorThatNamesWhatIsMissing) {
  const fs::path file = folder_ / "mesh.vtu";
  write_mesh(sample(), file);
  for (const std::string array : {"softening", "family", "crossing", "coefficient_per_mm", "tie_node"}) {
    std::string text = contents(file);
    const auto at = text.find("\"" + array + "\"");
    ASSERT_NE(at, std::string::npos);
    text[at + 1] = 'X';  // same length, so that the binary part keeps its offsets
    std::ofstream(folder_ / "foreign.vtu", std::ios::binary) << text;
    try {
      static_cast<void>(read_mesh(folder_ / "foreign.vtu"));
      ADD_FAILURE() << array;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(array), std::string::npos) << error.what();
    }
  }
}

// Versions before wrote no number of ties.
TEST_F(MeshFile, OfAVersionBeforeReadsBackToo) {
  const fs::path file = folder_ / "mesh.vtu";
  const Mesh mesh = sample();
  ASSERT_FALSE(mesh.tie.empty());
  write_mesh(mesh, file);
  std::string text = contents(file);
  text[text.find("\"tie_count\"") + 1] = 'X';
  std::ofstream(file, std::ios::binary) << text;
  EXPECT_EQ(read_mesh(file).tie.size(), mesh.tie.size());
}

}  // namespace
}  // namespace weaveform
