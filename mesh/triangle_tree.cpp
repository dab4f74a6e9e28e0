// SPDX-License-Identifier: MIT
#include "mesh/triangle_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace loft {

namespace {

/// Three times the middle of a triangle's corners, along an axis.
double middle(const Corners& t, std::size_t axis) { return t[0][axis] + t[1][axis] + t[2][axis]; }

std::size_t axis_to_halve(std::span<const Corners> triangles,
                          std::span<const std::uint32_t> numbers) {
  const auto middle_of = [&](std::uint32_t number) {
    const Corners& t = triangles[number];
    return Vec3{middle(t, 0), middle(t, 1), middle(t, 2)};
  };
  Box3 middles{middle_of(numbers[0]), middle_of(numbers[0])};
  for (const std::uint32_t number : numbers)
    middles = joined(middles, {middle_of(number), middle_of(number)});
  return longest_axis(middles);
}

}  // namespace

TriangleTree::TriangleTree(std::vector<Corners> triangles)
    : triangles_(std::move(triangles)), leaf_of_(triangles_.size()) {
  if (triangles_.empty()) return;
  std::vector<std::uint32_t> numbers(triangles_.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  nodes_.reserve(numbers.size() / 2);
  nodes_.emplace_back();
  build(0, std::move(numbers));
}

/// Makes a node that of some triangles, with all below it.
void TriangleTree::build(std::uint32_t node, std::vector<std::uint32_t> numbers) {
  Lie lie;
  for (const std::uint32_t number : numbers) add_lie(lie, lie_of(triangles_[number]));
  OrientedBox box(lie);
  for (const std::uint32_t number : numbers)
    for (const Vec3& p : triangles_[number]) box.add(p);
  nodes_[node].box = box;
  if (numbers.size() <= leaf_size) {
    for (const std::uint32_t number : numbers) leaf_of_[number] = node;
    nodes_[node].triangles = std::move(numbers);
    return;
  }
  const std::size_t axis = axis_to_halve(triangles_, numbers);
  const auto half = static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::ranges::nth_element(numbers, numbers.begin() + half, {}, [&](std::uint32_t number) {
    return std::pair(middle(triangles_[number], axis), number);
  });
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].triangles = {};
  nodes_[node].first = first;
  nodes_[node].second = first + 1;
  build(first, {numbers.begin(), numbers.begin() + half});
  build(first + 1, {numbers.begin() + half, numbers.end()});
}

void TriangleTree::add(const Corners& triangle) {
  triangles_.push_back(triangle);
  leaf_of_.push_back(0);
  if (nodes_.empty()) nodes_.emplace_back();
  insert(static_cast<std::uint32_t>(triangles_.size() - 1));
}

void TriangleTree::update(std::uint32_t number, const Corners& triangle) {
  remove(number);
  triangles_[number] = triangle;
  insert(number);
}

void TriangleTree::remove(std::uint32_t number) {
  std::erase(nodes_[leaf_of_[number]].triangles, number);
}

/// Into the leaf whose boxes have to grow least for it, of equals the nearest.
void TriangleTree::insert(std::uint32_t number) {
  const Corners& triangle = triangles_[number];
  const Vec3 centre{middle(triangle, 0) / 3, middle(triangle, 1) / 3, middle(triangle, 2) / 3};
  const auto cost = [&](std::uint32_t node) {
    const OrientedBox& box = nodes_[node].box;
    return std::pair(box.growth(triangle), box.squared_distance(centre));
  };
  std::uint32_t node = 0;
  while (true) {
    for (const Vec3& p : triangle) nodes_[node].box.add(p);
    const auto [first, second] = std::pair(nodes_[node].first, nodes_[node].second);
    if (first == 0) break;
    node = cost(second) < cost(first) ? second : first;
  }
  leaf_of_[number] = node;
  nodes_[node].triangles.push_back(number);
  if (nodes_[node].triangles.size() > 2 * leaf_size) build(node, nodes_[node].triangles);
}

}  // namespace loft
