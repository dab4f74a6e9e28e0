// SPDX-License-Identifier: MIT
// Only for sources that are built with DCMTK.
#pragma once

#include "io/dicom/dicom_object.h"
#include "io/stacks/read_options.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// The outlines (outlines.h) of the segments of a Segmentation (DICOM PS3.3, A.51, and A.90 of
/// label maps), in the patient's millimetres; a label for each segment, with its number as id and
/// its category for kind. Segments may overlap; those of a label map do not, and its segment 0 is
/// background. Of fractional ones at least half of the largest value there may be is inside, unless
/// the options have a level.
///
/// Frames may be in any order; see read_seg_frames() for those that are left out. Throws
/// InputError with paths of tags, and for pixels that are compressed by another way than RLE
/// Lossless.
[[nodiscard]] Stack read_segmentation(DicomObject& object, const ReadOptions& options);

/// What DCMTK 3.6.7 has no name for.
inline constexpr const char* label_map_segmentation = "1.2.840.10008.5.1.4.1.1.66.7";

}  // namespace loft::io
