#include "post/measurement/matrix_files.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace weaveform::dic {
namespace {

namespace fs = std::filesystem;

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// 'u', 'v', 'w', 'x' or 'y' when the word is a component's name behind the words `before`; else '\0'.
char component_of(const std::string& word, const std::string& before) {
  static const std::map<std::string, char> names = {{"u", 'u'},  {"ux", 'u'}, {"dx", 'u'}, {"v", 'v'}, {"uy", 'v'},
                                                    {"dy", 'v'}, {"w", 'w'},  {"uz", 'w'}, {"dz", 'w'}};
  if (const auto found = names.find(word); found != names.end()) return found->second;
  if (word != "x" && word != "y" && word != "z") return '\0';
  std::string last = before;
  while (!last.empty() && !is_word(last.back())) last.pop_back();
  if (last.ends_with("disp") || last.ends_with("displacement")) return static_cast<char>('u' + (word[0] - 'x'));
  return word == "z" ? '\0' : word[0];
}

struct Stem {
  std::string text, unit;  // without the unit in brackets
};

Stem stem_of(const fs::path& file) {
  Stem stem{file.stem().string(), ""};
  const auto open = stem.text.find_first_of("[("), close = stem.text.find_first_of("])", open);
  if (open == std::string::npos || close == std::string::npos) return stem;
  stem.unit = stem.text.substr(open + 1, close - open - 1);
  stem.text.erase(open, close - open + 1);
  while (stem.unit.starts_with(' ')) stem.unit.erase(0, 1);
  while (stem.unit.ends_with(' ')) stem.unit.pop_back();
  while (stem.text.ends_with(' ')) stem.text.pop_back();
  return stem;
}

}  // namespace

std::optional<MatrixName> matrix_name(const fs::path& file) {
  const Stem stem = stem_of(file);
  const std::string lower = lower_case(stem.text);
  for (std::size_t end = lower.size(); end > 0;) {
    if (!is_word(lower[end - 1])) {
      --end;
      continue;
    }
    std::size_t begin = end;
    while (begin > 0 && is_word(lower[begin - 1])) --begin;
    const char component = component_of(lower.substr(begin, end - begin), lower.substr(0, begin));
    if (component != '\0') return MatrixName{stem.text.substr(0, begin), stem.text.substr(end), component, stem.unit};
    end = begin;
  }
  return std::nullopt;
}

fs::path sister_of(const fs::path& file, char component) {
  const auto name = matrix_name(file);
  if (!name) return {};
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const auto other = matrix_name(entry.path());
    if (other && other->component == component && other->before == name->before && other->after == name->after &&
        entry.path().extension() == file.extension() && entry.is_regular_file(ignored))
      return file.has_parent_path() ? entry.path() : entry.path().filename();
  }
  return {};
}

std::vector<fs::path> stages_of_matrices(const std::vector<fs::path>& files, const std::vector<bool>& listed) {
  // u's file for every file that belongs to a pair of u and v
  std::vector<fs::path> stage(files.size());
  std::set<fs::path> folders;
  for (std::size_t k = 0; k < files.size(); ++k) {
    const auto name = matrix_name(files[k]);
    if (!name) continue;
    const fs::path u = name->component == 'u' ? files[k] : sister_of(files[k], 'u');
    if (u.empty() || sister_of(u, 'v').empty()) continue;
    stage[k] = u;
    folders.insert(files[k].parent_path());
  }
  std::vector<fs::path> kept;
  std::set<fs::path> seen;
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (stage[k].empty() && !listed[k] && folders.count(files[k].parent_path()) > 0) continue;
    const fs::path& file = stage[k].empty() ? files[k] : stage[k];
    if (seen.insert(file).second) kept.push_back(file);
  }
  return kept;
}

}  // namespace weaveform::dic
