#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "solver/result/result.hpp"
#include "tests/support/temporary_folder.hpp"

namespace weaveform {
namespace {

History small_history() {
  return {{"time_s", "top.force_N"}, {{0.0, 0.0}, {1.0 / 3.0, 12345.678901}, {0.5, -1e-30}}};
}

TEST(History, ComesBackToTenDigits) {
  const test::TemporaryFolder folder;
  const History written = small_history();
  write_history(written, folder.path() / "history.csv");
  const History read = read_history(folder.path() / "history.csv");
  EXPECT_EQ(read.column, written.column);
  ASSERT_EQ(read.row.size(), written.row.size());
  for (std::size_t r = 0; r < read.row.size(); ++r)
    for (std::size_t k = 0; k < read.column.size(); ++k)
      EXPECT_NEAR(read.row[r][k], written.row[r][k], 1e-9 * std::abs(written.row[r][k]));
}

TEST(History, NamesWithCommasAndQuotesComeBack) {
  const test::TemporaryFolder folder;
  const History written = {{"time_s", "upper, \"left\" jaw.force_N"}, {{0.0, 1.0}}};
  write_history(written, folder.path() / "history.csv");
  EXPECT_EQ(read_history(folder.path() / "history.csv").column, written.column);
}

TEST(History, UnknownColumnIsNamedTogetherWithTheOnesThereAre) {
  EXPECT_EQ(small_history().index("time_s"), 0);
  EXPECT_EQ(small_history().index("nothing"), -1);
  try {
    (void)small_history().values("nothing");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'nothing'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("top.force_N"), std::string::npos);
  }
}

TEST(History, WrongCellIsNamedWithFileAndLine) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "history.csv";
  for (const char* line : {"0.1,abc", "0.1", "0.1,2,3"}) {
    std::ofstream(file) << "time_s,x\n0,1\n" << line << "\n";
    try {
      (void)read_history(file);
      FAIL() << "no error for " << line;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("history.csv:3"), std::string::npos) << error.what();
    }
  }
}

TEST(History, FullDiskKeepsTheLastWholeFile) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "history.csv";
  write_history(small_history(), file);
  History longer = small_history();
  for (int k = 0; k < 2000; ++k) longer.row.push_back({k / 7.0, k / 3.0});
  {
    const test::FullDisk full(4096);
    EXPECT_THROW(write_history(longer, file), FileError);
  }
  EXPECT_EQ(read_history(file).row.size(), 3U);
  EXPECT_EQ(test::files_in(folder.path()), 1);
}

TEST(Statistics, ComeBackExactlyWithNotANumberAsSuch) {
  const test::TemporaryFolder folder;
  SolveStatistics written;
  written.cells = 2209;
  written.steps = 3'000'000'000L;
  written.wall_s = 1.0 / 3.0;
  written.step_set_by = "yarn (warp, node 123)";
  written.energy_error = std::numeric_limits<double>::quiet_NaN();
  written.folded_cells = 7;
  written.threads = 2;
  write_statistics(written, folder.path() / "solve.json");
  const SolveStatistics read = read_statistics(folder.path() / "solve.json");
  EXPECT_EQ(read.cells, written.cells);
  EXPECT_EQ(read.steps, written.steps);
  EXPECT_EQ(read.wall_s, written.wall_s);
  EXPECT_EQ(read.step_set_by, written.step_set_by);
  EXPECT_TRUE(std::isnan(read.energy_error));
  EXPECT_EQ(read.folded_cells, written.folded_cells);
  EXPECT_EQ(read.threads, written.threads);
}

TEST(Statistics, MissingValueIsNamed) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "solve.json") << R"({"cells": 4, "nodes": 9})";
  try {
    (void)read_statistics(folder.path() / "solve.json");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'yarns'"), std::string::npos) << error.what();
  }
  std::ofstream(folder.path() / "solve.json") << "{";
  EXPECT_THROW((void)read_statistics(folder.path() / "solve.json"), InputError);
}

TEST(Statistics, OfAnEarlierVersionAreThoseOfAFinishedRun) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "solve.json";
  SolveStatistics written;
  written.cells = 12;
  write_statistics(written, file);
  auto json = nlohmann::json::parse(read_text_file(file));
  for (const char* name : {"finished", "time_s", "program", "scene_digest", "card_digest", "mesh_digest"})
    json.erase(name);
  write_text_whole(file, json.dump());
  const SolveStatistics read = read_statistics(file);
  EXPECT_TRUE(read.finished);
  EXPECT_EQ(read.cells, 12);
}

TEST(Statistics, CountsThatDoNotFitAreRefused) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "solve.json";
  write_statistics({}, file);
  const auto sound = nlohmann::json::parse(read_text_file(file));
  for (const char* count : {"-1", "1e30", "0.5", "4294967296", "null", "true"}) {
    auto json = sound;
    json["cells"] = nlohmann::json::parse(count);
    write_text_whole(file, json.dump());
    EXPECT_THROW((void)read_statistics(file), InputError) << count;
  }
}

}  // namespace
}  // namespace weaveform
