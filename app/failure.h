// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/exit_code.h"

namespace loft::app {

/// What an exception tells the user.
struct Failure {
  std::string words;
  ExitCode code;
};

/// Every failure has its exit code. Precondition: an exception is being handled. Throws it again
/// where it is none of those that commands throw.
[[nodiscard]] Failure current_failure();

}  // namespace loft::app
