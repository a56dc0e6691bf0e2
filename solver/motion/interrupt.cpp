#include "solver/motion/interrupt.hpp"

namespace weaveform {
namespace {

volatile std::sig_atomic_t interrupt_requested = 0;

void request_interrupt(int /*signal*/) {
  interrupt_requested = 1;
}

}  // namespace

InterruptWatch::InterruptWatch() {
  interrupt_requested = 0;
  struct sigaction action {};
  action.sa_handler = &request_interrupt;
  sigaction(SIGINT, &action, &previous_int_);
  sigaction(SIGTERM, &action, &previous_term_);
}

InterruptWatch::~InterruptWatch() {
  sigaction(SIGINT, &previous_int_, nullptr);
  sigaction(SIGTERM, &previous_term_, nullptr);
}

bool InterruptWatch::requested() {
  return interrupt_requested != 0;
}

}  // namespace weaveform
