// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "app/json.h"
#include "mesh/mesh.h"
#include "reconstruct/stack.h"

namespace loft::app {

/// What can be said of a structure that is shown; lengths in the stack's unit.
struct ShownLabel {
  std::string label;
  std::optional<Colour> colour = {};  ///< that its source gives it; none: by its name
  bool is_skin = false;               ///< see io::is_skin()
  std::size_t slices = 0;             ///< that have contours of it; 0 where that is not known
  std::optional<double> volume = 0;   ///< none, and the area, where there is no surface
  std::optional<double> area = 0;
  std::size_t faces = 0;
};

/// `{"labels":[{"label","colour":"#rrggbb","is_skin","slices","volume","area","faces"}]}`;
/// null for a number that is none
[[nodiscard]] Json to_json(std::span<const ShownLabel> labels);

/// The sum of the areas of all faces.
[[nodiscard]] double area(const Mesh& mesh);

}  // namespace loft::app
