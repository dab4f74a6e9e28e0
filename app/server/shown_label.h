// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "app/json.h"
#include "mesh/mesh.h"

namespace loft::app {

/// What can be said of a structure that is shown; lengths in the stack's unit.
struct ShownLabel {
  std::string label;
  bool is_skin = false;    ///< encloses the others, so that it would hide them
  std::size_t slices = 0;  ///< that have contours of it; 0 where that is not known
  double volume = 0;
  double area = 0;
  std::size_t faces = 0;
};

/// `{"labels":[{"label","colour":"#rrggbb","is_skin","slices","volume","area","faces"}]}`
[[nodiscard]] Json to_json(std::span<const ShownLabel> labels);

/// Whether a structure is the outside of a body: by the type that its source gives it (EXTERNAL,
/// BODY), else by its name, where `external`, `body` or `skin` is a word in it.
[[nodiscard]] bool is_skin(std::string_view label, std::string_view kind = "");

/// The sum of the areas of all faces.
[[nodiscard]] double area(const Mesh& mesh);

}  // namespace loft::app
