// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace loft::app {

/// What the program tells its caller; `loft --help` lists them, too.
enum class ExitCode {
  ok = 0,
  check_failed = 1,
  usage = 2,
  bad_input = 3,
  cannot_write = 4,
  interrupted = 130,
};

/// The command line asks for something that makes no sense.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The work was interrupted, and what of it is done is not lost, as the words say.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace loft::app
