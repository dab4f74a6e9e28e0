// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cdt/triangulation.h"
#include "fields/beside.h"
#include "fields/class_table.h"
#include "fields/separator.h"
#include "fields/standing_change.h"
#include "overlay/polygon.h"

namespace loft::fields {

struct SeparatorTag {
  static constexpr char prefix = 'd';
};
/// A separator, as it is moved about.
using SeparatorId = cdt::Id<SeparatorTag>;
/// A point that is classified; the constraint that it is in the triangulation.
using PointId = cdt::ConstraintId;

/// A class that has points.
struct ClassCount {
  std::vector<Sign> signs;
  std::size_t points = 0;

  friend bool operator==(const ClassCount&, const ClassCount&) = default;
};

/// A part of the plane in which all have the same signs.
struct ClassFace {
  std::vector<Sign> signs;
  overlay::Polygon polygon;

  friend bool operator==(const ClassFace&, const ClassFace&) = default;
};

/// Points classified by separators, all of which come, move and go: the third class of problems of
/// Kallmann, Bieri and Thalmann, "Fully Dynamic Constrained Delaunay Triangulations" (2003),
/// section 7, "classification of statistical data according to several binary criteria". Each
/// separator says left, right or on of each point (Separator, which says what that means where a
/// line crosses itself); the list of these signs, in the order of the separators' ids, is the
/// point's class.
///
/// Guarantees. Signs are exact. Law: after an edit, changed() are the points whose signs are not
/// what they were, those and no others. All that is said here, but for ids, is a function of the
/// points and separators that are there, whatever was edited before.
///
/// Structure. Points, and the points of separators, are the vertices of a triangulation without
/// constrained edges. Where a separator moves, the vertices beside what is gone and what has come
/// of it are asked; from those whose side changes the change spreads over edges. So nothing is
/// looked at that is neither beside the line nor changes sides.
///
/// Edits throw std::invalid_argument, and then change nothing, where an id names nothing or a
/// coordinate is not usable (cdt::Triangulation::is_usable), and what Separator throws.
///
/// Not for several threads at once, except for reading. Copies are independent.
class Classes {
 public:
  // Points. Any number may be at one place. Their values are kept for whoever wants them.

  /// Cost: to locate it, and the points of all separators.
  PointId insert(Point p, double value = 0);
  /// Many at once: the same as one after the other, but faster. There are as many values, or none.
  std::vector<PointId> insert(std::span<const Point> points, std::span<const double> values = {});
  /// Cost: as insert(), and the points at the place that it leaves.
  void move(PointId id, Point to);
  void set_value(PointId id, double value);
  void remove(PointId id);

  [[nodiscard]] bool is_point(PointId id) const { return mesh_.is_constraint(id); }
  [[nodiscard]] std::size_t point_count() const { return mesh_.constraint_count(); }
  /// Ids are below it.
  [[nodiscard]] std::size_t point_bound() const { return mesh_.constraint_bound(); }
  /// Precondition of both: it is a point.
  [[nodiscard]] Point point(PointId id) const { return mesh_.point(mesh_.first_vertex(id)); }
  [[nodiscard]] double value(PointId id) const { return values_[id.index()]; }

  // Separators.

  /// Throws what Separator does. Cost: O(points), as all get another sign.
  SeparatorId insert_separator(std::span<const Point> points);
  /// Gives a separator other points, as many as it likes. Cost: those of its points that are gone
  /// or come, as in the triangulation; then, for each vertex beside pieces that are gone or have
  /// come, the number of these; then the points that change sides, with their neighbours. Pieces
  /// that it has had before, at its beginning and at its end, cost a comparison each.
  void move(SeparatorId id, std::span<const Point> points);
  /// Moves all of it; its points are rounded. Throws if two that follow one another become one.
  void translate(SeparatorId id, Point by);
  /// Cost: O(points).
  void remove(SeparatorId id);

  [[nodiscard]] bool is_separator(SeparatorId id) const {
    return id.index() < separators_.size() && separators_[id.index()].has_value();
  }
  /// In order.
  [[nodiscard]] std::vector<SeparatorId> separators() const;
  /// Precondition: it is one. Valid until the next edit.
  [[nodiscard]] const Separator& separator(SeparatorId id) const {
    return separators_[id.index()]->line;
  }

  // Classes.

  /// The signs of a point, in the order of the separators' ids. Valid until the next edit.
  /// Precondition: it is a point.
  [[nodiscard]] std::span<const Sign> signs(PointId id) const {
    return table_.signs(class_of_[mesh_.first_vertex(id).index()]);
  }
  /// Precondition: both are there.
  [[nodiscard]] Sign sign(PointId point, SeparatorId separator) const;
  /// The signs of any place. Cost: the points of all separators.
  [[nodiscard]] std::vector<Sign> signs(Point place) const;

  /// The points that are there after the last edit and did not have their signs before it: those
  /// that came, and those whose signs changed. In order. As the separators make up the vectors, all
  /// points change where one comes or goes.
  [[nodiscard]] std::span<const PointId> changed() const { return changed_; }

  /// The classes that have points, in the order of their signs: right, on, left. Cost: O(classes).
  [[nodiscard]] std::vector<ClassCount> classes() const;
  /// The points of a class, in order. Cost: O(points).
  [[nodiscard]] std::vector<PointId> points_with(std::span<const Sign> signs) const;

  /// What a box falls into, each face with its signs, sorted by their outlines' smallest points.
  /// Where separators leave for infinity and where they cross is rounded. Precondition: the box, or
  /// what is between the separators' points, is 1e-30 wide or high, and nothing is beyond 1e70.
  /// Cost: that of an overlay of all separators.
  [[nodiscard]] std::vector<ClassFace> faces(const cdt::Box& box) const;

  /// The points, and those of the separators.
  [[nodiscard]] const cdt::Triangulation& triangulation() const { return mesh_; }

 private:
  using VertexId = cdt::VertexId;
  static constexpr std::uint32_t no_class = 0xffff'ffff;

  struct Kept {
    Separator line;
    std::vector<VertexId> vertices;   // of its points
    std::vector<Standing> standings;  // by vertex: of those that have a point
  };
  /// What is gone of a separator, or has come, and the vertices of all its points.
  struct Half {
    PiecesOf some = {};
    std::span<const VertexId> vertices = {};
  };
  struct Move {
    Half gone;
    Half come;
  };

  [[nodiscard]] Kept& known(SeparatorId id);
  void check_known(PointId id) const;
  void grow();
  void list(PointId id, double value);
  void unlist(PointId id);
  void enter(VertexId v);
  void sort_changed();
  [[nodiscard]] std::vector<VertexId> place(std::span<const Point> points);
  void take_away(std::span<const VertexId> vertices);
  void find_beside(const Move& move);
  void find_standings(const Move& move);
  void change_sign(VertexId v, std::size_t place, Sign sign);
  void classify_all();

  cdt::Triangulation mesh_;
  std::vector<std::optional<Kept>> separators_;
  std::vector<double> values_;           // by point
  std::vector<PointId> next_here_;       // by point: another one at the same place
  std::vector<PointId> first_here_;      // by vertex
  std::vector<std::uint32_t> class_of_;  // by vertex that has a point
  ClassTable table_;
  std::vector<PointId> changed_;

  // Scratch memory, kept to spare allocations.
  BesidePieces beside_;
  std::vector<Standing> differences_;  // by vertex that is beside
  std::vector<Sign> signs_;
};

}  // namespace loft::fields
