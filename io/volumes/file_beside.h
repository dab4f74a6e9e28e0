// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "io/bytes/file.h"
#include "io/stacks/stack_format.h"

namespace loft::io {

/// The content of a second file that a header names in a field: a regular one in the header's own
/// folder. Throws InputError that names the field where it is none, FileError where it cannot be
/// read.
[[nodiscard]] FileBytes read_file_beside(const StackInput& header, std::string_view field,
                                         const std::string& file);

}  // namespace loft::io
