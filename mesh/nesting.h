// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace loft {

/// A closed, consistently oriented component of a mesh.
struct Shell {
  std::uint32_t first_face = 0;
  double volume = 0;        ///< signed: positive if its faces look outwards
  double volume_error = 0;  ///< how far rounding may have taken it at most
  std::uint32_t depth = 0;  ///< how many other shells it is inside of
};

/// A face's component where the face takes no part in any shell.
inline constexpr std::uint32_t not_in_a_shell = 0xffff'ffff;

/// The shells of a mesh, in the order of their first faces.
/// `component` holds for each face the first face of its component, or not_in_a_shell; `faces` are
/// the faces with an area.
/// Whether a shell is inside another one is decided exactly, at a corner that it does not share
/// with others (where there is none: at the rounded middle of a face).
/// Precondition: shells meet in common corners and edges only. Otherwise the depth is that of the
/// one corner.
/// Cost: O(n log n), and a search in a tree of the faces a shell.
[[nodiscard]] std::vector<Shell> shells(const Mesh& mesh, std::span<const std::uint32_t> component,
                                        std::span<const std::uint32_t> faces);

}  // namespace loft
