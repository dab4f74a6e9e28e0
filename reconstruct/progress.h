// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace loft {

/// The stages of a reconstruction, in their order; `simplify` only with Options::simplify.
enum class Stage { clean, tile, sew, simplify };

/// Called as a reconstruction goes on: the stage and the finished fraction of it, from 0 to 1.
/// Each stage reports 0 when it begins. Return false to cancel: reconstruct() then throws
/// Cancelled. May be empty.
using Progress = std::function<bool(Stage stage, double fraction)>;

}  // namespace loft
