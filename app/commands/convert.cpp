// SPDX-License-Identifier: MIT
#include "app/commands/commands.h"
#include "app/commands/label_choice.h"
#include "app/overwriting.h"
#include "app/terminal.h"
#include "io/stack.h"
#include "io/stack_writer.h"
#include "reconstruct/fair.h"

namespace loft::app {

ExitCode run(const ConvertCommand& command) {
  Terminal terminal(command.quiet);
  forbid_overwriting(command.inputs, {&command.output, 1});
  io::check_stack_writable(command.output);
  Stack stack = io::read_stack(command.inputs, command.read);
  if (command.fair) stack = fair(stack, *command.fair);
  LabelChoice(command.only, command.except).apply(stack);
  for (const std::string& note : stack.notes) terminal.say(note);
  for (const std::string& loss : io::write_stack(command.output, stack)) terminal.warn(loss);
  terminal.say("wrote " + command.output.string());
  return ExitCode::ok;
}

}  // namespace loft::app
