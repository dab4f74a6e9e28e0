// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "io/stacks/stack_format.h"

namespace loft::io {

/// Reads models of IMOD (binary, version 1.2): objects are labels with their names and colours;
/// contours in one another are holes (Fill::even_odd).
///
/// Coordinates are pixels times the pixel size, heights sections times that and the z scale, in the
/// model's unit; the origin of the image (MINX), where the model says it has it, is in the frame.
/// Models that were drawn on flipped images have their contours in planes of constant y, or x: the
/// planes that most contours are in are the slices, and the frame leads back.
///
/// Open contours (by their object, or themselves), objects of scattered points, contours of one or
/// two points and such as are in no plane are left out, and counted. Meshes and other chunks are
/// passed over.
[[nodiscard]] Stack read_imod(const StackInput& input, const ReadOptions& options);

/// Whether a file begins as a model of IMOD does, of any version.
[[nodiscard]] bool begins_like_imod(std::string_view bytes);

}  // namespace loft::io
