// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace loft::cdt {

/// How often operator new has been called in this program.
[[nodiscard]] std::size_t allocation_count();

}  // namespace loft::cdt
