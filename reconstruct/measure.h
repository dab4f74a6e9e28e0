// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "reconstruct/mesh.h"
#include "reconstruct/surface.h"

namespace loft {

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
};

/// Adds up area and volume face by face, seen from the first corner that is added, so that the
/// place of a mesh costs no accuracy.
class FaceSum {
 public:
  void add(const Vec3& a, const Vec3& b, const Vec3& c);
  [[nodiscard]] double area() const { return area_; }
  [[nodiscard]] double volume() const { return volume_; }

 private:
  std::optional<Vec3> origin_;
  double area_ = 0;
  double volume_ = 0;
};

/// The genus by Euler's formula, from the counts of everything else; `rims` closed chains of edges
/// have one face only.
[[nodiscard]] int genus(const Measures& measures, std::size_t rims);

/// Cost: O(n log n).
[[nodiscard]] Measures measure(const Mesh& mesh);
/// The same, from the surface's own connectivity. Precondition: no deleted elements.
/// Cost: O(n).
[[nodiscard]] Measures measure(const Surface& surface);

}  // namespace loft
