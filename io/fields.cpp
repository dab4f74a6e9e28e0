// SPDX-License-Identifier: MIT
#include "io/fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string_view>

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/bytes/format_table.h"
#include "io/images/png_write.h"
#include "io/planar/ascii_grid.h"
#include "io/planar/field_ply.h"
#include "io/planar/palette.h"

namespace loft::io {

namespace {

struct FieldLineFormat {
  std::string_view extension;
};
constexpr std::array field_line_formats{FieldLineFormat{".geojson"}, FieldLineFormat{".json"}};

struct FieldFormat {
  std::string_view extension;
  void (*write)(std::ostream& out, const FieldOutput& output);
  bool needs_grid = false;
};

const fields::Grid& grid_of(const FieldOutput& output) {
  if (!output.grid) throw std::invalid_argument("a grid of values without a grid");
  return *output.grid;
}

void write_grid(std::ostream& out, const FieldOutput& output) {
  write_ascii_grid(out, *output.picture.field, grid_of(output), output.smoothness);
}

void write_surface(std::ostream& out, const FieldOutput& output) {
  write_field_ply(out, *output.picture.field);
}

void write_drawing(std::ostream& out, const FieldOutput& output) {
  write_field_svg(out, output.picture, output.width);
}

/// Each place of the grid is a pixel, clear where there is no value.
void write_pixels(std::ostream& out, const FieldOutput& output) {
  const fields::Grid& grid = grid_of(output);
  const auto for_each_row = [&](auto visit) {
    fields::rasterize(*output.picture.field, grid, output.smoothness, visit);
  };
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for_each_row([&](std::size_t, std::span<const double> values) {
    for (const double value : values) {
      if (value < least) least = value;
      if (value > most) most = value;
    }
  });
  std::vector<std::uint8_t> pixels(4 * grid.columns * grid.rows);
  for_each_row([&](std::size_t row, std::span<const double> values) {
    std::uint8_t* pixel = pixels.data() + 4 * row * grid.columns;
    for (const double value : values) {
      // The whole range may be beyond all numbers.
      const double half = most / 2 - least / 2;
      const Colour colour =
          value_colour(half > 0 && value == value ? (value / 2 - least / 2) / half : 0.5);
      const std::array<std::uint8_t, 4> parts{colour.red, colour.green, colour.blue, 255};
      if (value == value) std::ranges::copy(parts, pixel);
      pixel += 4;
    }
  });
  out << to_png(pixels, grid.columns);
}

constexpr std::array field_formats{
    FieldFormat{".asc", write_grid, true},
    FieldFormat{".ply", write_surface},
    FieldFormat{".png", write_pixels, true},
    FieldFormat{".svg", write_drawing},
};

}  // namespace

std::string field_line_extensions() { return extensions_of(field_line_formats); }
std::string field_output_extensions() { return extensions_of(field_formats); }

std::vector<FieldLine> read_field_lines(const std::filesystem::path& path) {
  if (path == "-") return read_field_lines_geojson(read_standard_input(), standard_input);
  static_cast<void>(format_of(field_line_formats, path));
  return read_field_lines_geojson(read_file(path), path.string());
}

bool needs_grid(const std::filesystem::path& path) {
  const FieldFormat* const format = find_format(field_formats, path);
  return format != nullptr && format->needs_grid;
}

void check_writable_field(const std::filesystem::path& path) {
  const FieldFormat& format = format_of(field_formats, path);
  if (format.write == write_pixels && !writes_png())
    throw FileError(Access::write, path,
                    "this build writes no PNG; install libpng-dev and build loft again");
  const AtomicFile tried(path);
}

void write(const std::filesystem::path& path, const FieldOutput& output) {
  const FieldFormat& format = format_of(field_formats, path);
  AtomicFile file(path);
  format.write(file.stream(), output);
  file.commit();
}

}  // namespace loft::io
