// SPDX-License-Identifier: MIT
#pragma once

#include <istream>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/stacks/stack_format.h"
#include "reconstruct/slice.h"

namespace loft::io {

/// The native stack format: NDJSON, one slice a line, in any order of height.
///
///     {"z": 1.25, "contours": [[[x, y], [x, y], ...], ...], "labels": ["heart", ...]}
///
/// A contour is closed without repeating its first point (a repeated one does no harm). The
/// optional `labels` name each contour, `sources` say where each comes from (Contour::source),
/// `places` where its points are in the world ([x, y, z] each; Contour::places). `"op": "insert"`
/// is accepted; other edits belong in a stream. Blank lines, a byte order mark, CRLF line ends and
/// unknown keys are ignored; but a key that is a letter away from one that is not there
/// (`"contour"`, `"Z"`, `"lables"`) is misspelt, and an error. Contours of any number of points are
/// kept, and so are two lines with the same z.
///
/// The first line may say what holds for all, each member optional (see Stack):
///
///     {"stack": {"unit": "mm", "frame": [16 numbers, row by row], "fill": "evenodd",
///                "labels": [{"name": "heart", "colour": "#d02030", "id": "3", "kind": "ORGAN"}]}}
///
/// Coordinates must be finite numbers. Throws InputError that names `name`, line, slice, contour
/// and point of each bad place (the first 20, and how many more), also for a stream without slices;
/// FileError if reading fails. Lines are read in parallel by so many threads; 0: as many as the
/// machine has. Cost: O(n); a few lines are in memory at a time.
[[nodiscard]] Stack read_stack_json(std::istream& in, std::string_view name, unsigned threads = 0);

/// The same as a reader of the table of formats.
[[nodiscard]] Stack read_ndjson(const StackInput& input, const ReadOptions& options);

/// The slices alone.
[[nodiscard]] std::vector<Slice> read_slices_json(std::istream& in, std::string_view name,
                                                  unsigned threads = 0);

/// Appends a slice as one line, without its end. Precondition: as write_slices_json().
void append_slice(std::string& line, const Slice& slice);

/// Writes a stack so that read_stack_json() gives it back, exactly. Preconditions: as below.
void write_stack_json(std::ostream& out, const Stack& stack);

/// Writes slices so that read_slices_json() gives them back, exactly.
/// Precondition: all numbers are finite, labels are UTF-8.
void write_slices_json(std::ostream& out, std::span<const Slice> slices);

}  // namespace loft::io
