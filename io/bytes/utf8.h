// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace loft::io {

/// Whether the text is UTF-8: no stray or overlong bytes, no surrogates, nothing past U+10FFFF.
[[nodiscard]] bool is_utf8(std::string_view text);

/// Text that JSON can hold: where it is no UTF-8 (a file's name can be anything), its odd bytes are
/// replaced.
[[nodiscard]] std::string json_text(std::string text);

/// Appends a character. Precondition: up to U+10FFFF, no surrogate.
void append_utf8(std::string& text, char32_t character);

}  // namespace loft::io
