// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

// Clang says it in another way than GCC.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define LOFT_SANITIZED
#endif
#endif

namespace loft {

/// How many random cases are tried where a whole run tries so many: a third with sanitizers, which
/// take ten times as long and look for what few cases show.
constexpr std::uint64_t cases(std::uint64_t count) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(LOFT_SANITIZED)
  return (count + 2) / 3;
#else
  return count;
#endif
}

}  // namespace loft
