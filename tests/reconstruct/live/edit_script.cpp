// SPDX-License-Identifier: MIT
#include "tests/reconstruct/live/edit_script.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>

#include "reconstruct/reconstruct.h"
#include "tests/reconstruct/live/change_watch.h"

namespace loft::edits {

namespace {

using Place = std::array<double, 3>;

/// A vertex as both surfaces know it: the slice by its height.
using Vertex = std::tuple<Place, VertexKind, std::uint32_t, std::uint32_t>;
struct Content {
  std::vector<Vertex> vertices;
  std::vector<std::tuple<std::array<Place, 3>, FaceKind>> faces;
};

Place place(const Surface& surface, Surface::VertexHandle v) {
  const auto& p = surface.point(v);
  return {p[0], p[1], p[2]};
}

Content content(const Surface& surface) {
  Content content;
  for (const Surface::VertexHandle v : surface.vertices()) {
    const Origin& origin = surface.data(v).origin;
    content.vertices.emplace_back(place(surface, v), origin.kind, origin.contour, origin.point);
  }
  for (const Surface::FaceHandle f : surface.faces()) {
    std::array<Place, 3> corners{};
    std::size_t k = 0;
    for (const Surface::VertexHandle v : surface.fv_range(f)) corners[k++] = place(surface, v);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    content.faces.emplace_back(corners, surface.data(f).kind);
  }
  std::ranges::sort(content.vertices);
  std::ranges::sort(content.faces);
  return content;
}

std::string difference(const Content& is, const Content& expected) {
  std::ostringstream words;
  if (is.faces.size() != expected.faces.size())
    words << is.faces.size() << " faces for " << expected.faces.size() << "; ";
  if (is.vertices.size() != expected.vertices.size())
    words << is.vertices.size() << " vertices for " << expected.vertices.size() << "; ";
  if (!words.str().empty()) return words.str();
  if (is.vertices != expected.vertices) return "other vertices";
  if (is.faces != expected.faces) return "other faces";
  return "";
}

bool is_alive(const Surface& surface, Surface::HalfedgeHandle h) {
  return h.is_valid() && static_cast<std::size_t>(h.idx()) < surface.n_halfedges() &&
         !surface.status(surface.edge_handle(h)).deleted();
}

/// Whether a boundary goes on at both ends of its half-edge, and the vertex leads to it.
bool is_boundary_closed(const Surface& surface, Surface::HalfedgeHandle h) {
  const auto next = surface.next_halfedge_handle(h);
  const auto from = surface.from_vertex_handle(h);
  return is_alive(surface, next) && surface.is_boundary(next) &&
         surface.from_vertex_handle(next) == surface.to_vertex_handle(h) &&
         surface.prev_halfedge_handle(next) == h &&
         surface.is_boundary(surface.halfedge_handle(from));
}

}  // namespace

std::string broken(const Surface& surface) {
  std::map<int, std::size_t> faces_at;
  std::ostringstream words;
  for (const Surface::FaceHandle f : surface.faces()) {
    auto h = surface.halfedge_handle(f);
    for (int k = 0; k < 3; ++k, h = surface.next_halfedge_handle(h)) {
      if (!is_alive(surface, h)) return "a face has no edge";
      if (surface.face_handle(h) != f) return "a side is of another face";
      if (surface.prev_halfedge_handle(surface.next_halfedge_handle(h)) != h)
        return "next and previous differ";
      const auto other = surface.opposite_halfedge_handle(h);
      if (!surface.is_boundary(other) && surface.status(surface.face_handle(other)).deleted())
        return "a neighbour is deleted";
      if (surface.is_boundary(other) && !is_boundary_closed(surface, other))
        return "a boundary is broken";
      if (surface.status(surface.to_vertex_handle(h)).deleted()) return "a corner is deleted";
      ++faces_at[surface.to_vertex_handle(h).idx()];
    }
    if (h != surface.halfedge_handle(f)) return "a face is no triangle";
  }
  for (const Surface::VertexHandle v : surface.vertices()) {
    const auto first = surface.halfedge_handle(v);
    if (!is_alive(surface, first) || surface.from_vertex_handle(first) != v)
      return "a vertex leads elsewhere";
    std::size_t count = 0;
    auto h = first;
    do {
      if (!surface.is_boundary(h)) ++count;
      h = surface.opposite_halfedge_handle(surface.prev_halfedge_handle(h));
    } while (h != first && count <= faces_at[v.idx()]);
    if (count != faces_at[v.idx()]) return "a vertex does not see all its faces";
  }
  for (const Surface::EdgeHandle e : surface.edges())
    if (surface.is_boundary(surface.halfedge_handle(e, 0)) &&
        surface.is_boundary(surface.halfedge_handle(e, 1)))
      return "an edge has no face";
  return "";
}

std::string difference(const Reconstruction& live, const Options& options) {
  const Content is = content(live.surface());
  const auto other_repairs = [&](const std::vector<Defect>& expected) -> std::string {
    std::vector<Defect> repairs = live.repairs();
    // Those slices are one in what was built at once.
    std::erase_if(repairs, [](const Defect& one) { return one.kind == DefectKind::merged_slices; });
    const bool are_same = std::ranges::equal(repairs, expected, [](const auto& a, const auto& b) {
      return a.kind == b.kind && describe(a) == describe(b);
    });
    return are_same ? "" : "other repairs";
  };
  const auto compared = [&](const Surface& expected) -> std::string {
    std::string words = difference(is, content(expected));
    if (!words.empty()) return "live: " + words;
    words = difference(content(live.snapshot().surface(1)), content(expected));
    return words.empty() ? "" : "snapshot: " + words;
  };
  try {
    const Reconstructed expected = reconstruct(live.slices(), options);
    const std::string words = compared(expected.surface);
    return words.empty() ? other_repairs(expected.repairs) : words;
  } catch (const InputError&) {
    return compared(Surface());
  }
}

double RandomEdits::any_height(const Reconstruction& live) {
  const auto slices = live.slices();
  return slices[below(slices.size())].z;
}

void RandomEdits::jog(Slice& slice) {
  if (slice.contours.empty()) return;
  Contour& contour = slice.contours[below(slice.contours.size())];
  const auto small = [&] { return (static_cast<double>(below(2001)) - 1000) / 1024; };
  cdt::Box box;
  for (const cdt::Point p : contour.points) box.add(p);
  if (box.is_empty()) return;
  const double size = std::max(box.high.x - box.low.x, box.high.y - box.low.y) / 20;
  const cdt::Point by{small() * size, small() * size};
  for (cdt::Point& p : contour.points) p = {p.x + by.x, p.y + by.y};
}

/// A point or a line somewhere at a contour of another slice, for it to end in; often alone.
void RandomEdits::add_tip(Slice& slice, const Slice& other) {
  if (other.contours.empty()) return;
  const std::vector<cdt::Point>& points = other.contours[below(other.contours.size())].points;
  if (points.empty()) return;
  const auto between = [&] {
    const cdt::Point p = points[below(points.size())];
    const cdt::Point q = points[below(points.size())];
    const double share = static_cast<double>(below(5)) / 4;
    return cdt::Point{p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)};
  };
  if (below(2) == 0) slice.contours.clear();
  Contour tip;
  tip.label = other.contours.front().label;
  tip.points.push_back(between());
  if (below(3) == 0) tip.points.push_back(between());
  slice.contours.push_back(std::move(tip));
}

std::string RandomEdits::reject(Reconstruction& live) {
  const auto before = content(live.surface());
  const std::size_t count = live.slice_count();
  if (count == 0) return "";
  Slice bad = pool_[below(pool_.size())];
  const std::size_t kind = below(4);
  try {
    if (kind == 0) {
      bad.contours.push_back({{{0, 0}, {1, 0}, {std::numeric_limits<double>::quiet_NaN(), 1}}, ""});
      live.insert(std::move(bad));
    } else if (kind == 1) {
      bad.z = any_height(live);
      bad.z += std::abs(bad.z) * 0x1p-45;
      if (bad.z == 0) return "";  // there is no number so near
      live.insert(std::move(bad));
    } else if (kind == 2) {
      live.remove(1e30);
    } else {
      live.replace(1e30, bad);
    }
    return "a bad edit was taken";
  } catch (const InputError&) {
    const auto after = content(live.surface());
    if (before.faces != after.faces || before.vertices != after.vertices ||
        count != live.slice_count())
      return "a rejected edit has changed something";
  }
  return "";
}

std::string RandomEdits::next(Reconstruction& live) {
  if (live.slice_count() > 0 && below(10) == 0) return reject(live);
  const ChangeWatch watch(live);
  const std::optional<SurfaceChange> change = edit(live);
  return change ? watch.lie(live, *change) : "";
}

/// None where there was nothing to do.
std::optional<SurfaceChange> RandomEdits::edit(Reconstruction& live) {
  const std::size_t kind = below(22);
  if (live.slice_count() == 0 || kind < 7) {
    const Slice& slice = pool_[below(pool_.size())];
    if (live.find(slice.z) != nullptr && kind < 6) return live.replace(slice.z, slice);
    return live.insert(slice);
  }
  const double z = any_height(live);
  if (kind < 9) return live.remove(z);
  if (kind < 11) {
    Slice other = pool_[below(pool_.size())];
    other.z = z;
    return live.replace(z, std::move(other));
  }
  Slice slice = *live.find(z);
  if (kind < 12) {
    slice.z = pool_[below(pool_.size())].z;
    if (live.find(slice.z) != nullptr) return {};
    return live.replace(z, std::move(slice));
  }
  if (kind < 13) return live.replace(z, Slice{z, {}});
  if (kind < 14) {
    auto all = live.slices();
    for (Slice& one : all) jog(one);
    return live.replace(std::move(all));
  }
  if (kind < 15) {
    const Slice& other = pool_[below(pool_.size())];
    if (other.contours.empty()) return {};
    slice.contours.push_back(other.contours[below(other.contours.size())]);
    return live.replace(z, std::move(slice));
  }
  if (kind >= 20) {
    add_tip(slice, pool_[below(pool_.size())]);
    return live.replace(z, std::move(slice));
  }
  if (slice.contours.empty()) return {};
  const std::size_t contour = below(slice.contours.size());
  if (kind < 16) {
    slice.contours.erase(slice.contours.begin() + static_cast<std::ptrdiff_t>(contour));
    return live.replace(z, std::move(slice));
  }
  jog(slice);
  if (kind < 18) return live.move_contour(z, contour, slice.contours[contour].points);
  return live.replace(z, std::move(slice));
}

std::string fault_of_edits(const std::vector<Slice>& pool, std::uint64_t seed, int count) {
  Reconstruction live;
  RandomEdits random(pool, seed);
  for (int i = 0; i < count; ++i) {
    std::string wrong = random.next(live);
    if (wrong.empty()) wrong = difference(live, {});
    if (!wrong.empty())
      return "seed " + std::to_string(seed) + " edit " + std::to_string(i) + ": " + wrong;
  }
  return {};
}

}  // namespace loft::edits
