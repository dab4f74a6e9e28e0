// SPDX-License-Identifier: MIT
#include "paths/components.h"

#include <algorithm>
#include <utility>

#include "paths/free_space.h"

namespace loft::paths {

namespace {

/// Calls visit(neighbour) for what can be reached over a side of a triangle.
template <class Visit>
void for_each_beyond(const FreeSpace& space, TriangleId t, Visit visit) {
  for (unsigned corner = 0; corner < 3; ++corner) {
    const EdgeId entry = space.beyond(Triangulation::edge(t, corner));
    if (!entry.is_none()) visit(Triangulation::triangle(entry));
  }
}

}  // namespace

std::uint32_t Components::new_label() {
  const auto label = static_cast<std::uint32_t>(joined_.size());
  joined_.push_back(label);
  return label;
}

void Components::build(const FreeSpace& space) {
  const std::size_t triangles = space.mesh().triangle_bound();
  labels_.assign(triangles, none);
  search_of_.assign(triangles, none);
  hole_of_.assign(triangles, none);
  is_touched_.assign(triangles, false);
  joined_.clear();
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const TriangleId t(i);
    if (space.mesh().is_triangle(t) && space.is_free(t) && labels_[i] == none) flood_from(space, t);
  }
}

void Components::flood_from(const FreeSpace& space, TriangleId start) {
  const std::uint32_t label = new_label();
  std::vector<TriangleId> front{start};
  labels_[start.index()] = label;
  while (!front.empty()) {
    const TriangleId t = front.back();
    front.pop_back();
    for_each_beyond(space, t, [&](TriangleId next) {
      if (std::exchange(labels_[next.index()], label) != label) front.push_back(next);
    });
  }
}

void Components::update(const FreeSpace& space, std::span<const TriangleId> touched) {
  const std::size_t triangles = space.mesh().triangle_bound();
  if (joined_.size() > 2 * triangles + 1024) return build(space);
  labels_.resize(triangles, none);
  search_of_.resize(triangles, none);
  hole_of_.resize(triangles, none);
  is_touched_.resize(triangles);

  start_searches(space, touched);
  for (std::size_t active = searches_.size(); active > 0;) {
    active = 0;
    for (std::uint32_t i = 0; i < searches_.size(); ++i) {
      if (leaders_[i] != i || searches_[i].is_over) continue;
      if (searches_[i].next == searches_[i].reached.size() || is_settled(i)) {
        searches_[i].is_over = true;
        continue;
      }
      step(space, i);
      ++active;
    }
  }
  for (std::uint32_t i = 0; i < searches_.size(); ++i)
    if (leaders_[i] == i) give_label(searches_[i]);
  for (const Search& search : searches_)
    for (const TriangleId t : search.reached) search_of_[t.index()] = none;
  searches_ = {};
  for (const TriangleId t : touched) {
    is_touched_[t.index()] = false;
    hole_of_[t.index()] = none;
  }
}

/// What is touched and joined, whether one can go there or not, is a hole.
void Components::find_holes(const FreeSpace& space, std::span<const TriangleId> touched) {
  holes_.clear();
  for (const TriangleId t : touched) {
    if (hole_of_[t.index()] != none) continue;
    const auto hole = static_cast<std::uint32_t>(holes_.size());
    holes_.push_back(hole);
    hole_of_[t.index()] = hole;
    front_.assign(1, t);
    while (!front_.empty()) {
      const TriangleId here = front_.back();
      front_.pop_back();
      for (unsigned corner = 0; corner < 3; ++corner) {
        const EdgeId twin = space.mesh().twin(Triangulation::edge(here, corner));
        const TriangleId next = Triangulation::triangle(twin);
        if (!is_touched_[next.index()] || hole_of_[next.index()] != none) continue;
        hole_of_[next.index()] = hole;
        front_.push_back(next);
      }
    }
  }
}

std::uint32_t Components::whole_hole(std::uint32_t hole) const {
  while (holes_[hole] != hole) hole = holes_[hole];
  return hole;
}

/// What was settled for one of two holes alone may not be so for both.
void Components::join_holes(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t from = whole_hole(a);
  const std::uint32_t to = whole_hole(b);
  if (from == to) return;
  holes_[from] = to;
  for (Search& search : searches_)
    if (whole_hole(search.hole) == to) search.is_over = false;
}

/// One for each part of what was touched, with what is beside it, and one for each of those beside
/// it from which nothing leads there.
void Components::start_searches(const FreeSpace& space, std::span<const TriangleId> touched) {
  for (const TriangleId t : touched) {
    is_touched_[t.index()] = true;
    labels_[t.index()] = none;
  }
  find_holes(space, touched);
  leaders_.clear();
  for (const TriangleId t : touched) {
    if (!space.is_free(t) || search_of_[t.index()] != none) continue;
    std::uint32_t search = reach(t, new_search(hole_of_[t.index()]));
    front_.assign(1, t);
    while (!front_.empty()) {
      const TriangleId here = front_.back();
      front_.pop_back();
      for_each_beyond(space, here, [&](TriangleId next) {
        const bool is_new = search_of_[next.index()] == none;
        search = reach(next, search);
        if (is_new && is_touched_[next.index()]) front_.push_back(next);
      });
    }
  }
  const Triangulation& mesh = space.mesh();
  for (const TriangleId t : touched) {
    for (unsigned corner = 0; corner < 3; ++corner) {
      const TriangleId beside = Triangulation::triangle(mesh.twin(Triangulation::edge(t, corner)));
      if (is_touched_[beside.index()] || !space.is_free(beside)) continue;
      const std::uint32_t hole = hole_of_[t.index()];
      const std::uint32_t known = search_of_[beside.index()];
      if (known == none)
        (void)reach(beside, new_search(hole));
      else
        join_holes(searches_[leader(known)].hole, hole);
    }
  }
}

std::uint32_t Components::new_search(std::uint32_t hole) {
  const auto search = static_cast<std::uint32_t>(searches_.size());
  if (search == all_searches_.size()) all_searches_.emplace_back();
  searches_ = std::span(all_searches_).first(search + 1);
  Search& one = searches_.back();
  one.reached.clear();
  one.labels.clear();
  one.next = 0;
  one.hole = hole;
  one.is_over = false;
  leaders_.push_back(search);
  return search;
}

std::uint32_t Components::leader(std::uint32_t search) const {
  while (leaders_[search] != search) search = leaders_[search];
  return search;
}

/// A search gets to a triangle. Returns what that search is part of then.
std::uint32_t Components::reach(TriangleId t, std::uint32_t search) {
  std::uint32_t& known = search_of_[t.index()];
  if (known != none) return meet(leader(known), search);
  known = search;
  searches_[search].reached.push_back(t);
  if (labels_[t.index()] == none) return search;
  const std::uint32_t label = root(labels_[t.index()]);
  std::vector<std::uint32_t>& labels = searches_[search].labels;
  if (std::ranges::find(labels, label) == labels.end()) labels.push_back(label);
  return search;
}

std::uint32_t Components::meet(std::uint32_t a, std::uint32_t b) {
  if (a == b) return a;
  if (searches_[a].reached.size() < searches_[b].reached.size()) std::swap(a, b);
  Search& large = searches_[a];
  Search& small = searches_[b];
  leaders_[b] = a;
  join_holes(small.hole, large.hole);
  large.is_over = false;
  // What has its neighbours known goes before what has not.
  const auto open = large.reached.begin() + static_cast<std::ptrdiff_t>(large.next);
  const auto done = small.reached.begin() + static_cast<std::ptrdiff_t>(small.next);
  large.next += small.next;
  const auto at = static_cast<std::ptrdiff_t>(open - large.reached.begin());
  large.reached.insert(large.reached.end(), done, small.reached.end());
  large.reached.insert(large.reached.begin() + at, small.reached.begin(), done);
  for (const std::uint32_t label : small.labels)
    if (std::ranges::find(large.labels, label) == large.labels.end()) large.labels.push_back(label);
  small.reached.clear();
  small.next = 0;
  return a;
}

/// The neighbours of one more triangle.
void Components::step(const FreeSpace& space, std::uint32_t search) {
  const TriangleId t = searches_[search].reached[searches_[search].next++];
  for_each_beyond(space, t, [&](TriangleId next) { search = reach(next, leader(search)); });
}

/// Whether what a search has reached may keep its labels: no other search from its hole has any of
/// them.
bool Components::is_settled(std::uint32_t search) const {
  const std::uint32_t hole = whole_hole(searches_[search].hole);
  for (std::uint32_t other = 0; other < searches_.size(); ++other) {
    if (other == search || leaders_[other] != other || searches_[other].is_over) continue;
    if (whole_hole(searches_[other].hole) != hole) continue;
    for (const std::uint32_t label : searches_[search].labels)
      if (std::ranges::find(searches_[other].labels, label) != searches_[other].labels.end())
        return false;
  }
  return true;
}

/// What a search has gone through to the end has a new label, the rest one of those that it found.
void Components::give_label(const Search& search) {
  const bool is_whole = search.next == search.reached.size() || search.labels.empty();
  const std::uint32_t label = is_whole ? new_label() : root(search.labels.front());
  if (!is_whole)
    for (const std::uint32_t other : search.labels) joined_[root(other)] = label;
  for (const TriangleId t : search.reached)
    if (is_whole || is_touched_[t.index()]) labels_[t.index()] = label;
}

}  // namespace loft::paths
