// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fields/separator.h"

namespace loft::fields {

/// Some pieces of a separator. A view.
struct PiecesOf {
  const Separator* line = nullptr;  ///< none: no pieces
  OwnPieces own = {};

  [[nodiscard]] std::span<const SeparatorPiece> pieces() const {
    if (line == nullptr) return {};
    return line->pieces().subspan(own.first, own.last - own.first);
  }
};

/// What is added to the standing of a place where pieces of a separator go and others come. The
/// pieces are listed by height, so that not all of them are asked.
class StandingChange {
 public:
  /// Both must outlive it. Cost: O(pieces), times the slabs that each is in.
  StandingChange(const PiecesOf& gone, const PiecesOf& come);

  /// Exact. Cost: the pieces that are about as high as p.
  [[nodiscard]] Standing at(Point p) const;

 private:
  struct Entry {
    SeparatorPiece piece;
    bool is_gone;
  };

  void list(std::span<const SeparatorPiece> pieces, bool is_gone);
  [[nodiscard]] std::size_t slab_of(double y) const;

  const Separator* gone_;
  const Separator* come_;
  double low_ = 0;
  double slabs_per_height_ = 0;
  std::vector<std::vector<Entry>> slabs_;
};

}  // namespace loft::fields
