// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include "cdt/predicates.h"
#include "paths/free_space.h"
#include "tests/overlay/boxes.h"

namespace loft::paths {

using overlay::Ring;

/// What random scenes have in common.
enum class Ground {
  decimals,  ///< nothing is in line with anything
  touching,  ///< obstacles share corners, pieces of edges and edges; all is a multiple of 2^-10
  whole,     ///< coordinates are whole numbers, so that much is in line and as far
};
inline constexpr std::array all_grounds{Ground::decimals, Ground::touching, Ground::whole};

/// Convex obstacles and open walls in a room.
struct Scene {
  static constexpr double size = 96;

  Ring room = overlay::box(0, 0, size, size);
  std::vector<Ring> obstacles;
  std::vector<Ring> walls;  // open lines
};

/// A scene in an overlay, and what is free of it.
class Setting {
 public:
  explicit Setting(const Scene& scene) {
    std::vector<overlay::Shape> shapes{{room_, scene.room}};
    for (const Ring& ring : scene.obstacles) shapes.push_back({obstacle_, ring});
    for (const Ring& line : scene.walls) shapes.push_back({wall_, line, overlay::open});
    rings_ = overlay_.insert(shapes);
    space_.follow();
  }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

  /// Obstacles count from 0; walls come after them.
  void move(std::size_t shape, std::span<const Point> points) {
    overlay_.move(rings_[shape + 1], points);
    space_.follow();
  }

  [[nodiscard]] const FreeSpace& space() const { return space_; }
  [[nodiscard]] const overlay::Overlay& overlay() const { return overlay_; }
  [[nodiscard]] std::span<const overlay::RingId> walls() const { return overlay_.rings(wall_); }

 private:
  overlay::Overlay overlay_;
  LayerId room_ = overlay_.add_layer("room");
  LayerId obstacle_ = overlay_.add_layer("obstacles", overlay::FillRule::nonzero);
  LayerId wall_ = overlay_.add_layer("walls");
  FreeSpace space_{overlay_, overlay::Expression(room_) - obstacle_, std::array{wall_}};
  std::vector<overlay::RingId> rings_;
};

/// Makes scenes, and what happens in them. The same seed makes the same on every machine.
class SceneMaker {
 public:
  SceneMaker(std::uint64_t seed, Ground ground) : random_(seed), ground_(ground) {}

  /// A number from 0 to below 1.
  [[nodiscard]] double number() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  [[nodiscard]] double number(double low, double high) { return low + number() * (high - low); }
  [[nodiscard]] std::size_t index(std::size_t bound) { return random_() % bound; }

  [[nodiscard]] Scene scene(std::size_t obstacles, std::size_t walls) {
    Scene scene;
    reach_ = number(0.2, 0.8) * Scene::size / std::sqrt(static_cast<double>(obstacles));
    while (scene.obstacles.size() < obstacles) scene.obstacles.push_back(obstacle(scene));
    while (scene.walls.size() < walls) scene.walls.push_back(wall(scene));
    return scene;
  }

  /// An obstacle for a scene.
  [[nodiscard]] Ring obstacle(const Scene& scene) {
    if (ground_ != Ground::decimals && !scene.obstacles.empty() && number() < 0.4)
      return beside(scene.obstacles[index(scene.obstacles.size())]);
    for (;;) {
      const Point centre = place();
      std::vector<Point> points(3 + index(8));
      for (Point& p : points) p = near(centre);
      if (Ring hull = convex_hull(points); hull.size() > 2) return hull;
    }
  }

  [[nodiscard]] Ring wall(const Scene& scene) {
    Ring line{number() < 0.4 ? place_on(scene) : place()};
    const std::size_t points = 2 + index(3);
    while (line.size() < points) {
      const Point last = line.back();
      const Point next =
          number() < 0.3
              ? place_on(scene)
              : rounded({last.x + number(-1, 1) * 2 * reach_, last.y + number(-1, 1) * 2 * reach_});
      if (next != last) line.push_back(next);
    }
    return line;
  }

  /// Anywhere in a room.
  [[nodiscard]] Point place() { return rounded({number(0, Scene::size), number(0, Scene::size)}); }

  /// A corner of something, or halfway between two that follow each other.
  [[nodiscard]] Point place_on(const Scene& scene) {
    const std::size_t count = scene.obstacles.size() + scene.walls.size();
    if (count == 0) return place();
    const std::size_t i = index(count);
    const bool is_obstacle = i < scene.obstacles.size();
    const Ring& ring = is_obstacle ? scene.obstacles[i] : scene.walls[i - scene.obstacles.size()];
    const std::size_t k = index(ring.size());
    return number() < 0.5 || k + 1 == ring.size() ? ring[k] : middle(ring[k], ring[k + 1]);
  }

  /// Some ends are anywhere, some corners and edges of what is in the scene, or of those given.
  [[nodiscard]] Query query(const Scene& scene, std::span<const Point> corners = {}) {
    const auto end = [&] {
      const std::size_t kind = index(6);
      if (kind == 0) return place_on(scene);
      if (kind == 1 && !corners.empty()) return corners[index(corners.size())];
      return place();
    };
    const Point from = end();
    return {.from = from, .to = end()};
  }

 private:
  [[nodiscard]] static Point middle(Point a, Point b) {
    return {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2};
  }

  [[nodiscard]] Point rounded(Point p) const {
    const double unit = ground_ == Ground::whole ? 1 : 0x1p-10;
    if (ground_ == Ground::decimals) return p;
    return {unit * std::floor(p.x / unit), unit * std::floor(p.y / unit)};
  }
  [[nodiscard]] Point near(Point p) {
    return rounded({p.x + number(-1, 1) * reach_, p.y + number(-1, 1) * reach_});
  }

  /// An obstacle that has a corner, a piece of an edge or an edge of another one's.
  [[nodiscard]] Ring beside(const Ring& other) {
    const std::size_t k = index(other.size());
    const Point a = other[k];
    const Point b = other[(k + 1) % other.size()];
    for (;;) {
      std::vector<Point> points;
      const std::size_t kind = index(4);
      if (kind == 0) points = {a, near(a), near(a)};
      if (kind == 1) points = {middle(a, b), near(a), near(a)};
      if (kind == 2) points = {a, b, near(b)};
      if (kind == 3) points = {a, {2 * b.x - a.x, 2 * b.y - a.y}, near(b)};
      // On the other side of the edge, mostly.
      for (Point& p : points)
        if (cdt::orient(a, b, p) > 0) p = rounded({a.x + b.x - p.x, a.y + b.y - p.y});
      if (Ring hull = convex_hull(points); hull.size() > 2) return hull;
    }
  }

  /// Counter-clockwise, without three in line.
  [[nodiscard]] static Ring convex_hull(std::vector<Point> points) {
    std::ranges::sort(points);
    Ring hull;
    for (int half = 0; half < 2; ++half) {
      const std::size_t start = hull.size();
      for (const Point p : points) {
        while (hull.size() >= start + 2 && cdt::orient(hull[hull.size() - 2], hull.back(), p) <= 0)
          hull.pop_back();
        hull.push_back(p);
      }
      hull.pop_back();
      std::ranges::reverse(points);
    }
    return hull;
  }

  std::mt19937_64 random_;
  Ground ground_;
  double reach_ = 10;
};

}  // namespace loft::paths
