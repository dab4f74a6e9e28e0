// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/commands/commands.h"

namespace loft::app {

/// `stack.ndjson: label 'heart': `, as far as there is a choice.
inline std::string place_of(const ReconstructCommand& command, const Options& options) {
  std::string place;
  if (command.inputs.size() == 1) place += command.inputs[0].string() + ": ";
  if (options.label) place += "label '" + *options.label + "': ";
  return place;
}

}  // namespace loft::app
