#include "mesher/base/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "mesher/base/say.hpp"

namespace weaveform {
namespace {

std::string clock_text(double seconds) {
  const int whole = static_cast<int>(seconds + 0.5);
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

Progress::Progress(std::string title, bool quiet)
    : title_(std::move(title)),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      printed_(start_) {}

bool Progress::due(double fraction) const {
  if (quiet_) return false;
  if (!terminal_) return fraction >= printed_fraction_ + 0.1;
  return Clock::now() - printed_ > std::chrono::milliseconds(100);
}

void Progress::update(double fraction, const std::string& note) {
  if (start_fraction_ < 0.0) start_fraction_ = fraction;
  if (due(fraction)) print(fraction, note);
}

void Progress::finish(const std::string& note) {
  if (quiet_) return;
  print(1.0, note);
  if (terminal_) say("");
}

void Progress::print(double fraction, const std::string& note) {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double done = fraction - std::max(start_fraction_, 0.0);
  const std::string left = done > 0.0 ? clock_text(elapsed * (1.0 - fraction) / done) : "?";
  printed_ = Clock::now();
  printed_fraction_ = terminal_ ? fraction : static_cast<int>(fraction * 10.0 + 1e-9) / 10.0;
  if (!terminal_) {
    say(fmt::format("{} {:3.0f} %  {}  elapsed {}  left {}", title_, 100.0 * fraction, note, clock_text(elapsed),
                    left));
    return;
  }
  constexpr int width = 30;
  const int filled = std::clamp(static_cast<int>(fraction * width), 0, width);
  say_part(fmt::format("\r{} [{}{}] {:3.0f} %  {}  left {} \x1b[K", title_, std::string(filled, '#'),
                       std::string(width - filled, '.'), 100.0 * fraction, note, left));
}

}  // namespace weaveform
