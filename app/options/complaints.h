// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "app/commands/commands.h"
#include "cdt/point.h"
#include "mesh/mesh.h"

namespace loft::app {

/// Checks of what an option is given: the text says what is wrong, empty if nothing is.
[[nodiscard]] std::string complain_of_unit(const std::string& unit);
[[nodiscard]] std::string complain_of_length(const std::string& text);
[[nodiscard]] std::string complain_of_distance(const std::string& text);
/// As a distance, for a triangulation.
[[nodiscard]] std::string complain_of_epsilon(const std::string& text);
/// Edits a second, within what glTF's seconds, which are floats, tell apart.
[[nodiscard]] std::string complain_of_rate(const std::string& text);
[[nodiscard]] std::string complain_of_spacing(const std::string& text);

/// A finite number.
[[nodiscard]] std::string complain_of_value(const std::string& text);
[[nodiscard]] std::string complain_of_grid_size(const std::string& text);
[[nodiscard]] std::string complain_of_place(const std::string& text);
[[nodiscard]] std::string complain_of_direction(const std::string& text);

[[nodiscard]] std::string complain_of_slabs(const std::string& text);

/// `A..B`, `A..`, `..B`; none if the text is anything else.
[[nodiscard]] std::optional<SlabChoice> slab_choice(const std::string& text);
/// Three lengths with commas between them; none if the text is anything else.
[[nodiscard]] std::optional<Vec3> spacing(const std::string& text);
/// Two coordinates that a triangulation takes.
[[nodiscard]] std::optional<cdt::Point> place(const std::string& text);
/// Columns and rows, `1000x800`; none if the text is anything else.
[[nodiscard]] std::optional<GridSize> grid_size(const std::string& text);
/// Three numbers, not all 0.
[[nodiscard]] std::optional<Vec3> direction(const std::string& text);

}  // namespace loft::app
