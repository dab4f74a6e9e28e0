// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "app/terminal.h"
#include "io/surfaces.h"

namespace loft::app {

/// Says what became of surfaces in a file, if they are not all there as they were: what could not
/// be mended, and where the coordinates are about.
void tell(const std::filesystem::path& output, const io::Written& written, Terminal& terminal);

}  // namespace loft::app
