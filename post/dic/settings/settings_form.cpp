#include "post/dic/settings/settings_form.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "post/dic/settings/schema.hpp"

namespace weaveform::dic {
namespace {

constexpr std::size_t line_width = 110;

// Text behind '#', broken between words.
std::string comment(const std::string& text) {
  std::string lines(1, '#');
  std::size_t width = 1;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::size_t length = end - at;
    if (width > 1 && width + 1 + length > line_width) {
      lines.append("\n#");
      width = 1;
    }
    lines.append(fmt::format(" {}", text.substr(at, length)));
    width += 1 + length;
    at = end + 1;
  }
  lines.push_back('\n');
  return lines;
}

std::string about(const KeyInfo& key) {
  std::string text = key.doc + " (" + key.type;
  if (!key.unit.empty() && key.unit != "1") text += ", " + key.unit;
  if (!key.range.empty()) text += ", " + key.range;
  return text + ")";
}

const Question* question_for(const Questions& questions, const std::string& table, const std::string& key) {
  const auto found = std::find_if(questions.begin(), questions.end(),
                                  [&](const Question& q) { return q.key == fmt::format("{}.{}", table, key); });
  return found == questions.end() ? nullptr : &*found;
}

bool is_text(const KeyInfo& key) {
  return key.type == "text";
}

std::string placeholder(const KeyInfo& key) {
  if (!key.standard.empty()) return key.standard;
  return is_text(key) ? "\"\"" : "...";
}

// The example as TOML: --set takes bare words, a file does not.
std::string answer(const KeyInfo& key, const Question& question) {
  return is_text(key) ? fmt::format("\"{}\"", question.example) : question.example;
}

std::string one_table(const SettingsTable& table, const Settings& settings, const Questions& questions) {
  std::string text = fmt::format("\n{}[{}]\n", comment(table.doc), table.name);
  const auto given = table.given(settings);
  for (std::size_t k = 0; k < table.keys.size(); ++k) {
    const KeyInfo& key = table.keys[k];
    text += comment(about(key));
    const Question* question = question_for(questions, table.name, key.name);
    if (question != nullptr) text += comment("ANSWER: " + question->text);
    if (!given[k].empty())
      text += fmt::format("{} = {}\n", key.name, given[k]);
    else
      text += fmt::format("#{} = {}\n", key.name, question != nullptr ? answer(key, *question) : placeholder(key));
  }
  return text;
}

std::string list_of_tables(const SettingsTable& table) {
  std::string text = fmt::format("\n{}#[[{}]]\n", comment(table.doc + " As many as needed."), table.name);
  for (const KeyInfo& key : table.keys)
    text += comment(about(key)) + fmt::format("#{} = {}\n", key.name, placeholder(key));
  return text;
}

}  // namespace

std::string settings_form(const Settings& settings, const Questions& questions) {
  std::string text =
      "# Settings of 'weaveform post compare' (--settings THIS_FILE). Take the '#' from a key to set it; what is left\n"
      "# behind '#' keeps the value shown.\n";
  text += questions.empty() ? "# No question is open.\n"
                            : fmt::format("# {} question(s) are open: search for ANSWER.\n", questions.size());
  for (const SettingsTable& table : settings_tables())
    text += table.many ? list_of_tables(table) : one_table(table, settings, questions);
  return text;
}

}  // namespace weaveform::dic
