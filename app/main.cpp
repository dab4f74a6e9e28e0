// SPDX-License-Identifier: MIT
#include <cerrno>
#include <iostream>
#include <string>

#include "app/descriptors.h"
#include "app/failure.h"
#include "app/options/command_line.h"
#include "app/options/help.h"
#include "app/terminal.h"
#include "io/bytes/file.h"

namespace {

using namespace loft::app;

ExitCode fail(const std::string& words, ExitCode code) {
  Terminal().complain(words);
  return code;
}

ExitCode run_program(int argc, char** argv) {
  CommandLine line;
  try {
    line.app().parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
      const auto unknown = find_unknown(line.app(), {argv + 1, argv + argc});
      if (unknown) return fail(*unknown, ExitCode::usage);
    }
    return line.app().exit(error) == 0 ? ExitCode::ok : ExitCode::usage;
  }
  return line.run();
}

ExitCode run_safely(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (...) {
    const auto [words, code] = current_failure();
    return fail(words, code);
  }
}

/// Results that did not arrive are a failure, whatever else went well.
ExitCode flush_results(ExitCode code) {
  errno = 0;
  std::cout.flush();
  if (std::cout) return code;
  const std::string cause = errno != 0 ? loft::io::last_cause() : "a write failed";
  return fail("cannot write to standard output: " + cause, ExitCode::cannot_write);
}

}  // namespace

int main(int argc, char** argv) {
  open_closed_descriptors();
  std::ios::sync_with_stdio(false);
  return static_cast<int>(flush_results(run_safely(argc, argv)));
}
