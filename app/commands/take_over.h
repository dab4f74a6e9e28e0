// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/commands.h"
#include "app/terminal.h"
#include "reconstruct/stack.h"

namespace loft::app {

/// What a stack says of itself goes for what the command line leaves open: its unit, fill rule and
/// keyhole width. The stack's notes are said.
void take_over(const Stack& stack, ReconstructCommand& command, Terminal& terminal);

}  // namespace loft::app
