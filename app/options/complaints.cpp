// SPDX-License-Identifier: MIT
#include "app/options/complaints.h"

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <system_error>

#include "io/unit.h"
#include "mesh/admitted.h"

namespace loft::app {

std::string complain_of_unit(const std::string& unit) {
  if (io::metres_per_unit(unit)) return {};
  return "'" + unit + "' is no unit; known are " + std::string(io::unit_names);
}

std::string complain_of_length(const std::string& text) {
  double length = 0;
  if (CLI::detail::lexical_cast(text, length) && length > 0 && admitted::length.admits(length))
    return {};
  return "'" + text + "' is no length; give a number from 1e-30 to 1e70, in the unit of the input";
}

std::string complain_of_rate(const std::string& text) {
  double rate = 0;
  if (CLI::detail::lexical_cast(text, rate) && rate >= 0.001 && rate <= 1000) return {};
  return "'" + text + "' is no rate; give a number from 0.001 to 1000, edits a second";
}

namespace {

/// So many numbers with commas between them.
template <std::size_t Count>
std::optional<std::array<double, Count>> numbers_in(const std::string& text) {
  std::array<double, Count> numbers{};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < Count; ++i) {
    const std::size_t end = i + 1 < Count ? text.find(',', begin) : text.size();
    if (end == std::string::npos) return {};
    if (!CLI::detail::lexical_cast(text.substr(begin, end - begin), numbers[i])) return {};
    begin = end + 1;
  }
  return numbers;
}

}  // namespace

std::optional<SlabChoice> slab_choice(const std::string& text) {
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos || text == "..") return {};
  const auto number = [](std::string_view digits) -> std::optional<std::size_t> {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool is_whole = error == std::errc() && end == digits.data() + digits.size();
    return is_whole ? std::optional(value) : std::nullopt;
  };
  const std::string low = text.substr(0, dots);
  const std::string high = text.substr(dots + 2);
  const auto first = low.empty() ? std::optional<std::size_t>(0) : number(low);
  const auto bound = number(high);
  if (!first || (!bound && !high.empty()) || (bound && *bound <= *first)) return {};
  return SlabChoice{*first, bound};
}

std::string complain_of_slabs(const std::string& text) {
  if (slab_choice(text)) return {};
  return "'" + text +
         "' is no range of slabs; give A..B, A.. or ..B, from the slice A up to the slice B, "
         "counted by height from 0 (the list of slabs in the report is --list-slabs)";
}

std::optional<Vec3> spacing(const std::string& text) {
  const auto lengths = numbers_in<3>(text);
  if (!lengths) return {};
  for (const double length : *lengths)
    if (!(length > 0) || !admitted::length.admits_length(length)) return {};
  return lengths;
}

std::optional<Vec3> direction(const std::string& text) {
  const auto numbers = numbers_in<3>(text);
  if (!numbers || *numbers == Vec3{}) return {};
  for (const double number : *numbers)
    if (!admitted::length.admits(number)) return {};
  return numbers;
}

std::optional<cdt::Point> place(const std::string& text) {
  const auto numbers = numbers_in<2>(text);
  if (!numbers) return {};
  const auto [x, y] = *numbers;
  if (!admitted::planar.admits(x) || !admitted::planar.admits(y)) return {};
  return cdt::Point{x, y};
}

std::optional<GridSize> grid_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) return {};
  GridSize size;
  const auto read = [](std::string_view digits, std::size_t& number) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return error == std::errc() && end == digits.data() + digits.size() && number > 0;
  };
  const std::string_view all = text;
  if (!read(all.substr(0, cross), size.columns) || !read(all.substr(cross + 1), size.rows))
    return {};
  return size;
}

std::string complain_of_grid_size(const std::string& text) {
  if (grid_size(text)) return {};
  return "'" + text + "' is no size; give columns and rows as 1000x800";
}

std::string complain_of_value(const std::string& text) {
  double value = 0;
  if (CLI::detail::lexical_cast(text, value) && std::isfinite(value)) return {};
  return "'" + text + "' is no number";
}

std::string complain_of_place(const std::string& text) {
  if (place(text)) return {};
  return "'" + text + "' is no place; give two numbers X,Y, each 0 or from 1e-50 to 1e75";
}

std::string complain_of_direction(const std::string& text) {
  if (direction(text)) return {};
  return "'" + text + "' is no direction; give three numbers X,Y,Z, not all 0";
}

std::string complain_of_spacing(const std::string& text) {
  if (spacing(text)) return {};
  return "'" + text + "' is no spacing; give three lengths X,Y,Z, for example 0.5,0.5,3";
}

std::string complain_of_distance(const std::string& text) {
  double distance = 0;
  if (CLI::detail::lexical_cast(text, distance) && admitted::length.admits_length(distance))
    return {};
  return "'" + text +
         "' is no distance; give 0 or a number from 1e-30 to 1e70, in the unit of the input";
}

std::string complain_of_epsilon(const std::string& text) {
  double epsilon = 0;
  if (CLI::detail::lexical_cast(text, epsilon) && admitted::planar.admits_length(epsilon))
    return {};
  return "'" + text + "' is no distance; give 0 or a number from 1e-50 to 1e75";
}

}  // namespace loft::app
