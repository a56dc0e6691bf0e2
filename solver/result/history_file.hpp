// history.csv while a run goes on: each row is appended as soon as nothing will change it any more, so that a run that
// is killed leaves all but its last. At the end the file has the bytes that write_history would have given it.
#pragma once

#include <filesystem>

#include "solver/result/result.hpp"

namespace weaveform {

class HistoryFile {
public:
  // Writes the heading and the first `closed` rows anew. Throws FileError.
  HistoryFile(std::filesystem::path file, const History& history, int closed);
  ~HistoryFile();
  HistoryFile(const HistoryFile&) = delete;
  HistoryFile& operator=(const HistoryFile&) = delete;

  // Appends the rows up to `closed`; nothing to do is cheap. Throws FileError.
  void append(const History& history, int closed) {
    if (closed > written_) append_rows(history, closed);
  }

private:
  void append_rows(const History& history, int closed);
  std::filesystem::path file_;
  int descriptor_ = -1;
  int written_;
};

}  // namespace weaveform
