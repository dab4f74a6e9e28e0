// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cdt/point.h"
#include "io/stacks/read_options.h"
#include "io/volumes/sparse_table.h"
#include "io/volumes/square_outlines.h"

namespace loft::io {

/// A closed line around pixels of a label, which are on its left where rows go up; in pixels, whose
/// centres are whole numbers.
struct PixelOutline {
  std::uint32_t label = 0;
  std::vector<cdt::Point> points;
};

/// Draws what outlines.h says around the pixels of images of one size.
class MaskOutlines {
 public:
  /// Precondition: size_fits(columns, rows).
  MaskOutlines(std::uint32_t columns, std::uint32_t rows, Outline outline);

  /// Whether an image of that size can be worked on.
  [[nodiscard]] static bool size_fits(std::uint32_t columns, std::uint32_t rows);

  /// The label of each pixel, 0 for none, row by row: to be filled in before trace().
  [[nodiscard]] std::span<std::uint32_t> row(std::uint32_t row);

  /// Outlines in the order in which rows meet them. With a level, pixels of a label have a value of
  /// at least that; `values` are those of all pixels. Cost: O(pixels + labels met).
  [[nodiscard]] std::vector<PixelOutline> trace(std::span<const double> values = {},
                                                std::optional<double> level = {});

 private:
  /// Where an outline crosses from a pixel to its neighbour: twice the first pixel's place and
  /// whether the other is above rather than beside it; twice that and whether that other one is
  /// inside rather than the first.
  using Crossing = std::uint32_t;
  struct Start {
    Crossing crossing;
    std::uint32_t label;
  };

  void cross_cell(std::size_t place);
  [[nodiscard]] std::vector<Crossing> take_loop(Crossing start);
  [[nodiscard]] std::vector<PixelOutline> trace_fair();
  void add_squares(std::span<const Crossing> loop, SquareOutlines& squares) const;
  [[nodiscard]] std::array<std::uint32_t, 4> corners(std::size_t place) const;
  /// Of a pixel of the padded image, in the image.
  [[nodiscard]] cdt::Point centre(std::size_t pixel) const;
  [[nodiscard]] cdt::Point iso_point(Crossing crossing) const;
  [[nodiscard]] double share(std::size_t first, std::size_t second) const;
  [[nodiscard]] std::vector<cdt::Point> edge_points(std::span<const Crossing> loop) const;
  [[nodiscard]] std::vector<cdt::Point> iso_points(std::span<const Crossing> loop) const;

  std::uint32_t columns_;
  std::uint32_t rows_;
  std::size_t width_;  ///< with a border of pixels outside all around
  Outline outline_;
  std::vector<std::uint32_t> labels_;
  SparseTable next_;  ///< on its outline, by crossing, and whether the corner is cut
  std::vector<Start> starts_;
  std::span<const double> values_;
  std::optional<double> level_;
};

}  // namespace loft::io
