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
  const double twice_area = (side.to.x - side.from.x) * (p.y - side.from.y) -
                            (side.to.y - side.from.y) * (p.x - side.from.x);
  return has_foot_between(p, side.from, side.to)
             ? std::abs(twice_area) / distance_between(side.from, side.to)
             : std::min(distance_between(p, side.from), distance_between(p, side.to));
}

}  // namespace

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

/// Where a path is found by what comes near it; one without pieces, by its start.
void Planner::list(std::uint32_t number) {
  Kept& kept = kept_[number];
  if (kept.path.status != Status::found) return;
  if (!grid_.is_laid_out()) {
    cdt::Box box;
    for (const overlay::BorderEdge& edge : space_->border()) box.add(edge.from);
    grid_.lay_out(box, kept_.size());
  }
  grid_.add(number, kept.query.from, kept.query.from, kept.query.radius);
  for (const Piece& piece : kept.path.pieces)
    grid_.add(number, piece.from, piece.to, 2 * kept.query.radius);
  kept.is_listed = true;
}

void Planner::unlist(std::uint32_t number) {
  Kept& kept = kept_[number];
  if (!kept.is_listed) return;
  kept.is_listed = false;
  grid_.remove(number, kept.query.from, kept.query.from, kept.query.radius);
  for (const Piece& piece : kept.path.pieces)
    grid_.remove(number, piece.from, piece.to, 2 * kept.query.radius);
}

std::span<const PathId> Planner::after_edit() {
  broken_.clear();
  if (state_ == space_->state()) return broken_;
  const bool is_next = state_ == space_->state_before() && !space_->has_changed_everywhere();
  state_ = space_->state();
  near_.clear();
  if (is_next) {
    cdt::Box box;
    for (const Side& side : space_->came()) {
      box.add(side.from);
      box.add(side.to);
    }
    grid_.find(box, near_);
    std::ranges::sort(near_);
    near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
  } else {
    for (std::uint32_t i = 0; i < kept_.size(); ++i) near_.push_back(i);
  }
  const auto is_old = [&](const Kept& kept) { return kept.is_listed && kept.state != state_; };
  for (const std::uint32_t number : near_) {
    Kept& kept = kept_[number];
    if (!is_old(kept)) continue;
    const bool is_broken =
        is_next ? this->is_broken(kept, space_->came())
                : !space_->is_free(kept.query.from) ||
                      std::ranges::any_of(kept.path.pieces,
                                          [&](const Piece& piece) { return !is_way(kept, piece); });
    if (is_broken) kept.is_known = false;
  }
  for (const std::uint32_t number : shortest_) {
    Kept& kept = kept_[number];
    if (is_old(kept) && kept.is_known && (!is_next || may_be_shorter(kept, space_->gone())))
      kept.is_known = false;
  }
  const auto report = [&](std::uint32_t number) {
    if (!kept_[number].is_listed || kept_[number].is_known) return;
    unlist(number);
    broken_.push_back(PathId(number));
  };
  for (const std::uint32_t number : near_) report(number);
  for (const std::uint32_t number : shortest_) report(number);
  std::ranges::sort(broken_);
  return broken_;
}

/// Whether what came breaks a path: a piece that it touches is no way any more; or all of the path
/// is in what is no longer free, which then has come all around it.
bool Planner::is_broken(const Kept& kept, std::span<const Side> came) {
  bool is_touched = false;
  for (const Piece& piece : kept.path.pieces) {
    const bool is_close =
        std::ranges::any_of(came, [&](const Side& side) { return is_near(kept, piece, side); });
    if (is_close && !is_way(kept, piece)) return true;
    is_touched = is_touched || is_close;
  }
  return !is_touched && !space_->is_free(kept.query.from);
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
