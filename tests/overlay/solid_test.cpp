// SPDX-License-Identifier: MIT
#include "overlay/solid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "overlay/boolean.h"
#include "tests/cases.h"
#include "tests/overlay/boxes.h"

namespace loft::overlay {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Solid, AGasketWhoseHoleMoves) {
  Solid solid;
  const NodeId plate = solid.shape({square(0, 0, 10)});
  const NodeId hole = solid.shape({square(0, 0, 2)});
  const NodeId slot = solid.shape({square(0, 0, 1)});
  const NodeId holes = solid.combine(Operation::unite, {hole, slot});
  const NodeId gasket = solid.combine(Operation::subtract, {plate, holes});
  EXPECT_THAT(solid.polygons(), IsEmpty());  // no root yet
  solid.set_root(gasket);
  EXPECT_EQ(solid.area().to_double(), 96);
  solid.set_transform(hole, {.x0 = 4, .y0 = 4});
  EXPECT_EQ(solid.area().to_double(), 95);
  EXPECT_EQ(solid.change().area.to_double(), -1);
  solid.set_transform(holes, {.x0 = 1, .y0 = 1});
  const MultiPolygon parts = solid.polygons();
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].holes.size(), 2U);
  solid.set_operation(gasket, Operation::unite);
  EXPECT_EQ(solid.area().to_double(), 100);
  solid.set_operation(gasket, Operation::intersect);
  EXPECT_EQ(solid.area().to_double(), 5);
  solid.set_operation(gasket, Operation::subtract);
  solid.set_parent(slot, NodeId::none());
  EXPECT_EQ(solid.area().to_double(), 96);
  solid.set_parent(slot, plate.is_none() ? plate : gasket);
  EXPECT_EQ(solid.area().to_double(), 95);
  solid.remove(holes);
  EXPECT_FALSE(solid.is_node(hole));
  EXPECT_EQ(solid.area().to_double(), 99);
  solid.set_shape(slot, {square(0, 0, 3), square(1, 1, 1)});
  EXPECT_EQ(solid.area().to_double(), 92);
}

TEST(Solid, TurningToAndFroAddsUpNothing) {
  Solid solid;
  const NodeId shape = solid.shape({{{0, 0}, {7, 1}, {3, 5}}});
  solid.set_root(shape);
  const MultiPolygon before = solid.polygons();
  for (int i = 0; i < 100; ++i) {
    const double c = std::cos(i * 0.1);
    const double s = std::sin(i * 0.1);
    solid.set_transform(shape, {.xx = c, .xy = -s, .x0 = 0.1, .yx = s, .yy = c, .y0 = 0.2});
  }
  solid.set_transform(shape, {});
  EXPECT_EQ(solid.polygons(), before);
}

TEST(Solid, RefusesWhatIsNoTree) {
  Solid solid;
  const NodeId a = solid.shape({square(0, 0, 1)});
  const NodeId b = solid.shape({square(0, 0, 1)});
  const NodeId both = solid.combine(Operation::unite, {a, b});
  EXPECT_THROW(solid.combine(Operation::unite, {a}), std::invalid_argument);
  EXPECT_THROW(solid.set_parent(both, both), std::invalid_argument);
  EXPECT_THROW(solid.set_parent(b, a), std::invalid_argument);
  EXPECT_THROW(solid.set_operation(a, Operation::unite), std::invalid_argument);
  EXPECT_THROW(solid.set_shape(both, {}), std::invalid_argument);
  EXPECT_THROW(solid.set_root(NodeId(17)), std::invalid_argument);
  EXPECT_THROW(solid.shape({{{0, 0}, {1e90, 0}, {0, 1}}}), std::invalid_argument);
  EXPECT_THROW(solid.set_transform(both, {.xx = 1e80}), std::invalid_argument);
  const NodeId above = solid.combine(Operation::exclude, {both});
  EXPECT_THROW(solid.set_parent(above, both), std::invalid_argument);
  solid.set_root(above);
  EXPECT_THAT(solid.polygons(), ElementsAre(Polygon{square(0, 0, 1), {}}));
}

/// Edits at random, each compared with the operations one after the other.
TEST(Solid, IsWhatItsTreeSays) {
  for (std::uint64_t seed = 0; seed < cases(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    Solid solid;
    std::vector<NodeId> leaves;
    std::vector<NodeId> inner;
    const auto any = [&](int bound) {
      return static_cast<double>(random() % static_cast<unsigned>(bound));
    };
    for (int i = 0; i < 6; ++i) leaves.push_back(solid.shape({square(any(8), any(8), 1 + any(5))}));
    const auto operation = [&] { return static_cast<Operation>(random() % 4); };
    inner.push_back(solid.combine(operation(), {leaves[0], leaves[1]}));
    inner.push_back(solid.combine(operation(), {leaves[2], leaves[3], leaves[4]}));
    inner.push_back(solid.combine(operation(), {inner[0], inner[1], leaves[5]}));
    solid.set_root(inner[2]);
    std::vector<Operation> operations(3);
    for (std::size_t i = 0; i < 3; ++i) solid.set_operation(inner[i], operations[i] = operation());
    for (int edit = 0; edit < 30; ++edit) {
      if (random() % 2 == 0) {
        const std::size_t which = random() % 3;
        solid.set_operation(inner[which], operations[which] = operation());
      } else {
        const auto& nodes = random() % 3 == 0 ? inner : leaves;
        solid.set_transform(nodes[random() % nodes.size()],
                            {.xx = 1 + any(2), .x0 = any(5), .y0 = any(5)});
      }
      const auto shape_of = [&](NodeId leaf) {
        const Overlay& overlay = solid.overlay();
        MultiPolygon result;
        for (const RingId ring : overlay.rings(solid.layer(leaf)))
          result.push_back({overlay.triangulation().points(ring), {}});
        return result;
      };
      const auto combined = [&](std::size_t which, const std::vector<MultiPolygon>& operands) {
        MultiPolygon result = operands[0];
        for (std::size_t i = 1; i < operands.size(); ++i) switch (operations[which]) {
            case Operation::unite:
              result = unite(result, operands[i]);
              break;
            case Operation::intersect:
              result = intersect(result, operands[i]);
              break;
            case Operation::subtract:
              result = subtract(result, operands[i]);
              break;
            case Operation::exclude:
              result = exclude(result, operands[i]);
              break;
          }
        return result;
      };
      const MultiPolygon first = combined(0, {shape_of(leaves[0]), shape_of(leaves[1])});
      const MultiPolygon second =
          combined(1, {shape_of(leaves[2]), shape_of(leaves[3]), shape_of(leaves[4])});
      const MultiPolygon all = combined(2, {first, second, shape_of(leaves[5])});
      ASSERT_EQ(area(all), solid.area());
      ASSERT_EQ(area(solid.polygons()), solid.area());
    }
  }
}

TEST(Boolean, OneCallIsEnough) {
  const MultiPolygon a{{square(0, 0, 4), {}}};
  const MultiPolygon b{{square(2, 2, 4), {square(3, 3, 1)}}};
  EXPECT_EQ(area(unite(a, b)).to_double(), 16 + 15 - 3);
  EXPECT_EQ(area(intersect(a, b)).to_double(), 3);
  EXPECT_EQ(area(subtract(a, b)).to_double(), 13);
  EXPECT_EQ(area(exclude(a, b)).to_double(), 13 + 12);
  EXPECT_EQ(unite(unite(a, b), unite(a, b)), unite(a, b));
  EXPECT_EQ(unite(a, b), unite(b, a));
  const std::vector<MultiPolygon> many{a, b, {{square(100, 0, 1), {}}}, {}};
  EXPECT_EQ(area(dissolve(many)).to_double(), 29);
  const std::vector<Ring> bow{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}};
  EXPECT_EQ(fill(bow, FillRule::even_odd).size(), 2U);
  EXPECT_EQ(fill(bow, FillRule::positive).size(), 1U);
  EXPECT_THAT(fill({}, FillRule::nonzero), IsEmpty());
}

}  // namespace
}  // namespace loft::overlay
