// SPDX-License-Identifier: MIT
#include "reconstruct/stack.h"

#include <algorithm>
#include <cmath>

#include "mesh/admitted.h"

namespace loft {

Vec3 WorldFrame::at(const Vec3& place) const {
  Vec3 result{};
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = rows[i][0] * place[0] + rows[i][1] * place[1] + rows[i][2] * place[2] + rows[i][3];
  return result;
}

double WorldFrame::determinant() const {
  const auto& [a, b, c, last] = rows;
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

std::string fault(const WorldFrame& frame) {
  for (const auto& row : frame.rows)
    for (const double number : row)
      if (!admitted::slice.admits(number))
        return "a number that is not finite, or of no usable size";
  if (frame.rows[3] != std::array<double, 4>{0, 0, 0, 1}) return "its last row must be 0 0 0 1";
  double volume = 1;  // that upright axes of these lengths would have
  for (std::size_t column = 0; column < 3; ++column)
    volume *= std::hypot(frame.rows[0][column], frame.rows[1][column], frame.rows[2][column]);
  constexpr double flattest = 1e-6;
  if (std::abs(frame.determinant()) <= flattest * volume) return "its axes lie in one plane";
  if (frame.determinant() < 0) return "it is a mirror image; turn the sign of one axis";
  return {};
}

const StackLabel* find(std::span<const StackLabel> labels, std::string_view name) {
  const auto found = std::ranges::find(labels, name, &StackLabel::name);
  return found == labels.end() ? nullptr : &*found;
}

const StackLabel* Stack::find_label(std::string_view name) const { return find(labels, name); }

}  // namespace loft
