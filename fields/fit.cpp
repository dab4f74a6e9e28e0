// SPDX-License-Identifier: MIT
#include "fields/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace loft::fields {

namespace {

/// Places whose moments are closer to those of a line than that fix no plane: the square of an
/// angle.
constexpr double flatness = 1e-14;
/// With less, what is beside the line would be guessed from what hardly leaves it.
constexpr double safe_flatness = 1e-3;
/// A slope or a curvature of which less than that is left beside the terms before it is not fixed
/// by the values. (Where a slope is hardly fixed, the triangles are thin, and it matters little.)
constexpr double least_slope = 1e-7;
constexpr double least_curvature = 1e-2;

struct Moments {
  double xx = 0, xy = 0, yy = 0;
  void add(double weight, Vector d) {
    xx += weight * d.x * d.x;
    xy += weight * d.x * d.y;
    yy += weight * d.y * d.y;
  }
  [[nodiscard]] double trace() const { return xx + yy; }
  [[nodiscard]] bool is_flat(double limit = flatness) const {
    return !(xx * yy - xy * xy > limit * trace() * trace());
  }
};

/// The mean of places and values, and how they vary around it.
class Plane {
 public:
  Plane(cdt::Point at, const std::vector<Around>& around) : at_(at) {
    double total = 0;
    for (const Around& a : around) total += weight(a);
    for (const Around& a : around) {
      const double share = weight(a) / total;
      mean_ = mean_ + share * way(at, a.place);
      value_ += share * a.value;
    }
    for (const Around& a : around)
      add(weight(a) / total, way(at, a.place) + -1 * mean_, a.value - value_);
  }

  [[nodiscard]] bool is_fixed(double limit = flatness) const { return !moments_.is_flat(limit); }
  [[nodiscard]] double value() const {
    return value_ - dot(is_fixed() ? slope() : slope_along_line(), mean_);
  }

 private:
  [[nodiscard]] double weight(const Around& a) const {
    const Vector d = way(at_, a.place);
    return 1 / dot(d, d);
  }
  void add(double weight, Vector d, double rise) {
    moments_.add(weight, d);
    rise_ = rise_ + weight * rise * d;
  }
  [[nodiscard]] Vector slope() const {
    const double det = moments_.xx * moments_.yy - moments_.xy * moments_.xy;
    return {(moments_.yy * rise_.x - moments_.xy * rise_.y) / det,
            (moments_.xx * rise_.y - moments_.xy * rise_.x) / det};
  }
  [[nodiscard]] Vector slope_along_line() const {
    return moments_.trace() > 0 ? 1 / moments_.trace() * rise_ : Vector{};
  }

  cdt::Point at_;
  Vector mean_;
  double value_ = 0;
  Moments moments_;
  Vector rise_;
};

/// A least squares problem by Gram and Schmidt's process, modified: columns are made orthogonal one
/// after the other, and what they explain is taken from the values.
class QuadraticFit {
 public:
  QuadraticFit(cdt::Point at, double value, std::span<const Around> around)
      : scale_(scale(at, around)) {
    rows_.reserve(around.size());
    for (const Around& a : around) {
      const Vector d = 1 / scale_ * way(at, a.place);
      const double w = 1 / dot(d, d);
      rows_.push_back(
          {w * d.x, w * d.y, w * d.x * d.x, w * d.x * d.y, w * d.y * d.y, w * (a.value - value)});
    }
  }

  [[nodiscard]] Vector gradient() {
    std::array<double, terms> norm{};
    for (std::size_t k = 0; k < terms; ++k) {
      const double whole = std::sqrt(product(k, k));
      for (std::size_t j = 0; j < k; ++j)
        if (norm[j] > 0) take(j, k, factors_[j][k] = product(j, k) / norm[j]);
      norm[k] = product(k, k);
      if (!(std::sqrt(norm[k]) > (k < 2 ? least_slope : least_curvature) * whole)) norm[k] = 0;
      if (norm[k] > 0) take(k, terms, factors_[k][terms] = product(k, terms) / norm[k]);
    }
    std::array<double, terms> solution{};
    for (std::size_t k = terms; k-- > 0;) {
      if (norm[k] == 0) continue;
      solution[k] = factors_[k][terms];
      for (std::size_t j = k + 1; j < terms; ++j) solution[k] -= factors_[k][j] * solution[j];
    }
    return 1 / scale_ * Vector{solution[0], solution[1]};
  }

 private:
  static constexpr std::size_t terms = 5;  // x, y, xx, xy, yy
  using Row = std::array<double, terms + 1>;

  [[nodiscard]] static double scale(cdt::Point at, std::span<const Around> around) {
    double sum = 0;
    for (const Around& a : around) {
      const Vector d = way(at, a.place);
      sum += std::sqrt(dot(d, d));
    }
    return sum / static_cast<double>(around.size());
  }
  [[nodiscard]] double product(std::size_t j, std::size_t k) const {
    double sum = 0;
    for (const Row& row : rows_) sum += row[j] * row[k];
    return sum;
  }
  void take(std::size_t j, std::size_t k, double factor) {
    for (Row& row : rows_) row[k] -= factor * row[j];
  }

  double scale_;
  std::vector<Row> rows_;
  std::array<std::array<double, terms + 1>, terms> factors_{};
};

/// The same problem by its normal equations, which take a fraction of the time, but lose twice the
/// digits: for columns that are far from depending on one another.
class NormalEquations {
 public:
  NormalEquations(cdt::Point at, double value, std::span<const Around> around) {
    if (around.size() > most) return;
    for (std::size_t i = 0; i < around.size(); ++i) {
      const Vector d = way(at, around[i].place);
      const double w = 1 / dot(d, d);
      columns_[0][i] = w * d.x;
      columns_[1][i] = w * d.y;
      columns_[2][i] = w * d.x * d.x;
      columns_[3][i] = w * d.x * d.y;
      columns_[4][i] = w * d.y * d.y;
      columns_[5][i] = w * (around[i].value - value);
    }
    count_ = around.size();
    while (count_ % lanes != 0) {
      for (auto& column : columns_) column[count_] = 0;
      ++count_;
    }
  }

  /// None where columns are too near to depending on one another.
  [[nodiscard]] std::optional<Vector> gradient() const {
    if (count_ == 0) return std::nullopt;
    std::array<std::array<double, terms + 1>, terms> rest;  // what is left of products
    std::array<std::array<double, terms + 1>, terms> factors;
    std::array<double, terms> least;
    for (std::size_t j = 0; j < terms; ++j) {
      for (std::size_t k = j; k <= terms; ++k) rest[j][k] = product(columns_[j], columns_[k]);
      least[j] = clear_share * rest[j][j];
    }
    for (std::size_t j = 0; j < terms; ++j) {
      if (!(rest[j][j] > least[j])) return std::nullopt;
      const double inverse = 1 / rest[j][j];
      for (std::size_t k = j + 1; k <= terms; ++k) factors[j][k] = rest[j][k] * inverse;
      for (std::size_t i = j + 1; i < terms; ++i)
        for (std::size_t k = i; k <= terms; ++k) rest[i][k] -= factors[j][i] * rest[j][k];
    }
    std::array<double, terms> solution;
    for (std::size_t j = terms; j-- > 0;) {
      solution[j] = factors[j][terms];
      for (std::size_t k = j + 1; k < terms; ++k) solution[j] -= factors[j][k] * solution[k];
    }
    return Vector{solution[0], solution[1]};
  }

 private:
  static constexpr std::size_t terms = 5;  // as above
  static constexpr std::size_t most = 32;
  static constexpr std::size_t lanes = 4;
  /// Of a column's square, at least that is left beside the columns before it.
  static constexpr double clear_share = 1e-2;

  using Column = std::array<double, most>;

  [[nodiscard]] double product(const Column& a, const Column& b) const {
    std::array<double, lanes> sums{};
    for (std::size_t i = 0; i < count_; i += lanes)
      for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += a[i + lane] * b[i + lane];
    return (sums[0] + sums[2]) + (sums[1] + sums[3]);
  }

  std::array<Column, terms + 1> columns_;
  std::size_t count_ = 0;
};

/// The gradient where all that is known is in one line.
Vector gradient_along_line(cdt::Point at, double value, std::span<const Around> around) {
  double squares = 0;
  Vector rise;
  for (const Around& a : around) {
    const Vector d = way(at, a.place);
    const double weight = 1 / dot(d, d);
    squares += weight * dot(d, d);
    rise = rise + weight * (a.value - value) * d;
  }
  return squares > 0 ? 1 / squares * rise : Vector{};
}

[[nodiscard]] bool is_in_line(cdt::Point at, std::span<const Around> around) {
  Moments moments;
  for (const Around& a : around) {
    const Vector d = way(at, a.place);
    moments.add(1 / dot(d, d), d);
  }
  return moments.is_flat();
}

}  // namespace

std::optional<double> plane_value(cdt::Point at, const std::vector<Around>& around) {
  const Plane plane(at, around);
  if (!plane.is_fixed(safe_flatness)) return std::nullopt;
  return plane.value();
}

double nearest_plane_value(cdt::Point at, const std::vector<Around>& around) {
  return Plane(at, around).value();
}

Vector fit_gradient(cdt::Point at, double value, std::span<const Around> around) {
  if (const auto gradient = NormalEquations(at, value, around).gradient()) return *gradient;
  if (is_in_line(at, around)) return gradient_along_line(at, value, around);
  return QuadraticFit(at, value, around).gradient();
}

}  // namespace loft::fields
