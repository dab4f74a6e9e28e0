// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/predicates.h"
#include "reconstruct/shape/nearness.h"

namespace loft {

/// Keeps a surface that changes within a distance of what it was, both ways.
///
/// Each face of the surface as it was has witnesses: faces of the surface as it is that are
/// together near all of it. When faces are replaced, those of which they were witnesses must find
/// new ones among what comes and what is beside; and all of what comes must be near faces that the
/// old witnessed. So what is measured is the distance from the first surface, whatever the number
/// of changes since.
///
/// Faces have numbers, at first as they come; results depend on the faces' places and order.
class Witnesses {
 public:
  struct Made {
    std::uint32_t face;
    Corners corners;
  };

  Witnesses(std::vector<Corners> faces, double distance);

  /// Whether all stays near if the faces `gone` were replaced by `made`, which take over numbers
  /// of theirs. `beside` are faces along the rim of both.
  [[nodiscard]] bool keeps_near(std::span<const std::uint32_t> gone, std::span<const Made> made,
                                std::span<const std::uint32_t> beside);

  /// Does what the last call of keeps_near() asked for. Precondition: it said yes.
  void replace(std::span<const std::uint32_t> gone, std::span<const Made> made);

 private:
  using Faces = std::vector<std::uint32_t>;

  /// The first faces of which some of `gone_` is a witness.
  void find_affected(std::span<const std::uint32_t> gone);

  [[nodiscard]] bool finds_witnesses(std::uint32_t first_face, std::span<const Made> made,
                                     std::span<const std::uint32_t> beside);

  /// Whether all of what is made is near what it is to witness, or what the faces beside do.
  [[nodiscard]] bool made_is_near(std::span<const Made> made,
                                  std::span<const std::uint32_t> beside);

  [[nodiscard]] bool is_gone(std::uint32_t face) const { return gone_[face] == change_; }

  std::vector<Corners> first_;    // the faces as they were
  std::vector<Corners> current_;  // as they are
  std::vector<Faces> witnesses_;  // of each first face
  std::vector<Faces> witnessed_;  // by each current face; some may have found others since
  Nearness nearness_;

  // Of the change at hand.
  std::vector<std::uint32_t> gone_;  // of each face: the last change that replaces it
  std::uint32_t change_ = 0;
  Faces affected_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found_;  // a first face, its new witness
  Faces choice_;
  std::vector<Corners> choice_corners_;
};

}  // namespace loft
