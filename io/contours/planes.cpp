// SPDX-License-Identifier: MIT
#include "io/contours/planes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "io/bytes/text.h"
#include "io/contours/stack_builder.h"
#include "mesh/vec3.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

/// Of length 1, its largest part positive. Precondition: finite, not 0.
Vec3 unit(const Vec3& v) {
  double largest = 0;
  for (const double part : v)
    if (std::abs(part) > std::abs(largest)) largest = part;
  Vec3 result{v[0] / largest, v[1] / largest, v[2] / largest};
  const double length = std::sqrt(dot(result, result));
  for (double& part : result) part /= length;
  return result;
}

/// Where a plane is along its unit() by its offset, but for the sign of that.
double height(const ContourPlane& plane) {
  const double length = std::hypot(plane.normal[0], plane.normal[1], plane.normal[2]);
  return (dot(unit(plane.normal), plane.normal) < 0 ? -1 : 1) * plane.offset / length;
}

/// In degrees.
double angle_between(const ContourPlane& one, const ContourPlane& other) {
  const Vec3 a = unit(one.normal);
  const Vec3 b = unit(other.normal);
  const Vec3 normal = cross(a, b);
  return std::atan2(std::sqrt(dot(normal, normal)), std::abs(dot(a, b))) * 180 / std::numbers::pi;
}

constexpr double parallel = 0.01;  // degrees: normals are written with few digits

/// The planes that are not parallel to one of them.
std::vector<std::size_t> turned_against(const ContourPlane& one,
                                        const std::vector<ContourPlane>& planes) {
  std::vector<std::size_t> turned;
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (angle_between(one, planes[i]) > parallel) turned.push_back(i);
  return turned;
}

/// Throws InputError where the planes are not parallel, with those that are not to most.
void require_parallel(const std::vector<ContourPlane>& planes, std::string_view name) {
  constexpr std::size_t tries = 64;
  std::vector<std::size_t> turned = turned_against(planes.front(), planes);
  if (turned.empty()) return;
  std::size_t straight = 0;
  const std::size_t step = (planes.size() + tries - 1) / tries;
  for (std::size_t i = step; i < planes.size(); i += step) {
    std::vector<std::size_t> others = turned_against(planes[i], planes);
    if (others.size() >= turned.size()) continue;
    turned = std::move(others);
    straight = i;
  }
  const auto angle = [&](std::size_t i) { return angle_between(planes[straight], planes[i]); };
  const std::size_t worst = *std::ranges::max_element(turned, {}, angle);
  throw InputError(
      std::string(name) + ": its planes are not parallel: " + std::to_string(turned.size()) +
      " of " + std::to_string(planes.size()) + "; plane " + std::to_string(worst + 1) +
      " most, by " + short_number(angle(worst)) + " degrees against plane " +
      std::to_string(straight + 1) + "; a stack has parallel slices: keep those of one direction");
}

/// Columns are the axes of the slices: x, y, and the normal.
WorldFrame find_frame(const Vec3& normal) {
  WorldFrame frame;
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
  Vec3 x{};
  x[(axis + 1) % 3] = 1;
  Vec3 y{};
  y[(axis + 2) % 3] = 1;
  Vec3 z{};
  z[axis] = 1;
  if (normal != z) {
    z = normal;
    x = unit(cross(y, z));
    y = cross(z, x);
  }
  for (std::size_t i = 0; i < 3; ++i) frame.rows[i] = {x[i], y[i], z[i], 0};
  return frame;
}

class Planes {
 public:
  Planes(const std::vector<ContourPlane>& planes, std::string_view name)
      : builder_(name), frame_(find_frame(unit(planes.front().normal))) {
    for (const auto& row : frame_.rows)
      for (const double part : row) is_turned_ = is_turned_ || (part != 0 && part != 1);
    for (const ContourPlane& plane : planes)
      for (const PlaneContour& contour : plane.contours) materials_.insert(contour.material);
  }

  /// A slice for each plane that has no contours.
  void add_empty(const std::vector<ContourPlane>& planes) {
    double wrong_as_it_is = 0;
    double wrong_if_turned = 0;
    for (const ContourPlane& plane : planes)
      for (const PlaneContour& contour : plane.contours) {
        if (contour.points.empty()) continue;
        const double z = along(2, contour.points.front());
        wrong_as_it_is += std::abs(height(plane) - z);
        wrong_if_turned += std::abs(-height(plane) - z);
      }
    for (const ContourPlane& plane : planes)
      if (plane.contours.empty())
        builder_.add_height(wrong_if_turned < wrong_as_it_is ? -height(plane) : height(plane));
  }

  void add(const PlaneContour& from) {
    Contour contour{{}, label(from.material), from.source};
    double lowest = 0;
    double highest = 0;
    for (const Vec3& point : from.points) {
      const double z = along(2, point);
      lowest = contour.points.empty() ? z : std::min(lowest, z);
      highest = contour.points.empty() ? z : std::max(highest, z);
      contour.points.push_back({along(0, point), along(1, point)});
      if (is_turned_) contour.places.push_back(point);
    }
    builder_.add(std::move(contour), lowest, highest);
  }

  Stack finish(std::size_t open_lines) {
    Stack stack;
    if (!frame_.is_identity()) stack.frame = frame_;
    stack.fill = Fill::even_odd;
    if (materials_.size() > 1)
      for (const std::size_t material : materials_)
        stack.labels.push_back({label(material), {}, std::to_string(material), "", {}});
    builder_.skip("", "open line", open_lines);
    builder_.finish(stack, "contours are closed, and lie in their planes");
    return stack;
  }

 private:
  [[nodiscard]] std::string label(std::size_t material) const {
    return materials_.size() < 2 ? "" : "material " + std::to_string(material);
  }
  /// The part of a point along an axis of the slices; exact where that is an axis of space.
  [[nodiscard]] double along(std::size_t axis, const Vec3& point) const {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (frame_.rows[i][axis] == 1) return point[i];
    for (std::size_t i = 0; i < 3; ++i) sum += frame_.rows[i][axis] * point[i];
    return sum;
  }

  StackBuilder builder_;
  WorldFrame frame_;
  bool is_turned_ = false;
  std::set<std::size_t> materials_;
};

}  // namespace

Stack stack_of_planes(std::vector<ContourPlane> planes, std::size_t open_lines,
                      std::string_view name) {
  if (planes.empty()) throw InputError(std::string(name) + ": no plane in it");
  require_parallel(planes, name);
  Planes result(planes, name);
  result.add_empty(planes);
  for (const ContourPlane& plane : planes)
    for (const PlaneContour& contour : plane.contours) result.add(contour);
  return result.finish(open_lines);
}

}  // namespace loft::io
