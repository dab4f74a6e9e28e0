// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reconstruct/options.h"

namespace loft {

/// What users call them, in commands, files and reports: `evenodd`, `keyhole-aware`, `auto`, ...
[[nodiscard]] const char* name(Fill fill);
[[nodiscard]] const char* name(Cap cap);
[[nodiscard]] const char* name(LinkRule rule);

/// The options that are lengths, as far as set, by their names in files and reports.
[[nodiscard]] std::vector<std::pair<std::string, double>> lengths(const Options& options);

/// The options that files tell of the surface in them: fill, cap, link, smooth and lengths.
[[nodiscard]] std::map<std::string, std::string> settings_of(const Options& options);

}  // namespace loft
