// SPDX-License-Identifier: MIT
#pragma once

// LOFT_SANITIZED: compiled for a sanitizer of addresses or threads, which takes time and memory.
// GCC and Clang say so in ways of their own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define LOFT_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define LOFT_SANITIZED
#endif
#endif
