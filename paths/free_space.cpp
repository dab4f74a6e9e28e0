// SPDX-License-Identifier: MIT
#include "paths/free_space.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "paths/corners.h"

namespace loft::paths {

using cdt::Location;

namespace {

[[nodiscard]] std::uint64_t new_state() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

}  // namespace

FreeSpace::FreeSpace(overlay::Overlay& overlay, const overlay::Expression& free,
                     std::span<const LayerId> walls)
    : overlay_(&overlay), mesh_(&overlay.triangulation()), free_(overlay.watch(free)) {
  for (const LayerId layer : walls) {
    if (layer.index() >= is_wall_layer_.size()) is_wall_layer_.resize(layer.index() + 1);
    is_wall_layer_[layer.index()] = true;
  }
  build();
}

FreeSpace::~FreeSpace() { overlay_->unwatch(free_); }

bool FreeSpace::is_wall(EdgeId e) const {
  if (is_wall_layer_.empty()) return false;
  for (const cdt::Passage passage : mesh_->passages(e)) {
    const LayerId layer = overlay_->layer(mesh_->segment(passage.segment()).constraint);
    if (layer.index() < is_wall_layer_.size() && is_wall_layer_[layer.index()]) return true;
  }
  return false;
}

void FreeSpace::follow() {
  const std::size_t now = overlay_->revision();
  if (now == revision_) return;
  if (now != revision_ + 1) return build();
  revision_ = now;
  state_before_ = state_;
  state_ = new_state();
  has_changed_everywhere_ = false;

  const std::size_t triangles = mesh_->triangle_bound();
  is_free_.resize(triangles);
  beyond_.resize(3 * triangles);
  corners_.resize(3 * triangles);
  is_touched_.resize(triangles);
  is_around_.resize(mesh_->vertex_bound());
  touched_.clear();
  around_.clear();
  for (const TriangleId t : mesh_->changes().unmade) {
    if (mesh_->is_triangle(t)) continue;
    is_free_[t.index()] = 0;
    for (unsigned corner = 0; corner < 3; ++corner) {
      beyond_[3 * t.index() + corner] = EdgeId::none();
      corners_[3 * t.index() + corner] = EdgeId::none();
    }
  }
  touch_changed();
  const auto changed = std::span(touched_).first(changed_);
  for (const TriangleId t : changed) free(t);
  for (const TriangleId t : changed) open_sides(t);
  for (const VertexId v : around_) turn_at(v);
  components_.update(*this, changed);
  if (gaps_) gaps_->follow(*this, mesh_->changes().unmade, touched_);
  list_changes();
  for (const TriangleId t : touched_) is_touched_[t.index()] = false;
  for (const VertexId v : around_) is_around_[v.index()] = false;
}

/// Those that have only moved come last: of them, only where ways turn may be new.
void FreeSpace::touch_changed() {
  const cdt::Changes& changes = mesh_->changes();
  cdt::for_each_not_moved(changes, changes.made, [this](TriangleId t) { touch(t); });
  for (const TriangleId t : overlay_->recovered()) touch(t);
  changed_ = touched_.size();
  for (const TriangleId t : changes.moved) touch(t);
}

void FreeSpace::free(TriangleId t) { is_free_[t.index()] = overlay_->is_in(free_, t) ? 1 : 0; }

/// Of walls all that are beside what was made.
void FreeSpace::list_changes() {
  came_.clear();
  gone_.clear();
  for (const overlay::BorderEdge& edge : change().come) came_.push_back({edge.from, edge.to});
  for (const overlay::BorderEdge& edge : change().gone) gone_.push_back({edge.from, edge.to});
  if (is_wall_layer_.empty()) return;
  for (const TriangleId t : touched_) {
    if (mesh_->is_infinite(t)) continue;
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      const Side side{mesh_->point(mesh_->from(e)), mesh_->point(mesh_->to(e))};
      if (mesh_->is_constrained(e) && is_wall(e)) came_.push_back(side);
      gone_.push_back(side);
    }
  }
}

void FreeSpace::build() {
  revision_ = overlay_->revision();
  state_before_ = state_;
  state_ = new_state();
  has_changed_everywhere_ = true;
  came_.clear();
  gone_.clear();
  is_free_.assign(mesh_->triangle_bound(), 0);
  beyond_.assign(mesh_->edge_bound(), EdgeId::none());
  corners_.assign(mesh_->edge_bound(), EdgeId::none());
  is_touched_.assign(mesh_->triangle_bound(), false);
  is_around_.assign(mesh_->vertex_bound(), false);
  for (std::uint32_t i = 0; i < mesh_->triangle_bound(); ++i)
    if (mesh_->is_triangle(TriangleId(i))) free(TriangleId(i));
  for (std::uint32_t i = 0; i < mesh_->triangle_bound(); ++i)
    if (mesh_->is_triangle(TriangleId(i))) open_sides(TriangleId(i));
  for (std::uint32_t i = 1; i < mesh_->vertex_bound(); ++i)
    if (mesh_->is_vertex(VertexId(i))) turn_at(VertexId(i));
  components_.build(*this);
  if (gaps_) gaps_->build(*this);
}

void FreeSpace::keep_gaps() {
  if (gaps_) return;
  gaps_ = std::make_unique<Gaps>();
  gaps_->build(*this);
}

void FreeSpace::touch(TriangleId t) {
  if (is_touched_[t.index()]) return;
  is_touched_[t.index()] = true;
  touched_.push_back(t);
  for (unsigned corner = 0; corner < 3; ++corner) {
    const EdgeId e = Triangulation::edge(t, corner);
    corners_[e.index()] = EdgeId::none();
    const VertexId v = mesh_->from(e);
    if (v == Triangulation::infinite || is_around_[v.index()]) continue;
    is_around_[v.index()] = true;
    around_.push_back(v);
  }
}

/// Which sides of a triangle can be crossed, from both sides of them.
void FreeSpace::open_sides(TriangleId t) {
  for (unsigned corner = 0; corner < 3; ++corner) {
    const EdgeId e = Triangulation::edge(t, corner);
    const EdgeId twin = mesh_->twin(e);
    const bool is_open = is_free(t) && is_free(Triangulation::triangle(twin)) &&
                         !(mesh_->is_constrained(e) && is_wall(e));
    beyond_[e.index()] = is_open ? twin : EdgeId::none();
    beyond_[twin.index()] = is_open ? e : EdgeId::none();
  }
}

void FreeSpace::turn_at(VertexId v) {
  turn_corners(
      *mesh_, v, [this](TriangleId t) { return is_free(t); },
      [this](EdgeId e) { return beyond(e); },
      [this](EdgeId e, EdgeId last) { corners_[e.index()] = last; });
}

void FreeSpace::triangles_at(Point p, std::vector<TriangleId>& found) const {
  found.clear();
  const Location place = mesh_->locate(p);
  const auto add = [&](EdgeId e) {
    const TriangleId t = Triangulation::triangle(e);
    if (is_free(t)) found.push_back(t);
  };
  switch (place.kind) {
    case Location::Kind::triangle:
      add(place.edge);
      break;
    case Location::Kind::edge: {
      const bool is_upward =
          mesh_->point(mesh_->from(place.edge)) < mesh_->point(mesh_->to(place.edge));
      add(is_upward ? place.edge : mesh_->twin(place.edge));
      add(is_upward ? mesh_->twin(place.edge) : place.edge);
      break;
    }
    case Location::Kind::vertex: {
      // From the neighbour that the coordinates put first.
      EdgeId first = place.edge;
      EdgeId e = first;
      const auto is_before = [this](EdgeId a, EdgeId b) {
        if (mesh_->to(a) == Triangulation::infinite) return false;
        if (mesh_->to(b) == Triangulation::infinite) return true;
        return mesh_->point(mesh_->to(a)) < mesh_->point(mesh_->to(b));
      };
      do {
        if (is_before(e, first)) first = e;
        e = mesh_->rotated(e);
      } while (e != place.edge);
      e = first;
      do {
        add(e);
        e = mesh_->rotated(e);
      } while (e != first);
      break;
    }
    case Location::Kind::outside:
    case Location::Kind::nowhere:
      break;
  }
}

bool FreeSpace::is_free(Point p) const {
  std::vector<TriangleId> at;
  triangles_at(p, at);
  return !at.empty();
}

bool FreeSpace::is_reachable(Point from, Point to) const {
  std::vector<TriangleId> starts;
  std::vector<TriangleId> goals;
  triangles_at(from, starts);
  triangles_at(to, goals);
  return is_joined(starts, goals);
}

bool FreeSpace::is_joined(std::span<const TriangleId> some,
                          std::span<const TriangleId> others) const {
  return std::ranges::any_of(some, [&](TriangleId one) {
    return std::ranges::any_of(
        others, [&](TriangleId other) { return component(one) == component(other); });
  });
}

}  // namespace loft::paths
