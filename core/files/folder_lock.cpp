#include "core/files/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fstream>

#include "core/error.hpp"

namespace weaveform {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view mark = "Written by weaveform; held by ";

// As it was called, without control characters and not longer than a line of a message may be.
std::string command_line() {
  constexpr std::size_t longest = 200;
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string text;
  for (char c = 0; file.get(c) && text.size() < longest;) text += c == '\0' || std::iscntrl(c) != 0 ? ' ' : c;
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown host";
}

}  // namespace

FolderLock::FolderLock(const fs::path& directory, const std::string& name, const std::string& what) {
  const fs::path file = directory / name;
  file_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (file_ < 0) {
    trouble_ = fmt::format("{}: cannot be made ({}); nothing keeps a second run out of this folder", file.string(),
                           std::strerror(errno));
    return;
  }
  if (flock(file_, LOCK_EX | LOCK_NB) == 0) {
    sign();
    return;
  }
  if (errno == EWOULDBLOCK) refuse(directory, what);
  trouble_ = fmt::format("{}: this file system has no locks ({}); nothing keeps a second run out of this folder",
                         directory.string(), std::strerror(errno));
}

FolderLock::~FolderLock() {
  if (file_ >= 0) close(file_);
}

void FolderLock::refuse(const fs::path& directory, const std::string& what) const {
  std::array<char, 1024> text{};
  const auto count = pread(file_, text.data(), text.size() - 1, 0);
  close(file_);
  std::string holder(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  holder = holder.starts_with(mark) ? holder.substr(mark.size(), holder.find('\n') - mark.size()) : "another program";
  throw FileError(fmt::format("{}: {}, {}; wait for it, or choose another --output", directory.string(), what, holder));
}

void FolderLock::sign() {
  const std::time_t now = std::time(nullptr);
  const std::string text = fmt::format("{}process {} on {} since {:%Y-%m-%d %H:%M:%S} UTC ({})\n", mark, getpid(),
                                       host_name(), fmt::gmtime(now), command_line());
  const bool signed_it =
      ftruncate(file_, 0) == 0 && pwrite(file_, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
  if (!signed_it) trouble_ = fmt::format("the lock file cannot be written ({})", std::strerror(errno));
}

bool has_lock_file(const fs::path& directory) {
  const fs::path file = directory / folder_lock_name;
  if (!fs::is_regular_file(fs::symlink_status(file))) return false;
  std::ifstream stream(file);
  std::string line;
  return std::getline(stream, line) && line.starts_with(mark);
}

}  // namespace weaveform
