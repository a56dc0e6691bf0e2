#include "solver/result/history_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "core/files/files.hpp"

namespace weaveform {

HistoryFile::HistoryFile(std::filesystem::path file, const History& history, int closed)
    : file_(std::move(file)), written_(closed) {
  write_text_whole(file_, history_text(history, 0, closed));
  descriptor_ = open(file_.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor_ < 0) throw_cannot_write(file_, errno);
}

HistoryFile::~HistoryFile() {
  close(descriptor_);
}

void HistoryFile::append_rows(const History& history, int closed) {
  const std::string text = history_rows_text(history, written_, closed);
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(descriptor_, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw_cannot_write(file_, count < 0 ? errno : 0);
    done += static_cast<std::size_t>(count);
  }
  written_ = closed;
}

}  // namespace weaveform
