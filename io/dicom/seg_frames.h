// SPDX-License-Identifier: MIT
// Only for sources that are built with DCMTK.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/dicom/dicom_object.h"
#include "mesh/mesh.h"

namespace loft::io {

/// An image of a Segmentation, in the order of the file.
struct SegFrame {
  Vec3 origin{};              ///< of the centre of its first pixel
  std::uint16_t segment = 0;  ///< 0: it is of no one segment
  std::uint32_t plane = 0;    ///< once they are sorted
};

/// All frames, and where their planes lie.
struct SegFrames {
  std::vector<SegFrame> frames;
  /// From (column, row, distance from the first plane, 1) to the patient.
  std::array<std::array<double, 4>, 3> to_world{};
  std::vector<double> positions;  ///< of planes along their normal, from the first; ascending
  double spacing = 0;             ///< of planes as the file says it; 0: it does not
};

/// Reads where frames lie, and sorts them into planes. Planes are kept as far from each other as
/// they are; but where the file's spacing of them says that some have been left out, there is one
/// without frames next to either end of the gap, which is enough to leave it open. Throws
/// InputError with paths of tags for places that are none or do not make a volume.
[[nodiscard]] SegFrames read_seg_frames(DicomObject& object, bool have_segments);

}  // namespace loft::io
