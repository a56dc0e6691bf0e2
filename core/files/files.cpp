#include "core/files/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <system_error>

#include "core/error.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view temporary_ending = ".partial";
constexpr int random_letters = 12;
constexpr int tries = 100;  // of names that are taken already; one is enough unless somebody is at work against us
constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz234567";

std::string reason_of(int error_number) {
  return error_number == 0 ? "the write came back short" : std::generic_category().message(error_number);
}

FileError cannot_write(const fs::path& file, const std::string& reason) {
  return FileError(
      fmt::format("{}: cannot be written ({}); free space or choose another --output", file.string(), reason));
}

FileError cannot_read(const fs::path& file, const std::string& reason) {
  return FileError(fmt::format("{}: cannot be read ({}); check the path and its permissions", file.string(), reason));
}

std::string random_part() {
  std::random_device source;  // the kernel's, so that nobody can foretell it
  std::uniform_int_distribution<std::size_t> letter(0, letters.size() - 1);
  std::string text;
  for (int k = 0; k < random_letters; ++k) text += letters[letter(source)];
  return text;
}

// A temporary file, locked while this lives.
class Temporary {
public:
  // In the same folder as the file, so that the rename cannot cross a file system.
  explicit Temporary(const fs::path& file) {
    for (int k = 0; k < tries; ++k) {
      name_ = file;
      name_.replace_filename(fmt::format(".{}.{}{}", file.filename().string(), random_part(), temporary_ending));
      made_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
      if (made_ < 0 && errno != EEXIST) throw cannot_write(file, reason_of(errno));
      if (made_ >= 0 && locked()) return;
      if (made_ >= 0) close(made_);
    }
    throw cannot_write(file, "no free temporary name");
  }
  ~Temporary() { close(made_); }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  [[nodiscard]] const fs::path& name() const { return name_; }

private:
  // False when somebody who clears the folder away has come in between.
  [[nodiscard]] bool locked() const {
    if (flock(made_, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;  // a file system without locks will do
    struct stat found {};
    return fstat(made_, &found) == 0 && found.st_nlink > 0;
  }
  fs::path name_;
  int made_ = -1;
};

void settle(const fs::path& path, int flags) {
  const int opened = open(path.c_str(), flags | O_CLOEXEC);
  if (opened < 0) return;
  fsync(opened);
  close(opened);
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

}  // namespace

void throw_cannot_write(const fs::path& file, int error_number) {
  throw cannot_write(file, reason_of(error_number));
}

bool is_temporary_name(const std::string& name) {
  const auto ending = temporary_ending.size() + random_letters + 1;
  return name.size() > ending + 1 && name.front() == '.' && name.ends_with(temporary_ending) &&
         name[name.size() - ending] == '.' &&
         std::string_view(name).substr(name.size() - ending + 1, random_letters).find_first_not_of(letters) ==
             std::string_view::npos;
}

void clear_temporaries(const fs::path& folder) {
  std::error_code unimportant;
  for (const auto& entry : fs::directory_iterator(folder, unimportant)) {
    if (!is_temporary_name(entry.path().filename().string())) continue;
    const int opened = open(entry.path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (opened < 0) continue;
    if (flock(opened, LOCK_EX | LOCK_NB) == 0) fs::remove(entry.path(), unimportant);
    close(opened);
  }
}

void settle_on_disk(const fs::path& file) {
  settle(file, O_RDONLY);
}

void write_whole(const fs::path& file, const std::function<void(const fs::path& temporary)>& write,
                 Durability durability) {
  std::error_code failure;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), failure);
  if (failure) throw cannot_write(file, failure.message());

  const Temporary made(file);
  const fs::path& temporary = made.name();
  std::error_code unimportant;
  try {
    write(temporary);
  } catch (...) {
    fs::remove(temporary, unimportant);
    throw;
  }
  if (durability == Durability::power) settle(temporary, O_RDONLY);
  fs::rename(temporary, file, failure);
  if (failure) {
    fs::remove(temporary, unimportant);
    throw cannot_write(file, failure.message());
  }
  if (durability == Durability::power) settle(folder_of(file), O_RDONLY | O_DIRECTORY);
}

void write_text_whole(const fs::path& file, std::string_view text, Durability durability) {
  write_whole(
      file,
      [&](const fs::path& temporary) {
        errno = 0;
        std::ofstream stream(temporary, std::ios::binary);
        stream.write(text.data(), static_cast<std::streamsize>(text.size()));
        // close() flushes: a disk that fills up shows itself only here.
        stream.close();
        if (!stream) throw cannot_write(file, reason_of(errno));
      },
      durability);
}

void require_regular_file(const fs::path& file) {
  struct stat found {};
  if (stat(file.c_str(), &found) != 0) throw cannot_read(file, reason_of(errno));
  if (S_ISDIR(found.st_mode)) throw cannot_read(file, "it is a folder");
  if (!S_ISREG(found.st_mode)) throw cannot_read(file, "it is no regular file");
  if (access(file.c_str(), R_OK) != 0) throw cannot_read(file, reason_of(errno));
}

std::string read_text_file(const fs::path& file, std::uintmax_t most) {
  require_regular_file(file);
  std::error_code unknown;
  if (const std::uintmax_t size = fs::file_size(file, unknown); !unknown && size > most)
    throw cannot_read(file, fmt::format("it has {:.3g} MB, more than the {:.3g} MB of any such file",
                                        1e-6 * static_cast<double>(size), 1e-6 * static_cast<double>(most)));
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw cannot_read(file, reason_of(errno));
  std::string text;
  std::array<char, 1 << 16> part{};
  while (stream.read(part.data(), part.size()) || stream.gcount() > 0)
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) throw cannot_read(file, reason_of(errno));
  return text;
}

}  // namespace weaveform
