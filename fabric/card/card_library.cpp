// Finds a card: built into the program, or a file.
#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/keys/nearest_name.hpp"
#include "core/keys/toml_document.hpp"
#include "fabric/card/builtin_cards.hpp"
#include "fabric/card/card.hpp"

namespace weaveform {

std::vector<std::string> builtin_card_names() {
  std::vector<std::string> names;
  for (const auto& card : builtin_cards()) names.push_back(card.name);
  return names;
}

bool is_builtin_card(const std::string& name) {
  const auto names = builtin_card_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_card_path(const std::string& name) {
  return name.find('/') != std::string::npos || name.ends_with(".toml");
}

std::filesystem::path card_path(const std::string& path, const std::filesystem::path& relative_to) {
  const bool is_folder = std::filesystem::is_directory(relative_to);
  return (is_folder ? relative_to : relative_to.parent_path()) / path;  // an absolute path stays as it is
}

namespace {

struct CardText {
  std::string text, name;  // name: in messages
};

CardText find_card(const std::string& name_or_path, const std::filesystem::path& relative_to) {
  for (const auto& card : builtin_cards()) {
    if (card.name == name_or_path) return {std::string(card.text), "built-in card " + card.name};
  }
  const auto file = card_path(name_or_path, relative_to);
  if (!is_card_path(name_or_path) && !std::filesystem::exists(file)) {
    throw InputError(fmt::format("no built-in card is called '{}' and there is no file {}{}", name_or_path,
                                 file.string(), did_you_mean(name_or_path, builtin_card_names())));
  }
  return {read_text_file(file, most_written_by_hand), file.string()};
}

}  // namespace

Card load_card(const std::string& name_or_path, const std::filesystem::path& relative_to) {
  const CardText card = find_card(name_or_path, relative_to);
  return read_card_text(card.text, card.name);
}

std::string card_text_of(const std::string& name_or_path, const std::filesystem::path& relative_to) {
  return find_card(name_or_path, relative_to).text;
}

}  // namespace weaveform
