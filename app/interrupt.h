// SPDX-License-Identifier: MIT
#pragma once

namespace loft::app {

/// From now on the first interrupt (SIGINT, SIGTERM, or SIGHUP unless it is ignored, as by nohup)
/// is only noted, so that the work can stop where nothing is left behind; a second one ends the
/// program at once.
void catch_interrupts();
/// From now on who reads our words may leave: they go nowhere then, and the work goes on.
void ignore_closed_pipes();

[[nodiscard]] bool is_interrupted();

/// From now on SIGUSR1 is noted: somebody wants the output as it is.
void catch_output_requests();
/// Whether there was such a request since the last call.
[[nodiscard]] bool take_output_request();

}  // namespace loft::app
