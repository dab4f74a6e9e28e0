// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "reconstruct/reconstruction.h"

namespace loft::edits {

/// What is broken in the structure of a mesh that may have deleted elements; empty if nothing is.
[[nodiscard]] std::string broken(const Surface& surface);

/// How a live surface differs from the one built at once from the same slices; empty if they have
/// the same vertices and the same faces, of the same origin and kind, and the same repairs but for
/// slices that were merged. Nothing to compare is fine.
[[nodiscard]] std::string difference(const Reconstruction& live, const Options& options);

/// Random edits of a stack, all kinds of them: inserted in any order, at heights that are taken,
/// replaced, moved, by hardly anything, with contours that come and go, points and lines to end in,
/// removed, and rejected.
class RandomEdits {
 public:
  /// `pool`: slices to insert, each at its height.
  RandomEdits(std::vector<Slice> pool, std::uint64_t seed)
      : pool_(std::move(pool)), random_(seed) {}

  /// Does an edit. Returns what was wrong with it, or with what it says of itself (ChangeWatch).
  std::string next(Reconstruction& live);

 private:
  [[nodiscard]] std::size_t below(std::size_t bound) { return random_() % bound; }
  [[nodiscard]] double any_height(const Reconstruction& live);
  [[nodiscard]] std::string reject(Reconstruction& live);
  void jog(Slice& slice);
  void add_tip(Slice& slice, const Slice& other);
  std::optional<SurfaceChange> edit(Reconstruction& live);

  std::vector<Slice> pool_;
  std::mt19937_64 random_;
};

/// The first thing wrong with random edits, or different from the surface built at once after one;
/// empty if there is none.
[[nodiscard]] std::string fault_of_edits(const std::vector<Slice>& pool, std::uint64_t seed,
                                         int count);

}  // namespace loft::edits
