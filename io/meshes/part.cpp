// SPDX-License-Identifier: MIT
#include "io/meshes/part.h"

#include <algorithm>
#include <cstdint>

#include "reconstruct/world.h"

namespace loft::io {

namespace {

ContourLine line_of(const Stack& stack, std::uint32_t slice, std::uint32_t contour) {
  const double z = stack.slices[slice].z;
  ContourLine line{z, {}};
  const std::vector<cdt::Point>& points = stack.slices[slice].contours[contour].points;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    line.points.push_back(world_place(stack, {points[i].x, points[i].y, z},
                                      {VertexKind::contour, slice, contour, i}));
  return line;
}

}  // namespace

std::vector<ContourLine> contour_lines(const Stack& stack, const std::string& label) {
  std::vector<ContourLine> lines;
  for (std::uint32_t slice = 0; slice < stack.slices.size(); ++slice) {
    const std::vector<Contour>& contours = stack.slices[slice].contours;
    for (std::uint32_t contour = 0; contour < contours.size(); ++contour)
      if (contours[contour].label == label && contours[contour].points.size() > 1)
        lines.push_back(line_of(stack, slice, contour));
  }
  std::ranges::stable_sort(lines, {}, &ContourLine::height);
  return lines;
}

Part part_of(std::span<const StackLabel> about, const std::string& label) {
  Part part;
  part.label = label;
  if (const StackLabel* const said = find(about, label); said != nullptr) {
    part.colour = said->colour;
    part.id = said->id;
    part.kind = said->kind;
  }
  return part;
}

}  // namespace loft::io
