// Signals that would end the program ask a run to stop at the next step instead; while a watch lives, the handlers are
// ours, and a second signal changes nothing: the checkpoint is written to its end.
#pragma once

#include <array>
#include <csignal>
#include <cstddef>

namespace weaveform {

// Ctrl-C, kill, Ctrl-\, a closed terminal, the limit of processor time, what batch systems send before they kill, and
// timers. Not among them: what tells of a defect (SIGSEGV), and failed writes (SIGPIPE, SIGXFSZ).
inline constexpr std::array stopping_signals = {SIGINT,  SIGTERM, SIGQUIT, SIGHUP,    SIGXCPU, SIGUSR1,
                                                SIGUSR2, SIGALRM, SIGPROF, SIGVTALRM, SIGPWR};

class InterruptWatch {
public:
  // Signals that were ignored stay so (nohup ignores SIGHUP), but for SIGINT, SIGTERM and SIGQUIT: a shell without job
  // control ignores the first and last for everything it runs in the background.
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;
  [[nodiscard]] static bool requested();

private:
  std::array<struct sigaction, stopping_signals.size()> previous_{};
};

}  // namespace weaveform
