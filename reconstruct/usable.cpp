// SPDX-License-Identifier: MIT
#include "reconstruct/usable.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "reconstruct/number_text.h"

namespace loft {

namespace {

/// A problem of an option that has to be a length, none where it is not given.
void note_length(const char* option, std::optional<double> value, std::string& problems) {
  if (!value || admitted::length.admits_length(*value)) return;
  if (!problems.empty()) problems += '\n';
  problems += std::string(option) + ": " + why_not_admitted(*value, admitted::length);
}

}  // namespace

std::string why_not_admitted(double value, const Range& range) {
  if (std::isnan(value)) return "NaN is not a number";
  const auto with_sign = [&](double limit) { return exact(value < 0 ? -limit : limit); };
  if (std::isinf(value)) return exact(value) + " is not finite";
  if (std::abs(value) > range.largest)
    return exact(value) + " is beyond " + with_sign(range.largest);
  if (value != 0 && std::abs(value) < range.smallest)
    return exact(value) + " is nearer to 0 than " + with_sign(range.smallest) + ", but not 0";
  return exact(value) + " is below 0";
}

std::vector<Defect> find_unusable(const Slice& slice, std::uint32_t index,
                                  const std::optional<std::string>& label) {
  std::vector<Defect> found;
  const auto note = [&](std::optional<std::uint32_t> contour, std::optional<std::uint32_t> point,
                        std::string message) {
    found.push_back(
        {DefectKind::not_finite, slice.z, index, contour, point, {}, 0, std::move(message)});
  };
  if (!admitted::slice.admits(slice.z))
    note({}, {},
         "the height " + why_not_admitted(slice.z, admitted::slice) +
             "; correct it or leave the slice out");
  for (std::uint32_t c = 0; c < slice.contours.size(); ++c) {
    if (label && slice.contours[c].label != *label) continue;
    const auto& points = slice.contours[c].points;
    for (std::uint32_t p = 0; p < points.size(); ++p) {
      for (const double value : {points[p].x, points[p].y}) {
        if (admitted::slice.admits(value)) continue;
        note(c, p,
             "a coordinate: " + why_not_admitted(value, admitted::slice) +
                 "; correct the point or leave it out");
        break;
      }
    }
  }
  return found;
}

void require_usable(std::span<const Slice> slices) {
  std::vector<Defect> found;
  for (std::uint32_t s = 0; s < slices.size(); ++s)
    std::ranges::move(find_unusable(slices[s], s), std::back_inserter(found));
  if (!found.empty()) throw InputError(std::move(found));
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

void require_usable(const Options& options) {
  std::string problems;
  note_length("keyhole_width", options.keyhole_width, problems);
  note_length("fair", options.fair, problems);
  note_length("smooth_tolerance", options.smooth_tolerance, problems);
  note_length("max_edge", options.max_edge, problems);
  note_length("target_edge", options.target_edge, problems);
  note_length("simplify", options.simplify, problems);
  note_length("max_shift", options.max_shift, problems);
  for (const auto& [name, value] :
       {std::pair("max_edge", options.max_edge), std::pair("target_edge", options.target_edge)})
    if (value == 0.0)
      problems += (problems.empty() ? "" : "\n") + std::string(name) + ": 0 is no length";
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace loft
