// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

#include "app/commands/commands.h"

namespace loft::app {

/// Add the commands from stacks to surfaces and back; a command is ready when the line has been
/// parsed.
CLI::App* add_reconstruct(CLI::App& app, ReconstructCommand& command);
CLI::App* add_convert(CLI::App& app, ConvertCommand& command);
CLI::App* add_join(CLI::App& app, JoinCommand& command);
CLI::App* add_slice(CLI::App& app, SliceCommand& command);
CLI::App* add_check(CLI::App& app, CheckCommand& command);
CLI::App* add_info(CLI::App& app, InfoCommand& command);

}  // namespace loft::app
