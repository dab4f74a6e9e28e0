// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "cdt/triangulation.h"
#include "mesh/mesh.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/tile/contacts.h"

namespace loft {

/// In which of a slab's two regions an overlay triangle is.
enum class Side : std::uint8_t { none = 0, lower = 1, upper = 2, both = 3 };

/// One of the two slices of a slab.
enum class Level : std::uint8_t { lower, upper };

[[nodiscard]] constexpr Level other(Level level) {
  return level == Level::lower ? Level::upper : Level::lower;
}

/// The space between two neighbouring slices, with its overlay: the loops of both as constraints
/// of one CDT.
class Slab {
 public:
  /// Keeps references to the regions. In the overlay the upper region is moved by `shift`: a shear
  /// of the slab, which place() undoes. `memory` is cleared and used for the overlay.
  /// Cost: that of the CDT.
  Slab(const Region& lower, const Region& upper, cdt::Point shift = {},
       cdt::Triangulation memory = {});

  /// Whether contours come nearer to each other than `contact` without meeting exactly. By rounding
  /// alone those do that had a side or a corner in common until the stack was turned.
  [[nodiscard]] bool has_near_contact(double contact) const;
  /// The slab with an overlay in which such vertices are one and such edges go through them, as if
  /// they met exactly; the tiles have to be tested. None if that would make vertices of one slice
  /// one. See meet_exactly().
  [[nodiscard]] static std::optional<Slab> merged(const Region& lower, const Region& upper,
                                                  cdt::Point shift, double contact,
                                                  unsigned stir = 0);

  [[nodiscard]] const Region& lower() const { return lower_; }
  [[nodiscard]] const Region& upper() const { return upper_; }
  [[nodiscard]] const Region& region(Level level) const {
    return level == Level::lower ? lower_ : upper_;
  }
  [[nodiscard]] double height() const { return upper_.z - lower_.z; }

  [[nodiscard]] const cdt::Triangulation& overlay() const { return overlay_; }
  /// Where an overlay vertex is in space, once it is lifted to height z.
  [[nodiscard]] Vec3 place(cdt::VertexId v, double z) const;

  /// Where a place in space is in the overlay.
  [[nodiscard]] cdt::Point in_overlay(const Vec3& place) const {
    const double share = (place[2] - lower_.z) / height();
    return {place[0] + share * shift_.x, place[1] + share * shift_.y};
  }

  /// Whether rounding has decided nothing: contours of the two slices cross in vertices of their
  /// own, and otherwise meet exactly where they pass through each other's vertices.
  [[nodiscard]] bool is_exact() const;
  /// Whether each slice's loops have its region on their left, by parity: they do not where they
  /// are only some of the loops of a region, and others are missing around them.
  [[nodiscard]] bool is_oriented() const;
  /// Whether a triangle at a crossing is lower than `height`: there rounding may matter.
  [[nodiscard]] bool is_tight(double height) const;

  [[nodiscard]] Side side(cdt::TriangleId t) const { return sides_[t.index()]; }
  /// The side of the triangle left of an edge.
  [[nodiscard]] Side side(cdt::EdgeId e) const { return side(cdt::Triangulation::triangle(e)); }
  /// Whether a triangle is inside exactly one of the two regions.
  [[nodiscard]] bool is_sheet(cdt::EdgeId e) const {
    return side(e) == Side::lower || side(e) == Side::upper;
  }

  /// Whether an edge of a slice's contours runs along e.
  [[nodiscard]] bool is_contour(cdt::EdgeId e, Level level) const;
  /// Which slice a segment of the overlay is an edge of.
  [[nodiscard]] Level level(cdt::SegmentId s) const {
    return s.index() < first_segment(Level::upper) ? Level::lower : Level::upper;
  }
  /// The loop of its slice's region that a segment of the overlay is of.
  [[nodiscard]] std::size_t loop(cdt::SegmentId s) const;
  /// The segments of a slice's contour edge `i`, in the order of `loop_vertices`, are from the
  /// first to before the last of these: one, but where it is led through vertices of the other
  /// slice.
  [[nodiscard]] std::array<cdt::SegmentId, 2> segments(Level level, std::uint32_t i) const {
    const auto& starts = paths_[static_cast<unsigned>(level)].side_starts;
    const std::uint32_t first = first_segment(level);
    if (starts.empty()) return {cdt::SegmentId(first + i), cdt::SegmentId(first + i + 1)};
    return {cdt::SegmentId(first + starts[i]), cdt::SegmentId(first + starts[i + 1])};
  }
  /// The index of an overlay vertex among the points of a slice's region; Origin::none if it is
  /// none of them.
  [[nodiscard]] std::uint32_t index(cdt::VertexId v, Level level) const {
    const auto& indices = level == Level::lower ? lower_index_ : upper_index_;
    return v.index() < indices.size() ? indices[v.index()] : Origin::none;
  }
  /// Whether a vertex is a contour vertex of both slices.
  [[nodiscard]] bool is_column(cdt::VertexId v) const {
    return index(v, Level::lower) != Origin::none && index(v, Level::upper) != Origin::none;
  }
  [[nodiscard]] bool is_vertex(cdt::VertexId v, Level level) const {
    return index(v, level) != Origin::none;
  }

  /// Splits an edge or a triangle of a sheet at a point; none if it is too small for that.
  /// Call refresh() after the last one.
  std::optional<cdt::VertexId> split(cdt::EdgeId e, cdt::Point point);
  std::optional<cdt::VertexId> split(cdt::TriangleId t, cdt::Point point);
  /// Classifies the triangles anew.
  void refresh();
  /// Hands the overlay out, to be the memory of another one. The slab has none from then on.
  [[nodiscard]] cdt::Triangulation release() { return std::move(overlay_); }

 private:
  Slab(const Region& lower, const Region& upper, cdt::Point shift, std::array<LoopPaths, 2> paths);

  [[nodiscard]] std::uint32_t first_segment(Level level) const {
    if (level == Level::lower) return 0;
    return static_cast<std::uint32_t>(paths_[0].points.empty() ? lower_.loop_vertices.size()
                                                               : paths_[0].points.size());
  }
  void note_vertices(Level level);
  [[nodiscard]] bool is_bent(cdt::EdgeId e) const;
  [[nodiscard]] bool is_short_between_slices(cdt::EdgeId e, double contact) const;
  [[nodiscard]] bool is_near_apex(cdt::EdgeId e, double contact) const;
  [[nodiscard]] bool is_lower(cdt::EdgeId e, double height) const;

  const Region& lower_;
  const Region& upper_;
  cdt::Point shift_;
  cdt::Triangulation overlay_;
  std::array<LoopPaths, 2> paths_;  // empty: the loops as they are
  std::vector<Side> sides_;
  std::vector<std::uint32_t> lower_index_;
  std::vector<std::uint32_t> upper_index_;
};

}  // namespace loft
