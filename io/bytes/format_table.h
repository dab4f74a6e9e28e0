// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "io/bytes/file.h"

namespace loft::io {

/// Formats of one kind of file, chosen by the extension: rows that have an `extension`.
template <typename Format, std::size_t count>
using FormatTable = std::array<Format, count>;

/// All extensions, with a blank between two.
template <typename Format, std::size_t count>
[[nodiscard]] std::string extensions_of(const FormatTable<Format, count>& formats) {
  std::string result;
  for (const Format& format : formats) {
    if (!result.empty()) result += ' ';
    result += format.extension;
  }
  return result;
}

/// The format of a file's name; null if there is none.
template <typename Format, std::size_t count>
[[nodiscard]] const Format* find_format(const FormatTable<Format, count>& formats,
                                        const std::filesystem::path& path) {
  const auto found = std::ranges::find(formats, extension(path), &Format::extension);
  return found == formats.end() ? nullptr : &*found;
}

/// The format of a file's name. Throws UnknownFormat.
template <typename Format, std::size_t count>
[[nodiscard]] const Format& format_of(const FormatTable<Format, count>& formats,
                                      const std::filesystem::path& path) {
  const Format* const format = find_format(formats, path);
  if (format == nullptr) throw UnknownFormat(path, extensions_of(formats));
  return *format;
}

}  // namespace loft::io
