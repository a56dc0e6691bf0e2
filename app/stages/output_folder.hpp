// Folders and files that a command may write to. What Weaveform did not write is not lost: a folder that it never wrote
// to must not hold a file of a name that it would write, a file must be its own, links are never followed, and what a
// command reads is never what it overwrites, whoever wrote it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/files/folder_lock.hpp"
#include "core/files/owned_files.hpp"

namespace weaveform {

struct OutputClaim {
  std::filesystem::path directory;
  FileNames names;                            // that may be written, below the folder
  std::vector<std::filesystem::path> inputs;  // what the command reads
  bool can_force = false, force = false;      // whether the command has --force, and whether it is given
};

// A folder held by this program (FolderLock), with what killed runs left unfinished in it cleared away.
class OutputFolder {
public:
  // Makes the folder. Throws InputError, naming the files, when one of the names is a link or an input, or is there in
  // a folder that Weaveform never wrote to and --force is not given; FileError when the folder cannot be made or is
  // held.
  explicit OutputFolder(const OutputClaim& claim);
  [[nodiscard]] const std::string& trouble() const { return lock_.trouble(); }

private:
  FolderLock lock_;
};

// Whether Weaveform has written to the folder: it left its lock file or its scene.toml there.
[[nodiscard]] bool is_our_folder(const std::filesystem::path& directory);

// Whether the file, which is no link, says in its beginning that Weaveform wrote it.
[[nodiscard]] bool is_written_by_us(const std::filesystem::path& file);

// Whether it is one of them, by whatever name.
[[nodiscard]] bool is_one_of_files(const std::filesystem::path& file, const std::vector<std::filesystem::path>& files);

// For commands that write one file: throws InputError when `file` is one of the inputs, and, unless `force`, when it is
// there and does not say in its beginning that Weaveform wrote it. Formats without comments are known by `own_words`,
// which nobody else would write there.
void require_writable(const std::filesystem::path& file, const std::vector<std::filesystem::path>& inputs, bool force,
                      const std::string& own_words = "");

}  // namespace weaveform
