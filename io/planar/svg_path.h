// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace loft::io {

/// A place in a picture, y downwards.
struct GridPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;

  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

/// The path data (`d`) of SVG for any number of lines and loops, in relative coordinates.
/// Some XML parsers take no attribute beyond 10 MB: long data is cut where nothing is joined.
class SvgPath {
 public:
  void move(GridPoint place);
  /// From the last place; nothing if that is the same.
  void line(GridPoint place);
  /// A loop; nothing if it has no area because it has fewer than three points.
  void loop(const std::vector<GridPoint>& points);
  void dot(GridPoint place);

  /// Data may be cut here.
  void allow_cut();

  /// A path element with these attributes for each piece of data.
  void write(std::ostream& out, std::string_view attributes) const;

 private:
  void append(GridPoint place);

  std::vector<std::string> finished_;
  std::string data_;
  GridPoint at_;
};

}  // namespace loft::io
