// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cdt/triangulation.h"
#include "overlay/area.h"
#include "overlay/border.h"
#include "overlay/expression.h"
#include "overlay/layer.h"
#include "overlay/polygon.h"
#include "overlay/trace.h"

namespace loft::overlay {

/// What to insert. A view: the points belong to someone else.
struct Shape {
  LayerId layer;
  std::span<const Point> points;
  Ends ends = closed;
};

/// What the last edit did to a result. Pieces that are as before are in neither list, whatever
/// happened to the triangles beside them. In no order.
struct ResultChange {
  std::vector<BorderEdge> gone;  ///< their ids name nothing any more
  std::vector<BorderEdge> come;
  ExactArea area;  ///< by how much it has grown

  [[nodiscard]] bool is_empty() const { return gone.empty() && come.empty(); }
};

/// Which layers are at a place, each list sorted.
struct Cover {
  std::vector<LayerId> inside;        ///< all around the place
  std::vector<LayerId> on_border_of;  ///< on one side and not on another

  friend bool operator==(const Cover&, const Cover&) = default;
};

/// Which vertices the rings of polygons have.
enum class Vertices {
  needed,  ///< without those on a straight way along one inserted segment
  all,     ///< every vertex of the triangulation on the way
};

/// Layers of rings and lines that come, move and go, in one triangulation; which layers cover which
/// place; and results of expressions over the layers, kept up to date from edit to edit.
///
/// Anything goes in: rings that cross, overlap, repeat and touch one another and themselves,
/// spikes, equal layers. Every coordinate must be usable (cdt::Triangulation::is_usable). There is
/// no grid and no epsilon: the only rounding is that of crossing points, to the nearest double.
///
/// Guarantees. Everything said here is a function of what is in the layers, bit for bit, whatever
/// was edited before, where triangulation().snaps() is empty. Results fit together, as all are
/// unions of the same triangles: |A or B| + |A and B| = |A| + |B| holds exactly, and so does every
/// such law, at any time.
///
/// Cost of an edit: that of the triangulation, then O(made + changed) for the triangles that are
/// made and those whose windings change, times the results watched; never O(all).
///
/// Reading from several threads at once is safe while none edits. An overlay is moved, not copied;
/// what has been moved from can only be assigned to and destroyed.
class Overlay {
 public:
  Overlay();
  ~Overlay();
  Overlay(Overlay&&) noexcept;
  Overlay& operator=(Overlay&&) noexcept;

  // Layers. Their ids count up from 0 and stay.
  LayerId add_layer(std::string name, FillRule rule = FillRule::even_odd);
  [[nodiscard]] std::size_t layer_count() const;
  [[nodiscard]] const std::string& name(LayerId layer) const;
  [[nodiscard]] FillRule rule(LayerId layer) const;
  /// The rings and lines of a layer, in no order.
  [[nodiscard]] std::span<const RingId> rings(LayerId layer) const;
  /// Precondition: the id names a ring.
  [[nodiscard]] LayerId layer(RingId ring) const;

  // Edits. Each throws std::invalid_argument, and then changes nothing, if an id names nothing or
  // a coordinate is not usable; the message names layer, ring and point.

  /// Inserts a ring, or an open line, which encloses nothing.
  RingId insert(LayerId layer, std::span<const Point> points, Ends ends = closed);
  /// Inserts many at once: the same as one after the other, but faster.
  std::vector<RingId> insert(std::span<const Shape> shapes);
  /// Gives a ring other points, as many as it likes.
  void move(RingId ring, std::span<const Point> points);
  void translate(RingId ring, Point by);
  void remove(RingId ring);
  /// All rings and lines of a layer, as one edit. Points that `map` takes to what is no usable
  /// coordinate are refused.
  void translate(LayerId layer, Point by);
  void transform(LayerId layer, const Affine& map);
  /// Removes what is in a layer, not the layer.
  void clear(LayerId layer);
  /// From here to end_batch() edits are one as far as results, covers and changes are concerned.
  /// Until then these say what was before, and traversal of triangulation() alone is as it is now.
  void begin_batch();
  void end_batch();

  // Results.

  /// From now on the result of an expression is kept up to date. Throws std::invalid_argument if
  /// it is true where no layer is, so without bounds (subtract from a frame instead), or if it has
  /// a layer that is not there. Cost: O(covers x their layers x height of the expression +
  /// triangles in the result).
  ResultId watch(Expression what);
  /// Another expression for a result. Cost: O(covers x ..., as above) + the triangles whose truth
  /// changes. change() says what did.
  void set(ResultId result, Expression what);
  void unwatch(ResultId result);
  [[nodiscard]] const Expression& expression(ResultId result) const;
  /// What the last edit, or set(), did to a result; after watch() all of it has come.
  [[nodiscard]] const ResultChange& change(ResultId result) const;
  /// Exact; kept, so O(1).
  [[nodiscard]] const ExactArea& area(ResultId result) const;
  /// The result's border, in no order.
  [[nodiscard]] std::span<const BorderEdge> border(ResultId result) const;
  /// Valid polygons in the sense of OGC: rings are simple, holes inside, and touch others in points
  /// at most, and each polygon's inside is connected. Outer rings are counter-clockwise and holes
  /// clockwise, each begins at its smallest point; polygons and holes are sorted by these. Where
  /// parts touch in a point they are split. They sum to area() exactly. Cost: O(border), and, for
  /// each hole, the degrees of vertices on a way from it to the next border on its left.
  [[nodiscard]] MultiPolygon polygons(ResultId result, Vertices vertices = Vertices::needed) const;
  /// The edges along those polygons: triangulation().passages() says which segments of which rings
  /// are there.
  [[nodiscard]] std::vector<TracedPolygon> traces(ResultId result) const;
  /// The rings, outer ones and holes, on which something has come in the last edit. Cost: O(their
  /// length).
  [[nodiscard]] std::vector<Ring> changed_rings(ResultId result,
                                                Vertices vertices = Vertices::needed) const;
  /// Whether a triangle belongs to a result.
  [[nodiscard]] bool is_in(ResultId result, cdt::TriangleId t) const;

  // Covers. Their ids are valid until the next edit.

  /// The layers that cover a triangle. That of infinite ones is `nothing`.
  [[nodiscard]] CoverId cover(cdt::TriangleId t) const;
  static constexpr CoverId nothing{0};
  /// The same of all triangles, by their ids.
  [[nodiscard]] std::span<const CoverId> covers() const;
  /// Sorted.
  [[nodiscard]] std::span<const LayerId> layers(CoverId cover) const;
  /// Ids are below this; some may be nowhere now.
  [[nodiscard]] std::size_t cover_bound() const;
  /// The triangles with a cover, in no order; none for `nothing`. Cost: their number.
  [[nodiscard]] std::vector<cdt::TriangleId> triangles(CoverId cover) const;
  /// Which layers are at a point: exact, the same whichever side it is looked at from. Of the
  /// plane's points only, not those at infinity: nothing is there. Cost: to locate it, and at a
  /// vertex its degree.
  [[nodiscard]] Cover cover(Point p) const;

  /// How far the area of any result may be from that of the exact shapes: the sum over the
  /// vertices where rounding was needed of what they can have been moved by, times the length of
  /// the edges there. Cost: O(vertices).
  [[nodiscard]] double area_error_bound() const;
  /// Rings with fewer than three different points: they enclose nothing. Cost: O(rings).
  [[nodiscard]] std::vector<RingId> rings_without_inside() const;

  [[nodiscard]] const cdt::Triangulation& triangulation() const;

  // For whoever keeps something beside each triangle.

  /// Counts edits; a batch is one. It goes up by 1 where the covers of all triangles
  /// but those in triangulation().changes().made and in recovered() are what they were, and by more
  /// where any may have changed.
  [[nodiscard]] std::size_t revision() const;
  /// The triangles that stayed in the last edit and have had another cover since, in no order.
  [[nodiscard]] std::span<const cdt::TriangleId> recovered() const;

 private:
  template <class Edits>
  void as_one_edit(Edits edits);

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace loft::overlay
