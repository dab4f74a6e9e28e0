// SPDX-License-Identifier: MIT
#include "app/interrupt.h"

#include <csignal>

namespace loft::app {

namespace {

volatile std::sig_atomic_t interrupted = 0;
volatile std::sig_atomic_t output_wanted = 0;

}  // namespace

extern "C" {
static void note_interrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}
static void note_output_request(int) { output_wanted = 1; }
}

void catch_interrupts() {
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
  if (std::signal(SIGHUP, note_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

void ignore_closed_pipes() { std::signal(SIGPIPE, SIG_IGN); }

bool is_interrupted() { return interrupted != 0; }

void catch_output_requests() { std::signal(SIGUSR1, note_output_request); }

bool take_output_request() {
  const bool is_wanted = output_wanted != 0;
  output_wanted = 0;
  return is_wanted;
}

}  // namespace loft::app
