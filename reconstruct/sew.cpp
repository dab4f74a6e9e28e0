// SPDX-License-Identifier: MIT
#include "reconstruct/sew.h"

#include <algorithm>
#include <utility>

#include "reconstruct/caps.h"
#include "reconstruct/soup.h"

namespace loft {

namespace {

/// All vertices and faces: slice, inner vertices of the slab above it, next slice, and so on.
class Gathering {
 public:
  Gathering(std::span<const Region> regions, std::span<const TileSet> slabs)
      : regions_(regions), slabs_(slabs) {}

  Soup run(Cap cap) {
    reserve();
    for (std::uint32_t i = 0; i < regions_.size(); ++i) {
      add_slice(regions_[i]);
      if (i >= slabs_.size()) continue;
      add_inner(slabs_[i], regions_[i].slice);
      soup_.slab_slices.push_back(regions_[i].slice);
    }
    if (cap == Cap::flat) add_cap(0, FaceKind::bottom_cap);
    for (std::uint32_t i = 0; i < slabs_.size(); ++i) add_tiles(i);
    if (cap == Cap::flat)
      add_cap(static_cast<std::uint32_t>(regions_.size() - 1), FaceKind::top_cap);
    return std::move(soup_);
  }

 private:
  void reserve() {
    std::size_t points = 0;
    std::size_t faces = 0;
    for (const Region& region : regions_) points += region.points.size();
    for (const TileSet& slab : slabs_) {
      points += slab.inner.size();
      faces += slab.tiles.size();
    }
    soup_.points.reserve(points);
    soup_.origins.reserve(points);
    soup_.faces.reserve(faces);
  }

  [[nodiscard]] std::uint32_t point_count() const {
    return static_cast<std::uint32_t>(soup_.points.size());
  }

  void add_slice(const Region& region) {
    slice_starts_.push_back(point_count());
    for (const cdt::Point p : region.points) soup_.points.push_back({p.x, p.y, region.z});
    soup_.origins.insert(soup_.origins.end(), region.origins.begin(), region.origins.end());
  }

  void add_inner(const TileSet& slab, std::uint32_t slice) {
    inner_starts_.push_back(point_count());
    for (const InnerVertex& vertex : slab.inner) {
      soup_.points.push_back(vertex.place);
      soup_.origins.push_back({vertex.kind, slice, Origin::none, Origin::none});
    }
  }

  void add_tiles(std::uint32_t i) {
    const auto lower = static_cast<std::uint32_t>(regions_[i].points.size());
    const auto contour = lower + static_cast<std::uint32_t>(regions_[i + 1].points.size());
    for (const Tile& tile : slabs_[i].tiles) {
      Soup::Face face{tile.nodes, tile.kind, i};
      for (std::uint32_t& node : face.corners) {
        if (node < lower) {
          node += slice_starts_[i];
        } else if (node < contour) {
          node += slice_starts_[i + 1] - lower;
        } else {
          node += inner_starts_[i] - contour;
        }
      }
      soup_.faces.push_back(face);
    }
  }

  void add_cap(std::uint32_t i, FaceKind kind) {
    const auto slab = std::min(i, static_cast<std::uint32_t>(slabs_.size() - 1));
    for (auto [a, b, c] : flat_cap(regions_[i])) {
      if (kind == FaceKind::bottom_cap) std::swap(a, b);
      const std::uint32_t start = slice_starts_[i];
      soup_.faces.push_back({{a + start, b + start, c + start}, kind, slab});
    }
  }

  std::span<const Region> regions_;
  std::span<const TileSet> slabs_;
  Soup soup_;
  std::vector<std::uint32_t> slice_starts_;  // the first vertex of each slice
  std::vector<std::uint32_t> inner_starts_;  // the first inner vertex of each slab
};

/// Fills the mesh's connectivity directly: mates are known, so that nothing has to be searched for
/// and nothing can be refused.
class Assembly {
 public:
  Assembly(const Soup& soup, const Mates& mates) : soup_(soup), mates_(mates) {}

  Surface run() {
    surface_.reserve(soup_.points.size(), mates_.size() / 2 + 1, soup_.faces.size());
    add_vertices();
    add_edges();
    add_faces();
    close_rims();
    return std::move(surface_);
  }

 private:
  using Halfedge = Surface::HalfedgeHandle;

  void add_vertices() {
    for (std::size_t v = 0; v < soup_.points.size(); ++v) {
      const Vec3& p = soup_.points[v];
      surface_.data(surface_.add_vertex({p[0], p[1], p[2]})).origin = soup_.origins[v];
    }
  }

  [[nodiscard]] static Surface::VertexHandle vertex(std::uint32_t v) {
    return Surface::VertexHandle(static_cast<int>(v));
  }

  void add_edges() {
    halfedges_.resize(mates_.size());
    for (std::uint32_t h = 0; h < mates_.size(); ++h) {
      if (mates_[h] < h) continue;
      const auto& corners = soup_.faces[h / 3].corners;
      halfedges_[h] = surface_.new_edge(vertex(corners[h % 3]), vertex(corners[(h + 1) % 3]));
      const Halfedge opposite = surface_.opposite_halfedge_handle(halfedges_[h]);
      if (mates_[h] == no_mate) {
        surface_.set_boundary(opposite);
        rims_.push_back(opposite);
      } else {
        halfedges_[mates_[h]] = opposite;
      }
    }
  }

  void add_faces() {
    for (std::uint32_t f = 0; f < soup_.faces.size(); ++f) {
      const auto face = surface_.new_face();
      surface_.data(face).kind = soup_.faces[f].kind;
      surface_.data(face).slab = soup_.faces[f].slab;
      surface_.set_halfedge_handle(face, halfedges_[3 * f]);
      for (std::uint32_t i = 0; i < 3; ++i) {
        const Halfedge h = halfedges_[3 * f + i];
        surface_.set_face_handle(h, face);
        surface_.set_next_halfedge_handle(h, halfedges_[3 * f + (i + 1) % 3]);
        surface_.set_halfedge_handle(surface_.from_vertex_handle(h), h);
      }
    }
  }

  /// An open surface: each vertex of a rim has one half-edge of the rim leaving it.
  void close_rims() {
    for (const Halfedge h : rims_) surface_.set_halfedge_handle(surface_.from_vertex_handle(h), h);
    for (const Halfedge h : rims_)
      surface_.set_next_halfedge_handle(h, surface_.halfedge_handle(surface_.to_vertex_handle(h)));
  }

  const Soup& soup_;
  const Mates& mates_;
  Surface surface_;
  std::vector<Halfedge> halfedges_;  // of each half-edge of the soup
  std::vector<Halfedge> rims_;
};

}  // namespace

Surface sew(std::span<const Region> regions, std::span<const TileSet> slabs, Cap cap) {
  Soup soup = Gathering(regions, slabs).run(cap);
  const Mates mates = separate_touching(soup);
  return Assembly(soup, mates).run();
}

}  // namespace loft
