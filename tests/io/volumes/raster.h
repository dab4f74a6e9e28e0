// SPDX-License-Identifier: MIT
// Which pixels the contours of a slice enclose: what volumes and structure sets are compared with.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/slice.h"

namespace loft::io::testing {

/// Whether pixels' centres are inside of the contours of a label by the even-odd rule, row by row.
/// `to_pixels` leads from a slice's coordinates to pixels, whose centres are whole numbers. It
/// looks a thousandth of a pixel beside the centres, so that points upon them are on one side.
class Raster {
 public:
  Raster(std::size_t columns, std::size_t rows) : columns_(columns), bits_(columns * rows) {}

  void add(const std::vector<cdt::Point>& points,
           const std::function<cdt::Point(const cdt::Point&)>& to_pixels) {
    std::vector<cdt::Point> pixels;
    for (const cdt::Point& point : points) pixels.push_back(to_pixels(point));
    for (std::size_t i = 0; i < pixels.size(); ++i) add(pixels[i], pixels[(i + 1) % pixels.size()]);
  }

  [[nodiscard]] bool operator[](std::size_t pixel) const { return bits_[pixel]; }
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(std::ranges::count(bits_, true));
  }

 private:
  static constexpr double aside = 1e-3;

  /// Changes sides of all pixels to the left of a line.
  void add(const cdt::Point& a, const cdt::Point& b) {
    const double low = std::min(a.y, b.y) - aside;
    const double high = std::max(a.y, b.y) - aside;
    const auto rows = static_cast<double>(bits_.size() / columns_);
    for (double row = std::max(0.0, std::ceil(low)); row < high && row < rows; ++row) {
      const double x = a.x + (row + aside - a.y) * (b.x - a.x) / (b.y - a.y) - aside / 2;
      const double end = std::clamp(std::ceil(x), 0.0, static_cast<double>(columns_));
      const std::size_t first = static_cast<std::size_t>(row) * columns_;
      for (std::size_t i = first; i < first + static_cast<std::size_t>(end); ++i)
        bits_[i] = !bits_[i];
    }
  }

  std::size_t columns_;
  std::vector<bool> bits_;
};

}  // namespace loft::io::testing
