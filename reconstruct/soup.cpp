// SPDX-License-Identifier: MIT
#include "reconstruct/soup.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "cdt/predicates.h"
#include "reconstruct/predicates.h"

namespace loft {

namespace {

class Separation {
 public:
  explicit Separation(Soup& soup) : soup_(soup) {}

  Mates run() {
    mates_.assign(3 * soup_.faces.size(), no_mate);
    pair_half_edges();
    split_vertices();
    split_double_edges();
    return std::move(mates_);
  }

 private:
  struct End {
    std::uint32_t high;  // the larger vertex of an edge
    std::uint32_t half_edge;
  };

  [[nodiscard]] std::uint32_t from(std::uint32_t h) const {
    return soup_.faces[h / 3].corners[h % 3];
  }
  [[nodiscard]] std::uint32_t to(std::uint32_t h) const { return from(next(h)); }
  [[nodiscard]] static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  [[nodiscard]] std::uint32_t apex(std::uint32_t h) const { return from(next(next(h))); }
  [[nodiscard]] std::uint32_t half_edge_count() const {
    return static_cast<std::uint32_t>(3 * soup_.faces.size());
  }

  /// Sorts the half-edges by their smaller vertex, then by the larger one.
  void pair_half_edges() {
    std::vector<std::uint32_t> starts(soup_.points.size() + 1);
    for (std::uint32_t h = 0; h < half_edge_count(); ++h) ++starts[std::min(from(h), to(h)) + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<End> ends(half_edge_count());
    std::vector<std::uint32_t> free(starts.begin(), starts.end() - 1);
    for (std::uint32_t h = 0; h < half_edge_count(); ++h)
      ends[free[std::min(from(h), to(h))]++] = {std::max(from(h), to(h)), h};

    for (std::size_t v = 0; v + 1 < starts.size(); ++v) {
      const auto around = std::span(ends).subspan(starts[v], starts[v + 1] - starts[v]);
      std::ranges::sort(around, [](const End& a, const End& b) {
        return a.high != b.high ? a.high < b.high : a.half_edge < b.half_edge;
      });
      for (std::size_t i = 0; i < around.size();) {
        std::size_t j = i + 1;
        while (j < around.size() && around[j].high == around[i].high) ++j;
        pair(around.subspan(i, j - i));
        i = j;
      }
    }
  }

  void join(std::uint32_t a, std::uint32_t b) {
    mates_[a] = b;
    mates_[b] = a;
  }

  void pair(std::span<const End> edge) {
    if (edge.size() == 2) join(edge[0].half_edge, edge[1].half_edge);
    if (edge.size() > 2) pair_across_solid(edge);
  }

  /// Around the edge p -> q, counter-clockwise, a face with the half-edge p -> q looks ahead: the
  /// solid is between it and the face before it.
  void pair_across_solid(std::span<const End> edge) {
    std::vector<std::uint32_t> sorted;
    for (const End& end : edge) sorted.push_back(end.half_edge);
    const std::uint32_t first = sorted.front();
    const Vec3 p = soup_.points[from(first)];
    const Vec3 q = soup_.points[to(first)];
    const Vec3 reference = soup_.points[apex(first)];
    const auto quarter = [&](std::uint32_t h) {
      const Vec3& r = soup_.points[apex(h)];
      const int side = orient3d(p, q, reference, r);
      if (side != 0) return side > 0 ? 1 : 3;
      return on_same_side(p, q, reference, r) ? 0 : 2;
    };
    std::ranges::sort(sorted, [&](std::uint32_t a, std::uint32_t b) {
      const int qa = quarter(a);
      const int qb = quarter(b);
      if (qa != qb) return qa < qb;
      return orient3d(p, q, soup_.points[apex(a)], soup_.points[apex(b)]) > 0;
    });
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      const std::uint32_t before = sorted[(i + sorted.size() - 1) % sorted.size()];
      if (from(sorted[i]) == from(first) && from(before) != from(first)) join(sorted[i], before);
    }
    crowded_.push_back(std::move(sorted));
  }

  /// For r and s in a plane with the line pq: whether both are on the same side of it.
  [[nodiscard]] static bool on_same_side(const Vec3& p, const Vec3& q, const Vec3& r,
                                         const Vec3& s) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const auto flat = [axis](const Vec3& v) {
        return cdt::Point{v[(axis + 1) % 3], v[(axis + 2) % 3]};
      };
      const int side = cdt::orient(flat(p), flat(q), flat(r));
      if (side != 0) return side == cdt::orient(flat(p), flat(q), flat(s));
    }
    return true;
  }

  /// Corners of one vertex that mates connect are one fan: each fan gets a vertex of its own.
  void split_vertices() {
    std::vector<std::uint32_t> fan(half_edge_count());  // union-find over corners
    std::iota(fan.begin(), fan.end(), 0);
    const auto root = [&fan](std::uint32_t corner) {
      while (fan[corner] != corner) corner = fan[corner] = fan[fan[corner]];
      return corner;
    };
    const auto unite = [&](std::uint32_t a, std::uint32_t b) {
      a = root(a);
      b = root(b);
      fan[std::max(a, b)] = std::min(a, b);
    };
    for (std::uint32_t h = 0; h < half_edge_count(); ++h) {
      if (mates_[h] == no_mate || mates_[h] < h) continue;
      unite(h, next(mates_[h]));
      unite(next(h), mates_[h]);
    }
    std::vector<std::uint32_t> fan_of(soup_.points.size(), no_mate);
    std::vector<std::uint32_t> vertex_of(half_edge_count(), no_mate);
    for (std::uint32_t h = 0; h < half_edge_count(); ++h) {
      const std::uint32_t r = root(h);
      if (vertex_of[r] == no_mate) {
        const std::uint32_t v = from(r);
        if (fan_of[v] == no_mate) {
          fan_of[v] = r;
          vertex_of[r] = v;
        } else {
          vertex_of[r] = copy_vertex(v);
        }
      }
      vertex_of[h] = vertex_of[r];
    }
    for (std::uint32_t h = 0; h < half_edge_count(); ++h)
      soup_.faces[h / 3].corners[h % 3] = vertex_of[h];
  }

  std::uint32_t copy_vertex(std::uint32_t v) {
    soup_.points.push_back(Vec3(soup_.points[v]));
    soup_.origins.push_back(Origin(soup_.origins[v]));
    return static_cast<std::uint32_t>(soup_.points.size() - 1);
  }

  /// Where edges at one place still join the same two vertices, all that are there get midpoints,
  /// so that they go on touching corner by corner.
  void split_double_edges() {
    const auto ends = [this](std::uint32_t h) {
      return std::pair(std::min(from(h), to(h)), std::max(from(h), to(h)));
    };
    for (const auto& half_edges : crowded_) {
      std::vector<std::uint32_t> edges;
      for (std::uint32_t h : half_edges) {
        for (auto to = moved_.find(h); to != moved_.end(); to = moved_.find(h)) h = to->second;
        if (mates_[h] != no_mate && h < mates_[h]) edges.push_back(h);
      }
      std::ranges::sort(edges, {}, ends);
      if (std::ranges::adjacent_find(edges, {}, ends) == edges.end()) continue;
      for (const std::uint32_t h : edges) split_edge(h);
    }
  }

  /// A midpoint on the edge of h: both its faces are cut in two.
  void split_edge(std::uint32_t h) {
    const std::uint32_t g = mates_[h];
    const Vec3 p = soup_.points[from(h)];
    const Vec3 q = soup_.points[to(h)];
    const auto middle = static_cast<std::uint32_t>(soup_.points.size());
    soup_.points.push_back(
        {p[0] + (q[0] - p[0]) / 2, p[1] + (q[1] - p[1]) / 2, p[2] + (q[2] - p[2]) / 2});
    soup_.origins.push_back({VertexKind::steiner, soup_.slab_slices[soup_.faces[h / 3].slab],
                             Origin::none, Origin::none});
    const std::uint32_t h_half = cut(h, middle);
    const std::uint32_t g_half = cut(g, middle);
    join(h, g_half);
    join(g, h_half);
  }

  /// Cuts the face of h from the new vertex to the corner opposite. h keeps the first half of its
  /// edge; returns the half-edge on the second one.
  std::uint32_t cut(std::uint32_t h, std::uint32_t middle) {
    const auto f = static_cast<std::uint32_t>(soup_.faces.size());
    const std::uint32_t n = next(h);
    soup_.faces.push_back(Soup::Face(soup_.faces[h / 3]));
    soup_.faces[f].corners = {middle, from(n), apex(h)};
    mates_.resize(3 * soup_.faces.size(), no_mate);
    if (mates_[n] != no_mate) {
      join(3 * f + 1, mates_[n]);
    }
    soup_.faces[h / 3].corners[n % 3] = middle;
    moved_[n] = 3 * f + 1;
    join(n, 3 * f + 2);
    return 3 * f;
  }

  Soup& soup_;
  Mates mates_;
  std::map<std::uint32_t, std::uint32_t> moved_;     // half-edges that cuts gave another number
  std::vector<std::vector<std::uint32_t>> crowded_;  // half-edges where more than two faces meet
};

}  // namespace

Mates separate_touching(Soup& soup) { return Separation(soup).run(); }

}  // namespace loft
