// SPDX-License-Identifier: MIT
#include "reconstruct/registration/twist.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesh/vec3.h"
#include "reconstruct/registration/quads.h"

namespace loft {

namespace {

/// Lengths that differ by less than that share may do so by rounding_of_lengths.
constexpr double rounding_of_lengths = 1e-9;

class Easing {
 public:
  Easing(const Region& lower, const Region& upper, TileSet& tiles)
      : lower_(lower), upper_(upper), tiles_(tiles), contour_count_(contour_count(lower, upper)) {}

  void run(double most) {
    const std::vector<Quad> quads = find_quads(lower_, upper_, tiles_);
    // A tile may be in two quads: it belongs to that with the longer diagonal, to none of two that
    // are as long.
    std::vector<std::array<double, 2>> longest(tiles_.tiles.size());
    for (const Quad& quad : quads)
      for (const std::uint32_t tile : {quad.lower_tile, quad.upper_tile}) {
        auto& [first, second] = longest[tile];
        second = std::max(second, std::min(first, diagonal(quad)));
        first = std::max(first, diagonal(quad));
      }
    const auto has = [&](std::uint32_t tile, const Quad& quad) {
      return diagonal(quad) == longest[tile][0] &&
             longest[tile][1] < (1 - rounding_of_lengths) * longest[tile][0];
    };
    for (const Quad& quad : quads)
      if (has(quad.lower_tile, quad) && has(quad.upper_tile, quad) && twist(quad) > most)
        split(quad);
  }

 private:
  [[nodiscard]] Vec3 place(std::uint32_t node) const {
    return place_of(lower_, upper_, tiles_.inner, node);
  }

  [[nodiscard]] double diagonal(const Quad& quad) const {
    return length(minus(place(quad.lower), place(quad.upper)));
  }

  /// How far the lines through the diagonals pass each other.
  [[nodiscard]] double twist(const Quad& quad) const {
    const Vec3 corner = place(quad.lower);
    const Vec3 apex = place(quad.lower_apex);
    const Vec3 normal =
        cross(minus(place(quad.upper), corner), minus(place(quad.upper_apex), apex));
    const double size = length(normal);
    return size > 0 ? std::abs(dot(minus(apex, corner), normal)) / size : 0;
  }

  void split(const Quad& quad) {
    Vec3 middle{};
    for (const std::uint32_t node : {quad.lower, quad.upper, quad.lower_apex, quad.upper_apex})
      for (unsigned i = 0; i < 3; ++i) middle[i] += place(node)[i] / 4;
    const auto centre = contour_count_ + static_cast<std::uint32_t>(tiles_.inner.size());
    tiles_.inner.push_back({middle, VertexKind::steiner});
    for (const std::uint32_t tile : {quad.lower_tile, quad.upper_tile}) {
      Tile half = tiles_.tiles[tile];
      std::ranges::replace(half.nodes, quad.lower, centre);
      std::ranges::replace(tiles_.tiles[tile].nodes, quad.upper, centre);
      tiles_.tiles.push_back(half);
    }
  }

  const Region& lower_;
  const Region& upper_;
  TileSet& tiles_;
  std::uint32_t contour_count_;
};

}  // namespace

void ease_twists(const Region& lower, const Region& upper, TileSet& tiles, double most) {
  Easing(lower, upper, tiles).run(most);
}

}  // namespace loft
