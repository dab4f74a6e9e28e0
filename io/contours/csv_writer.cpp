// SPDX-License-Identifier: MIT
#include "io/contours/csv_writer.h"

#include <cstdint>
#include <ostream>

#include "io/bytes/csv_field.h"
#include "reconstruct/number_text.h"
#include "reconstruct/world.h"

namespace loft::io {

std::vector<std::string> write_csv(std::ostream& out, const Stack& stack) {
  out << "x,y,z,contour,label\r\n";
  std::size_t number = 0;
  std::size_t empty = 0;
  for (std::uint32_t s = 0; s < stack.slices.size(); ++s) {
    const Slice& slice = stack.slices[s];
    empty += slice.contours.empty() ? 1U : 0U;
    for (std::uint32_t c = 0; c < slice.contours.size(); ++c, ++number) {
      const Contour& contour = slice.contours[c];
      const std::string end =
          ',' + std::to_string(number) + ',' + csv_field(contour.label) + "\r\n";
      std::string lines;
      for (std::uint32_t p = 0; p < contour.points.size(); ++p) {
        const Vec3 place = world_place(stack, {contour.points[p].x, contour.points[p].y, slice.z},
                                       {VertexKind::contour, s, c, p});
        append_number(lines, place[0]);
        lines += ',';
        append_number(lines, place[1]);
        lines += ',';
        append_number(lines, place[2]);
        lines += end;
      }
      out << lines;
    }
  }
  std::vector<std::string> losses;
  if (empty > 0)
    losses.push_back("CSV has no empty slices: " + std::to_string(empty) + " left out");
  if (!stack.unit.empty() || !stack.labels.empty())
    losses.push_back("CSV has no units and no colours: left out");
  return losses;
}

}  // namespace loft::io
