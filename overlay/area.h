// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <span>

#include "cdt/exact_sum.h"
#include "cdt/point.h"

namespace loft::overlay {

/// An area without rounding: compared, added and subtracted exactly. Counter-clockwise outlines
/// have positive ones.
class ExactArea {
 public:
  ExactArea() = default;

  /// Adds what is under a directed piece of an outline: summed up along closed outlines, that is
  /// their area (Gauss). Precondition: the coordinates are usable (Triangulation::is_usable).
  void add_piece(cdt::Point from, cdt::Point to) {
    twice_.add_product(from.x, to.y);
    twice_.subtract_product(from.y, to.x);
  }
  void subtract_piece(cdt::Point from, cdt::Point to) { add_piece(to, from); }

  ExactArea& operator+=(const ExactArea& other) {
    twice_ += other.twice_;
    return *this;
  }
  ExactArea& operator-=(const ExactArea& other) {
    twice_ -= other.twice_;
    return *this;
  }
  friend ExactArea operator+(ExactArea a, const ExactArea& b) { return a += b; }
  friend ExactArea operator-(ExactArea a, const ExactArea& b) { return a -= b; }

  /// -1, 0 or +1.
  [[nodiscard]] int sign() const { return twice_.sign(); }
  /// The nearest double, ties to even.
  [[nodiscard]] double to_double() const { return twice_.to_double(-1); }

  friend std::strong_ordering operator<=>(const ExactArea&, const ExactArea&) = default;
  friend bool operator==(const ExactArea&, const ExactArea&) = default;

 private:
  cdt::ExactSum twice_;
};

/// The area inside a closed outline, negative if that is clockwise.
[[nodiscard]] inline ExactArea area(std::span<const cdt::Point> ring) {
  ExactArea result;
  for (std::size_t i = 0; i < ring.size(); ++i)
    result.add_piece(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
  return result;
}

}  // namespace loft::overlay
