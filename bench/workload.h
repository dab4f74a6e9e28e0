// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "cdt/triangulation.h"

namespace loft::bench {

/// A constraint of a workload; one point alone is a point constraint.
struct Outline {
  std::vector<cdt::Point> points;
  cdt::Ends ends = cdt::open;
};
using Workload = std::vector<Outline>;

/// Reads a workload: for each constraint a line `n closed` (closed: 0 or 1), then n lines `x y`.
/// Throws std::runtime_error, with the place, if that is not what the file holds.
[[nodiscard]] Workload read_workload(const std::filesystem::path& path);

[[nodiscard]] std::size_t point_count(const Workload& workload);

/// The outlines as what bulk insertion takes. Valid as long as the workload.
[[nodiscard]] std::vector<cdt::Polyline> views(const Workload& workload);

/// The same outline somewhere else.
[[nodiscard]] Outline displaced(const Outline& outline, cdt::Point by);

}  // namespace loft::bench
