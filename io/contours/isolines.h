// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/slice.h"

namespace loft::io {

/// A line of equal height; a closed one does not repeat its first point.
struct Isoline {
  std::vector<cdt::Point> points;
  double z = 0;
  bool is_closed = false;
  std::string source;
  std::string label = {};
};

/// Joins open lines of one height that end in the same point, where no third one does.
void join_isolines(std::vector<Isoline>& lines);

/// The slices of a terrain that lies in the box of all lines: at each height the outlines of what
/// is higher. Lines that end at the border are closed along it, round the side on which the lines
/// of other heights say that it is higher. Precondition: `lines` are not empty.
///
/// Throws InputError that names `name` where lines end inside the box, with their number.
/// Cost: O(n log n).
[[nodiscard]] std::vector<Slice> close_along_border(const std::vector<Isoline>& lines,
                                                    std::string_view name);

}  // namespace loft::io
