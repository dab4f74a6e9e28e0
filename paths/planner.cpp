// SPDX-License-Identifier: MIT
#include "paths/planner.h"

#include <algorithm>
#include <cmath>

#include "cdt/predicates.h"
#include "paths/distance.h"
#include "paths/exact_distance.h"
#include "paths/visible.h"

namespace loft::paths {

namespace {

/// Whether two closed segments have a point in common. Exact.
[[nodiscard]] bool touch(Point a, Point b, Point c, Point d) {
  const auto between = [](double from, double to, double x) {
    return std::min(from, to) <= x && x <= std::max(from, to);
  };
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
      std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
    return false;
  const auto is_on = [&](Point p, Point q, Point r) {
    return between(p.x, q.x, r.x) && between(p.y, q.y, r.y);
  };
  const int abc = cdt::orient(a, b, c);
  const int abd = cdt::orient(a, b, d);
  const int cda = cdt::orient(c, d, a);
  const int cdb = cdt::orient(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && is_on(a, b, c)) || (abd == 0 && is_on(a, b, d)) ||
         (cda == 0 && is_on(c, d, a)) || (cdb == 0 && is_on(c, d, b));
}

[[nodiscard]] double distance_to(const Side& side, Point p) {
  return distance_to_segment(p, side.from, side.to);
}

}  // namespace

/// Calls visit(part, from, to): the start, then the pieces.
template <class Visit>
void Planner::for_each_part(const Kept& kept, Visit visit) {
  visit(start_part, kept.query.from, kept.query.from);
  for (std::uint32_t i = 0; i < kept.path.pieces.size(); ++i)
    visit(i, kept.path.pieces[i].from, kept.path.pieces[i].to);
}

PathId Planner::keep(const Query& query, Wish wish) {
  std::uint32_t number = static_cast<std::uint32_t>(kept_.size());
  if (spare_.empty()) {
    kept_.emplace_back();
  } else {
    number = spare_.back();
    spare_.pop_back();
  }
  Kept& kept = kept_[number];
  kept.query = query;
  kept.wish = wish;
  kept.is_kept = true;
  kept.is_known = false;
  if (wish == Wish::shortest) shortest_.push_back(number);
  return PathId(number);
}

void Planner::change(PathId path, const Query& query) {
  unlist(path.index());
  kept_[path.index()].query = query;
  kept_[path.index()].is_known = false;
}

void Planner::forget(PathId path) {
  unlist(path.index());
  kept_[path.index()].is_kept = false;
  std::erase(shortest_, path.index());
  spare_.push_back(path.index());
}

const Path& Planner::path(PathId path) {
  Kept& kept = kept_[path.index()];
  // What had no way may have one since.
  if (kept.is_known && (kept.path.status == Status::found || state_ == space_->state()))
    return kept.path;
  unlist(path.index());
  workspace_.find(*space_, kept.query, kept.path);
  kept.state = space_->state();
  kept.is_known = true;
  list(path.index());
  return kept.path;
}

/// Where a path is found by what comes near it.
void Planner::list(std::uint32_t number) {
  Kept& kept = kept_[number];
  if (kept.path.status != Status::found) return;
  if (!grid_.is_laid_out()) {
    cdt::Box box;
    for (const overlay::BorderEdge& edge : space_->border()) box.add(edge.from);
    grid_.lay_out(box, kept_.size());
  }
  for_each_part(kept, [&](std::uint32_t part, Point from, Point to) {
    grid_.add({number, part}, from, to, 2 * kept.query.radius);
  });
  kept.is_listed = true;
}

void Planner::unlist(std::uint32_t number) {
  Kept& kept = kept_[number];
  if (!kept.is_listed) return;
  kept.is_listed = false;
  for_each_part(kept, [&](std::uint32_t part, Point from, Point to) {
    grid_.remove({number, part}, from, to, 2 * kept.query.radius);
  });
}

std::span<const PathId> Planner::after_edit() {
  broken_.clear();
  if (state_ == space_->state()) return broken_;
  const bool is_next = state_ == space_->state_before() && !space_->has_changed_everywhere();
  state_ = space_->state();
  const auto is_old = [&](std::uint32_t number) {
    return kept_[number].is_listed && kept_[number].is_known && kept_[number].state != state_;
  };
  const auto end = [&](std::uint32_t number) {
    kept_[number].is_known = false;
    broken_.push_back(PathId(number));
  };
  if (is_next) {
    find_near();
    for (const CellGrid::Item& item : near_)
      if (is_old(item.owner) && is_broken(kept_[item.owner], item.part)) end(item.owner);
  } else {
    for (std::uint32_t i = 0; i < kept_.size(); ++i)
      if (is_old(i) && is_broken(kept_[i])) end(i);
  }
  for (const std::uint32_t number : shortest_)
    if (is_old(number) && (!is_next || may_be_shorter(kept_[number], space_->gone()))) end(number);
  for (const PathId path : broken_) unlist(path.index());
  std::ranges::sort(broken_);
  return broken_;
}

/// The parts of paths where something came, and where all of a path may be inside of it.
void Planner::find_near() {
  came_ = {};
  for (const Side& side : space_->came()) {
    came_.add(side.from);
    came_.add(side.to);
  }
  near_.clear();
  grid_.find(came_, near_);
  std::ranges::sort(near_);
  near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
}

/// Of nothing but what is in the space now.
bool Planner::is_broken(const Kept& kept) {
  return !space_->is_free(kept.query.from) ||
         std::ranges::any_of(kept.path.pieces,
                             [&](const Piece& piece) { return !is_way(kept, piece); });
}

/// Whether what came breaks a part of a path: a piece that it touches is no way any more; or the
/// start, which stands for all of the path, is in what is no longer free.
bool Planner::is_broken(const Kept& kept, std::uint32_t part) {
  if (part == start_part) {
    const Point p = kept.query.from;
    return came_.low.x <= p.x && p.x <= came_.high.x && came_.low.y <= p.y && p.y <= came_.high.y &&
           !space_->is_free(p);
  }
  const Piece& piece = kept.path.pieces[part];
  const auto came = space_->came();
  return std::ranges::any_of(came, [&](const Side& side) { return is_near(kept, piece, side); }) &&
         !is_way(kept, piece);
}

bool Planner::is_near(const Kept& kept, const Piece& piece, const Side& side) {
  const double radius = kept.query.radius;
  if (radius == 0) return touch(piece.from, piece.to, side.from, side.to);
  // An arc is within its circle.
  if (piece.turn != Turn::straight) return distance_to(side, piece.centre) < 2 * radius;
  return touch(piece.from, piece.to, side.from, side.to) ||
         std::min({distance_to(side, piece.from), distance_to(side, piece.to),
                   distance_to({piece.from, piece.to}, side.from),
                   distance_to({piece.from, piece.to}, side.to)}) < radius;
}

bool Planner::is_way(const Kept& kept, const Piece& piece) {
  if (kept.query.radius == 0) return sees(*space_, piece.from, piece.to);
  // An arc beside which something has come is found anew, whether it is in the way or not.
  return piece.turn == Turn::straight && space_->gaps() != nullptr &&
         sweep_.is_clear(*space_->gaps(), piece.from, piece.to, kept.query.radius, EdgeId::none());
}

/// Whether a way over a side that is gone may be shorter: no shorter one than to it and on.
bool Planner::may_be_shorter(const Kept& kept, std::span<const Side> gone) {
  return std::ranges::any_of(gone, [&](const Side& side) {
    return distance_to(side, kept.query.from) + distance_to(side, kept.query.to) < kept.path.length;
  });
}

}  // namespace loft::paths
