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

constexpr double a_third = 1.0 / 3;
constexpr double a_sixth = 1.0 / 6;

/// Which of three is the least; of equal ones, the first.
unsigned least_of(const std::array<double, 3>& w) {
  const unsigned least = w[1] < w[0] ? 1 : 0;
  return w[2] < w[least] ? 2 : least;
}

constexpr std::array<unsigned, 3> following{1, 2, 0};

}  // namespace

Patch::Patch(const Field& field, TriangleId t, Smoothness smoothness) {
  const Triangulation& mesh = field.mesh();
  first_ = first_edge(mesh, t);
  EdgeId e = first_;
  for (unsigned i = 0; i < 3; ++i, e = Triangulation::next(e)) {
    corners_[i] = mesh.point(mesh.from(e));
    values_[i] = field.corner_value(e);
    has_values_ = has_values_ && values_[i] == values_[i];
  }
  inverse_area_ = 1 / cross(way(corners_[0], corners_[1]), way(corners_[0], corners_[2]));
  if (smoothness == Smoothness::cubic && has_values_) bend(field);
}

Patch::Weights Patch::weights(Point p) const {
  const Vector d = way(corners_[0], p);
  const double second = cross(d, way(corners_[0], corners_[2])) * inverse_area_;
  const double third = cross(way(corners_[0], corners_[1]), d) * inverse_area_;
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
  return {(rise_b * c.y - rise_c * b.y) * inverse_area_,
          (rise_c * b.x - rise_b * c.x) * inverse_area_};
}

/// The control points: at each corner in the plane of its gradient, beside each edge so that the
/// slope across it is linear, and inside so that the three polynomials meet smoothly.
void Patch::bend(const Field& field) {
  is_bent_ = true;
  Gradients gradients;
  EdgeId e = first_;
  for (unsigned i = 0; i < 3; ++i, e = Triangulation::next(e))
    gradients[i] = field.corner_gradient(e);

  const Point middle = centroid(corners_[0], corners_[1], corners_[2]);
  std::array<double, 3> inward{};  // on the way from a corner to the middle
  for (unsigned i = 0; i < 3; ++i)
    inward[i] = values_[i] + dot(gradients[i], way(corners_[i], middle)) * a_third;
  for (unsigned i = 0; i < 3; ++i) {
    const unsigned j = following[i];
    const Vector along = way(corners_[i], corners_[j]);
    const double foot = dot(way(corners_[i], middle), along) / dot(along, along);
    const Vector across = way(corners_[i], middle) + -foot * along;
    Third& third = thirds_[i];
    third.iii = values_[i];
    third.jjj = values_[j];
    third.iij = values_[i] + dot(gradients[i], along) * a_third;
    third.ijj = values_[j] - dot(gradients[j], along) * a_third;
    third.iim = inward[i];
    third.jjm = inward[j];
    third.ijm = dot(gradients[i] + gradients[j], across) * a_sixth + (1 - foot) * third.iij +
                foot * third.ijj;
  }
  std::array<double, 3> halfway{};
  for (unsigned i = 0; i < 3; ++i)
    halfway[i] = (inward[i] + thirds_[i].ijm + thirds_[following[following[i]]].ijm) * a_third;
  for (unsigned i = 0; i < 3; ++i) {
    thirds_[i].imm = halfway[i];
    thirds_[i].jmm = halfway[following[i]];
    thirds_[i].mmm = (halfway[0] + halfway[1] + halfway[2]) * a_third;
  }

  for (unsigned i = 0; i < 3; ++i, e = Triangulation::next(e))
    if (field.is_crease(e) && !field.is_separating(e)) add_bumps(field, e, i, gradients);
}

/// On a feature the slope at an end is the mean of what both sides have.
void Patch::add_bumps(const Field& field, EdgeId e, unsigned corner, const Gradients& gradients) {
  const unsigned next = following[corner];
  const Vector along = way(corners_[corner], corners_[next]);
  const EdgeId twin = field.mesh().twin(e);
  const Vector beyond_start = field.corner_gradient(Triangulation::next(twin));
  const Vector beyond_end = field.corner_gradient(twin);
  bumps_[bump_count_++] = {dot(beyond_start + -1 * gradients[corner], along) / 2, corner, next};
  bumps_[bump_count_++] = {-dot(beyond_end + -1 * gradients[next], along) / 2, next, corner};
}

double Patch::bent_value(const Weights& w) const {
  // The third that the smallest weight is opposite to.
  const unsigned least = least_of(w);
  const unsigned i = following[least];
  const Third& b = thirds_[i];
  const double u = w[i] - w[least];
  const double v = w[following[i]] - w[least];
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
  const unsigned least = least_of(w);
  const unsigned i = following[least];
  const unsigned j = following[i];
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
