// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace loft::io {

/// What stands in front of the layers of a CLI file.
struct CliHeader {
  bool is_binary = false;
  bool is_aligned = false;  ///< commands take four bytes
  double units = 1;         ///< mm a unit
  std::map<std::int64_t, std::string> labels;
  std::optional<std::array<double, 6>> dimension;  ///< in mm: least x, y, z, largest x, y, z
  std::optional<double> layers;                    ///< how many there should be
  std::size_t end = 0;                             ///< the byte behind it
};

/// Throws InputError that lists what is wrong.
[[nodiscard]] CliHeader read_cli_header(std::string_view bytes, std::string_view name);

/// A number as CLI writes it, with zeros and blanks around it; none if it is none, or not finite.
[[nodiscard]] std::optional<double> cli_number(std::string_view text);
/// Takes what is before the next comma out of a list; all of it if there is none.
std::string_view next_parameter(std::string_view& list);

}  // namespace loft::io
