// SPDX-License-Identifier: MIT
#include "app/server/shown_label.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "io/meshes/label_colour.h"

namespace loft::app {

namespace {

/// A linear share as screens have it (IEC 61966-2-1), in two hexadecimal digits.
std::string hexadecimal(double share) {
  const double curved =
      share <= 0.0031308 ? 12.92 * share : 1.055 * std::pow(share, 1 / 2.4) - 0.055;
  const auto value = static_cast<unsigned>(std::lround(255 * std::clamp(curved, 0.0, 1.0)));
  constexpr std::string_view digits = "0123456789abcdef";
  return {digits[value / 16], digits[value % 16]};
}

std::string colour_of(const std::string& label) {
  std::string text = "#";
  for (const double share : io::label_colour(label)) text += hexadecimal(share);
  return text;
}

Json one_to_json(const ShownLabel& label) {
  return {{"label", label.label},   {"colour", colour_of(label.label)}, {"is_skin", label.is_skin},
          {"slices", label.slices}, {"volume", label.volume},           {"area", label.area},
          {"faces", label.faces}};
}

}  // namespace

Json to_json(std::span<const ShownLabel> labels) {
  Json all = Json::array();
  for (const ShownLabel& label : labels) all.push_back(one_to_json(label));
  return {{"labels", std::move(all)}};
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [i, j, k] : mesh.faces) {
    const Vec3& a = mesh.points[i];
    const Vec3& b = mesh.points[j];
    const Vec3& c = mesh.points[k];
    const Vec3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Vec3 v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    sum +=
        std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  }
  return sum / 2;
}

}  // namespace loft::app
