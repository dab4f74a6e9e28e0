// SPDX-License-Identifier: MIT
#include "app/interrupt.h"

#include <csignal>

namespace loft::app {

namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

extern "C" {
static void note_interrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}
}

void catch_interrupts() {
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
}

bool is_interrupted() { return interrupted != 0; }

}  // namespace loft::app
