// Who hears of work. A library tells what happens and never prints; the program that calls it says what becomes of it
// (app/console.hpp prints). Whoever is not there is not told.
#pragma once

#include <functional>
#include <string>

namespace weaveform {

struct Listener {
  std::function<void(const std::string&)> line = {};     // of the log
  std::function<void(const std::string&)> warning = {};  // what a user must hear of, also where the log is not wanted

  void log(const std::string& text) const {
    if (line) line(text);
  }
  void warn(const std::string& text) const {
    if (warning && !text.empty()) warning(text);
  }
};

// Who watches how far long work is: `fraction` of it, 0 to 1. `note`: rate first, then what matters less, double blanks
// between them.
struct ProgressWatch {
  std::function<bool(double fraction)> due = {};  // whether an update is worth its note; asked often, so it is cheap
  std::function<void(double fraction, const std::string& note)> update = {};
  std::function<void(const std::string& note)> finish = {};

  [[nodiscard]] bool is_due(double fraction) const { return due && due(fraction); }
};

}  // namespace weaveform
