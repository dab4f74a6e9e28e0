// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

#include "app/commands/commands.h"

namespace loft::app {

/// Add the commands of captures and pages; a command is ready when the line has been parsed.
CLI::App* add_stream(CLI::App& app, StreamCommand& command);
CLI::App* add_view(CLI::App& app, ViewCommand& command);
CLI::App* add_live(CLI::App& app, LiveCommand& command);
CLI::App* add_session(CLI::App& app, SessionCommand& command);

/// Notes which of a session's settings the command line names. Throws UsageError for what makes no
/// sense in it.
void look_at_options(const CLI::App& sub, StreamCommand& command);

}  // namespace loft::app
