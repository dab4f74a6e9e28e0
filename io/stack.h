// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/stacks/read_options.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// The stack in a file, just as it is written there: nothing is cleaned, sorted or merged. The
/// file's first bytes or its extension choose the reader; `-` is standard input, as NDJSON. A
/// folder is a series of images, in natural order of their names.
///
/// Throws FileError where the file cannot be read, UnknownFormat, and InputError that lists all
/// that is wrong; a file without any slice is bad, too.
[[nodiscard]] Stack read_stack(const std::filesystem::path& path, const ReadOptions& options = {});

/// The stack in several files: their slices one after the other; images of a series as one volume,
/// in natural order of their names.
/// What is wrong in any of them is listed. Throws InputError, too, where their units or frames
/// differ.
[[nodiscard]] Stack read_stack(std::span<const std::filesystem::path> paths,
                               const ReadOptions& options = {});

/// For each file the label that its contours without one take: its name without extension, or,
/// where two files share that, its whole path. Empty where there is one file only, or they are
/// kept.
[[nodiscard]] std::vector<std::string> labels_of(std::span<const std::filesystem::path> paths,
                                                 Unlabelled unlabelled);

/// Gives the contours of a slice that have no label that one.
void label_unlabelled(Slice& slice, const std::string& label);

/// The extensions that read_stack() knows, in lower case: `.ndjson .jsonl .json ...`.
[[nodiscard]] std::string stack_extensions();

/// Whether read_stack() has a reader for this file, going by its name, or by its first bytes where
/// they can be read; a folder may be one of images.
[[nodiscard]] bool is_stack_file(const std::filesystem::path& path);

}  // namespace loft::io
