// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <istream>
#include <string_view>

#include "reconstruct/stack.h"

namespace loft::io {

/// Where a line is in its file, in bytes.
struct LinePlace {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
};

/// Reads a stack file slice by slice, lines in parallel, and calls take(slice, place) in their
/// order. Returns what its first line says of the stack, without slices. Throws what
/// read_stack_json() does, after the last slice.
Stack for_each_slice(std::istream& in, std::string_view name, unsigned threads,
                     const std::function<void(Slice&& slice, LinePlace place)>& take);

}  // namespace loft::io
