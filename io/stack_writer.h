// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reconstruct/stack.h"

namespace loft::io {

/// Writes a stack; the extension chooses the format. The file appears whole or not at all.
///
///     .ndjson   all that there is; read_stack() gives it back, exactly
///     .csv      x, y, z in the world, contour, label; exact
///     .cli      layers of a printer: what the contours enclose, level, in mm by $$UNITS
///     .contour  planes in the world; on each side of an edge a label's number, or 0
///
/// Returns what the format cannot hold and was left out, one sentence each. Throws UnknownFormat,
/// FileError, InputError where a coordinate is none.
std::vector<std::string> write_stack(const std::filesystem::path& path, const Stack& stack);

/// Whether write_stack() could write this file now: throws what it would throw.
void check_stack_writable(const std::filesystem::path& path);

/// The extensions that write_stack() knows, in lower case.
[[nodiscard]] std::string stack_writer_extensions();

}  // namespace loft::io
