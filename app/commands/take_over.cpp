// SPDX-License-Identifier: MIT
#include "app/commands/take_over.h"

#include "io/unit.h"

namespace loft::app {

void take_over(const Stack& stack, ReconstructCommand& command, Terminal& terminal) {
  if (command.unit.empty()) command.unit = io::metres_per_unit(stack.unit) ? stack.unit : "mm";
  if (stack.fill) command.options.fill = *stack.fill;
  if (!command.options.keyhole_width) command.options.keyhole_width = stack.keyhole_width;
  for (const std::string& note : stack.notes) terminal.say(note);
}

}  // namespace loft::app
