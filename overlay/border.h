// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "overlay/layer.h"
#include "overlay/numbers.h"

namespace loft::overlay {

/// A piece of a result's border: an edge of the triangulation that has the result on its left, and
/// not on its right.
struct BorderEdge {
  EdgeId edge;  ///< valid until the next edit
  Point from;
  Point to;

  /// By places: ids come and go.
  [[nodiscard]] bool is_at(const BorderEdge& other) const {
    return from == other.from && to == other.to;
  }
  [[nodiscard]] bool is_before(const BorderEdge& other) const {
    return from != other.from ? from < other.from : to < other.to;
  }
};

[[nodiscard]] inline BorderEdge border_edge(const cdt::Triangulation& mesh, EdgeId e) {
  return {e, mesh.point(mesh.from(e)), mesh.point(mesh.to(e))};
}

/// The border edges of a result, found by their ids. They keep their places, so that they can be
/// named when their triangles are gone.
class Border {
 public:
  [[nodiscard]] std::span<const BorderEdge> edges() const { return edges_; }
  [[nodiscard]] bool has(EdgeId edge) const { return slots_.find(edge.index()) != Numbers::none; }

  /// Precondition: it is not there.
  void add(const BorderEdge& edge) {
    slots_.set(edge.edge.index(), static_cast<std::uint32_t>(edges_.size()));
    edges_.push_back(edge);
  }

  /// Puts an edge that is there where it is now, if that is elsewhere. Returns what it was then.
  std::optional<BorderEdge> move(const BorderEdge& edge) {
    const std::uint32_t slot = slots_.find(edge.edge.index());
    if (slot == Numbers::none || edges_[slot].is_at(edge)) return std::nullopt;
    return std::exchange(edges_[slot], edge);
  }

  /// Takes an edge out, if it is there.
  std::optional<BorderEdge> take(EdgeId edge) {
    const std::uint32_t slot = slots_.find(edge.index());
    if (slot == Numbers::none) return std::nullopt;
    const BorderEdge taken = edges_[slot];
    edges_[slot] = edges_.back();
    edges_.pop_back();
    slots_.erase(edge.index());
    if (slot < edges_.size()) slots_.set(edges_[slot].edge.index(), slot);
    return taken;
  }

  /// These edges in place of all that there are; each once. `bound`: of all edges' numbers.
  void assign(std::vector<BorderEdge> edges, std::size_t bound) {
    edges_ = std::move(edges);
    slots_ = Numbers(edges_.size(), bound);
    for (std::uint32_t slot = 0; slot < edges_.size(); ++slot)
      slots_.set(edges_[slot].edge.index(), slot);
  }

 private:
  std::vector<BorderEdge> edges_;
  Numbers slots_;  // by edge: where in edges_
};

}  // namespace loft::overlay
