// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/layer.h"

namespace loft::overlay {

/// The cover of each triangle, and for each cover a list of its triangles, linked both ways. Those
/// without a layer are in no list.
class ListsByCover {
 public:
  /// By triangle.
  [[nodiscard]] std::span<const CoverId> by_triangle() const { return covers_; }

  void clear() {
    covers_.clear();
    links_.clear();
    first_.clear();
  }

  /// Makes room. What is new has no layer.
  void grow(std::size_t triangles, std::size_t covers) {
    covers_.resize(triangles, CoverId(0));
    links_.resize(triangles);
    first_.resize(covers, none);
  }

  void set(cdt::TriangleId t, CoverId cover) {
    if (t.index() >= covers_.size() || covers_[t.index()] == cover) return;
    unlink(t.index());
    covers_[t.index()] = cover;
    if (cover.index() != 0) link(t.index(), first_[cover.index()]);
  }

  template <class Visit>
  void for_each(CoverId cover, Visit visit) const {
    for (std::uint32_t t = first_[cover.index()]; t != none; t = links_[t].next)
      visit(cdt::TriangleId(t));
  }

 private:
  static constexpr std::uint32_t none = 0xffff'ffff;
  struct Links {
    std::uint32_t before = none;
    std::uint32_t next = none;
  };

  void link(std::uint32_t t, std::uint32_t& first) {
    links_[t] = {none, first};
    if (first != none) links_[first].before = t;
    first = t;
  }

  void unlink(std::uint32_t t) {
    if (covers_[t].index() == 0) return;
    const auto [before, next] = links_[t];
    (before == none ? first_[covers_[t].index()] : links_[before].next) = next;
    if (next != none) links_[next].before = before;
  }

  std::vector<CoverId> covers_;
  std::vector<Links> links_;
  std::vector<std::uint32_t> first_;  // by cover
};

}  // namespace loft::overlay
