// SPDX-License-Identifier: MIT
#include "io/planar/ascii_grid.h"

#include <algorithm>
#include <ostream>
#include <span>
#include <string>

#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

/// A number that stands for none: -9999, unless that is a value.
double mark_of_none(const fields::Field& field, const fields::Grid& grid,
                    fields::Smoothness smoothness) {
  constexpr double usual = -9999;
  double least = 0;
  bool is_taken = false;
  fields::rasterize(field, grid, smoothness, [&](std::size_t, std::span<const double> values) {
    for (const double value : values) {
      if (value < least) least = value;
      is_taken = is_taken || value == usual;
    }
  });
  return is_taken ? 2 * least : usual;
}

}  // namespace

void write_ascii_grid(std::ostream& out, const fields::Field& field, const fields::Grid& grid,
                      fields::Smoothness smoothness) {
  const double none = mark_of_none(field, grid, smoothness);
  std::string text =
      "ncols " + std::to_string(grid.columns) + "\nnrows " + std::to_string(grid.rows);
  const auto line = [&](const char* key, double number) {
    text += key;
    append_number(text, number);
  };
  line("\nxllcenter ", grid.first.x);
  line("\nyllcenter ", grid.place(grid.rows - 1, 0).y);
  line("\ncellsize ", grid.step_x);
  line("\nNODATA_value ", none);
  text += '\n';
  out << text;
  fields::rasterize(field, grid, smoothness, [&](std::size_t, std::span<const double> values) {
    text.clear();
    for (const double value : values) {
      if (!text.empty()) text += ' ';
      append_number(text, value == value ? value : none);
    }
    out << text << '\n';
  });
}

}  // namespace loft::io
