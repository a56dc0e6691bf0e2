#include "core/log/say.hpp"

#include <cstdio>

namespace weaveform {
namespace {

constexpr std::string_view to_line_begin = "\r", clear_to_end = "\x1b[K";

bool status_is_open = false;  // guarded by the lock of stderr

// Standard error has no buffer: without the lock two threads' lines would mix, and without two writes a line needs no
// memory to be put together in.
class Locked {
public:
  Locked() { flockfile(stderr); }
  ~Locked() { funlockfile(stderr); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;
};

}  // namespace

void say(std::string_view line) noexcept {
  const Locked locked;
  say_part(line);
  say_part("\n");
}

void say_part(std::string_view text) noexcept {
  const Locked locked;
  if (status_is_open) {
    status_is_open = false;
    say_part(to_line_begin);
    say_part(clear_to_end);
  }
  if (std::fwrite(text.data(), 1, text.size(), stderr) != text.size()) std::clearerr(stderr);
}

void say_status(std::string_view line) noexcept {
  const Locked locked;
  status_is_open = false;
  say_part(to_line_begin);
  say_part(line);
  say_part(clear_to_end);
  status_is_open = true;
}

void end_status_line() noexcept {
  const Locked locked;
  if (!status_is_open) return;
  status_is_open = false;
  say_part("\n");
}

}  // namespace weaveform
