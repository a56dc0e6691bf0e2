// What a message advises exists: every key that the messages of 'fit' and of the DIC comparison name is read from their
// own sources and looked up in the key tables, so that no advice ends in the next error.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "fabric/identify/fit_schema.hpp"
#include "post/dic/settings/schema.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

// The string literals of a folder's sources, those that are broken over lines put together.
std::string literals_of(const std::vector<std::string>& folders) {
  std::string all;
  for (const auto& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(WEAVEFORM_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      std::ifstream stream(entry.path());
      std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
      text = std::regex_replace(text, std::regex(R"re("\s*\n\s*")re"), "");
      const std::regex literal(R"re("((?:[^"\\\n]|\\.)*)")re");
      for (std::sregex_iterator at(text.begin(), text.end(), literal), end; at != end; ++at)
        all += (*at)[1].str() + "\n";
    }
  return all;
}

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

template <class Spec>
void add_names(const std::vector<Key<Spec>>& keys, std::set<std::string>& names) {
  for (const auto& name : key_names(keys)) names.insert(name);
}

TEST(Advice, OfFitNamesKeysThatExist) {
  std::set<std::string> keys;
  add_names(identify::fit_head_keys(), keys);
  add_names(identify::shear_fit_keys(), keys);
  add_names(identify::tensile_keys(), keys);
  add_names(identify::shear_frame_keys(), keys);
  add_names(identify::bias_extension_keys(), keys);
  add_names(identify::bending_fit_keys(), keys);
  add_names(identify::moment_curvature_keys(), keys);
  add_names(identify::cantilever_keys(), keys);
  add_names(identify::peirce_keys(), keys);
  for (const auto& info : card_keys()) keys.insert(info.name);
  const std::set<std::string> tables = {"shear_frame", "bias_extension", "moment_curvature"};
  const std::vector<std::string> channels = {"displacement",     "force",     "strain", "stress", "angle",
                                             "normalised_force", "curvature", "moment", "x",      "y"};
  const std::string literals = literals_of({"fabric/identify"});
  int found = 0;
  const auto expect_key = [&](const std::string& name) {
    ++found;
    if (!name.starts_with("{}")) {
      EXPECT_TRUE(keys.count(name) > 0 || tables.count(name) > 0)
          << "a message names '" << name << "', which is no key";
      return;
    }
    for (const auto& channel : channels)
      EXPECT_TRUE(keys.count(channel + name.substr(2)) > 0) << "a message names '" << channel + name.substr(2) << "'";
  };
  for (const auto& m : matches(literals, std::regex(R"re(((?:\{\}_)?[a-z][a-z_]*) = (?:-?\d|true|false|\{|\\"))re")))
    expect_key(m[1]);
  for (const auto& m : matches(literals, std::regex(R"re('((?:\{\})?[a-z]+_[a-z_]+)')re"))) expect_key(m[1]);
  for (const auto& m : matches(literals, std::regex(R"re(((?:\{\}|[a-z]+)_(?:unit|factor|column))\b)re")))
    expect_key(m[1]);
  EXPECT_GT(found, 30) << "the sources were not read";
}

TEST(Advice, OfTheDicComparisonNamesKeysThatExist) {
  std::set<std::string> keys;
  for (const auto& table : dic::settings_tables())
    for (const auto& info : table.keys) keys.insert(table.name + "." + info.name);
  const std::string literals = literals_of({"post/dic", "app/commands"});
  int found = 0;
  const auto expect_key = [&](const std::string& table, const std::string& name) {
    ++found;
    EXPECT_TRUE(keys.count(table + "." + name) > 0) << "a message names '" << name << "' of [" << table << "]";
  };
  for (const auto& m : matches(literals, std::regex(R"re(set ([a-z_]+) of \[([a-z]+)\])re"))) expect_key(m[2], m[1]);
  for (const auto& m :
       matches(literals, std::regex(R"re('([a-z_]+)'(?: (?:or|and) '([a-z_]+)')? of \[([a-z]+)\])re"))) {
    expect_key(m[3], m[1]);
    if (m[2].matched) expect_key(m[3], m[2]);
  }
  // the questions' own keys, and overrides in words
  for (const auto& m :
       matches(literals, std::regex(R"re(\b(measurement|instrument|stages|registration)\.([a-z_]+)\b)re")))
    if (m[2] != "csv" && m[2] != "hpp") expect_key(m[1], m[2]);  // a file's name
  EXPECT_GT(found, 25) << "the sources were not read";
}

}  // namespace
}  // namespace weaveform
