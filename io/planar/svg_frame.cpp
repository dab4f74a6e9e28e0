// SPDX-License-Identifier: MIT
#include "io/planar/svg_frame.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

/// `1200`, `612.25`
std::string to_pixels(double steps) {
  std::string text;
  append_number(text, std::round(steps) / SvgFrame::steps_per_pixel);
  return text;
}

}  // namespace

SvgFrame::SvgFrame(cdt::Box box, double width, Upwards upwards)
    : is_y_down_(upwards == Upwards::minus_y) {
  if (box.is_empty()) box.add({});
  const double across = box.high.x - box.low.x;
  const double up = box.high.y - box.low.y;
  unit_ = std::max(across, up / tallest);
  if (unit_ == 0) unit_ = 1;
  const double margin = 0.01 * width;
  scale_ = (width - 2 * margin) * steps_per_pixel;
  width_ = width * steps_per_pixel;
  height_ = 2 * margin * steps_per_pixel + up / unit_ * scale_;
  left_ = {box.low.x, (width_ - across / unit_ * scale_) / 2};
  top_ = {is_y_down_ ? box.low.y : box.high.y, margin * steps_per_pixel};
}

GridPoint SvgFrame::operator()(const cdt::Point& point) const {
  const double down = is_y_down_ ? point.y - top_.side : top_.side - point.y;
  const double x = left_.margin + (point.x - left_.side) / unit_ * scale_;
  const double y = top_.margin + down / unit_ * scale_;
  return {std::llround(x), std::llround(y)};
}

std::string SvgFrame::opening() const {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + to_pixels(width_) + "\" height=\"" +
         to_pixels(height_) + "\" viewBox=\"0 0 " + whole_steps(width_) + ' ' +
         whole_steps(height_) +
         "\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
}

std::string whole_steps(double steps) {
  std::string text;
  append_number(text, std::llround(steps));
  return text;
}

}  // namespace loft::io
