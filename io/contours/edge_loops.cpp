// SPDX-License-Identifier: MIT
#include "io/contours/edge_loops.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace loft::io {

namespace {

using Edge = std::array<std::uint32_t, 2>;

class Joiner {
 public:
  Joiner(std::span<const Edge> edges, std::size_t vertices)
      : edges_(edges), first_(vertices + 1), on_path_(vertices, nowhere), used_(edges.size()) {
    for (const Edge& edge : edges)
      for (const std::uint32_t end : edge) ++first_[end + 1];
    for (std::size_t v = 0; v < vertices; ++v) first_[v + 1] += first_[v];
    next_.assign(first_.begin(), first_.end() - 1);
    at_.resize(2 * edges.size());
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      for (const std::uint32_t end : edges[e]) at_[next_[end]++] = e;
    next_.assign(first_.begin(), first_.end() - 1);
  }

  EdgeLoops join() {
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
      if (!used_[e]) walk(e);
    return result_;
  }

 private:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  /// Goes on from an edge until no edge is left; takes out every loop that closes.
  void walk(std::uint32_t edge) {
    enter(edges_[edge][0]);
    for (std::optional<std::uint32_t> next = edge; next; next = unused_at(path_.back())) {
      used_[*next] = true;
      const auto [a, b] = edges_[*next];
      const std::uint32_t end = path_.back() == a ? b : a;
      if (on_path_[end] == nowhere) {
        enter(end);
      } else {
        close(on_path_[end]);
      }
    }
    if (path_.size() > 1) ++result_.open_lines;
    for (const std::uint32_t v : path_) on_path_[v] = nowhere;
    path_.clear();
  }

  void enter(std::uint32_t vertex) {
    on_path_[vertex] = static_cast<std::uint32_t>(path_.size());
    path_.push_back(vertex);
  }

  /// The path from `begin` is a loop; its first vertex stays.
  void close(std::uint32_t begin) {
    result_.loops.emplace_back(path_.begin() + begin, path_.end());
    while (path_.size() > begin + 1) {
      on_path_[path_.back()] = nowhere;
      path_.pop_back();
    }
  }

  std::optional<std::uint32_t> unused_at(std::uint32_t vertex) {
    for (std::size_t& i = next_[vertex]; i < first_[vertex + 1]; ++i)
      if (!used_[at_[i]]) return at_[i];
    return {};
  }

  std::span<const Edge> edges_;
  std::vector<std::size_t> first_;  // of the edges at each vertex, in at_
  std::vector<std::size_t> next_;   // those before are used
  std::vector<std::uint32_t> at_;
  std::vector<std::uint32_t> path_;
  std::vector<std::uint32_t> on_path_;  // where each vertex is on it
  std::vector<bool> used_;
  EdgeLoops result_;
};

/// Numbers the vertices of edges anew, from 0; gives what they were.
std::vector<std::uint32_t> take_numbers(std::vector<Edge>& edges) {
  std::vector<std::uint32_t> numbers;
  for (const Edge& edge : edges) numbers.insert(numbers.end(), edge.begin(), edge.end());
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  for (Edge& edge : edges)
    for (std::uint32_t& end : edge)
      end = static_cast<std::uint32_t>(std::ranges::lower_bound(numbers, end) - numbers.begin());
  return numbers;
}

}  // namespace

EdgeLoops join_edges(std::vector<Edge> edges) {
  const std::vector<std::uint32_t> numbers = take_numbers(edges);
  EdgeLoops result = Joiner(edges, numbers.size()).join();
  for (auto& loop : result.loops)
    for (std::uint32_t& vertex : loop) vertex = numbers[vertex];
  return result;
}

}  // namespace loft::io
