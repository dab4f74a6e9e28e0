// SPDX-License-Identifier: MIT
#include "app/report.h"

#include <cmath>
#include <optional>
#include <set>
#include <sstream>

namespace loft::app {

StackSize size_of(const std::vector<Slice>& stack) {
  StackSize size;
  for (const Slice& slice : stack) {
    if (!slice.contours.empty()) ++size.slices;
    size.contours += slice.contours.size();
    for (const Contour& contour : slice.contours) size.vertices += contour.points.size();
  }
  return size;
}

void add_sizes(std::map<std::string, StackSize>& of_labels, const Slice& slice) {
  std::set<std::string_view> seen;
  for (const Contour& contour : slice.contours) {
    StackSize& size = of_labels[contour.label];
    if (seen.insert(contour.label).second) ++size.slices;
    ++size.contours;
    size.vertices += contour.points.size();
  }
}

StackSize size_of(const std::vector<Slice>& stack, std::span<const ContourId> contours) {
  StackSize size;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    ++size.contours;
    size.vertices += stack[contours[i].slice].contours[contours[i].contour].points.size();
    if (i == 0 || contours[i].slice != contours[i - 1].slice) ++size.slices;
  }
  return size;
}

std::string grouped(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t place = digits.size(); place > 3; place -= 3) digits.insert(place - 3, 1, ',');
  return digits;
}

std::string counted(std::size_t number, const std::string& what) {
  return grouped(number) + ' ' + what + (number == 1 ? "" : "s");
}

std::string rounded(double number) {
  if (!std::isfinite(number)) return "out of range";
  std::ostringstream text;
  text.precision(4);
  text << number;
  return text.str();
}

std::string describe(const Angles& angles) {
  return "smallest angles: least " + rounded(angles.smallest) + ", 5th percentile " +
         rounded(angles.fifth_percentile) + ", median " + rounded(angles.median) +
         " degrees; worst aspect " + rounded(angles.worst_aspect);
}

std::string unit_word(std::string_view unit) {
  const bool is_name = !unit.empty() && unit.find_first_of("0123456789.") == std::string_view::npos;
  return is_name ? std::string(unit) : "unit";
}

std::string describe(const Measures& measures, std::string_view unit) {
  return grouped(measures.faces) + " triangles, " + grouped(measures.vertices) + " vertices, " +
         grouped(measures.components) +
         (measures.components == 1 ? " component, genus " : " components, genus ") +
         std::to_string(measures.genus) + ", area " + rounded(measures.area) + ' ' +
         unit_word(unit) + "^2, volume " + rounded(measures.volume) + ' ' + unit_word(unit) + "^3";
}

}  // namespace loft::app
