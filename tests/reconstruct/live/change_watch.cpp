// SPDX-License-Identifier: MIT
#include "tests/reconstruct/live/change_watch.h"

#include <algorithm>
#include <set>

namespace loft::edits {

namespace {

/// The entries of a map that another one does not have, or has with another value.
template <class Value, class IsSame>
std::vector<Value> missing(const std::map<int, Value>& from, const std::map<int, Value>& in,
                           IsSame is_same) {
  std::vector<Value> all;
  for (const auto& [key, value] : from) {
    const auto found = in.find(key);
    if (found == in.end() || !is_same(found->second, value)) all.push_back(value);
  }
  return all;
}

/// The slabs that are not among some others, from low to high.
std::vector<SlabInfo> others(const std::vector<SlabInfo>& slabs,
                             const std::vector<SlabInfo>& known) {
  std::vector<SlabInfo> all;
  for (const SlabInfo& slab : slabs)
    if (std::ranges::find(known, slab.id, &SlabInfo::id) == known.end()) all.push_back(slab);
  return all;
}

}  // namespace

ChangeWatch::ChangeWatch(const Reconstruction& live)
    : slabs_(live.slabs()), face_count_(live.face_count()), vertex_count_(live.vertex_count()) {
  const Surface& surface = live.surface();
  const auto place = [&](Surface::VertexHandle v) -> Place {
    const auto& p = surface.point(v);
    return {p[0], p[1], p[2]};
  };
  for (const Surface::VertexHandle v : surface.vertices()) vertices_[v.idx()] = place(v);
  for (const Surface::FaceHandle f : surface.faces()) {
    Face& face = faces_[f.idx()];
    face.slab = surface.data(f).slab;
    auto h = surface.halfedge_handle(f);
    for (std::size_t k = 0; k < 3; ++k, h = surface.next_halfedge_handle(h)) {
      face.vertices[k] = surface.from_vertex_handle(h).idx();
      face.places[k] = place(surface.from_vertex_handle(h));
    }
  }
}

std::string ChangeWatch::lie(const Reconstruction& live, const SurfaceChange& change) const {
  const ChangeWatch now(live);
  if (now.face_count_ != now.faces_.size() || now.vertex_count_ != now.vertices_.size())
    return "the surface has other counts";
  if (face_count_ + change.faces_added != now.face_count_ + change.faces_removed ||
      vertex_count_ + change.vertices_added != now.vertex_count_ + change.vertices_removed)
    return "the change has other counts";

  std::vector<std::uint32_t> removed;
  for (const SlabInfo& slab : others(slabs_, now.slabs_)) removed.push_back(slab.id);
  std::ranges::sort(removed);
  if (removed != change.removed) return "other slabs went";
  if (others(now.slabs_, slabs_) != change.added) return "other slabs came";

  // Handles that are not among what went and came have the same faces and vertices.
  const auto faces_gone = missing(faces_, now.faces_, is_same);
  const auto faces_come = missing(now.faces_, faces_, is_same);
  const auto is_same_place = [](const Place& a, const Place& b) { return a == b; };
  if (faces_gone.size() > change.faces_removed || faces_come.size() > change.faces_added ||
      missing(vertices_, now.vertices_, is_same_place).size() > change.vertices_removed ||
      missing(now.vertices_, vertices_, is_same_place).size() > change.vertices_added)
    return "more handles are others than went and came";

  if (change.bounds.has_value() != (change.faces_added + change.faces_removed > 0))
    return "bounds of nothing, or none";
  std::set<std::uint32_t> changed(change.removed.begin(), change.removed.end());
  changed.insert(change.resewn.begin(), change.resewn.end());
  for (const SlabInfo& slab : change.added) changed.insert(slab.id);
  for (const auto* faces : {&faces_gone, &faces_come}) {
    for (const Face& face : *faces) {
      if (!changed.contains(face.slab)) return "a slab that is not named has other faces";
      for (const Place& place : face.places)
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (place[axis] < change.bounds->low[axis] || place[axis] > change.bounds->high[axis])
            return "a face is beyond the bounds";
    }
  }
  return "";
}

}  // namespace loft::edits
