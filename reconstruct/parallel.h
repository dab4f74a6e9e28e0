// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

namespace loft {

/// The number of threads that `wanted` stands for: itself, or all that the machine has if it is 0.
[[nodiscard]] unsigned thread_count(unsigned wanted);

/// Calls body(i, worker) for every i below `count`, in ascending order of their beginnings, with at
/// most `threads` calls at once; each such line of calls has its own `worker` below `threads`, so
/// that it can have memory of its own. With one thread everything happens on the caller's.
///
/// After an exception no further call begins; of those that calls threw, the one of the lowest i is
/// thrown on, which does not depend on the number of threads.
void for_each_index(std::size_t count, unsigned threads,
                    const std::function<void(std::size_t i, unsigned worker)>& body);

}  // namespace loft
