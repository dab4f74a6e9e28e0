// SPDX-License-Identifier: MIT
#include "fields/patch.h"

#include <algorithm>
#include <cmath>

namespace loft::fields {

namespace {

/// Of a triangle's three edges, the one from the smallest corner.
EdgeId first_edge(const Triangulation& mesh, TriangleId t) {
  EdgeId first = Triangulation::edge(t);
  for (unsigned corner = 1; corner < 3; ++corner)
    if (const EdgeId e = Triangulation::edge(t, corner);
        mesh.point(mesh.from(e)) < mesh.point(mesh.from(first)))
      first = e;
  return first;
}

}  // namespace

Patch::Patch(const Field& field, TriangleId t, Smoothness smoothness) {
  const Triangulation& mesh = field.mesh();
  EdgeId e = first_edge(mesh, t);
  for (unsigned i = 0; i < 3; ++i, e = Triangulation::next(e)) {
    corners_[i] = mesh.point(mesh.from(e));
    values_[i] = field.corner_value(e);
  }
  area_ = cross(way(corners_[0], corners_[1]), way(corners_[0], corners_[2]));
  if (smoothness == Smoothness::cubic && has_values()) bend(field, t);
}

bool Patch::has_values() const {
  return std::none_of(values_.begin(), values_.end(), [](double z) { return z != z; });
}

Patch::Weights Patch::weights(Point p) const {
  const Vector d = way(corners_[0], p);
  const double second = cross(d, way(corners_[0], corners_[2])) / area_;
  const double third = cross(way(corners_[0], corners_[1]), d) / area_;
  return {1 - second - third, second, third};
}

double Patch::value(Point p) const {
  const Weights w = weights(p);
  if (is_bent_) return bent_value(w);
  const auto [least, most] = std::minmax({values_[0], values_[1], values_[2]});
  const double z = values_[0] + w[1] * (values_[1] - values_[0]) + w[2] * (values_[2] - values_[0]);
  return std::clamp(z, least, most);
}

Vector Patch::gradient(Point p) const {
  return gradient_of(is_bent_ ? bent_slopes(weights(p)) : values_);
}

/// From how a value changes with each weight, the others left alone.
Vector Patch::gradient_of(const std::array<double, 3>& slopes) const {
  const Vector b = way(corners_[0], corners_[1]);
  const Vector c = way(corners_[0], corners_[2]);
  const double rise_b = slopes[1] - slopes[0];
  const double rise_c = slopes[2] - slopes[0];
  return {(rise_b * c.y - rise_c * b.y) / area_, (rise_c * b.x - rise_b * c.x) / area_};
}

/// The control points: at each corner in the plane of its gradient, beside each edge so that the
/// slope across it is linear, and inside so that the three polynomials meet smoothly.
void Patch::bend(const Field& field, TriangleId t) {
  is_bent_ = true;
  EdgeId e = first_edge(field.mesh(), t);
  for (unsigned i = 0; i < 3; ++i, e = Triangulation::next(e))
    gradients_[i] = field.corner_gradient(e);

  const Point middle = centroid(corners_[0], corners_[1], corners_[2]);
  std::array<double, 3> inward{};  // on the way from a corner to the middle
  for (unsigned i = 0; i < 3; ++i)
    inward[i] = values_[i] + dot(gradients_[i], way(corners_[i], middle)) / 3;
  for (unsigned i = 0; i < 3; ++i) {
    const unsigned j = (i + 1) % 3;
    const Vector along = way(corners_[i], corners_[j]);
    const double foot = dot(way(corners_[i], middle), along) / dot(along, along);
    const Vector across = way(corners_[i], middle) + -foot * along;
    Third& third = thirds_[i];
    third.iii = values_[i];
    third.jjj = values_[j];
    third.iij = values_[i] + dot(gradients_[i], along) / 3;
    third.ijj = values_[j] - dot(gradients_[j], along) / 3;
    third.iim = inward[i];
    third.jjm = inward[j];
    third.ijm =
        dot(gradients_[i] + gradients_[j], across) / 6 + (1 - foot) * third.iij + foot * third.ijj;
  }
  std::array<double, 3> halfway{};
  for (unsigned i = 0; i < 3; ++i)
    halfway[i] = (inward[i] + thirds_[i].ijm + thirds_[(i + 2) % 3].ijm) / 3;
  for (unsigned i = 0; i < 3; ++i) {
    thirds_[i].imm = halfway[i];
    thirds_[i].jmm = halfway[(i + 1) % 3];
    thirds_[i].mmm = (halfway[0] + halfway[1] + halfway[2]) / 3;
  }

  for (unsigned i = 0; i < 3; ++i, e = Triangulation::next(e))
    if (field.is_crease(e) && !field.is_separating(e)) add_bumps(field, e, i);
}

/// On a feature the slope at an end is the mean of what both sides have.
void Patch::add_bumps(const Field& field, EdgeId e, unsigned corner) {
  const unsigned next = (corner + 1) % 3;
  const Vector along = way(corners_[corner], corners_[next]);
  const EdgeId twin = field.mesh().twin(e);
  const Vector beyond_start = field.corner_gradient(Triangulation::next(twin));
  const Vector beyond_end = field.corner_gradient(twin);
  bumps_[bump_count_++] = {dot(beyond_start + -1 * gradients_[corner], along) / 2, corner, next};
  bumps_[bump_count_++] = {-dot(beyond_end + -1 * gradients_[next], along) / 2, next, corner};
}

double Patch::bent_value(const Weights& w) const {
  // The third that the smallest weight is opposite to.
  const auto least = static_cast<unsigned>(std::min_element(w.begin(), w.end()) - w.begin());
  const unsigned i = (least + 1) % 3;
  const Third& b = thirds_[i];
  const double u = w[i] - w[least];
  const double v = w[(i + 1) % 3] - w[least];
  const double m = 3 * w[least];
  double z = u * u * (u * b.iii + 3 * (v * b.iij + m * b.iim)) +
             v * v * (v * b.jjj + 3 * (u * b.ijj + m * b.jjm)) +
             m * m * (m * b.mmm + 3 * (u * b.imm + v * b.jmm)) + 6 * u * v * m * b.ijm;
  for (unsigned k = 0; k < bump_count_; ++k) {
    const Bump& bump = bumps_[k];
    const double first = w[bump.first];
    const double second = w[bump.second];
    const double rest = 1 - first;
    if (rest > 0) z += bump.height * first * first * second * second / rest;
  }
  return z;
}

std::array<double, 3> Patch::bent_slopes(const Weights& w) const {
  const auto least = static_cast<unsigned>(std::min_element(w.begin(), w.end()) - w.begin());
  const unsigned i = (least + 1) % 3;
  const unsigned j = (i + 1) % 3;
  const Third& b = thirds_[i];
  const double u = w[i] - w[least];
  const double v = w[j] - w[least];
  const double m = 3 * w[least];
  const double by_u = 3 * (u * u * b.iii + v * v * b.ijj + m * m * b.imm +
                           2 * (u * v * b.iij + v * m * b.ijm + u * m * b.iim));
  const double by_v = 3 * (u * u * b.iij + v * v * b.jjj + m * m * b.jmm +
                           2 * (u * v * b.ijj + v * m * b.jjm + u * m * b.ijm));
  const double by_m = 3 * (u * u * b.iim + v * v * b.jjm + m * m * b.mmm +
                           2 * (u * v * b.ijm + v * m * b.jmm + u * m * b.imm));
  std::array<double, 3> slopes{};
  slopes[i] = by_u;
  slopes[j] = by_v;
  slopes[least] = 3 * by_m - by_u - by_v;
  for (unsigned k = 0; k < bump_count_; ++k) {
    const Bump& bump = bumps_[k];
    const double first = w[bump.first];
    const double second = w[bump.second];
    const double rest = 1 - first;
    if (!(rest > 0)) continue;
    const double square = bump.height * second * second / rest;
    slopes[bump.first] += square * first * (2 + first / rest);
    slopes[bump.second] += 2 * bump.height * first * first * second / rest;
  }
  return slopes;
}

}  // namespace loft::fields
