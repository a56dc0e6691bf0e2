// One program at a time writes into a folder. The lock is the system's (flock), so that it goes with whoever holds it,
// however that ends; the file beside it only says who that is. The file stays behind: it marks the folder as one that
// Weaveform writes to.
#pragma once

#include <filesystem>
#include <string>

namespace weaveform {

// Name of the lock file in a result folder.
inline constexpr const char* folder_lock_name = ".weaveform.lock";

class FolderLock {
public:
  // Makes DIR/NAME (not its folder) and holds it. Throws FileError, naming the holder (process, host, since when, with
  // what command), when somebody else does. Where the file system has no locks, or the file cannot be made, it holds
  // nothing, and trouble() says so.
  // `what` says in that case what is going on there.
  explicit FolderLock(const std::filesystem::path& directory, const std::string& name = folder_lock_name,
                      const std::string& what = "another run writes to this folder");
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  [[nodiscard]] const std::string& trouble() const { return trouble_; }  // a line; "" when the lock is held

private:
  [[noreturn]] void refuse(const std::filesystem::path& directory, const std::string& what) const;
  void sign();
  int file_ = -1;
  std::string trouble_;
};

// Whether DIR holds a lock file that Weaveform made, held or not.
[[nodiscard]] bool has_lock_file(const std::filesystem::path& directory);

}  // namespace weaveform
