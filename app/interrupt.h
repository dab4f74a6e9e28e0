// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace loft::app {

/// From now on the first interrupt (SIGINT, SIGTERM, or SIGHUP unless it is ignored, as by nohup)
/// is only noted, so that the work can stop where nothing is left behind; a second one ends the
/// program at once. Where the work has not ended after `grace` the program ends all the same, with
/// ExitCode::interrupted and without half-written outputs: 0 for commands that do not look.
void catch_interrupts(std::chrono::milliseconds grace = std::chrono::milliseconds(1300));
/// From now on who reads our words may leave: they go nowhere then, and the work goes on.
void ignore_closed_pipes();

[[nodiscard]] bool is_interrupted();

/// From now on SIGUSR1 is noted: somebody wants the output as it is.
void catch_output_requests();
/// Whether there was such a request since the last call.
[[nodiscard]] bool take_output_request();

}  // namespace loft::app
