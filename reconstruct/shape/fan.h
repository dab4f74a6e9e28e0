// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/box3.h"
#include "mesh/predicates.h"
#include "mesh/vec3.h"
#include "reconstruct/surface.h"

namespace loft {

/// The faces around a vertex, and what becomes of them when the vertex moves into a neighbour.
/// At a vertex on a rim the fan is open: its first and its last neighbour are on the rim.
class Fan {
 public:
  /// Reads the faces around v; whether they are one fan that can be seen as a whole.
  bool read(const Surface& surface, Surface::VertexHandle v);

  /// The number of neighbours.
  [[nodiscard]] std::size_t size() const { return spokes_.size(); }
  [[nodiscard]] std::size_t faces() const { return is_open_ ? size() - 1 : size(); }
  [[nodiscard]] bool is_open() const { return is_open_; }
  /// A rim follows its own line: its vertices move along it only.
  [[nodiscard]] bool may_move_into(std::size_t target) const {
    return !is_open_ || target == 0 || target + 1 == size();
  }
  [[nodiscard]] const Vec3& middle() const { return middle_; }
  [[nodiscard]] Surface::HalfedgeHandle halfedge(std::size_t i) const {
    return spokes_[i].halfedge;
  }
  /// The face between neighbours i and i + 1.
  [[nodiscard]] Surface::FaceHandle face(std::size_t i) const { return spokes_[i].face; }
  [[nodiscard]] const Vec3& place(std::size_t i) const { return spokes_[i].place; }
  [[nodiscard]] std::size_t after(std::size_t i) const { return i + 1 == size() ? 0 : i + 1; }
  [[nodiscard]] std::size_t before(std::size_t i) const { return (i == 0 ? size() : i) - 1; }

  /// The triangle that face i becomes when the middle moves into neighbour `target`; the two faces
  /// at the edge between them vanish.
  [[nodiscard]] Corners moved(std::size_t i, std::size_t target) const {
    return {place(target), place(i), place(after(i))};
  }
  [[nodiscard]] bool vanishes(std::size_t i, std::size_t target) const {
    return i == target || after(i) == target;
  }

  /// Finds what the faces pass through as the middle moves straight into neighbour `target`. Holds
  /// until the next one.
  void find_swept(std::size_t target);
  /// Whether that is some of a triangle outside the fan (exact). The triangle meets neither the old
  /// faces nor the new ones, so it is enough to know where its corners are, and where its edges
  /// start.
  [[nodiscard]] bool sweeps(std::size_t target, const Corners& t) const;

  /// How far the map along the normal moves a point when the middle moves into neighbour `target`;
  /// infinite if a face would turn over. On a rim, the map along the normal and across the rim.
  [[nodiscard]] double distance(std::size_t target) const;

  /// The sine of the smallest angle of the triangles that the faces become.
  [[nodiscard]] double worst_sine(std::size_t target) const;

 private:
  /// The neighbours as they come, counter-clockwise.
  void collect(const Surface& surface, Surface::VertexHandle v);

  /// Vertices with more neighbours stay: the effort grows with the cube of their number.
  static constexpr std::size_t largest_fan = 64;

  /// The edge to a neighbour, and the face left of it.
  struct Spoke {
    Surface::HalfedgeHandle halfedge;
    Surface::FaceHandle face;
    Vec3 place;      // of the neighbour
    Vec3 seen = {};  // the same, from the middle along the normal
  };

  /// Which neighbour is at a place; size() if none.
  [[nodiscard]] std::size_t find(const Vec3& p) const;

  /// Each face that stays sweeps a tetrahedron; flat ones sweep nothing.
  struct Swept {
    Corners face;
    int inside;  // the side of the face on which the middle is
    Box3 box;
  };
  [[nodiscard]] bool sweeps_point(const Vec3& p) const;

  /// Whether an edge from neighbour i to p, not along the rim of the fan, starts in what is swept.
  [[nodiscard]] bool starts_inside(std::size_t target, std::size_t i, const Vec3& p) const;

  /// Sums over the fan are rounded in one order, whatever the vertices' numbers.
  void start_at_smallest();

  /// A direction along which each face is seen from its front: the mean of the normals by area, or
  /// else one turned towards the faces that are not seen; whether there is one.
  bool find_normal();

  /// Turns the neighbours so that the normal is z; whether each face is seen from its front, and
  /// each place once.
  bool look_along_normal();

  [[nodiscard]] const Vec3& seen(std::size_t i) const { return spokes_[i].seen; }

  /// Whether all faces are still seen from their front, and none turns by 90 degrees or more.
  [[nodiscard]] bool keeps_sides(std::size_t target) const;

  /// Between the middle, at height 0, and the new triangle over or under it.
  [[nodiscard]] double distance_at_middle(std::size_t target) const;

  /// Between the middle and the edge that the rim becomes.
  [[nodiscard]] double distance_at_rim() const;

  /// Between each old edge and each new one that cross, as seen.
  [[nodiscard]] double distance_at_crossings(std::size_t target) const;

  /// Whether every face stays in its plane (exact): then the faces cover what they covered before.
  [[nodiscard]] bool changes_nothing(std::size_t target) const;

  Vec3 middle_{};
  Vec3 normal_{};
  bool is_open_ = false;
  double extent_ = 0;          // the farthest that a neighbour is, along an axis
  std::vector<Spoke> spokes_;  // counter-clockwise
  std::vector<Vec3> face_normals_;
  std::vector<Swept> swept_;
};

}  // namespace loft
