// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/predicates.h"

namespace loft {

/// How well shaped the faces of a mesh are. Angles in degrees: each face counts by its smallest
/// one, which is 60 at best; 0 where it is none (without area, or not a number). All 0 without
/// faces.
struct Angles {
  double smallest = 0;
  double fifth_percentile = 0;  ///< one face in 20 has a smaller one; to 0.01 degrees
  double median = 0;            ///< to 0.01 degrees
  double worst_aspect = 0;      ///< longest side over the height on it, 1 at best; see aspect()
};

/// Size and shape of a mesh. Lengths in its own units.
struct Measures {
  std::size_t vertices = 0;  ///< vertices that a face uses
  std::size_t edges = 0;
  std::size_t faces = 0;
  std::size_t components = 0;  ///< parts connected through edges
  /// The sum over the components, an open one with its holes closed; meaningful for manifolds only.
  int genus = 0;
  double area = 0;
  double volume = 0;  ///< signed: positive if faces look outwards
  Angles angles;
};

/// Counts the smallest angles of triangles, in bins so narrow that percentiles are right to a
/// hundredth of a degree.
class AngleCount {
 public:
  void add(const Corners& triangle);
  [[nodiscard]] Angles angles() const;

 private:
  static constexpr double bins_a_degree = 100;

  [[nodiscard]] double angle_of(std::size_t rank) const;

  std::vector<std::size_t> counts_ = std::vector<std::size_t>(6001);
  std::size_t count_ = 0;
  double smallest_ = 60;
  double worst_aspect_ = 0;
};

/// Measures what faces tell one by one: area, volume and angles. Volume is seen from the first
/// corner that is added, so that the place of a mesh costs no accuracy.
class FaceSum {
 public:
  void add(const Corners& triangle);
  /// Sets area, volume and angles.
  void put_into(Measures& measures) const;

 private:
  std::optional<Vec3> origin_;
  double area_ = 0;
  double volume_ = 0;
  AngleCount angles_;
};

/// The genus by Euler's formula, from the counts of everything else; `rims` closed chains of edges
/// have one face only.
[[nodiscard]] int genus(const Measures& measures, std::size_t rims);

/// Cost: O(n log n).
[[nodiscard]] Measures measure(const Mesh& mesh);

}  // namespace loft
