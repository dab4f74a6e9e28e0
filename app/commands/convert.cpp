// SPDX-License-Identifier: MIT
#include "app/commands/commands.h"
#include "app/commands/label_choice.h"
#include "app/overwriting.h"
#include "app/terminal.h"
#include "io/stack.h"
#include "io/stack_writer.h"
#include "reconstruct/contours_by_label.h"
#include "reconstruct/fair.h"

namespace loft::app {

namespace {

void make_fair(Stack& stack, double distance) {
  if (const auto unusable = ContoursByLabel(stack.slices).unusable(); !unusable.empty())
    throw InputError(unusable);
  stack = fair(stack, distance);
}

}  // namespace

ExitCode run(const ConvertCommand& command) {
  Terminal terminal(command.quiet);
  forbid_overwriting(command.inputs, {&command.output, 1});
  io::check_stack_writable(command.output);
  Stack stack = io::read_stack(command.inputs, command.read);
  if (command.fair) make_fair(stack, *command.fair);
  LabelChoice(command.only, command.except).apply(stack);
  for (const std::string& note : stack.notes) terminal.say(note);
  for (const std::string& loss : io::write_stack(command.output, stack)) terminal.warn(loss);
  terminal.say("wrote " + command.output.string());
  return ExitCode::ok;
}

}  // namespace loft::app
