// SPDX-License-Identifier: MIT
#include "fields/standing_change.h"

#include <algorithm>
#include <limits>

namespace loft::fields {

namespace {

/// From where to where a piece reaches in y.
struct Reach {
  double low;
  double high;
};

Reach reach_of(const SeparatorPiece& piece) {
  using Part = SeparatorPiece::Part;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double from = piece.a.y;
  const double to = piece.b.y;
  if (piece.part == Part::between || from == to) return {std::min(from, to), std::max(from, to)};
  const double end = piece.part == Part::before ? from : to;
  const bool is_under = (piece.part == Part::before) == (from < to);
  return is_under ? Reach{-infinity, end} : Reach{end, infinity};
}

}  // namespace

StandingChange::StandingChange(const PiecesOf& gone, const PiecesOf& come)
    : gone_(gone.line), come_(come.line) {
  constexpr std::size_t pieces_a_slab = 4;
  constexpr std::size_t most = 256;
  double high = -std::numeric_limits<double>::infinity();
  low_ = -high;
  for (const PiecesOf& half : {gone, come})
    for (const SeparatorPiece& piece : half.pieces()) {
      low_ = std::min({low_, piece.a.y, piece.b.y});
      high = std::max({high, piece.a.y, piece.b.y});
    }
  const std::size_t count = gone.pieces().size() + come.pieces().size();
  slabs_.resize(std::clamp<std::size_t>(count / pieces_a_slab, 1, most));
  if (high > low_) slabs_per_height_ = static_cast<double>(slabs_.size()) / (high - low_);
  list(gone.pieces(), true);
  list(come.pieces(), false);
}

/// Never less for a larger y, whatever is rounded.
std::size_t StandingChange::slab_of(double y) const {
  const double last = static_cast<double>(slabs_.size() - 1);
  if (!(y > low_)) return 0;
  return static_cast<std::size_t>(std::min((y - low_) * slabs_per_height_, last));
}

void StandingChange::list(std::span<const SeparatorPiece> pieces, bool is_gone) {
  for (const SeparatorPiece& piece : pieces) {
    const Reach reach = reach_of(piece);
    const std::size_t last = slab_of(reach.high);
    for (std::size_t i = slab_of(reach.low); i <= last; ++i) slabs_[i].push_back({piece, is_gone});
  }
}

Standing StandingChange::at(Point p) const {
  Standing sum;
  if (gone_ != nullptr) sum.winding -= gone_->closing(p);
  if (come_ != nullptr) sum.winding += come_->closing(p);
  for (const auto& [piece, is_gone] : slabs_[slab_of(p.y)]) {
    if (is_gone)
      sum -= piece.standing(p);
    else
      sum += piece.standing(p);
  }
  return sum;
}

}  // namespace loft::fields
