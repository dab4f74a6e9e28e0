// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace loft::app {

/// Whether a file is a table, by its extension: `.csv`.
[[nodiscard]] bool is_table(const std::filesystem::path& output);

/// Whether a table or a map could be written there now: throws what that would throw, without
/// touching it.
void check_table_or_map(const std::filesystem::path& output);

/// The file appears whole or not at all. Throws FileError.
void write_table(const std::filesystem::path& output, std::string_view table);

}  // namespace loft::app
