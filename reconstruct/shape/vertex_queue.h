// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace loft {

/// Vertices in the order of what they cost, of which each is there once, with what it cost last.
/// Small entries: most of the time is spent waiting for them to come from memory. Cost: O(log n).
class VertexQueue {
 public:
  /// Those of less cost come first, then those of the larger sine, then by place.
  struct Rank {
    double cost = 0;
    double sine = 0;
    Vec3 place{};

    friend bool operator<(const Rank& a, const Rank& b) {
      if (a.cost != b.cost) return a.cost < b.cost;
      if (a.sine != b.sine) return a.sine > b.sine;
      return a.place < b.place;
    }
  };

  explicit VertexQueue(std::size_t vertices = 0) : at_(vertices, none), ranks_(vertices) {}

  [[nodiscard]] bool is_empty() const { return heap_.empty(); }

  /// Puts a vertex in, or where it belongs now.
  void put(std::uint32_t vertex, const Rank& rank) {
    ranks_[vertex] = rank;
    if (at_[vertex] == none) {
      at_[vertex] = static_cast<std::uint32_t>(heap_.size());
      heap_.push_back({});
    }
    settle({rank.cost, vertex}, at_[vertex]);
  }

  void remove(std::uint32_t vertex) {
    const std::uint32_t at = std::exchange(at_[vertex], none);
    if (at == none) return;
    const Entry last = heap_.back();
    heap_.pop_back();
    if (last.vertex != vertex) settle(last, at);
  }

  /// Takes out the first. Precondition: there is one.
  std::uint32_t pop() {
    const std::uint32_t vertex = heap_.front().vertex;
    remove(vertex);
    return vertex;
  }

 private:
  static constexpr std::uint32_t none = 0xffff'ffff;
  static constexpr std::size_t arity = 4;

  struct Entry {
    double cost;
    std::uint32_t vertex;
  };

  [[nodiscard]] bool is_before(const Entry& a, const Entry& b) const {
    return a.cost != b.cost ? a.cost < b.cost : ranks_[a.vertex] < ranks_[b.vertex];
  }

  void set(std::size_t at, const Entry& entry) {
    heap_[at] = entry;
    at_[entry.vertex] = static_cast<std::uint32_t>(at);
  }

  /// Puts an entry into a gap, or where it belongs above or below it.
  void settle(const Entry& entry, std::size_t at) {
    while (at > 0 && is_before(entry, heap_[(at - 1) / arity])) {
      set(at, heap_[(at - 1) / arity]);
      at = (at - 1) / arity;
    }
    while (true) {
      const std::size_t first = arity * at + 1;
      std::size_t least = first;
      for (std::size_t child = first + 1; child < first + arity && child < heap_.size(); ++child)
        if (is_before(heap_[child], heap_[least])) least = child;
      if (first >= heap_.size() || !is_before(heap_[least], entry)) break;
      set(at, heap_[least]);
      at = least;
    }
    set(at, entry);
  }

  std::vector<Entry> heap_;
  std::vector<std::uint32_t> at_;  // of each vertex: its place in the heap
  std::vector<Rank> ranks_;        // of each vertex
};

}  // namespace loft
