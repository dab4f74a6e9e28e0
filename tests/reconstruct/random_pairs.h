// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reconstruct/options.h"
#include "reconstruct/slice.h"

namespace loft::stacks {

/// Two neighbouring slices and how to fill them.
struct Pair {
  std::vector<Slice> slices;
  Fill fill = Fill::even_odd;
};

/// A pair of the kinds that are hard: crossing polygons, masks, copies that nearly coincide,
/// keyholes, spikes, chains in line and so on. The same seed gives the same pair.
[[nodiscard]] Pair random_pair(std::uint64_t seed);
/// What kind of pair that is, for messages.
[[nodiscard]] std::string kind_of_pair(std::uint64_t seed);

}  // namespace loft::stacks
