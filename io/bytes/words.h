// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace loft::io {

/// The text without blanks, tabs and ends of lines at its ends.
[[nodiscard]] std::string_view without_blanks(std::string_view text);

/// What blanks and tabs part.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text);

/// ASCII letters in lower case.
[[nodiscard]] std::string in_lower_case(std::string_view text);

/// A decimal number, as what is all of the text but for blanks around it; may be infinite or none.
[[nodiscard]] std::optional<double> number_in(std::string_view text);

}  // namespace loft::io
