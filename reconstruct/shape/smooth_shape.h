// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "mesh/mesh.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/plane/signed_distance.h"

namespace loft {

/// What a smooth surface has to know of a slice: how far any place is from its contours.
struct SliceShape {
  double z = 0;
  SignedDistance distance;  ///< empty where the region is

  SliceShape() = default;
  explicit SliceShape(const Region& region) : z(region.z), distance(boundary(region)) {}

  /// How deep a place is in the parts, or in the cavities; negative outside of them. Of the
  /// contours those count that face about as the unit vector `facing`; all, if it is 0.
  [[nodiscard]] double depth(bool is_solid, cdt::Point place, cdt::Point facing = {}) const {
    const double outside = distance.at(place, facing).distance;
    return is_solid ? -outside : outside;
  }
};

/// A slab, between the slices [1] and [2], with the slices before and after it. Null at the end of
/// the stack, where there is none.
using Surroundings = std::array<const SliceShape*, 4>;

/// A smooth surface near a place: it is where the value is 0.
struct Sample {
  double value;
  Vec3 gradient;
};

/// The smooth surface between two slices that both have a part in it.
///
/// Over each place of the plane the signed distances to the contours of the slices, as a function
/// of z, are joined by a cubic with tangents at both slices: shape-based interpolation (Raya and
/// Udupa, 1990) of the third order. The tangent at a slice is that of the circle through the three
/// points: the directions of both chords, each weighted with the other's length. So it is exact
/// for round shapes, follows the flatter side where a flat face meets an upright one, and all but
/// disregards a slice in which there is nothing near. Over a gap that is many times as high as the
/// one beside it, a tangent is believed the less: noise would grow. Reads one slice on either side
/// of the slab.
class SmoothPassage {
 public:
  /// The slab is sheared: what is at p in the lower slice is expected at p + shift in the upper
  /// one.
  explicit SmoothPassage(const Surroundings& slices, cdt::Point shift = {});

  /// Of the contours those count that face about as the unit vector `facing`; all, if it is 0. So
  /// both sides of a thin wall bend as they go themselves. Cost: that of a query of each slice. The
  /// gradient is approximate: it takes the tangents for weighted means of the chords.
  [[nodiscard]] Sample at(const Vec3& p, cdt::Point facing = {}) const;
  /// The surface on which distances change evenly from slice to slice. Straight tiles are on it but
  /// for corners of outlines, where distances are round.
  [[nodiscard]] Sample even_at(const Vec3& p, cdt::Point facing) const;

 private:
  using Weights = std::array<double, 4>;
  struct Distances {
    Weights values{};
    std::array<cdt::Point, 4> outward{};
  };
  struct Tangent {
    double slope;
    Weights weights;  // of the slices' distances in it
  };

  [[nodiscard]] bool has(std::size_t slice) const { return slices_[slice] != nullptr; }
  [[nodiscard]] double z(std::size_t slice) const { return slices_[slice]->z; }
  /// To the contours of some slices, each at the place that p is sheared to there.
  [[nodiscard]] Distances distances(const Vec3& p, cdt::Point facing, std::size_t first,
                                    std::size_t last) const;
  /// With the gradient in the plane, and by z as far as the shear changes it.
  [[nodiscard]] Sample sample(double value, double rise, const Weights& weights,
                              const Distances& distances) const;
  [[nodiscard]] std::array<Tangent, 2> tangents(const Weights& distances) const;

  Surroundings slices_;  // null, too, where the slice is empty
  cdt::Point shift_;
};

/// The smooth surface over a part that is in one slice of a slab only, or over such a hole.
///
/// A spheroid standing on the contours: at the depth d of a place below the part's boundary, as
/// high as a ball is at r - d from its axis, r the part's largest depth. A part that is longer than
/// wide gets lower towards its far ends: nowhere is it higher than the ball whose section has the
/// chord across the part there (of a ball, too, the product of the two ways to the boundary along
/// any chord through a place is the power of that place). How fast the ball shrinks
/// is read from the slice before: how deep the part's middle is there; where that is hollow, how
/// far its outline is around the part's own. The height is kept within the slab; where the slice
/// before has nothing there it is 0.7 of it or a little more, where there is no slice before, half
/// of it.
class SmoothEnd {
 public:
  /// On slice 1 or 2 of the surroundings; `middle` is where the part is deepest, `depth` deep;
  /// `across` is a unit vector across it, 0 if it is about as wide as it is long. Its axis goes
  /// sideways by `lean`, by height from that slice.
  SmoothEnd(const Surroundings& slices, std::size_t slice, cdt::Point middle, double depth,
            cdt::Point across, cdt::Point lean = {});

  /// As if it did not lean. Cost: that of a query of the slice; of a dozen where it is long.
  [[nodiscard]] Sample at(const Vec3& p) const;
  /// Where a place would be if it did not lean.
  [[nodiscard]] Vec3 upright(const Vec3& p) const { return sheared(p, -1); }
  [[nodiscard]] Vec3 leant(const Vec3& p) const { return sheared(p, 1); }

 private:
  /// The square of the radius of the ball's section at its own slice, less that of the distance
  /// from the ball's axis; and how it changes in the plane.
  struct Power {
    double value;
    cdt::Point gradient;
  };
  [[nodiscard]] Power power(cdt::Point place) const;
  /// From a place, `nearest` deep, along a unit vector to the boundary.
  [[nodiscard]] double way_out(cdt::Point place, cdt::Point way, double nearest) const;
  [[nodiscard]] Vec3 sheared(const Vec3& p, double share) const {
    const double way = share * upwards_ * (p[2] - slice_->z);
    return {p[0] + way * lean_.x, p[1] + way * lean_.y, p[2]};
  }

  const SliceShape* slice_;
  bool is_solid_;
  cdt::Point across_;
  cdt::Point lean_;
  double upwards_;    // 1 or -1
  double depth_;      // of the middle
  double trend_;      // growth of the squared radius a unit of height, less the ball's own
  double scale_ = 1;  // of heights, to fit into the slab
};

}  // namespace loft
