// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "tests/cdt/edits.h"

namespace loft::cdt {

/// Bytes as edits. The first byte chooses the ground, then every edit has a byte for what it is, a
/// few for its numbers. There is no invalid input; it ends where the bytes end.
class EditBytes {
 public:
  explicit EditBytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    ground_ = static_cast<Ground>(byte() % 4);
  }

  [[nodiscard]] bool is_on_grid() const {
    return ground_ == Ground::integers || ground_ == Ground::small_integers;
  }

  [[nodiscard]] Script script() {
    Script script;
    while (!bytes_.empty() && script.size() < most_edits) {
      const Edit edit = next();
      if (!applies(edit, constraints_)) continue;
      undo_.push_back(inverse(edit, constraints_));
      carry_out(edit, constraints_);
      script.push_back(edit);
    }
    return script;
  }

 private:
  enum class Ground { integers, small_integers, thirds, nudged };
  static constexpr std::size_t most_edits = 40;

  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
  }

  [[nodiscard]] Edit next() {
    const unsigned what = byte();
    const std::size_t name = what / 8 % 8;
    switch (what % 8) {
      case 0:
        return {Edit::Kind::remove, name, {}, {}};
      case 1:
        return {Edit::Kind::move, name, {points(), open}, {}};
      case 2:
        return {Edit::Kind::translate, name, {}, stride()};
      case 3:
        return undone();
      default:
        return {Edit::Kind::insert, name, {points(), what < 128 ? open : closed}, {}};
    }
  }

  /// Takes back the last edit that has not been taken back.
  [[nodiscard]] Edit undone() {
    if (undo_.empty()) return {Edit::Kind::remove, constraints_.size() + 8, {}, {}};
    const Edit edit = undo_.back();
    undo_.pop_back();
    return edit;
  }

  [[nodiscard]] std::vector<Point> points() {
    std::vector<Point> points(1 + byte() % 7);
    for (Point& p : points) p = point();
    return points;
  }

  [[nodiscard]] Point point() {
    const unsigned both = byte();
    const unsigned size = ground_ == Ground::small_integers ? 4 : 8;
    const Point p{both % 16 % size * 1.0, both / 16 % size * 1.0};
    if (ground_ == Ground::thirds) return {p.x / 3, p.y / 3};
    if (ground_ != Ground::nudged) return p;
    const unsigned nudges = byte();
    return {nudged(1 + p.x, nudges % 16), nudged(1 + p.y, nudges / 16)};  // steps at 0 underflow
  }

  /// Up to three steps in the last place up or down; mostly none.
  [[nodiscard]] static double nudged(double x, unsigned nudge) {
    const double to = std::numeric_limits<double>::infinity() * (nudge < 4 ? 1 : -1);
    for (unsigned i = nudge % 4; nudge < 8 && i > 0; --i) x = std::nextafter(x, to);
    return x;
  }

  [[nodiscard]] Point stride() {
    const unsigned both = byte();
    const Point by{both % 16 - 8.0, both / 16 - 8.0};
    return ground_ == Ground::integers || ground_ == Ground::small_integers
               ? by
               : Point{by.x / 16, by.y / 16};
  }

  std::span<const std::uint8_t> bytes_;
  Ground ground_;
  Constraints constraints_;
  std::vector<Edit> undo_;
};

}  // namespace loft::cdt
