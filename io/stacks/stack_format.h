// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "io/stacks/read_options.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// A file that a stack is read from.
struct StackInput {
  std::string_view bytes;             ///< all that is in it
  std::string name;                   ///< what messages call it
  std::filesystem::path folder = {};  ///< for formats that have their pixels in a second file
};

/// A format of stacks: one row of the table in stack_formats.cpp.
///
/// A reader throws InputError that lists what is wrong, each with its place (line, byte offset,
/// tag) and the way out. It trusts no count in the file: what it asks memory for is a small
/// multiple of bytes that are there.
struct StackFormat {
  std::string_view name;        ///< `NIfTI`
  std::string_view extensions;  ///< in lower case: `.nii .nii.gz`
  Stack (*read)(const StackInput& input, const ReadOptions& options);
  /// Whether a file that begins like that is of this format, whatever it is called; may be null.
  bool (*begins_like)(std::string_view bytes) = nullptr;
  /// Of images of which each is a slice: all of them, in the order given; may be null.
  Stack (*read_series)(std::span<const StackInput> inputs, const ReadOptions& options) = nullptr;
};

/// All that can be read.
[[nodiscard]] std::span<const StackFormat> stack_formats();

/// The format of a file, by its first bytes or else by its name; null if it is none of them.
[[nodiscard]] const StackFormat* find_stack_format(const std::filesystem::path& path,
                                                   std::string_view bytes);
/// By its name alone.
[[nodiscard]] const StackFormat* find_stack_format(const std::filesystem::path& path);

/// How many first bytes begins_like() wants to see.
inline constexpr std::size_t enough_to_tell = 1024;

/// For formats that are known but not read: with what to convert them; empty for others.
[[nodiscard]] std::string_view advice_for(const std::filesystem::path& path);

}  // namespace loft::io
