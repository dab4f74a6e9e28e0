// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cdt/triangulation.h"
#include "fields/line.h"
#include "fields/vector.h"

namespace loft::fields {

using cdt::EdgeId;
using cdt::Ends;
using cdt::Point;
using cdt::TriangleId;
using cdt::Triangulation;
using cdt::VertexId;

struct SampleTag {
  static constexpr char prefix = 'p';
};
struct LineTag {
  static constexpr char prefix = 'l';
};
using SampleId = cdt::Id<SampleTag>;
using LineId = cdt::Id<LineTag>;

/// A value at a place.
struct Sample {
  Point place;
  double value = 0;
};

/// A line to insert. A view: points and values belong to someone else.
struct Line {
  std::span<const Point> points;
  LineKind kind = LineKind::feature;
  std::span<const double> values = {};  ///< of a feature, one for each point
  std::span<const double> left = {};    ///< of a wall, one for each point, on the left of its way
  std::span<const double> right = {};   ///< of a wall
  Ends ends = cdt::open;
};

/// What becomes of different values at one place.
enum class OnConflict {
  mean,    ///< the mean of what is given there; whatever the order in which it came
  first,   ///< what was inserted first
  refuse,  ///< the edit is undone and throws std::invalid_argument
};

/// A sample or a line that says what the value at a place is.
struct Claim {
  SampleId sample;  ///< none: a line
  LineId line;      ///< none: a sample
  double value = 0;
};

/// A place at which several values were given, on one side of it.
struct Conflict {
  Point place;
  std::vector<Claim> claims;  ///< sorted by value
  double taken = 0;
};

/// How the surface is bent.
enum class Smoothness {
  linear,  ///< flat triangles
  cubic,   ///< with a gradient that changes steadily but across features, walls and barriers
};

/// Which side of a wall or barrier, for a place that is on one: of the line there that was inserted
/// first, in its direction.
enum class Side { left, right };

/// What there is beyond the hull of all samples and lines.
enum class Outside {
  nothing,
  nearest,  ///< the value at the nearest point of the hull
};

/// Values over the plane: samples and lines with values come, move and go, and there is a surface
/// through them over the constrained Delaunay triangulation of all (KBT, section 7).
///
/// Each triangle has a value at each of its corners: at a vertex where walls or barriers meet, one
/// for each sector between them. Values along a line are linear between its points. What has no
/// value given:
/// - A soft line is on the linear surface as it is without soft lines, beyond its hull at the
///   height of the nearest place.
/// - A barrier, on each of its sides, is on the plane that fits best to the given values around:
///   those that are joined to its side by triangles with no wall or barrier between, from ring to
///   ring until there are enough. Where there are none at all, there is no value.
///
/// Laws. At a sample the value is that of the sample, bit for bit, unless there is a conflict, and
/// so at the points of features and, on each side, of walls. Nothing inside or on the hull is
/// without value, but where barriers enclose a part without any. Linear values are between those at
/// the corners. Both triangles of an edge have the same values on it, bit for bit. A plane is
/// reproduced, but behind barriers where all values are in one line. What is beyond a wall or
/// barrier has no influence at all. The result is a function of what is there, whatever the order
/// of edits (where the triangulation's snaps() is empty, and but for OnConflict::first).
///
/// Cubic values are those of Clough and Tocher's triangles (1965): their gradients at vertices fit
/// the values around best, by quadratic polynomials, from what is in the same sector between
/// features, walls and barriers; they agree across edges, but across a feature only the values do.
/// Gradients are found when they are asked for the first time, and kept.
///
/// Cost of an edit: that of the triangulation, then O(m d) for m triangles made, of degree d. While
/// there are soft lines, twice that, as there is a second triangulation without them.
///
/// Reading from several threads at once is safe while nobody edits.
class Field {
 public:
  /// Beyond it products of two values overflow.
  static constexpr double largest_value = 1e150;
  /// Whether a field takes a value: up to that in magnitude.
  [[nodiscard]] static constexpr bool is_usable(double value) {
    return value <= largest_value && value >= -largest_value;
  }

  explicit Field(OnConflict policy = OnConflict::mean);
  ~Field();
  Field(Field&&) noexcept;
  Field& operator=(Field&&) noexcept;

  // Edits. Each throws std::invalid_argument, and then changes nothing, if a coordinate is not
  // usable (Triangulation::is_usable), a value is not (is_usable), a line has fewer than two
  // different points or not as many values as it needs, or an id names nothing.

  SampleId insert(const Sample& sample);
  /// Many at once: the same, but faster.
  std::vector<SampleId> insert(std::span<const Sample> samples);
  LineId insert(const Line& line);
  void move(SampleId sample, Point place);
  void set_value(SampleId sample, double value);
  void remove(SampleId sample);
  /// Gives a line, which stays what kind it is, other points and values; ends stay as well.
  void move(LineId line, const Line& to);
  void translate(LineId line, Point by);
  void remove(LineId line);

  // What is there. Precondition: the ids name something.

  [[nodiscard]] bool is_sample(SampleId sample) const;
  [[nodiscard]] bool is_line(LineId line) const;
  [[nodiscard]] Sample sample(SampleId sample) const;
  [[nodiscard]] LineKind kind(LineId line) const;
  [[nodiscard]] std::vector<Point> points(LineId line) const;
  /// Ids are below.
  [[nodiscard]] std::size_t id_bound() const { return mesh_.constraint_bound(); }
  /// The places where different values are given, sorted. Those within what rounding can do to an
  /// interpolated value are no conflict. Cost: their number.
  [[nodiscard]] std::vector<Conflict> conflicts() const;

  // Values.

  /// The value at a place; none if there is none. Cost: to locate it.
  [[nodiscard]] std::optional<double> value(Point p, Smoothness smoothness = Smoothness::linear,
                                            Side side = Side::left,
                                            Outside outside = Outside::nothing) const;
  /// How the value rises at a place, by unit of length. At a vertex of the linear surface, that of
  /// one of its triangles on that side; on an edge, of the one on the left, seen upwards.
  [[nodiscard]] std::optional<Vector> gradient(Point p, Smoothness smoothness = Smoothness::linear,
                                               Side side = Side::left) const;

  // The surface, triangle by triangle: for those who make something of all of it. Edges and
  // triangles are those of mesh().

  [[nodiscard]] const Triangulation& mesh() const { return mesh_; }
  /// The value at from(e) in the triangle on the left of e. Not a number if there is none.
  [[nodiscard]] double corner_value(EdgeId e) const {
    const double given = values_[e.index()];
    return given == given ? given : derived_value(e);
  }
  /// How the cubic surface rises there.
  [[nodiscard]] Vector corner_gradient(EdgeId e) const;
  /// Whether nothing goes over an edge: a wall or a barrier is along it, or it is on the hull.
  [[nodiscard]] bool is_separating(EdgeId e) const {
    return is_infinite(e) || is_infinite(mesh_.twin(e)) || has_line(e, separates);
  }
  /// Whether a feature is along an edge.
  [[nodiscard]] bool is_crease(EdgeId e) const {
    return has_line(e, [](LineKind kind) { return kind == LineKind::feature; });
  }
  /// The value on an edge, between its ends, at a place that is on it or rounded to it, as seen
  /// from the triangle on its left.
  [[nodiscard]] double edge_value(EdgeId e, Point p,
                                  Smoothness smoothness = Smoothness::linear) const;
  /// Of an edge and its twin, the one that has on its left what is on that side of the wall or
  /// barrier along it, or of the edge as it goes upwards; but of an edge of the hull always the one
  /// that has the inside there.
  [[nodiscard]] EdgeId seen_from(EdgeId e, Side side) const;
  /// Goes up with each edit.
  [[nodiscard]] std::uint64_t revision() const { return epoch_; }

 private:
  struct Values;   // of a line
  struct Claimed;  // a value that is claimed at a vertex
  struct Given {   // of a constraint that is a sample
    double value = 0;
    std::uint64_t order = 0;
    VertexId vertex{};
    SampleId next_here{};  // of those at the vertex
    SampleId firm{};       // its id in firm_
  };
  struct Rise {  // of a vertex
    std::uint64_t state = 0;
    Vector gradient;
  };

  [[nodiscard]] bool is_infinite(EdgeId e) const {
    return mesh_.is_infinite(Triangulation::triangle(e));
  }
  template <class Chosen>
  [[nodiscard]] bool has_line(EdgeId e, Chosen chosen) const {
    if (!mesh_.is_constrained(e)) return false;
    for (const cdt::Passage passage : mesh_.passages(e))
      if (const auto line = line_of(passage); line && chosen(*line)) return true;
    return false;
  }
  [[nodiscard]] std::optional<LineKind> line_of(cdt::Passage passage) const;

  // field.cpp
  void check(const Line& line) const;
  void expect(SampleId sample) const;
  void expect(LineId line) const;
  void make_room();
  void list(SampleId sample, double value, std::uint64_t order);
  void list_at_vertex(SampleId sample);
  void unlist_at_vertex(SampleId sample);
  void touch(VertexId v);
  void touch_line(LineId line);
  void touch_only_vertex();
  void finish_edit(bool has_changed_triangles = true);
  void undo_if_refused(std::size_t conflicts_before, const std::function<void()>& undo);
  void make_firm();
  void take_values(LineId id, const Line& line);
  void rebuild();

  // corner_values.cpp
  void settle(VertexId v);
  void settle_lone(VertexId v);
  void settle_sectors(VertexId v);
  [[nodiscard]] bool is_made_by_soft_lines(VertexId v) const;
  void leave_open(VertexId v);
  void gather_ring(VertexId v);
  void claim_samples(VertexId v);
  void claim_along(EdgeId e, bool is_first, bool is_last);
  void claim_at(EdgeId e, cdt::ConstraintId line, std::size_t segment,
                std::span<const double> given);
  [[nodiscard]] double resolve(VertexId v);
  void note_conflict(VertexId v, double taken);

  // derived_values.cpp
  [[nodiscard]] double derived_value(EdgeId e) const;
  [[nodiscard]] double find_derived_value(EdgeId e) const;
  [[nodiscard]] double fit_from_around(EdgeId e) const;
  [[nodiscard]] double firm_value(EdgeId e) const;
  [[nodiscard]] std::optional<double> firm_value_beside(EdgeId e, bool is_on_left) const;

  // gradients.cpp
  [[nodiscard]] Vector find_gradient(EdgeId e, bool& reads_derived) const;
  [[nodiscard]] std::optional<Vector> find_whole_gradient(EdgeId e, bool& reads_derived) const;
  [[nodiscard]] Vector find_sector_gradient(EdgeId e, bool& reads_derived) const;
  [[nodiscard]] bool is_derived(EdgeId e) const { return values_[e.index()] != values_[e.index()]; }
  void forget_gradients_around(VertexId v);

  // interpolate.cpp
  [[nodiscard]] EdgeId corner_at(EdgeId e, Side side) const;
  [[nodiscard]] std::optional<double> value_beyond(EdgeId e, Point p, Smoothness smoothness,
                                                   Side side) const;
  [[nodiscard]] std::optional<double> lone_value(Point p, Outside outside) const;
  [[nodiscard]] std::optional<cdt::Passage> first_separator(EdgeId e, bool& is_forward) const;
  [[nodiscard]] const Values* line_along(cdt::Passage passage) const;

  OnConflict policy_;
  Triangulation mesh_;
  std::uint64_t epoch_ = 0;
  std::uint64_t order_ = 0;
  std::vector<Given> samples_;                  // by constraint
  std::vector<std::unique_ptr<Values>> lines_;  // by constraint; as long as needed
  std::vector<SampleId> first_sample_;          // by vertex
  std::vector<double> values_;                  // by edge, of its start; those given
  std::map<VertexId, std::vector<Conflict>> conflicts_;
  std::size_t soft_lines_ = 0;
  std::unique_ptr<Field> firm_;  // the same without soft lines, while there are any

  // Found when they are asked for, by whoever is first; `state`: by vertex, see Kept.
  mutable std::vector<double> derived_;  // by edge
  mutable std::vector<std::uint64_t> derived_state_;
  mutable std::vector<Rise> rises_;        // by vertex
  mutable std::vector<Vector> gradients_;  // by edge, where they are not the same all around

  double lone_value_ = 0;  // while there is one vertex only

  // Of one edit.
  std::vector<VertexId> touched_;
  std::vector<EdgeId> ring_;
  std::vector<bool> splits_;  // by place in ring_: whether a sector begins there
  std::vector<Claimed> claims_;
};

}  // namespace loft::fields
