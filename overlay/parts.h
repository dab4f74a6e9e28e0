// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cdt/follow.h"
#include "overlay/formula.h"
#include "overlay/lists_by_cover.h"
#include "overlay/overlay.h"
#include "overlay/windings.h"

namespace loft::overlay {

/// A layer and what is in it.
struct Layer {
  std::string name;
  FillRule rule;
  std::vector<RingId> rings;
};

/// Where a ring is listed.
struct Listing {
  LayerId layer;
  std::uint32_t place = 0;  // in the layer's rings
};

/// What is kept of an expression.
struct Result {
  explicit Result(Expression expression) : what(std::move(expression)), formula(what) {}

  Expression what;
  Formula formula;
  std::vector<std::uint32_t> is_in;  // by cover: 1 or 0
  Border border;
  ExactArea area;
  ResultChange change;
};

/// What an overlay is made of. An edit changes the triangulation first; then the windings of
/// triangles follow, then their covers, then the borders of results, each from what changed in the
/// one before.
struct Overlay::Parts {
  /// What a passage along an edge does to windings.
  struct Cross {
    Parts* parts;

    WindingId operator()(EdgeId e, WindingId here) const {
      for (const cdt::Passage passage : parts->mesh.passages(e)) {
        const RingId ring = parts->mesh.segment(passage.segment()).constraint;
        if (parts->mesh.ends(ring) == open) continue;
        here = parts->windings.crossed(here, parts->listings[ring.index()].layer,
                                       parts->mesh.is_forward(e, passage) ? -1 : 1);
      }
      return here;
    }
  };

  Parts() : follower(mesh, WindingId(0), Cross{this}) { mesh.record_changes(true); }

  cdt::Triangulation mesh;
  std::vector<Layer> layers;
  std::vector<Listing> listings;  // by constraint
  Windings windings;
  std::uint32_t windings_at_rebuild = 0;
  cdt::Follower<WindingId, Cross> follower;
  ListsByCover covers;
  std::vector<std::optional<Result>> results;
  std::vector<std::uint8_t> bordering;  // by triangle: corners whose edges may border a result
  std::vector<EdgeId> gone;             // of one edit: of triangles that are no more, bordering
  std::vector<EdgeId> moved;            // of those that have only moved, bordering
  std::vector<EdgeId> doubtful;         // and constrained ones, on either side of what changed
  std::vector<EdgeId> fences;           // between covers, one of two twins; as of that revision:
  std::size_t fences_revision = ~std::size_t{0};
  bool is_in_batch = false;
  std::size_t revision = 0;

  // What is asked for.
  [[nodiscard]] Layer& known(LayerId layer) {
    if (layer.index() >= layers.size())
      throw std::invalid_argument("overlay: there is no such layer");
    return layers[layer.index()];
  }
  [[nodiscard]] Result& known(ResultId result) {
    if (result.index() >= results.size() || !results[result.index()])
      throw std::invalid_argument("overlay: there is no such result");
    return *results[result.index()];
  }
  void check_known(RingId ring) const {
    if (!mesh.is_constraint(ring)) throw std::invalid_argument("overlay: there is no such ring");
  }
  void check_usable(LayerId layer, std::span<const Point> points) const;
  [[nodiscard]] Regions region(const Result& result) const {
    return {.mesh = &mesh, .covers = covers.by_triangle(), .region_of = result.is_in};
  }

  // Rings.
  void list(RingId ring, LayerId layer);
  void unlist(RingId ring);

  // After an edit.
  void finish_edit();
  void follow();
  void rebuild();
  void flood_again();
  void cover_anew(cdt::TriangleId t);
  void learn_truths(Result& result);
  void check_truths(Result& result, std::span<const CoverId> some);
  void update(Result& result);
  void gather_edges(const cdt::Changes& changes);
  void forget(Result& result);
  void move_borders(Result& result) const;
  [[nodiscard]] bool may_border(EdgeId e) const {
    return (unsigned{bordering[e.index() / 3]} >> e.index() % 3 & 1U) != 0;
  }
  void note_bordering(EdgeId e) {
    bordering[e.index() / 3] |= static_cast<std::uint8_t>(1U << e.index() % 3);
  }
  void add_border(Result& result, EdgeId e);
  void take_border(Result& result, EdgeId e);
  void check_border(Result& result, EdgeId e);
  void check_borders(Result& result, EdgeId e);
  void check_borders(Result& result, cdt::TriangleId t);
  void build_border(Result& result);
  [[nodiscard]] std::vector<BorderEdge> find_border(const Result& result);
  [[nodiscard]] const std::vector<EdgeId>& known_fences();
  void sum_up(Result& result);
};

}  // namespace loft::overlay
