// SPDX-License-Identifier: MIT
#include "reconstruct/defect.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace loft {

namespace {

std::string lines(const std::vector<Defect>& defects) {
  std::string result;
  for (const Defect& defect : defects) {
    if (!result.empty()) result += '\n';
    result += describe(defect);
  }
  return result;
}

}  // namespace

const char* name(DefectKind kind) {
  switch (kind) {
    case DefectKind::not_finite:
      return "not_finite";
    case DefectKind::slices_too_near:
      return "slices_too_near";
    case DefectKind::too_few_slices:
      return "too_few_slices";
    case DefectKind::too_few_points:
      return "too_few_points";
    case DefectKind::zero_area:
      return "zero_area";
    case DefectKind::repeated_contour:
      return "repeated_contour";
    case DefectKind::repeated_point:
      return "repeated_point";
    case DefectKind::spike:
      return "spike";
    case DefectKind::keyhole:
      return "keyhole";
    case DefectKind::self_crossing:
      return "self_crossing";
    case DefectKind::overlap:
      return "overlap";
    case DefectKind::covered:
      return "covered";
    case DefectKind::touching:
      return "touching";
    case DefectKind::empty_slice:
      return "empty_slice";
    case DefectKind::merged_slices:
      return "merged_slices";
    case DefectKind::unlinked_slices:
      return "unlinked_slices";
    case DefectKind::off_plane:
      return "off_plane";
    case DefectKind::refused_link:
      return "refused_link";
  }
  return "unknown";
}

std::string describe(const Defect& defect) {
  std::ostringstream out;
  out.precision(9);  // millimetres within kilometres, without the noise of the last digits
  out << "slice " << defect.slice << " (z = " << defect.z << ')';
  if (defect.contour) out << " contour " << *defect.contour;
  if (defect.point) out << " point " << *defect.point;
  if (defect.place) out << " near " << *defect.place;
  out << ": " << (defect.message.empty() ? name(defect.kind) : defect.message);
  return out.str();
}

InputError::InputError(std::vector<Defect> defects)
    : Error(lines(defects)), defects_(std::move(defects)) {}

bool is_too_little(const InputError& error) {
  return !error.defects().empty() && std::ranges::all_of(error.defects(), [](const Defect& defect) {
    return defect.kind == DefectKind::too_few_slices;
  });
}

}  // namespace loft
