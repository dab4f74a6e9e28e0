// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cdt/point.h"

namespace loft {

/// Closed lines through points that they may share: what runs along two of them is there once.
struct OutlineNet {
  std::vector<cdt::Point> points;
  std::vector<std::uint32_t> loop_starts{0};  ///< one more than there are loops
  std::vector<std::uint32_t> loop_vertices;   ///< numbers of points, loop by loop

  [[nodiscard]] std::size_t loop_count() const { return loop_starts.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> loop(std::size_t i) const {
    return std::span(loop_vertices).subspan(loop_starts[i], loop_starts[i + 1] - loop_starts[i]);
  }
  void end_loop() { loop_starts.push_back(static_cast<std::uint32_t>(loop_vertices.size())); }
};

/// The points that each point is joined to, ascending, each once; none is joined to itself.
class Neighbours {
 public:
  explicit Neighbours(const OutlineNet& net);

  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t point) const {
    return std::span(all_).subspan(starts_[point], starts_[point + 1] - starts_[point]);
  }
  /// Every edge once, the smaller end first; ascending.
  [[nodiscard]] const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges() const {
    return edges_;
  }

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> all_;
};

/// The area that a loop turns around to the left, less what it turns around to the right, with its
/// points at these places.
[[nodiscard]] double signed_area(std::span<const std::uint32_t> loop,
                                 std::span<const cdt::Point> places);

}  // namespace loft
