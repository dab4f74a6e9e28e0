// SPDX-License-Identifier: MIT
#include "fields/fit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace loft::fields {
namespace {

class Places {
 public:
  explicit Places(std::uint64_t seed) : random_(seed) {}

  [[nodiscard]] double any() { return any_(random_); }
  /// Around a place, in a disc that is flattened to some of its height.
  [[nodiscard]] std::vector<Around> around(cdt::Point at, std::size_t count, double height) {
    std::vector<Around> result;
    while (result.size() < count) {
      const Vector d{any(), any()};
      if (dot(d, d) > 0.01 && dot(d, d) < 1)
        result.push_back({{at.x + d.x, at.y + height * d.y}, any()});
    }
    return result;
  }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> any_{-1, 1};
};

/// The fit by definition: normal equations in long doubles, by Gauss's elimination.
Vector slow_fit(cdt::Point at, double value, const std::vector<Around>& around) {
  constexpr std::size_t terms = 5;
  std::array<std::array<long double, terms + 1>, terms> rows{};
  for (const Around& a : around) {
    const long double x = a.place.x - at.x;
    const long double y = a.place.y - at.y;
    const long double weight = 1 / ((x * x + y * y) * (x * x + y * y));
    const std::array<long double, terms + 1> row{x, y, x * x, x * y, y * y, a.value - value};
    for (std::size_t j = 0; j < terms; ++j)
      for (std::size_t k = 0; k <= terms; ++k) rows[j][k] += weight * row[j] * row[k];
  }
  for (std::size_t j = 0; j < terms; ++j)
    for (std::size_t i = 0; i < terms; ++i) {
      if (i == j) continue;
      const long double factor = rows[i][j] / rows[j][j];
      for (std::size_t k = j; k <= terms; ++k) rows[i][k] -= factor * rows[j][k];
    }
  return {static_cast<double>(rows[0][terms] / rows[0][0]),
          static_cast<double>(rows[1][terms] / rows[1][1])};
}

TEST(Fit, IsThatOfLeastSquares) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Places places(seed);
    const cdt::Point at{places.any(), places.any()};
    const std::vector<Around> around = places.around(at, 8 + seed % 40, 1);
    const double value = places.any();
    const Vector gradient = fit_gradient(at, value, around);
    const Vector expected = slow_fit(at, value, around);
    const double slack = 1e-9 * (1 + std::sqrt(dot(expected, expected)));
    EXPECT_NEAR(gradient.x, expected.x, slack);
    EXPECT_NEAR(gradient.y, expected.y, slack);
  }
}

TEST(Fit, FollowsAQuadraticPolynomialAlsoWhereAllIsNearlyInOneLine) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Places places(seed);
    const double height = std::pow(10, -static_cast<double>(seed % 4));
    const cdt::Point at{places.any(), places.any()};
    std::vector<Around> around = places.around(at, 8 + seed % 40, height);
    for (Around& a : around) {
      const Vector d = way(at, a.place);
      a.value = 3 + 2 * d.x - d.y + 0.5 * d.x * d.x;
    }
    const Vector gradient = fit_gradient(at, 3, around);
    EXPECT_NEAR(gradient.x, 2, 1e-7);
    EXPECT_NEAR(gradient.y, -1, 1e-7 / height);
  }
}

TEST(Fit, DoesNotDependOnTheUnit) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Places places(seed);
    const std::vector<Around> around = places.around({}, 12, 1);
    const Vector gradient = fit_gradient({}, 0, around);
    for (const double unit : {0x1p-100, 0x1p+100}) {
      std::vector<Around> scaled = around;
      for (Around& a : scaled) a.place = {unit * a.place.x, unit * a.place.y};
      EXPECT_EQ(fit_gradient({}, 0, scaled), 1 / unit * gradient);
    }
  }
}

}  // namespace
}  // namespace loft::fields
