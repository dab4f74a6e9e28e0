// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reconstruct/slice.h"

namespace loft::io {

/// The slices of a stack file, in its order, just as they are written there: nothing is cleaned,
/// sorted or merged. The extension chooses the reader; `-` is standard input, as NDJSON.
///
/// Throws FileError where the file cannot be read, UnknownFormat, and InputError that lists all bad
/// lines; a file without any slice is bad, too. `threads` is how many read at the same time; 0: as
/// many as the machine has.
[[nodiscard]] std::vector<Slice> read_slices(const std::filesystem::path& path,
                                             unsigned threads = 0);

/// What becomes of contours without a label where there are several files.
enum class Unlabelled {
  keep,           ///< all files are one stack
  label_by_file,  ///< each file is a structure of its own: they take its name, see labels_of()
};

/// The slices of several files one after the other. Bad lines of all of them are listed.
[[nodiscard]] std::vector<Slice> read_slices(std::span<const std::filesystem::path> paths,
                                             unsigned threads = 0,
                                             Unlabelled unlabelled = Unlabelled::keep);

/// For each file the label that its contours without one take: its name without extension, or,
/// where two files share that, its whole path. Empty where there is one file only, or they are
/// kept.
[[nodiscard]] std::vector<std::string> labels_of(std::span<const std::filesystem::path> paths,
                                                 Unlabelled unlabelled);

/// Gives the contours of a slice that have no label that one.
void label_unlabelled(Slice& slice, const std::string& label);

/// The extensions that read_slices() knows, in lower case: `.ndjson .jsonl .json`.
[[nodiscard]] std::string slice_extensions();

/// Whether read_slices() has a reader for this file, going by its name alone.
[[nodiscard]] bool is_slice_file(const std::filesystem::path& path);

}  // namespace loft::io
