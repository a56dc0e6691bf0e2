#include "post/dic/readers/matrix_files.hpp"

#include <cctype>
#include <map>
#include <set>

#include "core/files/text_words.hpp"

namespace weaveform::dic {
namespace {

namespace fs = std::filesystem;

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
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

// The matrices of a folder, by stage and component; read once, for there may be thousands.
class MatrixFolder {
public:
  explicit MatrixFolder(const fs::path& folder) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? fs::path(".") : folder, ignored)) {
      const auto name = matrix_name(entry.path());
      if (name && entry.is_regular_file(ignored))
        file_[key(*name, entry.path())].emplace(name->component, folder / entry.path().filename());
    }
  }

  // The component's file of the same stage; "" when there is none.
  [[nodiscard]] fs::path sister(const fs::path& file, char component) const {
    const auto name = matrix_name(file);
    if (!name) return {};
    const auto stage = file_.find(key(*name, file));
    if (stage == file_.end()) return {};
    const auto found = stage->second.find(component);
    return found == stage->second.end() ? fs::path() : found->second;
  }

private:
  static std::string key(const MatrixName& name, const fs::path& file) {
    return name.before + '/' + name.after + '/' + file.extension().string();  // no name holds a '/'
  }
  std::map<std::string, std::map<char, fs::path>> file_;
};

}  // namespace

std::optional<MatrixName> matrix_name(const fs::path& file) {
  const Stem stem = stem_of(file);
  const std::string small = lower(stem.text);
  for (std::size_t end = small.size(); end > 0;) {
    if (!is_word(small[end - 1])) {
      --end;
      continue;
    }
    std::size_t begin = end;
    while (begin > 0 && is_word(small[begin - 1])) --begin;
    const char component = component_of(small.substr(begin, end - begin), small.substr(0, begin));
    if (component != '\0') return MatrixName{stem.text.substr(0, begin), stem.text.substr(end), component, stem.unit};
    end = begin;
  }
  return std::nullopt;
}

fs::path sister_of(const fs::path& file, char component) {
  return MatrixFolder(file.parent_path()).sister(file, component);
}

std::vector<fs::path> stages_of_matrices(const std::vector<fs::path>& files, const std::vector<bool>& listed) {
  std::map<fs::path, MatrixFolder> folders;
  // u's file for every file that belongs to a pair of u and v
  std::vector<fs::path> stage(files.size());
  std::set<fs::path> with_matrices;
  for (std::size_t k = 0; k < files.size(); ++k) {
    const fs::path parent = files[k].parent_path();
    const MatrixFolder& folder = folders.try_emplace(parent, parent).first->second;
    const fs::path u = folder.sister(files[k], 'u');
    if (u.empty() || folder.sister(files[k], 'v').empty()) continue;
    stage[k] = u;
    with_matrices.insert(parent);
  }
  std::vector<fs::path> kept;
  std::set<fs::path> seen;
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (stage[k].empty() && !listed[k] && with_matrices.count(files[k].parent_path()) > 0) continue;
    const fs::path& file = stage[k].empty() ? files[k] : stage[k];
    if (seen.insert(file).second) kept.push_back(file);
  }
  return kept;
}

}  // namespace weaveform::dic
