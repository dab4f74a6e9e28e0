// SPDX-License-Identifier: MIT
#include "paths/funnel.h"

#include <limits>

#include "cdt/predicates.h"
#include "paths/channel.h"
#include "paths/distance.h"

namespace loft::paths {

void Funnel::pull(const Channel& channel, Path& path) {
  path.status = channel.status;
  path.pieces.clear();
  path.length = std::numeric_limits<double>::infinity();
  if (channel.status != Status::found) return;
  path.length = 0;
  begin(channel.from, channel.portals.size());
  for (const Portal& portal : channel.portals) {
    if (portal.left != chain_[left_]) add_left(portal.left, path);
    if (portal.right != chain_[right_]) add_right(portal.right, path);
  }
  // The goal is a portal without width; what is left of the funnel on its right leads there.
  add_left(channel.to, path);
  for (std::size_t i = root_; i > left_; --i) go_to(chain_[i - 1], path);
}

void Funnel::begin(Point from, std::size_t portals) {
  chain_.resize(2 * portals + 3);
  left_ = root_ = right_ = portals + 1;
  chain_[root_] = at_ = from;
}

/// Another left end: what it sees past goes from the left chain, and what it needs from the right
/// one comes to the path.
void Funnel::add_left(Point p, Path& path) {
  while (left_ < root_ && cdt::orient(chain_[left_ + 1], chain_[left_], p) <= 0) ++left_;
  if (left_ == root_) {
    while (root_ < right_ && cdt::orient(chain_[root_], chain_[root_ + 1], p) < 0)
      go_to(chain_[++root_], path);
    left_ = root_;
  }
  if (p != chain_[left_]) chain_[--left_] = p;
}

void Funnel::add_right(Point p, Path& path) {
  while (right_ > root_ && cdt::orient(chain_[right_ - 1], chain_[right_], p) >= 0) --right_;
  if (right_ == root_) {
    while (root_ > left_ && cdt::orient(chain_[root_], chain_[root_ - 1], p) > 0)
      go_to(chain_[--root_], path);
    right_ = root_;
  }
  if (p != chain_[right_]) chain_[++right_] = p;
}

void Funnel::go_to(Point p, Path& path) {
  path.pieces.push_back({.from = at_, .to = p});
  path.length += distance_between(at_, p);
  at_ = p;
}

Path pull_taut(const Channel& channel) {
  Funnel funnel;
  Path path;
  funnel.pull(channel, path);
  return path;
}

}  // namespace loft::paths
