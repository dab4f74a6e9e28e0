// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

#include "app/commands/commands.h"

namespace loft::app {

/// Add the commands about maps; a command is ready when the line has been parsed.
CLI::App* add_overlay(CLI::App& app, OverlayCommand& command);
CLI::App* add_coverage(CLI::App& app, CoverageCommand& command);
CLI::App* add_query(CLI::App& app, QueryCommand& command);
CLI::App* add_path(CLI::App& app, PathCommand& command);
CLI::App* add_classify(CLI::App& app, ClassifyCommand& command);
CLI::App* add_field(CLI::App& app, FieldCommand& command);

}  // namespace loft::app
