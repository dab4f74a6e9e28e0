// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "cdt/point.h"

namespace loft::app {

/// What the page asked for cannot be done: an HTTP status, and why.
class Refusal : public std::runtime_error {
 public:
  Refusal(int status, const std::string& why) : std::runtime_error(why), status_(status) {}
  [[nodiscard]] int status() const { return status_; }

 private:
  int status_;
};

/// What a page names a thing of a scene by. Never used again.
using ItemId = std::uint32_t;

/// Something that the page wants done with a scene.
struct Edit {
  enum class Kind {
    move,     ///< a thing to another place
    reshape,  ///< other points for it
    insert,   ///< a new one
    remove,
    set,  ///< something that has a name: of a thing, or of the scene
  };
  Kind kind = Kind::move;
  std::optional<ItemId> id = {};
  std::optional<cdt::Point> at = {};     ///< where it is to be, as the state of the scene says
  std::vector<cdt::Point> points = {};   ///< of insert and reshape: one at least
  std::string name = {};                 ///< of set: what; of insert: a kind of thing, or empty
  std::optional<std::string> text = {};  ///< of set: its value, this or
  std::optional<double> value = {};      ///< that; of insert: what is measured there

  friend bool operator==(const Edit&, const Edit&) = default;
};

/// What an edit may be at most.
struct EditLimits {
  std::size_t most_points = 2'000;
  std::size_t most_text = 10'000;  ///< bytes
  std::size_t most_name = 100;
};

/// The door: all that a page sends comes through here.
///
///     {"do": "move", "id": 7, "at": [x, y]}
///     {"do": "reshape", "id": 7, "points": [[x, y], ...]}
///     {"do": "insert", "points": [[x, y], ...], "name": "wall", "id": 2, "value": 1.5}
///     {"do": "remove", "id": 7}
///     {"do": "set", "name": "radius", "value": 1.5}         or "text"; with or without "id"
///
/// What it admits: one object with these keys, each once; ids below 2^32; coordinates and values
/// that are 0 or from 1e-50 to 1e75 in magnitude, what a triangulation takes; numbers, texts and
/// names within the limits. Whether an id names something is the scene's to say. Throws Refusal
/// (400, of what is too large 413) that says what is wrong. Cost: O(bytes).
[[nodiscard]] Edit read_edit(std::string_view text, const EditLimits& limits = {});

/// Something that the page wants to know of a scene.
struct Question {
  std::string what = {};
  std::optional<ItemId> id = {};
  std::optional<cdt::Point> at = {};
};

/// The same for a question: `at` has the text `x,y`; empty texts are not given.
[[nodiscard]] Question read_question(std::string what, std::string_view id, std::string_view at);

}  // namespace loft::app
