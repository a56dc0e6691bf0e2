#include "app/interrupt.hpp"

namespace weaveform {
namespace {

volatile std::sig_atomic_t interrupt_requested = 0;

void request_interrupt(int /*signal*/) {
  interrupt_requested = 1;
}

bool always_taken(int signal) {
  return signal == SIGINT || signal == SIGTERM || signal == SIGQUIT;
}

}  // namespace

InterruptWatch::InterruptWatch() {
  interrupt_requested = 0;
  struct sigaction action {};
  action.sa_handler = &request_interrupt;
  action.sa_flags = SA_RESTART;  // the checkpoint's writes go on
  for (std::size_t k = 0; k < stopping_signals.size(); ++k) {
    const int signal = stopping_signals[k];
    sigaction(signal, nullptr, &previous_[k]);
    if (previous_[k].sa_handler != SIG_IGN || always_taken(signal)) sigaction(signal, &action, nullptr);
  }
}

InterruptWatch::~InterruptWatch() {
  for (std::size_t k = 0; k < stopping_signals.size(); ++k) sigaction(stopping_signals[k], &previous_[k], nullptr);
}

bool InterruptWatch::requested() {
  return interrupt_requested != 0;
}

}  // namespace weaveform
