// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>

#include "tests/cdt/edits.h"

namespace loft::cdt {

/// When an edited triangulation is compared, and with what.
struct Judging {
  std::size_t every = 1;               ///< edits between comparisons; the last one always counts
  std::size_t reference_segments = 0;  ///< with the reference too, up to so many segments
};

/// How comparisons ended that found nothing wrong.
struct Tally {
  std::size_t edits = 0;
  std::size_t same_as_fresh = 0;
  std::size_t same_as_reference = 0;
  std::size_t snapped_in_vain = 0;  ///< of these: a snap is reported all the same
  std::size_t not_as_fresh = 0;     ///< but a snap is reported
  std::size_t not_embeddable = 0;   ///< rounding makes the answer of the reference impossible
  std::size_t unexplained = 0;      ///< snapped, and too large for the reference

  Tally& operator+=(const Tally& other);
  friend std::ostream& operator<<(std::ostream& out, const Tally& tally);
};

/// Plays a script on a triangulation. What is wrong first, in words; empty if nothing is:
/// check() finds nothing, and courses follow their segments; without snaps all is as in a
/// triangulation that has never been edited; where that is possible all is as the reference says.
[[nodiscard]] std::string first_wrong(const Script& script, Judging judging, Tally& tally);

/// The script with as few edits and points as possible that still has something wrong.
[[nodiscard]] Script shrunk(Script script, Judging judging);

/// first_wrong; if there is something: that, and the shrunk script as text and as code.
[[nodiscard]] std::string verdict(const Script& script, Judging judging, Tally& tally);

}  // namespace loft::cdt
