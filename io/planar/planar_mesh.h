// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "cdt/ids.h"
#include "cdt/point.h"
#include "cdt/triangulation.h"

namespace loft::io {

/// A constraint and the name that files shall give it.
struct NamedConstraint {
  cdt::ConstraintId id;
  std::string name = {};  ///< may be shared and may be empty
};

/// A triangulation as files hold it. Its numbers follow from the coordinates alone: triangulations
/// that are equal become planar meshes that are equal, whatever their ids.
struct PlanarMesh {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// A constraint along an edge. An edge has one piece for each constraint along it.
  struct Piece {
    std::uint32_t from;  ///< the smaller vertex
    std::uint32_t to;
    std::uint32_t constraint;
    std::uint32_t passages = 1;  ///< more than one where the constraint overlaps itself

    friend auto operator<=>(const Piece&, const Piece&) = default;
  };

  /// Triangles that hang together without a constrained edge between them.
  struct Region {
    /// Whether an odd number of closed constraints is between the region and the outside.
    bool is_odd = false;
    /// Equal for regions that the same names enclose an odd number of times (constraints without a
    /// name count one by one); 0 where none does.
    std::uint64_t key = 0;
    std::size_t triangles = 0;

    friend bool operator==(const Region&, const Region&) = default;
  };

  struct Course {
    std::string name;
    std::uint64_t key = 0;  ///< that of a region which this name alone encloses
    /// The vertices that the constraint passes, in its order and direction. A closed one ends where
    /// it began; a point is one vertex.
    std::vector<std::uint32_t> vertices;

    [[nodiscard]] bool is_loop() const {
      return vertices.size() > 1 && vertices.front() == vertices.back();
    }
    friend bool operator==(const Course&, const Course&) = default;
  };

  std::vector<cdt::Point> points;                       ///< sorted
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< the smallest corner first; sorted
  std::vector<std::uint32_t> neighbours;   ///< by 3 * triangle + corner: the edge's twin, or none
  std::vector<std::uint32_t> region_of;    ///< one a triangle
  std::vector<Region> regions;             ///< in the order of their first triangles
  std::vector<Course> constraints;         ///< in the order of their numbers
  std::vector<Piece> pieces;               ///< sorted
  std::vector<std::uint32_t> first_piece;  ///< of those `from` a vertex; one more at the end

  /// The pieces along the edge between two vertices; none if it is not constrained.
  [[nodiscard]] std::span<const Piece> pieces_along(std::uint32_t a, std::uint32_t b) const;
  /// The same for the edge 3 * triangle + corner.
  [[nodiscard]] std::span<const Piece> pieces_along(std::size_t edge) const {
    return pieces_along(start_of(edge), start_of(next(edge)));
  }
  /// The vertex that the edge 3 * triangle + corner starts from.
  [[nodiscard]] std::uint32_t start_of(std::size_t edge) const {
    return triangles[edge / 3][edge % 3];
  }
  /// The next edge around the same triangle.
  [[nodiscard]] static std::size_t next(std::size_t edge) {
    return edge % 3 == 2 ? edge - 2 : edge + 1;
  }

  friend bool operator==(const PlanarMesh&, const PlanarMesh&) = default;
};

/// Makes the planar mesh. The constraints get their numbers in the order given; where none is
/// given, those of the triangulation are numbered by their courses, without names.
/// Precondition: the constraints given are all of the triangulation's, each once.
/// Cost: O(n log n).
[[nodiscard]] PlanarMesh to_planar_mesh(const cdt::Triangulation& mesh,
                                        std::span<const NamedConstraint> constraints = {});

/// How many edges have a constraint along them.
[[nodiscard]] std::size_t count_constrained_edges(const PlanarMesh& mesh);

}  // namespace loft::io
