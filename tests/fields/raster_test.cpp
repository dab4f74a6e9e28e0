// SPDX-License-Identifier: MIT
#include "fields/raster.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/fields/edited.h"

namespace loft::fields {
namespace {

TEST(Raster, HasTheValuesOfTheField) {
  for (std::uint64_t seed = 0; seed < fields_to_try(20); ++seed) {
    SCOPED_TRACE(seed);
    Edited edited(seed);
    for (int i = 0; i < 60; ++i) edited.edit();
    const Field& field = edited.field();
    const Grid grid{.first = {-1, 17}, .step_x = 0.25, .step_y = -0.5, .columns = 70, .rows = 37};
    std::size_t rows = 0;
    for (const Smoothness smoothness : smoothnesses)
      rasterize(field, grid, smoothness, [&](std::size_t row, std::span<const double> values) {
        ASSERT_EQ(row, rows++ % grid.rows);
        ASSERT_EQ(values.size(), grid.columns);
        for (std::size_t column = 0; column < grid.columns; ++column) {
          const std::optional<double> value = field.value(grid.place(row, column), smoothness);
          if (value)
            ASSERT_EQ(values[column], *value);
          else
            ASSERT_NE(values[column], values[column]);
        }
      });
    EXPECT_EQ(rows, 2 * grid.rows);
  }
}

TEST(Raster, HasThemAlsoWhereRowsAreClose) {
  for (std::uint64_t seed = 100; seed < 100 + fields_to_try(6); ++seed) {
    SCOPED_TRACE(seed);
    Edited edited(seed);
    for (int i = 0; i < 200; ++i) edited.edit();
    const Field& field = edited.field();
    const Grid grid{
        .first = {-0.51, -0.5}, .step_x = 0.0625, .step_y = 0.03, .columns = 280, .rows = 567};
    for (const Smoothness smoothness : smoothnesses)
      rasterize(field, grid, smoothness, [&](std::size_t row, std::span<const double> values) {
        for (std::size_t column = 0; column < grid.columns; ++column) {
          const std::optional<double> value = field.value(grid.place(row, column), smoothness);
          ASSERT_EQ(value.has_value(), values[column] == values[column]);
          if (value) {
            ASSERT_EQ(values[column], *value);
          }
        }
      });
  }
}

}  // namespace
}  // namespace loft::fields
