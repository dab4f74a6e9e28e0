// SPDX-License-Identifier: MIT
// Results against arithmetic without rounding.
#include "tests/overlay/truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <compare>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "overlay/overlay.h"
#include "overlay/validity.h"
#include "tests/cases.h"

namespace loft::overlay {
namespace {

/// Of whole numbers below 8. Corners and crossings have denominators below 2^7, heights of segments
/// at their x below 2^10: different ones differ by 2^-20 or more, and are off by less than 2^-130.
using GridNumber = FixedPoint<320, 140, 100>;
/// Of whole numbers below 2^65. Different ones differ by 2^-266 or more, in the same way, and are
/// off by less than 2^-284.
using DecimalNumber = FixedPoint<1024, 352, 270>;

/// A rational number behind the functions of FixedPoint.
class Rational {
 public:
  using Whole = boost::multiprecision::cpp_int;

  Rational() = default;
  explicit Rational(const Whole& whole) : value_(whole) {}

  [[nodiscard]] static Rational quotient(const Whole& a, const Whole& b) { return Rational(a) / b; }
  [[nodiscard]] static Rational scaled(double x, int shift) {
    return Rational(Value(std::ldexp(x, shift)));
  }
  [[nodiscard]] double to_double(int shift) const {
    return std::ldexp(value_.convert_to<double>(), -shift);
  }

  friend Rational operator+(const Rational& a, const Rational& b) {
    return Rational(Value(a.value_ + b.value_));
  }
  friend Rational operator-(const Rational& a, const Rational& b) {
    return Rational(Value(a.value_ - b.value_));
  }
  friend Rational operator*(const Rational& a, const Rational& b) {
    return Rational(Value(a.value_ * b.value_));
  }
  friend Rational operator*(const Rational& a, const Whole& b) {
    return Rational(Value(a.value_ * b));
  }
  friend Rational operator/(const Rational& a, const Whole& b) {
    return Rational(Value(a.value_ / b));
  }
  friend bool operator==(const Rational& a, const Rational& b) { return a.value_ == b.value_; }
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
    return a.value_.compare(b.value_) <=> 0;
  }

 private:
  using Value = boost::multiprecision::cpp_rational;

  explicit Rational(Value value) : value_(std::move(value)) {}

  Value value_ = 0;
};

/// Rings of two layers.
struct SmallCase {
  enum class Kind {
    grid,    ///< whole numbers below 8
    stairs,  ///< the same, and edges along the axes: all crossings are whole
    tenths,
    thousandths,
    sevenths,  ///< beyond 5e6
    beside,    ///< tenths, and points as near to an edge before them as doubles are
    clusters,  ///< around whole numbers below 3, few last places apart
  };
  Kind kind;
  FillRule rule;
  std::array<std::vector<Ring>, 2> layers;
};

double some_coordinate(SmallCase::Kind kind, std::mt19937_64& random) {
  using Kind = SmallCase::Kind;
  switch (kind) {
    case Kind::grid:
    case Kind::stairs:
      break;
    case Kind::tenths:
    case Kind::beside:
      return static_cast<double>(random() % 80) / 10;
    case Kind::thousandths:
      return static_cast<double>(random() % 8000) / 1000;
    case Kind::sevenths:
      return 5e6 + static_cast<double>(random() % 56) / 7;
    case Kind::clusters:
      return static_cast<double>(1 + random() % 3) + static_cast<double>(random() % 6) * 0x1p-52;
  }
  return static_cast<double>(random() % 8);
}

/// Edges along the axes, to corners of which every other one is as before.
void make_stairs(Ring& ring) {
  if (ring.size() % 2 != 0) ring.push_back(ring.front());
  for (std::size_t i = 0; i < ring.size(); i += 2)
    ring[i + 1] = {ring[i].x, ring[(i + 2) % ring.size()].y};
}

/// Every third corner is put on the edge that leads to the corner before it, and rounded.
void put_beside_edges(Ring& ring, std::mt19937_64& random) {
  for (std::size_t i = 2; i < ring.size(); i += 3) {
    const double part = static_cast<double>(1 + random() % 9) / 10;
    const Point from = ring[i - 2];
    const Point to = ring[i - 1];
    ring[i] = {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)};
  }
}

Ring some_ring(SmallCase::Kind kind, std::mt19937_64& random) {
  Ring ring(3 + random() % 10);
  for (Point& p : ring) p = {some_coordinate(kind, random), some_coordinate(kind, random)};
  if (kind == SmallCase::Kind::stairs) make_stairs(ring);
  if (kind == SmallCase::Kind::beside) put_beside_edges(ring, random);
  return ring;
}

/// One or two rings of 3 to 12 corners in each layer.
SmallCase small_case(SmallCase::Kind kind, std::uint64_t seed) {
  constexpr FillRule rules[] = {FillRule::even_odd, FillRule::nonzero, FillRule::positive};
  std::mt19937_64 random(seed);
  SmallCase result{kind, rules[seed % 3], {}};
  for (std::vector<Ring>& rings : result.layers)
    for (std::size_t count = 1 + random() % 2; count > 0; --count)
      rings.push_back(some_ring(kind, random));
  return result;
}

/// An operation, on layers and on what windings say.
struct PairOperation {
  Expression what;
  bool (*is_true)(bool, bool);
};

std::vector<PairOperation> operations() {
  const Expression a = LayerId(0);
  const Expression b = LayerId(1);
  return {{a | b, [](bool in_a, bool in_b) { return in_a || in_b; }},
          {a & b, [](bool in_a, bool in_b) { return in_a && in_b; }},
          {a - b, [](bool in_a, bool in_b) { return in_a && !in_b; }},
          {a ^ b, [](bool in_a, bool in_b) { return in_a != in_b; }}};
}

template <class Number>
TrueResult<Number> true_result(const TrueArrangement<Number>& truth, FillRule rule,
                               const PairOperation& operation) {
  return truth.result([&](const std::array<int, 2>& turns) {
    return operation.is_true(is_inside(rule, turns[0]), is_inside(rule, turns[1]));
  });
}

Overlay overlay_of(const SmallCase& small) {
  Overlay overlay;
  for (const std::vector<Ring>& rings : small.layers) {
    const LayerId layer = overlay.add_layer("", small.rule);
    for (const Ring& ring : rings) overlay.insert(layer, ring);
  }
  return overlay;
}

/// Twice the area inside a border, without rounding.
template <class Number>
Number twice_area(std::span<const BorderEdge> border, int shift) {
  Number sum;
  const auto number = [&](double x) { return Number::scaled(x, shift); };
  for (const BorderEdge& edge : border)
    sum = sum + number(edge.from.x) * number(edge.to.y) - number(edge.from.y) * number(edge.to.x);
  return sum;
}

std::vector<std::size_t> hole_counts(const MultiPolygon& polygons) {
  std::vector<std::size_t> result;
  for (const Polygon& polygon : polygons) result.push_back(polygon.holes.size());
  std::ranges::sort(result);
  return result;
}

/// How a kind's coordinates are made whole, times 2^shift; and from which distance on nothing
/// changes sides by rounding, which is less than 2^-52 of the largest coordinate.
struct Scale {
  int shift;
  double clear_distance;
};

Scale scale_of(SmallCase::Kind kind) {
  switch (kind) {
    case SmallCase::Kind::grid:
    case SmallCase::Kind::stairs:
      return {0, 1e-13};
    case SmallCase::Kind::sevenths:
      return {30, 1e-7};
    case SmallCase::Kind::tenths:
    case SmallCase::Kind::thousandths:
    case SmallCase::Kind::beside:
    case SmallCase::Kind::clusters:
      break;
  }
  return {62, 1e-13};
}

template <class Number>
class TruthCheck {
 public:
  explicit TruthCheck(const SmallCase& small)
      : rule_(small.rule),
        truth_(small.layers, scale_of(small.kind).shift),
        overlay_(overlay_of(small)),
        bound_(overlay_.area_error_bound()),
        is_clear_(truth_.is_clear_by(scale_of(small.kind).clear_distance)),
        is_exact_(is_clear_ && truth_.is_representable()) {}

  void expect_all() {
    if (is_exact_) {
      ASSERT_EQ(bound_, 0);
    }
    for (const PairOperation& operation : operations()) {
      const ResultId result = overlay_.watch(operation.what);
      const TrueResult<Number> wanted = true_result(truth_, rule_, operation);
      ASSERT_NO_FATAL_FAILURE(expect_area(result, wanted.twice_area));
      ASSERT_NO_FATAL_FAILURE(expect_polygons(result, wanted.holes));
      overlay_.unwatch(result);
    }
  }

  [[nodiscard]] bool is_clear() const { return is_clear_; }
  [[nodiscard]] bool is_exact() const { return is_exact_; }

 private:
  void expect_area(ResultId result, const Number& wanted) {
    const int shift = truth_.shift();
    const Number difference = twice_area<Number>(overlay_.border(result), shift) - wanted;
    // Where nothing is rounded the numbers here still are, but far less than by this.
    ASSERT_LE(std::abs(difference.to_double(2 * shift + 1)), std::max(bound_, 0x1p-80));
    if (is_exact_) {
      ASSERT_EQ(overlay_.area(result).to_double(), wanted.to_double(2 * shift + 1));
    }
  }

  void expect_polygons(ResultId result, const std::vector<std::size_t>& holes) {
    const MultiPolygon polygons = overlay_.polygons(result);
    ASSERT_THAT(validity_problems(polygons), ::testing::IsEmpty());
    if (is_clear_) {
      ASSERT_EQ(hole_counts(polygons), holes);
    }
  }

  FillRule rule_;
  TrueArrangement<Number> truth_;
  Overlay overlay_;
  double bound_;
  bool is_clear_;  // nothing could change sides by rounding
  bool is_exact_;  // nothing is rounded
};

/// How many cases came out how.
struct Tally {
  std::size_t clear = 0;
  std::size_t exact = 0;
};

/// Areas are within the bound that is given, and equal where no crossing is rounded; and there are
/// as many polygons with as many holes where corners and crossings are clear of what they are not
/// on.
template <class Number>
void expect_truth(SmallCase::Kind kind, std::uint64_t count, Tally& tally) {
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    TruthCheck<Number> check(small_case(kind, seed));
    ASSERT_NO_FATAL_FAILURE(check.expect_all());
    tally.clear += check.is_clear() ? 1U : 0U;
    tally.exact += check.is_exact() ? 1U : 0U;
  }
}

TEST(Truth, OnTheGrid) {
  Tally tally;
  expect_truth<GridNumber>(SmallCase::Kind::grid, cases(4000), tally);
  EXPECT_EQ(tally.clear, cases(4000));
  EXPECT_GT(tally.exact, 0U);
}

TEST(Truth, AlongTheAxesOfTheGrid) {
  Tally tally;
  expect_truth<GridNumber>(SmallCase::Kind::stairs, cases(2000), tally);
  EXPECT_EQ(tally.clear, cases(2000));
  EXPECT_EQ(tally.exact, cases(2000));
}

/// Tenths that are to be on a line are not: the nearest doubles are beside it, and crossings beside
/// these by less than they are rounded. About an eighth of the cases has such.
TEST(Truth, InTenths) {
  Tally tally;
  expect_truth<DecimalNumber>(SmallCase::Kind::tenths, cases(2000), tally);
  EXPECT_GT(tally.clear, cases(2000) * 3 / 4);
  RecordProperty("not_clear", std::to_string(cases(2000) - tally.clear));
}

TEST(Truth, InThousandths) {
  Tally tally;
  expect_truth<DecimalNumber>(SmallCase::Kind::thousandths, cases(2000), tally);
  EXPECT_EQ(tally.clear, cases(2000));
}

/// Where hardly anything is clear, areas are within the bound all the same, and polygons valid.
TEST(Truth, WhereRoundingChangesSides) {
  using Kind = SmallCase::Kind;
  Tally tally;
  for (const Kind kind : {Kind::sevenths, Kind::beside, Kind::clusters})
    expect_truth<DecimalNumber>(kind, cases(500), tally);
  RecordProperty("clear", std::to_string(tally.clear));
}

template <class Number>
void expect_as_rational(SmallCase::Kind kind) {
  const auto [shift, clear_distance] = scale_of(kind);
  for (std::uint64_t seed = 0; seed < cases(50); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SmallCase small = small_case(kind, seed);
    for (std::vector<Ring>& rings : small.layers)
      rings = {Ring(rings[0].begin(), rings[0].begin() + 3)};
    const TrueArrangement<Number> fixed(small.layers, shift);
    const TrueArrangement<Rational> rational(small.layers, shift);
    ASSERT_EQ(fixed.is_representable(), rational.is_representable());
    ASSERT_EQ(fixed.is_clear_by(clear_distance), rational.is_clear_by(clear_distance));
    for (const PairOperation& operation : operations()) {
      const auto one = true_result(fixed, small.rule, operation);
      const auto other = true_result(rational, small.rule, operation);
      ASSERT_EQ(one.holes, other.holes);
      ASSERT_DOUBLE_EQ(one.twice_area.to_double(0), other.twice_area.to_double(0));
    }
  }
}

TEST(Truth, FixedPointIsAsRational) {
  expect_as_rational<GridNumber>(SmallCase::Kind::grid);
  expect_as_rational<DecimalNumber>(SmallCase::Kind::tenths);
  expect_as_rational<DecimalNumber>(SmallCase::Kind::thousandths);
}

}  // namespace
}  // namespace loft::overlay
