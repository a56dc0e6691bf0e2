// Ctrl-C and SIGTERM ask a run to stop at the next step; while one lives, the handlers are ours.
#pragma once

#include <csignal>

namespace weaveform {

class InterruptWatch {
public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;
  [[nodiscard]] static bool requested();

private:
  struct sigaction previous_int_ {};
  struct sigaction previous_term_ {};
};

}  // namespace weaveform
