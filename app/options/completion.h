// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "app/options/tree.h"

namespace loft::app {

/// What completes the program's command lines: for `shell` bash, zsh or fish.
[[nodiscard]] std::string completion(const CommandNote& program, std::string_view shell);

}  // namespace loft::app
