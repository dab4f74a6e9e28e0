// SPDX-License-Identifier: MIT
#include "reconstruct/link/lean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/box_tree.h"
#include "mesh/triangle_pairs.h"

namespace loft {

namespace {

using cdt::Point;

/// An end leans no less than that share of what is suggested, or not at all.
constexpr double least_share = 0.25;

Box3 box(std::span<const Corners> tiles) {
  Box3 whole = box_around(tiles.front());
  for (const Corners& tile : tiles) whole = joined(whole, box_around(tile));
  return whole;
}

/// An end on its way.
struct Leaning {
  std::uint32_t piece;
  double z;                                         // of its slice
  Point velocity;                                   // by height
  double share = 1;                                 // of it that holds
  std::vector<std::uint32_t> inner = {};            // its inner vertices
  std::vector<Vec3> upright = {};                   // where they were
  std::vector<TrianglePairs::Vertices> nodes = {};  // of its tiles
  std::vector<Corners> corners = {};                // as they are now
  BoxTree tree = BoxTree({});
  std::vector<Corners> near = {};  // tiles that stay, and that it may meet

  [[nodiscard]] bool meets(const Corners& tile) const {
    bool is_found = false;
    tree.for_each_meeting(box_around(tile), [&](std::uint32_t i) {
      is_found = is_found || triangles_meet(tile, corners[i]);
    });
    return is_found;
  }

  [[nodiscard]] bool meets(const Leaning& other) const {
    return std::ranges::any_of(other.corners,
                               [&](const Corners& tile) { return this->meets(tile); });
  }
};

/// The leaning of one slab's ends.
class Ends {
 public:
  Ends(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces)
      : lower_(lower),
        upper_(upper),
        tiles_(tiles),
        pieces_(pieces),
        contour_count_(contour_count(lower, upper)) {}

  void run(std::span<const EndLean> leans) {
    collect(leans);
    if (ends_.empty()) return;
    collect_tiles();
    find_near();
    std::vector<bool> is_changed(ends_.size(), true);
    while (std::ranges::find(is_changed, true) != is_changed.end()) {
      is_changed = find_meeting(is_changed);
      for (std::size_t i = 0; i < ends_.size(); ++i)
        if (is_changed[i]) draw_back(ends_[i]);
    }
    for (const Leaning& end : ends_)
      pieces_.pieces[end.piece].lean = {end.share * end.velocity.x, end.share * end.velocity.y};
  }

 private:
  /// Which of the pieces lean.
  void collect(std::span<const EndLean> leans) {
    end_of_.assign(pieces_.pieces.size(), Origin::none);
    std::array<std::vector<const EndLean*>, 2> of_loop;  // by level
    for (const EndLean& lean : leans) {
      auto& of_level = of_loop[static_cast<std::size_t>(lean.level)];
      if (of_level.size() <= lean.loop) of_level.resize(lean.loop + 1, nullptr);
      of_level[lean.loop] = &lean;
    }
    for (std::uint32_t i = 0; i < pieces_.pieces.size(); ++i) {
      const Piece& piece = pieces_.pieces[i];
      if (!piece.is_end()) continue;
      const Level level = piece.upper.is_empty() ? Level::lower : Level::upper;
      const auto& of_level = of_loop[static_cast<std::size_t>(level)];
      const std::uint32_t loop = piece.footprint(level).loops.front();
      const EndLean* const lean = loop < of_level.size() ? of_level[loop] : nullptr;
      if (lean == nullptr) continue;
      end_of_[i] = static_cast<std::uint32_t>(ends_.size());
      ends_.push_back({i, level == Level::lower ? lower_.z : upper_.z, lean->velocity});
    }
  }

  void collect_tiles() {
    std::vector<bool> is_known(tiles_.inner.size());
    for (std::size_t t = 0; t < tiles_.tiles.size(); ++t) {
      if (end_of_[pieces_.of_tile[t]] == Origin::none) continue;
      Leaning& end = ends_[end_of_[pieces_.of_tile[t]]];
      end.nodes.push_back(tiles_.tiles[t].nodes);
      for (const std::uint32_t node : tiles_.tiles[t].nodes) {
        if (node < contour_count_ || is_known[node - contour_count_]) continue;
        is_known[node - contour_count_] = true;
        end.inner.push_back(node - contour_count_);
        end.upright.push_back(tiles_.inner[node - contour_count_].place);
      }
    }
  }

  [[nodiscard]] Corners corners(const TrianglePairs::Vertices& nodes) const {
    const auto place = [&](std::uint32_t node) {
      return place_of(lower_, upper_, tiles_.inner, node);
    };
    return {place(nodes[0]), place(nodes[1]), place(nodes[2])};
  }

  /// Puts an end where it leans to.
  void place(Leaning& end) {
    for (std::size_t i = 0; i < end.inner.size(); ++i) {
      const Vec3& from = end.upright[i];
      const double way = end.share * std::abs(from[2] - end.z);
      tiles_.inner[end.inner[i]].place = {from[0] + way * end.velocity.x,
                                          from[1] + way * end.velocity.y, from[2]};
    }
    end.corners.clear();
    std::vector<Box3> boxes;
    for (const auto& nodes : end.nodes) {
      end.corners.push_back(corners(nodes));
      boxes.push_back(box_around(end.corners.back()));
    }
    end.tree = BoxTree(boxes);
  }

  void draw_back(Leaning& end) {
    end.share = end.share > least_share ? end.share / 2 : 0;
    place(end);
  }

  /// An end leans from upright to where it is first: what does not come near that it does not meet.
  void find_near() {
    std::vector<Box3> boxes;
    for (Leaning& end : ends_) {
      end.share = 0;
      place(end);
      const Box3 upright = box(end.corners);
      end.share = 1;
      place(end);
      boxes.push_back(joined(upright, box(end.corners)));
    }
    const BoxTree tree(boxes);
    tree.for_each_pair([&](std::uint32_t i, std::uint32_t j) { pairs_.emplace_back(i, j); });
    for (std::size_t t = 0; t < tiles_.tiles.size(); ++t) {
      if (end_of_[pieces_.of_tile[t]] != Origin::none) continue;
      const Corners here = corners(tiles_.tiles[t].nodes);
      tree.for_each_meeting(box_around(here),
                            [&](std::uint32_t i) { ends_[i].near.push_back(here); });
    }
  }

  /// Which leaning ends meet something, of those that have changed or meet one that has.
  [[nodiscard]] std::vector<bool> find_meeting(const std::vector<bool>& is_changed) const {
    std::vector<bool> is_met(ends_.size());
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      const Leaning& end = ends_[i];
      if (!is_changed[i] || end.share == 0) continue;
      is_met[i] = meets_itself(end) || std::ranges::any_of(end.near, [&](const Corners& tile) {
                    return end.meets(tile);
                  });
    }
    for (const auto& [i, j] : pairs_) {
      if (!is_changed[i] && !is_changed[j]) continue;
      if ((ends_[i].share == 0 && ends_[j].share == 0) || !ends_[i].meets(ends_[j])) continue;
      is_met[i] = is_met[i] || ends_[i].share > 0;
      is_met[j] = is_met[j] || ends_[j].share > 0;
    }
    return is_met;
  }

  /// A shear keeps an end as sound as it was, but for rounding.
  [[nodiscard]] static bool meets_itself(const Leaning& end) {
    const auto is_flat = [](const Corners& c) { return collinear(c[0], c[1], c[2]); };
    if (std::ranges::any_of(end.corners, is_flat)) return true;
    std::vector<std::uint32_t> known;  // numbered by themselves: there are more in the slab
    for (const auto& nodes : end.nodes) known.insert(known.end(), nodes.begin(), nodes.end());
    std::ranges::sort(known);
    known.erase(std::unique(known.begin(), known.end()), known.end());
    auto own = end.nodes;
    for (auto& nodes : own)
      for (std::uint32_t& node : nodes)
        node = static_cast<std::uint32_t>(std::ranges::lower_bound(known, node) - known.begin());
    return !TrianglePairs(end.corners, own, known.size())
                .all_of([&](std::uint32_t i, std::uint32_t j) {
                  return !triangles_meet(end.corners[i], end.corners[j]);
                });
  }

  const Region& lower_;
  const Region& upper_;
  TileSet& tiles_;
  Pieces& pieces_;
  std::uint32_t contour_count_;
  std::vector<Leaning> ends_;
  std::vector<std::uint32_t> end_of_;                           // of each piece, or none
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;  // of ends that may meet
};

}  // namespace

void lean_ends(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
               std::span<const EndLean> leans) {
  if (!leans.empty()) Ends(lower, upper, tiles, pieces).run(leans);
}

}  // namespace loft
