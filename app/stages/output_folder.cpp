#include "app/stages/output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "mesher/scene/scene_copy.hpp"

namespace weaveform {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_named = 5;  // files in one message

// The first bytes.
std::string beginning_of(const fs::path& file) {
  std::array<char, 8192> bytes{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), bytes.size());
  return {bytes.data(), static_cast<std::size_t>(stream.gcount())};
}

bool says_weaveform_wrote_it(const fs::path& file, const std::string& own_words = "") {
  if (!fs::is_regular_file(fs::symlink_status(file))) return false;
  const std::string text = beginning_of(file);
  return text.find(written_mark) != std::string::npos ||
         (!own_words.empty() && text.find(own_words) != std::string::npos);
}

bool is_link(const fs::path& path) {
  return fs::is_symlink(fs::symlink_status(path));
}

bool is_same_file(const fs::path& one, const fs::path& other) {
  std::error_code missing;
  return fs::equivalent(one, other, missing) && !missing;
}

// The folders below `directory` that the names lie in, itself first.
std::set<fs::path> folders_of(const OutputClaim& claim) {
  std::set<fs::path> folders = {claim.directory};
  for (const auto& name : claim.names) folders.insert((claim.directory / name).parent_path());
  return folders;
}

void refuse_linked_folders(const OutputClaim& claim) {
  for (const auto& folder : folders_of(claim))
    if (folder != claim.directory && is_link(folder))
      throw InputError(
          fmt::format("{}: is a link, which Weaveform does not write through; remove it or choose another "
                      "--output",
                      folder.string()));
}

std::string listed(const std::vector<fs::path>& files) {
  std::string text;
  for (std::size_t k = 0; k < std::min(files.size(), most_named); ++k)
    text += (k == 0 ? "" : ", ") + files[k].filename().string();
  return files.size() <= most_named ? text : text + fmt::format(" and {} more", files.size() - most_named);
}

void refuse_what_would_be_lost(const OutputClaim& claim) {
  refuse_linked_folders(claim);
  const std::vector<fs::path> present = present_files(claim.directory, claim.names);
  std::vector<std::string> complaints;
  for (const auto& file : present) {
    if (is_link(file))
      complaints.push_back(
          fmt::format("{}: is a link, which would be replaced; remove it or choose another --output", file.string()));
    else if (is_one_of_files(file, claim.inputs))
      complaints.push_back(
          fmt::format("{}: is an input of this command and would be overwritten; choose another "
                      "--output",
                      file.string()));
  }
  if (!complaints.empty()) throw InputError(complaints);
  if (present.empty() || claim.force || is_our_folder(claim.directory)) return;
  throw InputError(
      fmt::format("{}: Weaveform never wrote to this folder, and would overwrite {} there; choose another "
                  "--output{}",
                  claim.directory.string(), listed(present), claim.can_force ? ", or give --force" : ""));
}

void make_folder(const fs::path& directory) {
  std::error_code trouble;
  fs::create_directories(directory, trouble);
  if (!trouble && fs::is_directory(directory)) return;
  throw FileError(fmt::format("{}: cannot make this folder ({}); choose another --output", directory.string(),
                              trouble ? trouble.message() : "a file of that name is in the way"));
}

const fs::path& prepared(const OutputClaim& claim) {
  make_folder(claim.directory);
  refuse_what_would_be_lost(claim);
  return claim.directory;
}

}  // namespace

OutputFolder::OutputFolder(const OutputClaim& claim) : lock_(prepared(claim)) {
  // what runs that were killed left half-written
  for (const auto& folder : folders_of(claim)) clear_temporaries(folder);
}

bool is_one_of_files(const fs::path& file, const std::vector<fs::path>& files) {
  return std::any_of(files.begin(), files.end(), [&](const fs::path& other) { return is_same_file(file, other); });
}

bool is_written_by_us(const fs::path& file) {
  return says_weaveform_wrote_it(file);
}

bool is_our_folder(const fs::path& directory) {
  return has_lock_file(directory) || says_weaveform_wrote_it(directory / file_name::scene);
}

void require_writable(const fs::path& file, const std::vector<fs::path>& inputs, bool force,
                      const std::string& own_words) {
  if (!fs::exists(fs::symlink_status(file))) return;
  if (is_one_of_files(file, inputs))
    throw InputError(fmt::format("{}: is an input of this command; choose another --output", file.string()));
  if (force || says_weaveform_wrote_it(file, own_words)) return;
  throw InputError(
      fmt::format("{}: is there and was not written by Weaveform; choose another --output, or give --force "
                  "to overwrite it",
                  file.string()));
}

}  // namespace weaveform
