// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cdt/point.h"
#include "io/planar/svg_path.h"

namespace loft::io {

/// Where the second coordinate of a plane grows to.
enum class Upwards { y, minus_y };

/// Where the points of the plane are in a picture, in steps of a hundredth of a pixel.
class SvgFrame {
 public:
  static constexpr double steps_per_pixel = 100;

  /// Shows a box, with a small margin, in a picture of that width in pixels; the height follows.
  SvgFrame(cdt::Box box, double width, Upwards upwards = Upwards::y);

  [[nodiscard]] GridPoint operator()(const cdt::Point& point) const;
  [[nodiscard]] double width() const { return width_; }
  [[nodiscard]] double height() const { return height_; }
  /// A length in the plane, in steps.
  [[nodiscard]] double length(double in_plane) const { return in_plane / unit_ * scale_; }

  /// The tag that begins the picture: its size in pixels, and the steps that it is drawn in.
  [[nodiscard]] std::string opening() const;

 private:
  static constexpr double tallest = 4;  // heights a width: thin and high things get narrow

  struct Side {
    double side = 0;
    double margin = 0;
  };

  double unit_ = 1;  // the length that is as wide as the picture without its margins
  double scale_ = 1;
  double width_ = 1;
  double height_ = 1;
  bool is_y_down_;
  Side left_;
  Side top_;
};

/// A number of steps without its fraction.
[[nodiscard]] std::string whole_steps(double steps);

}  // namespace loft::io
