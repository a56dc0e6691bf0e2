#include "mesher/base/say.hpp"

#include <cstdio>

namespace weaveform {

// Standard error has no buffer: without the lock two threads' lines would mix, and without two writes a line needs no
// memory to be put together in.
void say(std::string_view line) noexcept {
  flockfile(stderr);
  say_part(line);
  say_part("\n");
  funlockfile(stderr);
}

void say_part(std::string_view text) noexcept {
  if (std::fwrite(text.data(), 1, text.size(), stderr) != text.size()) std::clearerr(stderr);
}

}  // namespace weaveform
