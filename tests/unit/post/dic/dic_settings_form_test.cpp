// The settings file that --write-settings leaves: complete, readable as it is, with the questions where they belong.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "post/dic/comparison/compare.hpp"
#include "post/dic/settings/schema.hpp"
#include "post/dic/settings/settings_form.hpp"
#include "tests/support/run_command.hpp"

namespace {

using namespace weaveform;
using namespace weaveform::dic;
using test::TemporaryFolder;
using test::write_text;

TEST(SettingsForm, IsCompleteAndReadsBackAsTheSettingsItWasMadeOf) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "form.toml";
  const Settings given =
      read_settings("", {"measurement.pixel_size=0.05", "registration.method=axes", "stages.displacement=[1, 2]"});
  const std::string form = settings_form(given, {});
  write_text(form, file);
  const Settings back = read_settings(file.string(), {});
  EXPECT_EQ(back.measurement.pixel_size, 0.05);
  EXPECT_EQ(back.registration.method, dic::RegistrationMethod::axes);
  EXPECT_EQ(back.stages.displacement, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(back.instrument.facet_size, std::nullopt);
  for (const SettingsTable& table : settings_tables())
    for (const KeyInfo& key : table.keys)
      EXPECT_TRUE(std::regex_search(form, std::regex(fmt::format("(^|\n)#?{} = ", key.name))))
          << table.name << "." << key.name;
}

// Every key taken from behind its '#' is a key that is read.
TEST(SettingsForm, TheAnswersAreValuesOnceTheirMarkIsTakenAway) {
  const TemporaryFolder folder;
  std::string rows = "x,y,u,v,depth\n";
  for (const char* place : {"0,0", "7,0", "0,7", "7,7"}) rows += fmt::format("{},1,2,3\n", place);
  write_text(rows, folder.path() / "m.csv");
  const auto questions = questions_of({(folder.path() / "m.csv").string()}, Settings{});
  EXPECT_GE(questions.size(), 9U) << "format, x, y, u, v, unit, sense of y, facet, travel";
  std::string form = settings_form({}, questions);
  for (const Question& question : questions) {
    const std::string name = question.key.substr(question.key.find('.') + 1);
    EXPECT_NE(form.find("ANSWER"), std::string::npos);
    if (question.key == "stages.displacement") continue;  // its example is a word that says what to give
    form = std::regex_replace(form, std::regex(fmt::format("\n#{} = ", name)), fmt::format("\n{} = ", name),
                              std::regex_constants::format_first_only);
  }
  write_text(form, folder.path() / "form.toml");
  const Settings filled = read_settings((folder.path() / "form.toml").string(), {});
  EXPECT_EQ(filled.measurement.format, dic::MeasurementFormat::columns);
  EXPECT_EQ(filled.measurement.x, "NAME_OF_x");
}

TEST(SettingsForm, IsWrittenByTheCommandAndNeverOverAFile) {
  const TemporaryFolder folder;
  write_text("x,y,u,v\n0,0,1,2\n7,0,1,2\n0,7,1,2\n7,7,1,2\n", folder.path() / "m.csv");
  const std::string command = "weaveform post compare pw m.csv --write-settings form.toml";
  const auto first = test::run_command(command, folder.path());
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_NE(first.err.find("--set instrument.facet_size="), std::string::npos) << first.err;
  write_text("mine", folder.path() / "form.toml");
  const auto second = test::run_command(command, folder.path());
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find("is not overwritten"), std::string::npos) << second.err;
  EXPECT_EQ(test::read_text(folder.path() / "form.toml"), "mine");
}

}  // namespace
