// Complaints of one look after another at the same thing: all of them for somebody who mends a file, or only the first
// one's for who wants the thing or nothing.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace weaveform {

class Findings {
public:
  enum class Want { all, first };
  explicit Findings(Want want = Want::all) : want_(want) {}

  // Runs `look`; true when it threw nothing. What it throws of InputError, FileError and PhysicsError is kept, each
  // line once; when only the first is wanted, it goes on its way.
  template <class Look>
  bool attempt(Look look) {
    try {
      look();
      return true;
    } catch (const InputError& error) {
      if (want_ == Want::first) throw;
      for (const std::string& line : error.complaints()) keep(line, false);
    } catch (const FileError& error) {
      if (want_ == Want::first) throw;
      for (const std::string& line : error.complaints()) keep(line, true);
    } catch (const PhysicsError& error) {
      if (want_ == Want::first) throw;
      keep(error.what(), false);
    }
    return false;
  }

  [[nodiscard]] bool empty() const { return lines_.empty(); }

  // Throws InputError with all of them, or FileError when no more is wrong than that files cannot be read.
  void throw_if_any() const {
    if (lines_.empty()) return;
    if (only_files_) throw FileError(lines_);
    throw InputError(lines_);
  }

private:
  void keep(const std::string& line, bool of_a_file) {
    only_files_ = only_files_ && of_a_file;
    if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
  }
  Want want_;
  std::vector<std::string> lines_;
  bool only_files_ = true;
};

}  // namespace weaveform
