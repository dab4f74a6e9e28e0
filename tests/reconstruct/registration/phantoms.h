// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reconstruct/options.h"
#include "reconstruct/slice.h"

namespace loft::stacks {

/// Solids that move, turn, fold or fork on their way up.
enum class PhantomKind : std::uint8_t {
  tube,      ///< round, along a random curve, of random radius
  fork,      ///< a tube that becomes two
  membrane,  ///< a sheet along a wave whose folds travel
  blade,     ///< a bar much longer than it is thick, that turns
  walls,     ///< one to three nested walls, each all the way round, that drift together
};
inline constexpr std::array phantom_kinds{PhantomKind::tube, PhantomKind::fork,
                                          PhantomKind::membrane, PhantomKind::blade,
                                          PhantomKind::walls};
[[nodiscard]] const char* name(PhantomKind kind);

/// A stack cut from a solid of which everything is known.
struct Phantom {
  PhantomKind kind = PhantomKind::tube;
  std::vector<Slice> slices;
  Options options;
  double shift = 0;  ///< the farthest that a point of it moves from slice to slice, in thicknesses
  /// The truth, between the first slice and the last.
  std::size_t components = 1;
  int genus = 0;  ///< the sum over the components
  double volume = 0;
};

/// Kinds in turn; cut so densely or sparsely that the shift is 0.05 to 2.25.
[[nodiscard]] Phantom phantom_from_seed(std::uint64_t seed);

}  // namespace loft::stacks
