// SPDX-License-Identifier: MIT
#include "io/dicom/space_contours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

#include "io/bytes/text.h"
#include "mesh/vec3.h"

namespace loft::io {

namespace {

Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double length(const Vec3& a) { return std::hypot(a[0], a[1], a[2]); }

Vec3 scaled(const Vec3& a, double by) { return {a[0] * by, a[1] * by, a[2] * by}; }

/// How far a contour reaches: the diagonal of its box.
double extent(const SpaceContour& contour) {
  Vec3 least = contour.points.front();
  Vec3 most = least;
  for (const Vec3& point : contour.points)
    for (std::size_t i = 0; i < 3; ++i) {
      least[i] = std::min(least[i], point[i]);
      most[i] = std::max(most[i], point[i]);
    }
  return length(minus(most, least));
}

/// Upright on a contour, as long as twice its area.
Vec3 area_vector(const SpaceContour& contour) {
  Vec3 sum{};
  const Vec3& first = contour.points.front();
  for (std::size_t i = 1; i + 1 < contour.points.size(); ++i) {
    const Vec3 part = cross(minus(contour.points[i], first), minus(contour.points[i + 1], first));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return sum;
}

/// Three axes at right angles: two in the planes, the third upright on them.
struct Axes {
  Vec3 u;
  Vec3 v;
  Vec3 normal;
};

/// Heights, and how far two of them may differ by rounding.
class Heights {
 public:
  Heights(std::vector<double> of_contours, double largest_extent)
      : of_contours_(std::move(of_contours)), sorted_(of_contours_) {
    std::ranges::sort(sorted_);
    tolerance_ = tolerance_of(largest_extent);
  }

  [[nodiscard]] double tolerance() const { return tolerance_; }

  /// The contours' numbers, those of a plane together, the planes ascending.
  [[nodiscard]] std::vector<std::vector<std::size_t>> planes() const {
    std::vector<std::size_t> order(of_contours_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [this](std::size_t i) { return of_contours_[i]; });
    std::vector<std::vector<std::size_t>> result;
    double lowest = 0;
    for (const std::size_t i : order) {
      if (result.empty() || of_contours_[i] - lowest > tolerance_) {
        lowest = of_contours_[i];
        result.emplace_back();
      }
      result.back().push_back(i);
    }
    return result;
  }

  /// The height that most contours of a plane have; the lowest of those that are as frequent.
  [[nodiscard]] double most_frequent(const std::vector<std::size_t>& plane) const {
    double best = of_contours_[plane.front()];
    std::size_t most = 0;
    for (std::size_t begin = 0; begin < plane.size();) {  // ascending
      std::size_t end = begin;
      while (end < plane.size() && of_contours_[plane[end]] == of_contours_[plane[begin]]) ++end;
      if (end - begin > most) best = of_contours_[plane[begin]];
      most = std::max(most, end - begin);
      begin = end;
    }
    return best;
  }

  [[nodiscard]] double spread(const std::vector<std::size_t>& plane) const {
    return of_contours_[plane.back()] - of_contours_[plane.front()];
  }

 private:
  /// A hundredth of the median gap. Gaps as small as numbers of single precision are rounded are
  /// none. Without gaps, what decimals of a contour in one plane may differ in.
  [[nodiscard]] double tolerance_of(double largest_extent) const {
    constexpr double rounding = 1e-6;
    constexpr double share = 0.01;
    const double size =
        std::max({std::abs(sorted_.front()), std::abs(sorted_.back()), largest_extent});
    std::vector<double> gaps;
    for (std::size_t i = 1; i < sorted_.size(); ++i)
      if (sorted_[i] - sorted_[i - 1] > rounding * size)
        gaps.push_back(sorted_[i] - sorted_[i - 1]);
    if (gaps.empty()) return rounding * size;
    const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
    std::ranges::nth_element(gaps, middle);
    return share * *middle;
  }

  std::vector<double> of_contours_;
  std::vector<double> sorted_;
  double tolerance_ = 0;
};

/// All contours of a stack, and the direction of their planes.
class Planes {
 public:
  Planes(std::vector<SpaceContour> contours, std::string_view name, Stack& stack,
         Problems& problems)
      : contours_(std::move(contours)), name_(name), stack_(stack), problems_(problems) {
    for (const SpaceContour& contour : contours_)
      largest_extent_ = std::max(largest_extent_, extent(contour));
  }

  /// Whether all are in planes of constant x (0), y (1) or z (2): then makes slices of them.
  [[nodiscard]] bool are_along(std::size_t axis) {
    const Heights heights =
        heights_at([&](const SpaceContour& contour) { return contour.points.front()[axis]; });
    std::size_t uneven = 0;
    for (const SpaceContour& contour : contours_) {
      const auto [least, most] = std::ranges::minmax(
          contour.points, {}, [axis](const Vec3& point) { return point[axis]; });
      if (most[axis] - least[axis] > heights.tolerance()) return false;
      if (most[axis] != least[axis]) ++uneven;
    }
    uneven_ = uneven;
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    slice(heights, [&](const Vec3& point) { return cdt::Point{point[u], point[v]}; });
    if (axis == 2) return true;
    WorldFrame frame;
    frame.rows = {};
    frame.rows[u][0] = frame.rows[v][1] = frame.rows[axis][2] = frame.rows[3][3] = 1;
    stack_.frame = frame;
    return true;
  }

  void tilt() {
    std::vector<std::size_t> all(contours_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::optional<Axes> axes = fitted(all);
    if (!axes) {
      problems_.add(std::string(name_) +
                    ": its contours have no area that would tell the direction of their planes");
      return;
    }
    // One that is turned turns the mean of all: what is wrong is told by what most agree on.
    if (!off_planes(*axes).empty())
      if (const auto most = fitted(most_alike(*axes))) axes = most;
    if (const auto off = off_planes(*axes); !off.empty()) {
      add_not_parallel(off, *axes);
      return;
    }
    keep_places_ = true;
    slice(heights_along(*axes), [&](const Vec3& point) {
      return cdt::Point{dot(axes->u, point), dot(axes->v, point)};
    });
    WorldFrame frame;
    for (std::size_t i = 0; i < 3; ++i)
      frame.rows[i] = {axes->u[i], axes->v[i], axes->normal[i], 0};
    stack_.frame = frame;
  }

 private:
  template <class Height>
  [[nodiscard]] Heights heights_at(Height height) const {
    std::vector<double> heights;
    heights.reserve(contours_.size());
    for (const SpaceContour& contour : contours_) heights.push_back(height(contour));
    return {std::move(heights), largest_extent_};
  }

  [[nodiscard]] Heights heights_along(const Axes& axes) const {
    return heights_at(
        [&](const SpaceContour& contour) { return mean_height(contour, axes.normal); });
  }

  static double mean_height(const SpaceContour& contour, const Vec3& normal) {
    double sum = 0;
    for (const Vec3& point : contour.points) sum += dot(point, normal);
    return sum / static_cast<double>(contour.points.size());
  }

  /// The normal that areas agree on, large ones more; it points the way of its largest part.
  [[nodiscard]] std::optional<Axes> fitted(const std::vector<std::size_t>& contours) const {
    std::vector<Vec3> areas;
    for (const std::size_t i : contours) areas.push_back(area_vector(contours_[i]));
    if (areas.empty()) return {};
    const Vec3 largest = *std::ranges::max_element(areas, {}, length);
    Vec3 sum{};
    for (const Vec3& area : areas)
      for (std::size_t i = 0; i < 3; ++i) sum[i] += dot(area, largest) < 0 ? -area[i] : area[i];
    if (!(length(sum) > 0)) return {};
    Vec3 normal = scaled(sum, 1 / length(sum));
    const auto strongest =
        *std::ranges::max_element(normal, {}, [](double part) { return std::abs(part); });
    if (strongest < 0) normal = scaled(normal, -1);
    // The first axis as near to the world's as it can be: x, or y for planes across x.
    const Vec3 wanted = std::abs(normal[0]) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    Vec3 u = minus(wanted, scaled(normal, dot(wanted, normal)));
    u = scaled(u, 1 / length(u));
    return Axes{u, cross(normal, u), normal};
  }

  /// Contours that have points off the plane that they would have.
  [[nodiscard]] std::vector<std::size_t> off_planes(const Axes& axes) const {
    constexpr double flatness = 1e-3;  // of a contour's extent: decimals that were cut off
    const double tolerance = heights_along(axes).tolerance();
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < contours_.size(); ++i) {
      const double height = mean_height(contours_[i], axes.normal);
      double off = 0;
      for (const Vec3& point : contours_[i].points)
        off = std::max(off, std::abs(dot(point, axes.normal) - height));
      if (off > std::max(tolerance, flatness * extent(contours_[i]))) result.push_back(i);
    }
    return result;
  }

  /// The largest set of contours that are in parallel planes, of those that some of them tell.
  [[nodiscard]] std::vector<std::size_t> most_alike(const Axes& mean) const {
    constexpr std::size_t tries = 64;
    const auto others = [&](const std::vector<std::size_t>& off) {
      std::vector<std::size_t> result;
      for (std::size_t i = 0; i < contours_.size(); ++i)
        if (!std::ranges::binary_search(off, i)) result.push_back(i);
      return result;
    };
    std::vector<std::size_t> best = others(off_planes(mean));
    const std::size_t step = (contours_.size() + tries - 1) / tries;
    for (std::size_t i = 0; i < contours_.size(); i += step) {
      const std::optional<Axes> axes = fitted({i});
      if (!axes) continue;
      std::vector<std::size_t> alike = others(off_planes(*axes));
      if (alike.size() > best.size()) best = std::move(alike);
    }
    return best;
  }

  void add_not_parallel(const std::vector<std::size_t>& off, const Axes& axes) {
    constexpr double right_angle = 90;
    const SpaceContour* worst = nullptr;
    double worst_angle = -1;
    for (const std::size_t i : off) {
      const Vec3 area = area_vector(contours_[i]);
      const double sine = length(cross(area, axes.normal));
      const double angle =
          std::atan2(sine, std::abs(dot(area, axes.normal))) * right_angle / std::acos(0.0);
      if (angle <= worst_angle) continue;
      worst_angle = angle;
      worst = &contours_[i];
    }
    problems_.add(std::string(name_) + ": planes are not parallel: " + std::to_string(off.size()) +
                  " of " + std::to_string(contours_.size()) + " contours; " + worst->source +
                  " most, by " + short_number(worst_angle) +
                  " degrees; export structures of parallel planes only, one file each");
  }

  template <class Project>
  void slice(const Heights& heights, Project project) {
    std::size_t merged = 0;
    double widest = 0;
    for (const auto& plane : heights.planes()) {
      Slice slice{heights.most_frequent(plane), {}};
      if (heights.spread(plane) > 0 && !keep_places_) ++merged;
      widest = std::max(widest, heights.spread(plane));
      std::vector<std::size_t> in_order = plane;
      std::ranges::sort(in_order);
      for (const std::size_t i : in_order) slice.contours.push_back(flat(contours_[i], project));
      stack_.slices.push_back(std::move(slice));
    }
    if (merged > 0)
      stack_.notes.push_back("planes that differ by up to " + short_number(widest) +
                             " were taken as one in " + std::to_string(merged) + " slices");
    if (uneven_ > 0)
      stack_.notes.push_back(std::to_string(uneven_) +
                             " contours are a little off their planes; they were moved there");
  }

  template <class Project>
  Contour flat(SpaceContour& contour, Project project) {
    Contour result;
    result.points.reserve(contour.points.size());
    for (const Vec3& point : contour.points) result.points.push_back(project(point));
    result.label = std::move(contour.label);
    result.source = std::move(contour.source);
    if (keep_places_) result.places = std::move(contour.points);
    contour.points = {};  // so much less memory in use
    return result;
  }

  std::vector<SpaceContour> contours_;
  std::string_view name_;
  Stack& stack_;
  Problems& problems_;
  double largest_extent_ = 0;
  std::size_t uneven_ = 0;
  bool keep_places_ = false;
};

}  // namespace

void into_slices(std::vector<SpaceContour>&& contours, std::string_view name, Stack& stack,
                 Problems& problems) {
  if (contours.empty()) return;
  Planes planes(std::move(contours), name, stack, problems);
  if (!planes.are_along(2) && !planes.are_along(0) && !planes.are_along(1)) planes.tilt();
}

}  // namespace loft::io
