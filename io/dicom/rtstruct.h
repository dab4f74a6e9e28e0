// SPDX-License-Identifier: MIT
// Only for sources that are built with DCMTK.
#pragma once

#include "io/dicom/dicom_object.h"
#include "io/stacks/read_options.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// The closed contours of an RT Structure Set (DICOM PS3.3, A.19), in the patient's millimetres; a
/// label for each ROI, with its number as id and what it is interpreted as for kind. ROIs of one
/// name are told apart by their numbers. Contours are CLOSED_PLANAR or CLOSEDPLANAR_XOR, and
/// nested ones are holes; points, lines and closed contours of less than three points are left
/// out, and a note for each label counts them. Channels to holes are closed where rt-utils drew
/// them (close_pin_holes()), unless the options have a rule that is not aware of keyholes.
///
/// Planes: see into_slices(). Throws InputError for numbers that are none, for planes that are not
/// parallel and where there is no closed contour.
[[nodiscard]] Stack read_structure_set(DicomObject& object, const ReadOptions& options = {});

}  // namespace loft::io
