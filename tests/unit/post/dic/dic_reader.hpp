// What the tests of readers of measured point fields share: a file read as one stage, what it is refused for, what is noted.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "post/dic/readers/measurement.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform::dic {

class DicReader : public testing::Test {
protected:
  MeasuredStage read(const std::string& text, const std::string& name = "stage.csv") {
    test::write_text(text, folder_.path() / name);
    auto stages = read_stages(folder_.path() / name, spec);
    EXPECT_EQ(stages.size(), 1U);
    return stages.front();
  }
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  static MeasuredStage sample(const std::string& name, const MeasurementSpec& spec) {
    return read_stages(std::string(WEAVEFORM_SOURCE_DIR) + "/tests/data/dic/" + name, spec).front();
  }
  static long good(const MeasuredStage& stage) { return std::count(stage.valid.begin(), stage.valid.end(), true); }

  MeasurementSpec spec;
  test::TemporaryFolder folder_;
};

inline bool noted(const MeasuredStage& stage, const std::string& words) {
  return std::any_of(stage.notes.begin(), stage.notes.end(), [&](const auto& note) { return test::says(note, words); });
}

}  // namespace weaveform::dic
