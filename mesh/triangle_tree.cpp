// SPDX-License-Identifier: MIT
#include "mesh/triangle_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace loft {

namespace {

/// Three times the middle of a triangle's corners, along an axis.
double middle(const Corners& t, std::size_t axis) { return t[0][axis] + t[1][axis] + t[2][axis]; }

}  // namespace

/// Makes the nodes over some triangles.
class TriangleTree::Builder {
 public:
  Builder(TriangleTree& tree, std::span<const std::uint32_t> numbers,
          std::span<const Corners> triangles)
      : tree_(tree), numbers_(numbers), triangles_(triangles), order_(numbers.size()) {
    for (const Corners& t : triangles) lies_.push_back(lie_of(t));
    std::iota(order_.begin(), order_.end(), 0U);
  }

  /// Makes a node that of the triangles, with all below it.
  void build(std::uint32_t node) { divide(node, order_); }

 private:
  void divide(std::uint32_t node, std::span<std::uint32_t> some) {
    surround(node, some);
    if (some.size() <= first_size) {
      fill(node, some);
      return;
    }
    const std::size_t half = halve(some);
    const auto first = static_cast<std::uint32_t>(tree_.nodes_.size());
    tree_.nodes_.resize(tree_.nodes_.size() + 2);
    tree_.nodes_[node].first = first;
    tree_.nodes_[first].parent = tree_.nodes_[first + 1].parent = node;
    tree_.nodes_[first].leaf = std::exchange(tree_.nodes_[node].leaf, none);
    divide(first, some.first(half));
    divide(first + 1, some.subspan(half));
  }

  void fill(std::uint32_t node, std::span<const std::uint32_t> some) {
    std::uint32_t& place = tree_.nodes_[node].leaf;
    if (place == none) {
      place = static_cast<std::uint32_t>(tree_.leaves_.size());
      tree_.leaves_.emplace_back();
    }
    Leaf& leaf = tree_.leaves_[place];
    leaf.size = 0;
    for (const std::uint32_t i : some) {
      leaf.numbers[leaf.size] = numbers_[i];
      leaf.triangles[leaf.size++] = triangles_[i];
      tree_.node_of_[numbers_[i]] = node;
    }
  }

  /// Makes the boxes of a node.
  void surround(std::uint32_t node, std::span<const std::uint32_t> some) {
    Box3 box = no_box;
    Lie lie;
    for (const std::uint32_t i : some) {
      for (const Vec3& p : triangles_[i]) box = extended(box, p);
      if (lies_[i].length > 0) add_lie(lie, lies_[i]);
    }
    tree_.nodes_[node].box = box;
    lie = lie_of_most(lie, some.size(), box);
    std::uint32_t& place = tree_.nodes_[node].turned;
    if (lie.length == 0) {
      place = none;
      return;
    }
    if (place == none) {
      place = static_cast<std::uint32_t>(tree_.turned_.size());
      tree_.turned_.emplace_back();
    }
    TurnedBox turned(lie);
    for (const std::uint32_t i : some)
      for (const Vec3& p : triangles_[i]) turned.add(p);
    tree_.turned_[place] = turned;
  }

  /// Puts those of one half of the space first; how many they are.
  std::size_t halve(std::span<std::uint32_t> some) const {
    Box3 middles = no_box;
    for (const std::uint32_t i : some) {
      const Corners& t = triangles_[i];
      middles = extended(middles, {middle(t, 0), middle(t, 1), middle(t, 2)});
    }
    const std::size_t axis = longest_axis(middles);
    const std::size_t half = some.size() / 2;
    std::ranges::nth_element(
        some, some.begin() + static_cast<std::ptrdiff_t>(half), {},
        [&](std::uint32_t i) { return std::pair(middle(triangles_[i], axis), numbers_[i]); });
    return half;
  }

  TriangleTree& tree_;
  std::span<const std::uint32_t> numbers_;
  std::span<const Corners> triangles_;
  std::vector<Lie> lies_;             // of each triangle
  std::vector<std::uint32_t> order_;  // of the triangles
};

TriangleTree::TriangleTree(std::span<const Corners> triangles) : node_of_(triangles.size()) {
  if (triangles.empty()) return;
  std::vector<std::uint32_t> numbers(triangles.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  nodes_.reserve(numbers.size() / 2);
  nodes_.emplace_back();
  Builder(*this, numbers, triangles).build(0);
}

bool TriangleTree::may_meet(const Node& node, const OrientedBox& query) const {
  if (query.is_turned) {
    if (node.turned == none) return !query.turned.is_apart(query.box, node.box);
    const TurnedBox& turned = turned_[node.turned];
    return !turned.is_apart(node.box, query.turned, query.box) &&
           !query.turned.is_apart(query.box, turned, node.box);
  }
  return node.turned == none || !turned_[node.turned].is_apart(node.box, query.box);
}

void TriangleTree::add(const Corners& triangle, std::uint32_t near) {
  const auto number = static_cast<std::uint32_t>(node_of_.size());
  node_of_.push_back(0);
  insert(number, triangle, node_of_[near]);
}

void TriangleTree::update(std::uint32_t number, const Corners& triangle) {
  remove(number);
  insert(number, triangle, node_of_[number]);
}

void TriangleTree::remove(std::uint32_t number) {
  std::uint32_t node = node_of_[number];
  if (nodes_[node].first != 0) return;  // it was gone when that was divided
  Leaf& leaf = leaves_[nodes_[node].leaf];
  const auto all = std::span(leaf.numbers).first(leaf.size);
  const auto at = static_cast<std::size_t>(std::ranges::find(all, number) - all.begin());
  if (at == leaf.size) return;
  --leaf.size;
  leaf.numbers[at] = leaf.numbers[leaf.size];
  leaf.triangles[at] = leaf.triangles[leaf.size];
}

void TriangleTree::insert(std::uint32_t number, const Corners& triangle, std::uint32_t node) {
  while (nodes_[node].first != 0) node = nodes_[node].first;
  if (leaves_[nodes_[node].leaf].size == most_size) {
    divide_with(number, triangle, node);
  } else {
    Leaf& leaf = leaves_[nodes_[node].leaf];
    leaf.numbers[leaf.size] = number;
    leaf.triangles[leaf.size++] = triangle;
    node_of_[number] = node;
  }
  for (;; node = nodes_[node].parent) {
    Node& n = nodes_[node];
    for (const Vec3& p : triangle) n.box = extended(n.box, p);
    if (n.turned != none)
      for (const Vec3& p : triangle) turned_[n.turned].add(p);
    if (node == 0) break;
  }
}

void TriangleTree::divide_with(std::uint32_t number, const Corners& triangle, std::uint32_t node) {
  std::array<std::uint32_t, most_size + 1> numbers;
  std::array<Corners, most_size + 1> triangles;
  const Leaf& full = leaves_[nodes_[node].leaf];
  std::ranges::copy(full.numbers, numbers.begin());
  std::ranges::copy(full.triangles, triangles.begin());
  numbers.back() = number;
  triangles.back() = triangle;
  Builder(*this, numbers, triangles).build(node);
}

}  // namespace loft
