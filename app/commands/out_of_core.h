// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "app/commands/commands.h"
#include "app/commands/reconstruct_report.h"
#include "app/terminal.h"

namespace loft::app {

/// Inputs larger than this are worked on out of core where that can be done: about 14 times as much
/// memory would be needed.
inline constexpr std::uintmax_t most_in_memory = std::uintmax_t{256} << 20U;

/// Whether a stack is to stay in its files: as the command asks, or else by its size.
/// Throws UsageError if it is asked for and cannot be.
[[nodiscard]] bool is_out_of_core(const ReconstructCommand& command);

/// Makes the surface slab by slab, and writes it. Fills in all of the report, and in the command
/// what the stack says of itself.
void run_out_of_core(ReconstructCommand& command, Terminal& terminal, Report& report);

}  // namespace loft::app
