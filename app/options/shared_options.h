// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/stacks/read_options.h"
#include "reconstruct/options.h"

namespace loft::app {

/// The heading of options that say what comes out, and how it is told.
inline constexpr const char* results_heading = "Results";
/// The heading of options of commands that serve.
inline constexpr const char* server_heading = "Server";

/// Options that are added to a command from here on stand under that heading in its help.
void begin_group(CLI::App& sub, const std::string& heading);

/// `--quiet`.
void add_quiet_option(CLI::App& sub, bool& quiet);
/// `--json` of commands that report at the end.
void add_report_option(CLI::App& sub, bool& json);
/// Which labels.
void add_label_options(CLI::App& sub, std::vector<std::string>& only,
                       std::vector<std::string>& except);
/// What readers of other formats want to know.
void add_read_options(CLI::App& sub, io::ReadOptions& options);
/// What is inside, and how the ends are closed. `given_fill`: set where the command line has a
/// rule; null for streams, which cannot extend their ends.
void add_slice_options(CLI::App& sub, Options& options, std::optional<Fill>* given_fill = nullptr);
/// How far contours may be moved to be smooth.
void add_fair_option(CLI::App& sub, std::optional<double>& distance);
/// How the surface goes from slice to slice.
void add_slab_options(CLI::App& sub, Options& options);
/// Smaller or fewer triangles.
void add_triangle_options(CLI::App& sub, Options& options);

}  // namespace loft::app
