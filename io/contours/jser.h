// SPDX-License-Identifier: MIT
#pragma once

#include "io/stacks/stack_format.h"

namespace loft::io {

/// Reads a series of PyReconstruct, in either layout: `{"sections": [...], "series": {...}}`, or a
/// member a section, `NAME.12`, and `NAME.ser`. Each name of traces is a label, with its colour.
///
/// Traces are placed by ReadOptions::alignment, or else the series' current one; heights are the
/// thicknesses of the sections, summed, in micrometres. A section that is not there keeps its
/// place. What is in positive traces is inside, wherever they lie in one another (Fill::nonzero;
/// all are counter-clockwise), unless it is in a negative one: where a section has such, its
/// outlines are those of what is left. Hidden and open traces, and such of one or two points, are
/// left out, and counted.
///
/// Throws InputError. Cost: O(n), a section is in memory at a time beside the result; no document
/// tree is built.
[[nodiscard]] Stack read_jser(const StackInput& input, const ReadOptions& options);

}  // namespace loft::io
