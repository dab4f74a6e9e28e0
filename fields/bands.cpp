// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "fields/isolines.h"
#include "fields/level.h"
#include "overlay/boolean.h"

namespace loft::fields {

namespace {

/// A straight piece of a border, what it is of on its left.
struct BorderPiece {
  Point from;
  Point to;
  friend auto operator<=>(const BorderPiece&, const BorderPiece&) = default;
};

/// Gathers the border of a band, triangle by triangle.
class Outliner {
 public:
  Outliner(const Field& field, double low, double high)
      : field_(field), low_(field, low), high_(field, high) {}

  [[nodiscard]] std::vector<BorderPiece> run() {
    const Triangulation& mesh = field_.mesh();
    for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i)
      if (has_surface(field_, TriangleId(i))) outline(TriangleId(i));
    return std::move(pieces_);
  }

 private:
  void add(Point from, Point to) {
    if (from != to) pieces_.push_back({from, to});
  }
  void outline(TriangleId t) {
    if (const EdgeId e = low_.falling_edge(t); !e.is_none())
      add(low_.crossing(e), low_.crossing(low_.rising_edge(e)));
    if (const EdgeId e = high_.falling_edge(t); !e.is_none())
      add(high_.crossing(high_.rising_edge(e)), high_.crossing(e));
    for (unsigned corner = 0; corner < 3; ++corner)
      if (const EdgeId e = Triangulation::edge(t, corner); field_.is_separating(e)) border_on(e);
  }
  /// The part of an edge that is in the band on its left, less what is so on its right as well.
  void border_on(EdgeId e) {
    const BorderPiece here = inside(e);
    if (here.from == here.to) return;
    const EdgeId twin = field_.mesh().twin(e);
    const bool has_twin = has_surface(field_, Triangulation::triangle(twin));
    const BorderPiece there = has_twin ? inside(twin) : BorderPiece{};
    if (there.from == there.to) return add(here.from, here.to);
    // Both as they go along e.
    const auto comes_before = [&](Point p, Point q) {
      return (here.from < here.to) == (p < q) && p != q;
    };
    const Point first = comes_before(there.to, here.to) ? there.to : here.to;
    if (comes_before(here.from, first)) add(here.from, first);
    const Point second = comes_before(here.from, there.from) ? there.from : here.from;
    if (comes_before(second, here.to)) add(second, here.to);
  }
  [[nodiscard]] bool is_in(EdgeId e) const { return low_.is_above(e) && !high_.is_above(e); }
  /// In the edge's direction; nothing: from equals to.
  [[nodiscard]] BorderPiece inside(EdgeId e) const {
    const EdgeId end = Triangulation::next(e);
    const Point from = field_.mesh().point(field_.mesh().from(e));
    const Point to = field_.mesh().point(field_.mesh().to(e));
    if (!low_.is_above(e) && !low_.is_above(end)) return {from, from};
    if (high_.is_above(e) && high_.is_above(end)) return {from, from};
    BorderPiece piece{from, to};
    if (!is_in(e)) piece.from = high_.is_above(e) ? high_.crossing(e) : low_.crossing(e);
    if (!is_in(end)) piece.to = high_.is_above(end) ? high_.crossing(e) : low_.crossing(e);
    return piece;
  }

  const Field& field_;
  Level low_;
  Level high_;
  std::vector<BorderPiece> pieces_;
};

/// Rings of pieces, each beginning where the one before ends. Every point has as many that end
/// there as begin.
std::vector<overlay::Ring> rings_of(std::vector<BorderPiece> pieces) {
  std::sort(pieces.begin(), pieces.end());
  std::vector<bool> is_used(pieces.size());
  const auto next_from = [&](Point p) {
    auto i = static_cast<std::size_t>(
        std::lower_bound(pieces.begin(), pieces.end(), p,
                         [](const BorderPiece& piece, Point q) { return piece.from < q; }) -
        pieces.begin());
    while (i < pieces.size() && pieces[i].from == p && is_used[i]) ++i;
    return i < pieces.size() && pieces[i].from == p ? i : pieces.size();
  };
  std::vector<overlay::Ring> rings;
  for (std::size_t start = 0; start < pieces.size(); ++start) {
    if (is_used[start]) continue;
    overlay::Ring& ring = rings.emplace_back();
    for (std::size_t i = start; i < pieces.size(); i = next_from(pieces[i].to)) {
      is_used[i] = true;
      ring.push_back(pieces[i].from);
    }
  }
  return rings;
}

}  // namespace

std::vector<Band> bands(const Field& field, std::span<const double> levels) {
  std::vector<Band> result;
  for (std::size_t i = 0; i + 1 < levels.size(); ++i)
    result.push_back({levels[i], levels[i + 1],
                      overlay::fill(rings_of(Outliner(field, levels[i], levels[i + 1]).run()),
                                    overlay::FillRule::nonzero)});
  return result;
}

}  // namespace loft::fields
