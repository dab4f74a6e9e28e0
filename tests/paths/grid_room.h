// SPDX-License-Identifier: MIT
#pragma once

#include <random>
#include <vector>

#include "paths/free_space.h"
#include "tests/overlay/boxes.h"

namespace loft::paths {

/// A room with obstacles and walls at random, on a grid: much of it touches, overlaps, is in line.
/// The grid's unit is `unit`; where that is a decimal, so are the coordinates.
class GridRoom {
 public:
  GridRoom(unsigned seed, int size, double unit = 1) : size_(size), unit_(unit), random_(seed) {
    overlay_.insert(room_, overlay::box(0, 0, size * unit, size * unit));
    const int shapes = 1 + number(size);
    for (int i = 0; i < shapes; ++i) insert_shape();
    const int lines = number(size / 2);
    for (int i = 0; i < lines; ++i) insert_wall();
  }

  [[nodiscard]] FreeSpace free_space() {
    return {overlay_, overlay::Expression(room_) - boxes_, std::vector{walls_}};
  }
  [[nodiscard]] overlay::Overlay& overlay() { return overlay_; }
  [[nodiscard]] std::vector<overlay::RingId>& rings() { return rings_; }

  /// 0 to most.
  [[nodiscard]] int number(int most) {
    return static_cast<int>(random_() % static_cast<unsigned>(most + 1));
  }
  /// On the grid, in the room.
  [[nodiscard]] Point place() {
    const double x = number(size_) * unit_;
    return {x, number(size_) * unit_};
  }
  /// Anywhere in and around the room.
  [[nodiscard]] Point any_place() {
    std::uniform_real_distribution<> coordinate(-0.5 * size_ * unit_, 1.5 * size_ * unit_);
    const double x = coordinate(random_);
    return {x, coordinate(random_)};
  }

  void insert_shape() {
    const Point a = place();
    const Point b = place();
    rings_.push_back(overlay_.insert(
        boxes_, number(2) == 0 ? overlay::Ring{a, b, place()} : overlay::box(a.x, a.y, b.x, b.y)));
  }
  void insert_wall() {
    std::vector<Point> points{place(), place()};
    if (number(1) == 0) points[1].x = points[0].x;
    if (number(2) == 0) points.push_back(place());
    rings_.push_back(overlay_.insert(walls_, points, overlay::open));
  }

 private:
  int size_;
  double unit_;
  std::mt19937 random_;
  overlay::Overlay overlay_;
  LayerId room_ = overlay_.add_layer("room");
  LayerId boxes_ = overlay_.add_layer("boxes", overlay::FillRule::nonzero);
  LayerId walls_ = overlay_.add_layer("walls");
  std::vector<overlay::RingId> rings_;
};

}  // namespace loft::paths
