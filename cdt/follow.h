// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "cdt/changes.h"
#include "cdt/ids.h"
#include "cdt/point.h"
#include "cdt/predicates.h"
#include "cdt/regions.h"
#include "cdt/triangulation.h"

namespace loft::cdt {

/// The values of flood(), kept up to date from edit to edit: after follow(), each triangle has the
/// value that flood() would give it, for the same `outside` and `cross`, whose answers for passages
/// that stay must stay, too.
///
/// What was not touched may change as well, as when a polygon jumps over a triangle. So the made
/// triangles are taken part by part, each part being what is joined by edges, and the parts from
/// the right to the left by their rightmost vertices. Beyond that vertex there is nothing that was
/// made, up to a part that had its turn or to infinity: so the value of the triangle beside the
/// part there is right already. From there values spread through the part, and where they meet a
/// triangle that stayed and had another value, on through those that stayed until nothing changes.
///
/// Triangles that have only moved count to those that stayed: between these, values are right as
/// they were.
///
/// Cost of follow(): O(m log m + moved + changed) for m triangles that were made or unmade, those
/// that have only moved, and `changed` others whose value changes. Values are compared by ==.
template <class Value, class Cross>
class Follower {
 public:
  /// The triangulation, which must outlive this and stay in its place, is to record its changes.
  /// Cost: O(triangles).
  Follower(const Triangulation& mesh, Value outside, Cross cross)
      : mesh_(&mesh), outside_(std::move(outside)), cross_(std::move(cross)) {
    begin();
  }

  /// Forgets all and floods, as after clear() or edits that were not followed.
  void begin() {
    values_ = flood(*mesh_, outside_, cross_);
    part_.assign(values_.size(), settled);
    unmade_.clear();
    remade_.clear();
    changed_.clear();
  }

  /// Takes over what an edit, or a batch, did; each in its turn.
  void follow(const Changes& changes) {
    changed_.clear();
    values_.resize(mesh_->triangle_bound(), outside_);
    part_.resize(values_.size(), settled);
    leave_out_moved(changes, changes.unmade, unmade_);
    leave_out_moved(changes, changes.made, remade_);
    for (const TriangleId t : unmade_)
      if (t.index() < values_.size()) values_[t.index()] = outside_;
    gather_parts(remade_);
    for (const Part& part : parts_) spread(part);
  }

  /// The value of a triangle.
  [[nodiscard]] typename std::vector<Value>::const_reference operator[](TriangleId t) const {
    return values_[t.index()];
  }
  /// By the ids of triangles; `outside` where there is none.
  [[nodiscard]] const std::vector<Value>& values() const { return values_; }

  /// The triangles that were unmade in the last follow(), and made, and have not only moved;
  /// sorted.
  [[nodiscard]] std::span<const TriangleId> unmade() const { return unmade_; }
  [[nodiscard]] std::span<const TriangleId> remade() const { return remade_; }
  /// The others that have another value since, in no order.
  [[nodiscard]] std::span<const TriangleId> changed() const { return changed_; }

 private:
  static constexpr std::uint32_t settled = 0xffff'ffff;
  static constexpr std::uint32_t waiting = 0xffff'fffe;

  /// Made triangles that are joined by edges.
  struct Part {
    std::uint32_t number = 0;
    TriangleId infinite{};  // one of them, if any is
    EdgeId first{};         // else: from the rightmost vertex, the first one counter-clockwise
  };

  [[nodiscard]] Point from(EdgeId e) const { return mesh_->point(mesh_->from(e)); }
  [[nodiscard]] Point to(EdgeId e) const { return mesh_->point(mesh_->to(e)); }

  /// Whether an edge starts further right than any so far, or from the same vertex and more
  /// clockwise: all from the rightmost vertex are within half a turn.
  [[nodiscard]] bool is_before(EdgeId e, EdgeId first) const {
    if (first.is_none()) return true;
    if (mesh_->from(e) != mesh_->from(first)) return from(first) < from(e);
    return orient(from(e), to(e), to(first)) > 0;
  }

  static void leave_out_moved(const Changes& changes, const std::vector<TriangleId>& some,
                              std::vector<TriangleId>& rest) {
    rest.clear();
    for_each_not_moved(changes, some, [&](TriangleId t) { rest.push_back(t); });
  }

  void gather_parts(std::span<const TriangleId> made) {
    parts_.clear();
    for (const TriangleId t : made) part_[t.index()] = waiting;
    for (const TriangleId t : made)
      if (part_[t.index()] == waiting) parts_.push_back(part_of(t));
    std::sort(parts_.begin(), parts_.end(), [this](const Part& a, const Part& b) {
      if (a.infinite.is_none() != b.infinite.is_none()) return b.infinite.is_none();
      return a.infinite.is_none() ? is_before(a.first, b.first) : a.number < b.number;
    });
  }

  /// The part of a triangle, in which all get its number.
  [[nodiscard]] Part part_of(TriangleId start) {
    Part part{.number = static_cast<std::uint32_t>(parts_.size())};
    part_[start.index()] = part.number;
    front_.assign(1, start);
    double furthest = -std::numeric_limits<double>::infinity();
    while (!front_.empty()) {
      const TriangleId t = front_.back();
      front_.pop_back();
      const bool is_infinite = mesh_->is_infinite(t);
      if (is_infinite) part.infinite = t;
      for (unsigned corner = 0; corner < 3; ++corner) {
        const EdgeId e = Triangulation::edge(t, corner);
        if (!is_infinite && from(e).x >= furthest && is_before(e, part.first)) {
          part.first = e;
          furthest = from(e).x;
        }
        const TriangleId beyond = neighbour(e);
        if (part_[beyond.index()] != waiting) continue;
        part_[beyond.index()] = part.number;
        front_.push_back(beyond);
      }
    }
    return part;
  }

  [[nodiscard]] TriangleId neighbour(EdgeId e) const {
    return Triangulation::triangle(mesh_->twin(e));
  }

  /// The value beyond an edge.
  [[nodiscard]] Value beyond(EdgeId e) const {
    const Value& here = values_[Triangulation::triangle(e).index()];
    return mesh_->is_constrained(e) ? cross_(e, here) : here;
  }

  void spread(const Part& part) {
    TriangleId start = part.infinite;
    if (start.is_none()) {
      start = Triangulation::triangle(part.first);
      values_[start.index()] = beyond(mesh_->twin(part.first));
    } else {
      values_[start.index()] = outside_;
    }
    part_[start.index()] = settled;
    front_.assign(1, start);
    while (!front_.empty()) {
      const TriangleId t = front_.back();
      front_.pop_back();
      for (unsigned corner = 0; corner < 3; ++corner) {
        const EdgeId e = Triangulation::edge(t, corner);
        const TriangleId next = neighbour(e);
        if (part_[next.index()] == part.number) {
          part_[next.index()] = settled;
          values_[next.index()] = beyond(e);
          front_.push_back(next);
        } else if (part_[next.index()] == settled) {
          change(next, beyond(e));
        }
      }
    }
  }

  /// A triangle that stayed, or has had its turn, gets a value, unless it is what it has.
  void change(TriangleId t, Value value) {
    if (values_[t.index()] == value) return;
    values_[t.index()] = std::move(value);
    changed_.push_back(t);
    front_.push_back(t);
  }

  const Triangulation* mesh_;
  Value outside_;
  Cross cross_;
  std::vector<Value> values_;        // by triangle
  std::vector<std::uint32_t> part_;  // by triangle: of those made that had no turn yet, or settled
  std::vector<Part> parts_;
  std::vector<TriangleId> unmade_;
  std::vector<TriangleId> remade_;
  std::vector<TriangleId> changed_;

  // Scratch memory, kept to spare allocations.
  std::vector<TriangleId> front_;
};

}  // namespace loft::cdt
