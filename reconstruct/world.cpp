// SPDX-License-Identifier: MIT
#include "reconstruct/world.h"

#include <algorithm>

namespace loft {

namespace {

/// Where the file has a vertex; null where it does not say.
const Vec3* place_in_file(const Stack& stack, const Origin& origin) {
  // A stack that stays in its files has only those contours that have places.
  if (origin.kind != VertexKind::contour || origin.slice >= stack.slices.size()) return nullptr;
  const std::vector<Contour>& contours = stack.slices[origin.slice].contours;
  if (origin.contour >= contours.size()) return nullptr;
  const auto& places = contours[origin.contour].places;
  return places.empty() ? nullptr : &places[origin.point];
}

}  // namespace

Vec3 world_place(const Stack& stack, const Vec3& place, const Origin& origin) {
  if (const Vec3* const in_file = place_in_file(stack, origin)) return *in_file;
  return stack.frame ? stack.frame->at(place) : place;
}

namespace {

bool has_places(const Stack& stack) {
  return std::ranges::any_of(stack.slices, [](const Slice& slice) {
    return std::ranges::any_of(slice.contours,
                               [](const Contour& contour) { return !contour.places.empty(); });
  });
}

void set_point(Surface& surface, Surface::VertexHandle v, const Vec3& place) {
  surface.set_point(v, {place[0], place[1], place[2]});
}

}  // namespace

void place_in_world(const Stack& stack, Surface& surface, std::vector<Defect>& repairs) {
  if (!stack.frame) return;
  std::vector<Vec3> by_frame;
  for (const auto v : surface.vertices()) {
    const auto& point = surface.point(v);
    by_frame.push_back(stack.frame->at({point[0], point[1], point[2]}));
    const Vec3* const in_file = place_in_file(stack, surface.data(v).origin);
    set_point(surface, v, in_file != nullptr ? *in_file : by_frame.back());
  }
  if (!has_places(stack) || check(surface).empty()) return;
  for (const auto v : surface.vertices())
    set_point(surface, v, by_frame[static_cast<std::size_t>(v.idx())]);
  repairs.push_back({DefectKind::off_plane,
                     0,
                     0,
                     {},
                     {},
                     {},
                     0,
                     "points are not in one plane, and the surface through them would meet itself; "
                     "they were moved to their planes"});
}

}  // namespace loft
