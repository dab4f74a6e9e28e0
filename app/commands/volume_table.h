// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/commands/reconstruct_report.h"

namespace loft::app {

/// The volumes of some labels, for people: a line each with name, slices, contours, volume (in
/// cm^3, too, where the unit is a length), area.
[[nodiscard]] std::vector<std::string> volume_table(std::span<const PartReport> parts,
                                                    const std::string& unit);

/// The same as CSV (RFC 4180), with a header: label, slices, contours, volume_cm3, volume, unit,
/// area. Numbers are exact, with a decimal point. Throws FileError.
void write_volumes_csv(const std::filesystem::path& path, std::span<const PartReport> parts,
                       const std::string& unit);

}  // namespace loft::app
