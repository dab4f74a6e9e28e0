// SPDX-License-Identifier: MIT
#pragma once

namespace loft::app {

/// Puts /dev/null, for reading, where standard input, output or error is closed. Else the next file
/// that is opened takes the place, and what is meant for them lands in it. Writing there fails.
void open_closed_descriptors();

}  // namespace loft::app
