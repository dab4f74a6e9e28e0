// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "cdt/regions.h"
#include "overlay/overlay.h"
#include "overlay/validity.h"
#include "tests/cases.h"
#include "tests/cdt/random_edits.h"
#include "tests/overlay/player.h"

namespace loft::overlay {
namespace {

using cdt::Ground;
using cdt::TriangleId;
using cdt::Triangulation;

/// A border without ids, sorted.
std::vector<std::pair<Point, Point>> places(std::span<const BorderEdge> edges) {
  std::vector<std::pair<Point, Point>> result;
  for (const BorderEdge& edge : edges) result.emplace_back(edge.from, edge.to);
  std::ranges::sort(result);
  return result;
}

/// The layers around a triangle by winding numbers that are computed for each alone.
class LayersByHand {
 public:
  explicit LayersByHand(const Overlay& overlay) : overlay_(&overlay) {
    for (std::uint32_t l = 0; l < overlay.layer_count(); ++l)
      windings_.push_back(cdt::winding_numbers(overlay.triangulation(), [&](cdt::ConstraintId c) {
        return overlay.layer(c) == LayerId(l) && overlay.triangulation().ends(c) == closed;
      }));
  }

  [[nodiscard]] std::vector<LayerId> around(TriangleId t) const {
    std::vector<LayerId> result;
    for (std::uint32_t l = 0; l < windings_.size(); ++l)
      if (is_inside(overlay_->rule(LayerId(l)), windings_[l][t.index()])) result.emplace_back(l);
    return result;
  }

 private:
  const Overlay* overlay_;
  std::vector<std::vector<int>> windings_;
};

void expect_right_covers(const Overlay& overlay) {
  const LayersByHand by_hand(overlay);
  const Triangulation& mesh = overlay.triangulation();
  for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i) {
    const TriangleId t(i);
    if (!mesh.is_triangle(t)) continue;
    const auto layers = overlay.layers(overlay.cover(t));
    ASSERT_EQ(std::vector<LayerId>(layers.begin(), layers.end()), by_hand.around(t)) << t;
  }
}

/// |A or B| + |A and B| = |A| + |B|, and so on; results as in some_expressions().
void expect_laws(const Overlay& overlay, const std::vector<ResultId>& results) {
  const auto area_of = [&](std::size_t i) { return overlay.area(results[i]); };
  for (std::size_t i = 0; i < results.size(); ++i) ASSERT_GE(area_of(i).sign(), 0);
  const ExactArea a = area_of(0);
  const ExactArea b = area_of(1);
  const ExactArea a_or_b = area_of(3);
  const ExactArea a_and_b = area_of(4);
  ASSERT_EQ(a_or_b + a_and_b, a + b);
  ASSERT_EQ(area_of(5) + a_and_b, a);
  ASSERT_EQ(area_of(6), a_or_b - a_and_b);
  ASSERT_LE(area_of(7), a_or_b);
}

void expect_valid_polygons_of_its_area(const Overlay& overlay, ResultId result) {
  for (const Vertices vertices : {Vertices::needed, Vertices::all}) {
    const MultiPolygon polygons = overlay.polygons(result, vertices);
    ASSERT_EQ(area(polygons), overlay.area(result));
    ASSERT_THAT(validity_problems(polygons), ::testing::IsEmpty());
  }
}

/// Everything as if it had been built at once.
void expect_fresh(const Player& player) {
  const Player fresh = player.fresh();
  for (std::size_t i = 0; i < player.results().size(); ++i) {
    const ResultId one = player.results()[i];
    const ResultId other = fresh.results()[i];
    const Overlay& overlay = player.overlay();
    ASSERT_EQ(places(overlay.border(one)), places(fresh.overlay().border(other)));
    ASSERT_EQ(overlay.area(one), fresh.overlay().area(other));
    ASSERT_EQ(overlay.polygons(one), fresh.overlay().polygons(other));
  }
}

/// The borders before, and what is said of each change, make the borders after.
class ChangeWatch {
 public:
  explicit ChangeWatch(const Player& player) : player_(&player) { note(); }

  void expect_told() {
    const Overlay& overlay = player_->overlay();
    for (std::size_t i = 0; i < borders_.size(); ++i) {
      const ResultChange& change = overlay.change(player_->results()[i]);
      auto border = borders_[i];
      for (const auto& edge : places(change.gone)) {
        const auto at = std::ranges::find(border, edge);
        ASSERT_NE(at, border.end());
        border.erase(at);
      }
      const auto come = places(change.come);
      for (const auto& edge : come) ASSERT_EQ(std::ranges::count(border, edge), 0);
      border.insert(border.end(), come.begin(), come.end());
      std::ranges::sort(border);
      ASSERT_EQ(border, places(overlay.border(player_->results()[i])));
      ASSERT_EQ(areas_[i] + change.area, overlay.area(player_->results()[i]));
    }
    note();
  }

 private:
  void note() {
    borders_.clear();
    areas_.clear();
    for (const ResultId result : player_->results()) {
      borders_.push_back(places(player_->overlay().border(result)));
      areas_.push_back(player_->overlay().area(result));
    }
  }

  const Player* player_;
  std::vector<std::vector<std::pair<Point, Point>>> borders_;
  std::vector<ExactArea> areas_;
};

void expect_all(std::uint64_t seed, Ground ground, std::size_t edits, std::size_t every) {
  SCOPED_TRACE(std::string(cdt::name_of(ground)) + ", seed " + std::to_string(seed));
  Player player;
  ChangeWatch watch(player);
  std::size_t count = 0;
  for (const cdt::Edit& edit : cdt::random_script(seed, ground, edits, 12)) {
    SCOPED_TRACE("edit " + std::to_string(count));
    player.play(edit);
    if (every == 1) {
      ASSERT_NO_FATAL_FAILURE(watch.expect_told());
    }
    if (++count % every != 0) continue;
    ASSERT_NO_FATAL_FAILURE(expect_right_covers(player.overlay()));
    ASSERT_NO_FATAL_FAILURE(expect_laws(player.overlay(), player.results()));
    for (const ResultId result : player.results())
      ASSERT_NO_FATAL_FAILURE(expect_valid_polygons_of_its_area(player.overlay(), result));
    if (player.overlay().triangulation().snaps().empty()) {
      ASSERT_NO_FATAL_FAILURE(expect_fresh(player));
    }
  }
}

TEST(OverlayEdits, LeaveAllAsAFreshBuild) {
  for (const Ground ground : cdt::all_grounds)
    for (std::uint64_t seed = 0; seed < cases(12); ++seed)
      ASSERT_NO_FATAL_FAILURE(expect_all(seed, ground, 60, 1));
}

/// In the long run a million edits, all compared every hundred.
TEST(OverlaySoak, ManyEditsLeaveAllAsAFreshBuild) {
  const char* asked = std::getenv("LOFT_SOAK_EDITS");
  const std::size_t edits = asked != nullptr ? std::strtoull(asked, nullptr, 10) : cases(10'000);
  const std::size_t runs = 2 * std::size(cdt::all_grounds);
  for (std::uint64_t seed = 0; seed < runs; ++seed)
    ASSERT_NO_FATAL_FAILURE(expect_all(
        1000 + seed, cdt::all_grounds[seed % std::size(cdt::all_grounds)], edits / runs, 100));
}

}  // namespace
}  // namespace loft::overlay
