// SPDX-License-Identifier: MIT
#include "reconstruct/usable.h"

#include <cmath>

#include "cdt/triangulation.h"

namespace loft {

std::vector<Defect> find_unusable(const Slice& slice, std::uint32_t index,
                                  const std::optional<std::string>& label) {
  std::vector<Defect> found;
  const auto note = [&](std::optional<std::uint32_t> contour, std::optional<std::uint32_t> point,
                        const char* message) {
    found.push_back({DefectKind::not_finite, slice.z, index, contour, point, {}, 0, message});
  };
  if (!(std::abs(slice.z) <= cdt::Triangulation::largest_coordinate))
    note({}, {}, "the height is not a finite number below 1e75; correct it or leave the slice out");
  for (std::uint32_t c = 0; c < slice.contours.size(); ++c) {
    if (label && slice.contours[c].label != *label) continue;
    const auto& points = slice.contours[c].points;
    for (std::uint32_t p = 0; p < points.size(); ++p)
      if (!cdt::Triangulation::is_usable(points[p].x) ||
          !cdt::Triangulation::is_usable(points[p].y))
        note(c, p,
             "a coordinate is not finite, beyond 1e75, or below 1e-50 without being 0; "
             "correct the point or leave it out");
  }
  return found;
}

void OneLabel::add(const Slice& slice) {
  for (const Contour& contour : slice.contours) add(contour.label);
}

void OneLabel::add(const std::string& label) {
  if (is_chosen_) return;
  if (!label_) label_ = label;
  if (label != *label_)
    throw InputError("the stack has contours of several labels, '" + *label_ + "' and '" + label +
                     "'; choose one of labels() by Options::label, a surface each, or give all "
                     "contours the same label");
}

}  // namespace loft
