// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/exit_code.h"

namespace loft::app {

/// Prints the help of a command, given by its words (`session list`); of none, that of the program.
/// Throws UsageError that names the nearest command where there is none of that name.
ExitCode show_help(const CLI::App& app, const std::vector<std::string>& words);

/// What is wrong with a command line that could not be read, if that is a command or an option that
/// there is not: names it, and the nearest that there is.
[[nodiscard]] std::optional<std::string> find_unknown(const CLI::App& app,
                                                      const std::vector<std::string>& arguments);

}  // namespace loft::app
