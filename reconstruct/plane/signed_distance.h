// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/plane/segment_tree.h"

namespace loft {

/// How far places in the plane are from the boundary of a region, on which side of it.
class SignedDistance {
 public:
  struct Value {
    double distance;  ///< negative inside
    /// Unit vector in which the distance grows; 0 upon the boundary's corners. Where several places
    /// of the boundary are equally near, the mean of theirs: rounding does not choose among them.
    cdt::Point outward;
    cdt::Point foot;  ///< the nearest place of the boundary; of several any
  };

  SignedDistance() = default;
  /// The edges of the region's loops; the region is on their left. Cost: O(n log n).
  explicit SignedDistance(std::vector<Segment> boundary) : tree_(std::move(boundary)) {}

  [[nodiscard]] bool is_empty() const { return tree_.is_empty(); }
  /// Precondition: the region is not empty. Cost: O(log n) in practice.
  [[nodiscard]] Value at(cdt::Point p) const;
  /// The same to the edges alone that face about the same way: whose outward normals are within 120
  /// degrees of `facing`, a unit vector. So the other side of a thin wall does not count. As at(p)
  /// if `facing` is 0, or no edge faces that way.
  [[nodiscard]] Value at(cdt::Point p, cdt::Point facing) const;

  /// A corner of the boundary near a place.
  struct Corner {
    double distance;  ///< from the place
    double edge;      ///< length of the shorter edge at it
  };
  /// The nearest corner no further than `most` away.
  [[nodiscard]] std::optional<Corner> corner_near(cdt::Point p, double most) const;

 private:
  SegmentTree tree_;
};

}  // namespace loft
