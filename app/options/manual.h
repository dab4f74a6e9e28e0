// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "app/options/tree.h"

namespace loft::app {

/// The manual page of a program, for `man`: troff with the macros of man(7). `version` is what the
/// program calls itself.
[[nodiscard]] std::string manual(const CommandNote& program, std::string_view version);

}  // namespace loft::app
