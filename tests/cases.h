// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "tests/sanitized.h"

namespace loft {

/// How many random cases are tried where a whole run tries so many: a sixth with sanitizers, which
/// take ten times as long and look for what few cases show.
constexpr std::uint64_t cases(std::uint64_t count) {
#ifdef LOFT_SANITIZED
  return (count + 5) / 6;
#else
  return count;
#endif
}

}  // namespace loft
