// SPDX-License-Identifier: MIT
#pragma once

#include <istream>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reconstruct/slice.h"

namespace loft::io {

/// The native stack format: NDJSON, one slice a line, in any order of height.
///
///     {"z": 1.25, "contours": [[[x, y], [x, y], ...], ...], "labels": ["heart", ...]}
///
/// A contour is closed without repeating its first point (a repeated one does no harm). The
/// optional `labels` name each contour. `"op": "insert"` is accepted; other edits belong in a
/// stream. Blank lines, a byte order mark, CRLF line ends and unknown keys are ignored; but a key
/// that is a letter away from one that is not there (`"contour"`, `"Z"`, `"lables"`) is misspelt,
/// and an error. Contours of any number of points are kept, and so are two lines with the same z.
///
/// Coordinates must be finite numbers. Throws InputError that names `name`, line, slice, contour
/// and point of each bad place (the first 20, and how many more), also for a stream without slices;
/// FileError if reading fails. Lines are read in parallel by so many threads; 0: as many as the
/// machine has. Cost: O(n); a few lines are in memory at a time.
[[nodiscard]] std::vector<Slice> read_slices_json(std::istream& in, std::string_view name,
                                                  unsigned threads = 0);

/// Appends a slice as one line, without its end. Precondition: as write_slices_json().
void append_slice(std::string& line, const Slice& slice);

/// Writes slices so that read_slices_json() gives them back, exactly.
/// Precondition: all numbers are finite, labels are UTF-8.
void write_slices_json(std::ostream& out, std::span<const Slice> slices);

}  // namespace loft::io
