// SPDX-License-Identifier: MIT
#pragma once

namespace loft::app {

/// From now on the first interrupt (SIGINT, SIGTERM) is only noted, so that the work can stop where
/// nothing is left behind; a second one ends the program at once.
void catch_interrupts();

[[nodiscard]] bool is_interrupted();

}  // namespace loft::app
