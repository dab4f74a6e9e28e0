// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "overlay/overlay.h"
#include "paths/components.h"
#include "paths/gaps.h"
#include "paths/path.h"

namespace loft::paths {

using cdt::EdgeId;
using cdt::TriangleId;
using cdt::Triangulation;
using cdt::VertexId;
using overlay::LayerId;

/// A straight piece of what blocks the way.
struct Side {
  Point from;
  Point to;
};

/// Where one can go: the places where an expression over the layers of an overlay is true, less
/// walls, lines that nobody crosses. Kept up to date from edit to edit, with the components of what
/// is free, so that it is known at once whether a way leads from one place to another.
///
/// What is free is closed: ways may touch obstacles and walls, run along them and turn at their
/// corners. But **a passage without width is closed**: where two obstacles touch in a point,
/// nothing goes through between them, and nothing through the end of a wall that touches another.
///
/// Cost of follow(): O(triangles made, or that are free now or no longer, and the degrees of their
/// vertices), and for the components see there.
///
/// Reading from several threads at once is safe while nobody edits or follows.
class FreeSpace {
 public:
  /// The overlay must outlive this and stay in its place; it watches the expression, and so an
  /// expression that is true where no layer is, is refused: std::invalid_argument (subtract
  /// obstacles from a frame). All rings and lines of the layers in `walls` are walls.
  FreeSpace(overlay::Overlay& overlay, const overlay::Expression& free,
            std::span<const LayerId> walls = {});
  ~FreeSpace();
  FreeSpace(const FreeSpace&) = delete;
  FreeSpace& operator=(const FreeSpace&) = delete;

  /// Takes over what the last edit, or batch, of the overlay did. After each of them, before
  /// anything is asked; if one was left out, all is built anew.
  void follow();
  /// From now on the gaps between obstacles are kept, too, for queries with a radius above 0. Cost:
  /// a triangulation of its own, of what blocks the way; an edit takes two to three times as long.
  void keep_gaps();
  /// None if they are not kept.
  [[nodiscard]] const Gaps* gaps() const { return gaps_.get(); }
  /// Whether there was an edit since.
  [[nodiscard]] bool is_stale() const { return revision_ != overlay_->revision(); }

  /// Which state of which space this is: no other one in this program ever had that number.
  [[nodiscard]] std::uint64_t state() const { return state_; }
  /// The state before that.
  [[nodiscard]] std::uint64_t state_before() const { return state_before_; }

  [[nodiscard]] const overlay::Overlay& overlay() const { return *overlay_; }
  [[nodiscard]] const Triangulation& mesh() const { return *mesh_; }

  [[nodiscard]] bool is_free(TriangleId t) const { return is_free_[t.index()] != 0; }
  /// The twin of an edge, if it can be crossed from the triangle on its left; none otherwise.
  [[nodiscard]] EdgeId beyond(EdgeId e) const { return beyond_[e.index()]; }
  /// What is free around from(e), on the left of e, if ways turn there: it spans more than half a
  /// turn. The last edge of it counter-clockwise that has it on its left; none if ways do not turn
  /// there.
  [[nodiscard]] EdgeId corner(EdgeId e) const { return corners_[e.index()]; }
  /// What came with the last edit that was followed, of what blocks the way, and what is gone.
  /// Where there are walls, some that stayed may be among what came, and some that never blocked
  /// anything among what is gone.
  [[nodiscard]] std::span<const Side> came() const { return came_; }
  [[nodiscard]] std::span<const Side> gone() const { return gone_; }
  /// Whether these say nothing, as all was built anew.
  [[nodiscard]] bool has_changed_everywhere() const { return has_changed_everywhere_; }
  /// What the last edit did to the border of what is free, walls not counted.
  [[nodiscard]] const overlay::ResultChange& change() const { return overlay_->change(free_); }
  /// The border of what is free, walls not counted.
  [[nodiscard]] std::span<const overlay::BorderEdge> border() const {
    return overlay_->border(free_);
  }
  /// Whether a wall runs along an edge.
  [[nodiscard]] bool is_wall(EdgeId e) const;

  /// The number of the component that a triangle belongs to; Components::none if it is not free.
  [[nodiscard]] std::uint32_t component(TriangleId t) const { return components_.of(t); }
  /// The free triangles that touch a point, put in `found`, in an order that depends on coordinates
  /// alone; none if the point is inside an obstacle or outside of everything. Cost: to locate it,
  /// and at a vertex its degree.
  void triangles_at(Point p, std::vector<TriangleId>& found) const;
  [[nodiscard]] bool is_free(Point p) const;
  /// Whether a way leads from one point to another. Cost: to locate both.
  [[nodiscard]] bool is_reachable(Point from, Point to) const;
  /// Whether a way leads from any of some free triangles to any of others.
  [[nodiscard]] bool is_joined(std::span<const TriangleId> some,
                               std::span<const TriangleId> others) const;

 private:
  void build();
  void touch_changed();
  void touch(TriangleId t);
  void free(TriangleId t);
  void open_sides(TriangleId t);
  void turn_at(VertexId v);
  void list_changes();

  overlay::Overlay* overlay_;
  const Triangulation* mesh_;
  overlay::ResultId free_;
  std::vector<bool> is_wall_layer_;
  std::size_t revision_ = 0;
  std::uint64_t state_ = 0;
  std::uint64_t state_before_ = 0;
  bool has_changed_everywhere_ = true;
  std::vector<Side> came_;
  std::vector<Side> gone_;
  std::vector<std::uint8_t> is_free_;  // by triangle
  std::vector<EdgeId> beyond_;         // by edge
  std::vector<EdgeId> corners_;        // by edge
  Components components_;
  std::unique_ptr<Gaps> gaps_;

  // Of one update.
  std::vector<TriangleId> touched_;
  std::size_t changed_ = 0;  // those of them that have not only moved come first
  std::vector<bool> is_touched_;
  std::vector<VertexId> around_;
  std::vector<bool> is_around_;
};

}  // namespace loft::paths
