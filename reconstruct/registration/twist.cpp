// SPDX-License-Identifier: MIT
#include "reconstruct/registration/twist.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/vec3.h"

namespace loft {

namespace {

/// Lengths that differ by less than that share may do so by rounding.
constexpr double rounding = 1e-9;

/// A tile at an edge from a vertex of the lower slice to one of the upper.
struct Wing {
  std::uint32_t lower;  // ends of the edge, by nodes
  std::uint32_t upper;
  std::uint32_t apex;
  std::uint32_t tile;
};

/// Two tiles with an edge of each slice; their common edge is one diagonal.
struct Quad {
  Wing below;  // with another vertex of the lower slice
  Wing above;
  double length;  // of the diagonal
};

class Easing {
 public:
  Easing(const Region& lower, const Region& upper, TileSet& tiles)
      : lower_(lower),
        upper_(upper),
        tiles_(tiles),
        lower_count_(static_cast<std::uint32_t>(lower.points.size())),
        contour_count_(lower_count_ + static_cast<std::uint32_t>(upper.points.size())) {}

  void run(double most) {
    const std::vector<Quad> quads = find_quads();
    // A tile may be in two quads: it belongs to that with the longer diagonal, to none of two that
    // are as long.
    std::vector<std::array<double, 2>> longest(tiles_.tiles.size());
    for (const Quad& quad : quads)
      for (const std::uint32_t tile : {quad.below.tile, quad.above.tile}) {
        auto& [first, second] = longest[tile];
        second = std::max(second, std::min(first, quad.length));
        first = std::max(first, quad.length);
      }
    const auto has = [&](std::uint32_t tile, const Quad& quad) {
      return quad.length == longest[tile][0] &&
             longest[tile][1] < (1 - rounding) * longest[tile][0];
    };
    for (const Quad& quad : quads)
      if (has(quad.below.tile, quad) && has(quad.above.tile, quad) && twist(quad) > most)
        split(quad);
  }

 private:
  [[nodiscard]] Vec3 place(std::uint32_t node) const {
    return place_of(lower_, upper_, tiles_.inner, node);
  }

  [[nodiscard]] std::vector<Wing> find_wings() const {
    std::vector<Wing> wings;
    for (std::uint32_t t = 0; t < tiles_.tiles.size(); ++t) {
      const auto& nodes = tiles_.tiles[t].nodes;
      if (std::ranges::max(nodes) >= contour_count_) continue;
      for (unsigned i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(nodes[i], nodes[(i + 1) % 3]);
        if (low < lower_count_ && high >= lower_count_)
          wings.push_back({low, high, nodes[(i + 2) % 3], t});
      }
    }
    std::ranges::sort(wings, {}, [](const Wing& wing) {
      return std::tuple(wing.lower, wing.upper, wing.apex, wing.tile);
    });
    return wings;
  }

  [[nodiscard]] std::vector<Quad> find_quads() const {
    std::vector<Quad> quads;
    const std::vector<Wing> wings = find_wings();
    for (std::size_t i = 0; i + 1 < wings.size(); ++i) {
      const Wing& a = wings[i];
      const Wing& b = wings[i + 1];
      if (a.lower == b.lower && a.upper == b.upper && a.apex < lower_count_ &&
          b.apex >= lower_count_)
        quads.push_back({a, b, length(minus(place(a.lower), place(a.upper)))});
    }
    return quads;
  }

  /// How far the lines through the diagonals pass each other.
  [[nodiscard]] double twist(const Quad& quad) const {
    const Vec3 corner = place(quad.below.lower);
    const Vec3 diagonal = minus(place(quad.below.upper), corner);
    const Vec3 other = minus(place(quad.above.apex), place(quad.below.apex));
    const Vec3 normal = cross(diagonal, other);
    const double size = length(normal);
    return size > 0 ? std::abs(dot(minus(place(quad.below.apex), corner), normal)) / size : 0;
  }

  void split(const Quad& quad) {
    Vec3 middle{};
    for (const std::uint32_t node :
         {quad.below.lower, quad.below.upper, quad.below.apex, quad.above.apex})
      for (unsigned i = 0; i < 3; ++i) middle[i] += place(node)[i] / 4;
    const auto centre = contour_count_ + static_cast<std::uint32_t>(tiles_.inner.size());
    tiles_.inner.push_back({middle, VertexKind::steiner});
    for (const Wing& wing : {quad.below, quad.above}) {
      Tile half = tiles_.tiles[wing.tile];
      std::ranges::replace(half.nodes, wing.lower, centre);
      std::ranges::replace(tiles_.tiles[wing.tile].nodes, wing.upper, centre);
      tiles_.tiles.push_back(half);
    }
  }

  const Region& lower_;
  const Region& upper_;
  TileSet& tiles_;
  std::uint32_t lower_count_;
  std::uint32_t contour_count_;
};

}  // namespace

void ease_twists(const Region& lower, const Region& upper, TileSet& tiles, double most) {
  Easing(lower, upper, tiles).run(most);
}

}  // namespace loft
