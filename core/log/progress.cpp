#include "core/log/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "core/log/say.hpp"

namespace weaveform {
namespace {

constexpr int usual_columns = 80;  // of a terminal that does not tell
constexpr int longest_bar = 30, shortest_bar = 6;

std::string clock_text(double seconds) {
  const auto whole = std::lround(seconds);
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

// One that can go back to the beginning of its line.
bool is_terminal() {
  const char* kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && kind != nullptr && std::string_view(kind) != "dumb";
}

// Asked anew for each line: people resize windows.
int terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual_columns;
}

std::string without_last_part(const std::string& note) {
  const std::size_t end = note.rfind("  ");
  return end == std::string::npos ? "" : note.substr(0, end);
}

std::string bar(int width, double fraction) {
  const int filled = std::clamp(static_cast<int>(fraction * width), 0, width);
  return fmt::format(" [{}{}]", std::string(filled, '#'), std::string(width - filled, '.'));
}

}  // namespace

std::string progress_line(const std::string& title, double fraction, const std::string& note, const std::string& left,
                          int columns) {
  const std::size_t room = static_cast<std::size_t>(std::max(columns - 1, 0));
  const auto line = [&](int width, const std::string& kept) {
    return fmt::format("{}{} {:3.0f} %{}{}  left {}", title, width > 0 ? bar(width, fraction) : "", 100.0 * fraction,
                       kept.empty() ? "" : "  ", kept, left);
  };
  std::string kept = note;
  while (!kept.empty() && line(shortest_bar, kept).size() > room) kept = without_last_part(kept);
  for (int width = longest_bar; width >= shortest_bar; --width)
    if (std::string text = line(width, kept); text.size() <= room) return text;
  return line(0, "").substr(0, room);
}

Progress::Progress(std::string title, bool quiet)
    : title_(std::move(title)), quiet_(quiet), terminal_(is_terminal()), start_(Clock::now()), printed_(start_) {}

// What failed in between is told below the bar, not after it.
Progress::~Progress() {
  if (terminal_) end_status_line();
}

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
  if (terminal_) end_status_line();
}

void Progress::print(double fraction, const std::string& note) {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double done = fraction - std::max(start_fraction_, 0.0);
  const std::string left = done > 0.0 ? clock_text(elapsed * (1.0 - fraction) / done) : "?";
  printed_ = Clock::now();
  printed_fraction_ = terminal_ ? fraction : static_cast<int>(fraction * 10.0 + 1e-9) / 10.0;
  if (terminal_) return say_status(progress_line(title_, fraction, note, left, terminal_columns()));
  say(fmt::format("{} {:3.0f} %  {}  elapsed {}  left {}", title_, 100.0 * fraction, note, clock_text(elapsed), left));
}

}  // namespace weaveform
