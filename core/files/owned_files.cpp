#include "core/files/owned_files.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <system_error>

namespace weaveform {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool matches(std::string_view name, std::string_view pattern, bool begins = true) {
  if (pattern.empty()) return name.empty();
  const char first = pattern.front();
  if (first == '#') {
    if (name.empty() || !is_digit(name.front())) return false;
    return matches(name.substr(1), pattern) || matches(name.substr(1), pattern.substr(1), false);
  }
  if (first == '*') {
    if (matches(name, pattern.substr(1), begins)) return !begins || name.empty() || name.front() != '.';
    const bool takes = !name.empty() && name.front() != '/' && !(begins && name.front() == '.');
    return takes && matches(name.substr(1), pattern, false);
  }
  return !name.empty() && name.front() == first && matches(name.substr(1), pattern.substr(1), first == '/');
}

// The folders in `folder` whose name is one of the pattern's; none of them a link.
std::vector<fs::path> folders_in(const fs::path& folder, const std::string& pattern) {
  std::vector<fs::path> found;
  if (!fs::is_directory(folder)) return found;
  if (pattern.find_first_of("*#") == std::string::npos) {
    if (fs::is_directory(fs::symlink_status(folder / pattern))) found.push_back(folder / pattern);
    return found;
  }
  for (const auto& entry : fs::directory_iterator(folder))
    if (fs::is_directory(entry.symlink_status()) && matches(entry.path().filename().string(), pattern))
      found.push_back(entry.path());
  return found;
}

// The folders below `directory` that the names lie in, itself first; none of them a link but itself.
std::set<fs::path> folders_of(const fs::path& directory, const FileNames& names) {
  std::set<fs::path> folders = {directory};
  for (const std::string& name : names) {
    std::vector<fs::path> here = {directory};
    for (const fs::path& part : fs::path(name).parent_path()) {
      std::vector<fs::path> next;
      for (const fs::path& folder : here)
        for (fs::path& found : folders_in(folder, part.string())) next.push_back(std::move(found));
      folders.insert(next.begin(), next.end());
      here = std::move(next);
    }
  }
  return folders;
}

}  // namespace

bool is_one_of(std::string_view name, const FileNames& names) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& pattern) { return matches(name, pattern); });
}

std::vector<fs::path> present_files(const fs::path& directory, const FileNames& names) {
  std::vector<fs::path> found;
  for (const fs::path& folder : folders_of(directory, names)) {
    if (!fs::is_directory(folder)) continue;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().lexically_relative(directory).string();
      if (is_one_of(name, names) && !fs::is_directory(entry.symlink_status())) found.push_back(entry.path());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

void remove_files(const fs::path& directory, const FileNames& names) {
  for (const fs::path& file : present_files(directory, names)) fs::remove(file);
  const std::set<fs::path> folders = folders_of(directory, names);
  std::error_code not_empty;
  // the deepest first
  for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder)
    if (*folder != directory) fs::remove(*folder, not_empty);
}

FileNames below(const std::string& folder, FileNames names) {
  for (std::string& name : names) name.insert(0, folder + "/");
  return names;
}

FileNames joined(std::initializer_list<FileNames> lists) {
  FileNames all;
  for (const FileNames& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace weaveform
