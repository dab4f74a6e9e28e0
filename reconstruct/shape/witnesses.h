// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "mesh/predicates.h"
#include "reconstruct/shape/cover.h"
#include "reconstruct/shape/nearness.h"
#include "reconstruct/shape/prism.h"

namespace loft {

/// Keeps a surface that changes within a distance of what it was, both ways.
///
/// Each face of the surface as it was has witnesses: faces of the surface as it is that are
/// together near all of it. When faces are replaced, those of which they were witnesses must find
/// new ones among what comes and what is beside; and all of what comes must be near faces that the
/// old witnessed. So what is measured is the distance from the first surface, whatever the number
/// of changes since.
///
/// That is proven by a search, which costs as much as there are first faces around. It is not
/// needed as long as one map after the other is known to have moved no point by more than the
/// distance: a face that came by such changes alone is near by its map, and where each point of a
/// first face went is one of its witnesses.
///
/// Faces have numbers, at first as they come; results depend on the faces' places and order.
class Witnesses {
 public:
  struct Made {
    std::uint32_t face;
    Corners corners;
  };

  /// `neighbours`: of each face, as Cover asks for them.
  Witnesses(std::vector<Corners> faces, std::vector<Cover::Neighbours> neighbours, double distance);
  Witnesses(const Witnesses&) = delete;
  Witnesses& operator=(const Witnesses&) = delete;

  /// Faces `gone` that are to be replaced by `made`, which take over numbers of theirs.
  struct Change {
    std::vector<std::uint32_t> gone;
    std::vector<Made> made;
    std::vector<std::uint32_t> beside;  ///< faces along the rim of both
    /// How far this and the changes that made `gone` together have moved any point of theirs, as
    /// maps of the one to the other; infinite if some was none.
    double moved = std::numeric_limits<double>::infinity();
  };

  /// Whether all stays near by a change.
  [[nodiscard]] bool keeps_near(const Change& change);

  /// Makes the change that the last call of keeps_near() was asked for. Precondition: it said yes.
  void replace(const Change& change);

 private:
  using Faces = std::vector<std::uint32_t>;

  /// The first faces of which some of `gone` is a witness.
  void find_affected(std::span<const std::uint32_t> gone);

  /// Witnesses of a face without a search: those that it has and keeps, and all that is made where
  /// it may have been moved to.
  void follow_map(std::uint32_t first_face, const Change& change);

  [[nodiscard]] bool finds_witnesses(std::uint32_t first_face, const Change& change);

  /// Whether all of what is made is near what it is to witness, or what the faces beside do.
  [[nodiscard]] bool made_is_near(const Change& change);

  [[nodiscard]] bool is_gone(std::uint32_t face) const { return gone_[face] == change_; }

  std::vector<Corners> first_;         // the faces as they were
  std::vector<Corners> current_;       // as they are
  std::vector<Faces> witnesses_;       // of each first face
  std::vector<Faces> witnessed_;       // by each current face; some may have found others since
  std::vector<bool> first_is_mapped_;  // of each first face: its witnesses came by maps alone
  std::vector<bool> is_mapped_;        // the same of each current face, and its corners
  double distance_;
  Cover cover_;  // by the faces as they were
  Nearness nearness_;

  // Of the change at hand.
  std::vector<std::uint32_t> gone_;  // of each face: the last change that replaces it
  std::uint32_t change_ = 0;
  bool is_by_map_ = false;          // it needs no search for what is made
  std::vector<Prism> around_made_;  // where what is mapped to each that is made may come from
  Faces affected_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found_;  // a first face, its new witness
  Faces choice_;
  std::vector<Corners> choice_corners_;
};

}  // namespace loft
