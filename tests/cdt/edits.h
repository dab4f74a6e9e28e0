// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cdt/point.h"
#include "cdt/triangulation.h"
#include "tests/cdt/reference.h"

namespace loft::cdt {

/// One edit of a set of constraints. Constraints have names, so that a script keeps its meaning
/// when some of its edits are dropped: what names a constraint that is not there does nothing, nor
/// does inserting one that is.
struct Edit {
  enum class Kind { insert, remove, move, translate };
  Kind kind = Kind::insert;
  std::size_t name = 0;
  Outline outline;  ///< insert; move: the points
  Point by;         ///< translate
  friend bool operator==(const Edit&, const Edit&) = default;
};
using Script = std::vector<Edit>;

/// A script as text, a line an edit: `insert NAME open|closed X Y ...`, `remove NAME`,
/// `move NAME X Y ...`, `translate NAME X Y`. Numbers are the shortest that are read back exactly.
/// Reading throws std::invalid_argument for anything else.
[[nodiscard]] std::string as_text(const Script& script);
[[nodiscard]] Script read_script(std::string_view text);

/// A script as statements that a test can hold.
[[nodiscard]] std::string as_code(const Script& script);

/// What there is after some edits, without triangles.
using Constraints = std::map<std::size_t, Outline>;

/// Whether an edit does anything, and its effect.
[[nodiscard]] bool applies(const Edit& edit, const Constraints& constraints);
void carry_out(const Edit& edit, Constraints& constraints);

/// What undoes an edit that applies.
[[nodiscard]] Edit inverse(const Edit& edit, const Constraints& before);

}  // namespace loft::cdt
