// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "cdt/point.h"
#include "cdt/triangulation.h"

namespace loft::io {

/// Something that happens to a feature of a scene.
struct SceneEdit {
  enum class Kind {
    move,     ///< by a vector
    reshape,  ///< other points for its only ring or line
    remove,
    insert,  ///< a new feature
  };
  Kind kind = Kind::move;
  std::string feature = {};             ///< its id or name; of a new one, or empty
  cdt::Point by = {};                   ///< of move
  std::vector<cdt::Point> points = {};  ///< of reshape and insert: one at least, as written
  cdt::Ends ends = cdt::closed;         ///< of insert: an open one is a wall
  std::string layer = {};               ///< of insert; empty where it is not said
  std::string place = {};               ///< in its file, for messages: `moves.ndjson:3`

  friend bool operator==(const SceneEdit&, const SceneEdit&) = default;
};

/// Reads edits, one a line, blank lines left out:
///
///     {"move": "box7", "by": [dx, dy]}
///     {"ring": "box7", "points": [[x, y], ...]}
///     {"remove": "box7"}
///     {"insert": {"id": "box9", "layer": "obstacles", "points": [[x, y], ...]}}
///     {"insert": {"id": "door", "line": [[x, y], ...]}}
///
/// A feature is called by its id (a text or a number) or its name; id and layer of a new one may be
/// left out. Keys that are unknown are ignored, those that are misspelt named.
///
/// Throws InputError that names `name` and line of each bad place, or says that there is no edit.
/// Cost: O(n).
[[nodiscard]] std::vector<SceneEdit> read_scene_edits(std::string_view text, std::string_view name);

}  // namespace loft::io
