// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace loft {

/// The stages of a reconstruction, in their order; smooth, refine and simplify only if asked for.
enum class Stage { clean, tile, smooth, refine, sew, simplify };

/// Called as a reconstruction goes on: the stage and the finished fraction of it, from 0 to 1.
/// Each stage reports 0 when it begins. Return false to cancel: reconstruct() then throws
/// Cancelled. May be empty. Called from any of the threads that work, but never twice at once, and
/// with fractions that never fall.
using Progress = std::function<bool(Stage stage, double fraction)>;

/// What reports call a stage: `clean`, `tile`, ...
[[nodiscard]] const char* name(Stage stage);

/// How much of all the work is done at that point: each stage counts for about what it takes.
[[nodiscard]] double overall(Stage stage, double fraction);

}  // namespace loft
