// SPDX-License-Identifier: MIT
#include "app/interrupt.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <thread>

#include "app/exit_code.h"
#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"

namespace loft::app {

namespace {

volatile std::sig_atomic_t interrupted = 0;
volatile std::sig_atomic_t output_wanted = 0;
int noted[2] = {-1, -1};  // a pipe: a byte for each interrupt

/// Ends the program when the work has not come to its end in time. Sessions keep what they have
/// acknowledged; outputs are there as a whole or not at all.
void watch(std::chrono::milliseconds grace) {
  char byte = 0;
  while (::read(noted[0], &byte, 1) < 0 && errno == EINTR) {
  }
  std::this_thread::sleep_for(grace);
  io::abandon_atomic_files();
  constexpr std::string_view words = "error: interrupted\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, words.data(), words.size());
  std::_Exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace

extern "C" {
static void note_interrupt(int signal) {
  const int cause = errno;
  interrupted = 1;
  [[maybe_unused]] const auto written = ::write(noted[1], "", 1);
  errno = cause;
  std::signal(signal, SIG_DFL);
}
static void note_output_request(int) { output_wanted = 1; }
}

void catch_interrupts(std::chrono::milliseconds grace) {
  if (noted[0] < 0) {
    if (::pipe2(noted, O_CLOEXEC) != 0) throw Error("no pipe: " + io::last_cause());
    std::thread(watch, grace).detach();
  }
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
