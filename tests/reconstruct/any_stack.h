// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reconstruct/options.h"
#include "reconstruct/slice.h"

namespace loft::stacks {

/// A stack and what is to be made of it.
struct AnyStack {
  std::vector<Slice> slices;
  Options options;
};

/// Bytes as a stack of two to four slices, every sequence as another one: rooms along corridors
/// with shared and flush sides, in decimals; corners a few last places beside others' sides; sides
/// of many points; outlines of labels; any polygons. Options of every kind. Where the bytes end,
/// zeros follow.
[[nodiscard]] AnyStack stack_from_bytes(std::span<const std::uint8_t> bytes);

/// The same from a seed, which stands for so many bytes that none are missing.
[[nodiscard]] AnyStack stack_from_seed(std::uint64_t seed);

/// What is wrong with the surface or with the region of a slice, whose area has to be that of its
/// contours to 1e-12 of their extent, squared; empty if nothing is.
[[nodiscard]] std::string complaint(const AnyStack& any);

/// As a stack file, behind a line with the options.
[[nodiscard]] std::string as_words(const AnyStack& any);

}  // namespace loft::stacks
