// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/measure.h"
#include "reconstruct/option_names.h"
#include "reconstruct/options.h"
#include "reconstruct/progress.h"
#include "reconstruct/slice.h"

namespace loft::app {

/// How much of a stack there is: all of it, or the contours of one label.
struct StackSize {
  std::size_t slices = 0;  ///< with at least one of the contours
  std::size_t contours = 0;
  std::size_t vertices = 0;
};

[[nodiscard]] StackSize size_of(const std::vector<Slice>& stack);
/// Of some contours, in order.
[[nodiscard]] StackSize size_of(const std::vector<Slice>& stack,
                                std::span<const ContourId> contours);

/// Adds what there is of each label in a slice.
void add_sizes(std::map<std::string, StackSize>& of_labels, const Slice& slice);

/// `1,234,567`
[[nodiscard]] std::string grouped(std::size_t number);
/// `1 slice`, `1,234 slices`
[[nodiscard]] std::string counted(std::size_t number, const std::string& what);
/// Four significant digits, for people; words where a number is beyond all numbers.
[[nodiscard]] std::string rounded(double number);
/// `1,234 triangles, 619 vertices, 1 component, genus 0, area 12.3 mm^2, volume 4.56 mm^3`; `unit`
/// is a name that metres_per_unit() knows; a number of metres, or nothing, is called `unit`.
[[nodiscard]] std::string describe(const Measures& measures, std::string_view unit);
/// What unit_names calls it, for people.
[[nodiscard]] std::string unit_word(std::string_view unit);
/// `smallest angles: least 1.2, 5th percentile 12.3, median 34.5 degrees; worst aspect 56.7`
[[nodiscard]] std::string describe(const Angles& angles);

/// Whether contours are bent without having been made fair.
[[nodiscard]] inline bool bends_as_they_are(const Options& options) {
  return options.smooth && !options.fair;
}
/// The warning that stairs are bent from slice to slice, and the ways out.
inline constexpr const char* stairs_are_bent =
    "the contours are stairs, as outlines along pixels are, and --smooth bends every step; smooth "
    "them in their slices with --fair DISTANCE, half a pixel or a little more, or draw outlines of "
    "label volumes with --outline fair or iso";

}  // namespace loft::app
