// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
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
    counts_.clear();
  }

  /// Makes room. What is new has no layer.
  void grow(std::size_t triangles, std::size_t covers) {
    covers_.resize(triangles, CoverId(0));
    links_.resize(triangles);
    first_.resize(covers, none);
    counts_.resize(covers);
  }

  void set(cdt::TriangleId t, CoverId cover) {
    if (t.index() >= covers_.size() || covers_[t.index()] == cover) return;
    unlink(t.index());
    covers_[t.index()] = cover;
    if (cover.index() != 0) link(t.index(), cover);
  }

  /// How many triangles a cover has, which is not that without a layer.
  [[nodiscard]] std::size_t count(CoverId cover) const { return counts_[cover.index()]; }

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

  void link(std::uint32_t t, CoverId cover) {
    ++counts_[cover.index()];
    std::uint32_t& first = first_[cover.index()];
    links_[t] = {none, first};
    if (first != none) links_[first].before = t;
    first = t;
  }

  void unlink(std::uint32_t t) {
    if (covers_[t].index() == 0) return;
    --counts_[covers_[t].index()];
    const auto [before, next] = links_[t];
    (before == none ? first_[covers_[t].index()] : links_[before].next) = next;
    if (next != none) links_[next].before = before;
  }

  std::vector<CoverId> covers_;
  std::vector<Links> links_;
  std::vector<std::uint32_t> first_;   // by cover
  std::vector<std::uint32_t> counts_;  // by cover
};

}  // namespace loft::overlay
