// SPDX-License-Identifier: MIT
// Small PNGs, written byte by byte.
#pragma once

#include <zlib.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/io/bytes/gzipped.h"
#include "tests/io/stacks/readers.h"

namespace loft::io::testing {

struct MadePng {
  std::uint32_t columns = 3;
  std::uint32_t rows = 2;
  unsigned depth = 8;
  unsigned kind = 0;           ///< 0: grey, 2: RGB, 3: palette, 4: grey and alpha, 6: RGBA
  std::vector<int> samples{};  ///< row by row, those of a pixel side by side
  std::string palette{};
  std::string clear{};
  std::uint32_t per_metre = 0;  ///< pixels; 0: it does not say
  bool is_interlaced = false;

  [[nodiscard]] std::string bytes() const {
    std::string head;
    number(head, columns);
    number(head, rows);
    head += static_cast<char>(depth);
    head += static_cast<char>(kind);
    head += std::string(2, '\0') + (is_interlaced ? '\1' : '\0');
    std::string file = "\x89PNG\r\n\x1a\n" + chunk("IHDR", head);
    if (!palette.empty()) file += chunk("PLTE", palette);
    if (!clear.empty()) file += chunk("tRNS", clear);
    if (per_metre != 0) {
      std::string place;
      number(place, per_metre);
      number(place, per_metre);
      file += chunk("pHYs", place + '\1');
    }
    return file + chunk("IDAT", packed()) + chunk("IEND", "");
  }

 private:
  static void number(std::string& bytes, std::uint32_t value) {
    append(bytes, value, std::endian::big);
  }

  static std::string chunk(const std::string& name, const std::string& content) {
    std::string result;
    number(result, static_cast<std::uint32_t>(content.size()));
    const std::string checked = name + content;
    result += checked;
    number(result,
           static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(checked.data()),
                                            static_cast<uInt>(checked.size()))));
    return result;
  }

  [[nodiscard]] std::size_t channels() const {
    constexpr std::array<std::size_t, 7> of_kind{1, 0, 3, 1, 2, 0, 4};
    return of_kind[kind];
  }

  /// Each step-th pixel of each step-th row, from the first on, without a filter.
  void add_rows(std::string& bytes, std::size_t left, std::size_t top, std::size_t step_x,
                std::size_t step_y) const {
    if (left >= columns) return;
    for (std::size_t y = top; y < rows; y += step_y) {
      bytes += '\0';
      std::string row;
      unsigned bits = 0;
      for (std::size_t x = left; x < columns; x += step_x) {
        for (std::size_t c = 0; c < channels(); ++c, bits += depth)
          add_sample(row, bits, static_cast<unsigned>(samples[(y * columns + x) * channels() + c]));
      }
      bytes += row;
    }
  }

  void add_sample(std::string& row, unsigned bit, unsigned sample) const {
    if (depth == 16) row += static_cast<char>(sample >> 8);
    if (bit % 8 == 0) row += '\0';
    const unsigned shift = depth < 8 ? 8 - depth - bit % 8 : 0;
    row.back() =
        static_cast<char>(static_cast<unsigned char>(row.back()) | (sample << shift & 255));
  }

  [[nodiscard]] std::string packed() const {
    std::string plain;
    if (is_interlaced) {
      constexpr std::array<std::array<std::size_t, 4>, 7> passes{{{0, 0, 8, 8},
                                                                  {4, 0, 8, 8},
                                                                  {0, 4, 4, 8},
                                                                  {2, 0, 4, 4},
                                                                  {0, 2, 2, 4},
                                                                  {1, 0, 2, 2},
                                                                  {0, 1, 1, 2}}};
      for (const auto& [left, top, step_x, step_y] : passes)
        add_rows(plain, left, top, step_x, step_y);
    } else {
      add_rows(plain, 0, 0, 1, 1);
    }
    return deflated(plain);
  }
};

}  // namespace loft::io::testing
