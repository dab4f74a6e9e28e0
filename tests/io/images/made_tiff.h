// SPDX-License-Identifier: MIT
// Small TIFFs, written byte by byte.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/io/stacks/readers.h"

namespace loft::io::testing {

struct MadePage {
  std::uint32_t columns = 3;
  std::uint32_t rows = 2;
  std::uint16_t bits = 8;
  std::uint16_t samples = 1;
  std::uint16_t ink = 1;     ///< 0: 0 is white, 1: 0 is black, 2: RGB, 3: palette
  std::uint16_t format = 1;  ///< of samples: 1 unsigned, 2 signed, 3 real
  std::string pixels{};      ///< as they are to be in the file
  std::string description{};
  double x_resolution = 0;  ///< pixels in a unit; 0: none
  double y_resolution = 0;
  std::uint16_t resolution_unit = 1;
  std::vector<std::uint16_t> palette{};
  std::vector<std::uint16_t> extra_samples{};
  std::uint32_t kind = 0;  ///< 1: a preview
  bool is_separate = false;
  std::uint16_t compression = 1;
};

/// Writes a TIFF, all of a page's pixels in one strip (one for each sample if they are separate).
class TiffWriter {
 public:
  explicit TiffWriter(std::endian order) : order_(order) {
    bytes_ = order == std::endian::little ? "II" : "MM";
    append(bytes_, std::uint16_t{42}, order_);
    append(bytes_, std::uint32_t{8}, order_);
  }

  void add(const MadePage& page) {
    entries_ = {};
    put_entries(page);
    write_entries(page);
  }
  /// The file, whose last page says where the next is to be.
  [[nodiscard]] std::string file(std::uint32_t next = 0) const {
    std::string end;
    append(end, next, order_);
    return std::string(bytes_).replace(link_, 4, end);
  }

 private:
  struct Entry {
    std::uint16_t tag;
    std::uint16_t type;
    std::uint32_t count;
    std::string value;
  };

  template <class Number>
  void put(std::uint16_t tag, std::uint16_t type, const std::vector<Number>& numbers) {
    Entry entry{tag, type, static_cast<std::uint32_t>(numbers.size()), {}};
    for (const Number number : numbers) append(entry.value, number, order_);
    entries_.push_back(std::move(entry));
  }
  void put_long(std::uint16_t tag, std::uint32_t number) { put(tag, 4, std::vector{number}); }
  void put_short(std::uint16_t tag, std::uint16_t number) { put(tag, 3, std::vector{number}); }
  void put_ratio(std::uint16_t tag, double number) {
    constexpr std::uint32_t whole = 1'000'000;
    const auto part = static_cast<std::uint32_t>(std::lround(number * whole));
    put(tag, 5, std::vector<std::uint32_t>{part, whole});
    entries_.back().count = 1;
  }

  void put_entries(const MadePage& page) {
    const std::size_t strips = page.is_separate ? page.samples : 1;
    if (page.kind != 0) put_long(254, page.kind);
    put_long(256, page.columns);
    put_long(257, page.rows);
    put(258, 3, std::vector<std::uint16_t>(page.samples, page.bits));
    put_short(259, page.compression);
    put_short(262, page.ink);
    if (!page.description.empty()) {
      put(270, 2, std::vector<char>(page.description.begin(), page.description.end()));
      entries_.back().value += '\0';
      ++entries_.back().count;
    }
    put(273, 4, std::vector<std::uint32_t>(strips));
    put_short(277, page.samples);
    put_long(278, page.rows);
    put(279, 4,
        std::vector<std::uint32_t>(strips,
                                   static_cast<std::uint32_t>(page.pixels.size() / strips)));
    if (page.x_resolution > 0) put_ratio(282, page.x_resolution);
    if (page.y_resolution > 0) put_ratio(283, page.y_resolution);
    put_short(284, page.is_separate ? 2 : 1);
    put_short(296, page.resolution_unit);
    if (!page.palette.empty()) put(320, 3, page.palette);
    if (!page.extra_samples.empty()) put(338, 3, page.extra_samples);
    put(339, 3, std::vector<std::uint16_t>(page.samples, page.format));
  }

  /// The directory, what does not fit into it, and then the pixels.
  void write_entries(const MadePage& page) {
    const std::size_t size = 2 + 12 * entries_.size() + 4;
    std::size_t place = bytes_.size() + size;
    for (const Entry& entry : entries_) place += entry.value.size() > 4 ? entry.value.size() : 0;
    for (Entry& entry : entries_)
      if (entry.tag == 273) set_places(entry, place, page.pixels.size());
    std::string directory;
    std::string behind;
    append(directory, static_cast<std::uint16_t>(entries_.size()), order_);
    for (Entry& entry : entries_) {
      append(directory, entry.tag, order_);
      append(directory, entry.type, order_);
      append(directory, entry.count, order_);
      if (entry.value.size() > 4) {
        append(directory, static_cast<std::uint32_t>(bytes_.size() + size + behind.size()), order_);
        behind += entry.value;
      } else {
        entry.value.resize(4);
        directory += entry.value;
      }
    }
    link_ = bytes_.size() + directory.size();
    append(directory, static_cast<std::uint32_t>(place + page.pixels.size()), order_);
    bytes_ += directory + behind + page.pixels;
  }

  void set_places(Entry& entry, std::size_t first, std::size_t size) const {
    entry.value.clear();
    for (std::uint32_t i = 0; i < entry.count; ++i)
      append(entry.value, static_cast<std::uint32_t>(first + i * size / entry.count), order_);
  }

  std::endian order_;
  std::string bytes_;
  std::vector<Entry> entries_;
  std::size_t link_ = 4;  ///< where the place of the next directory is
};

inline std::string tiff_of(const std::vector<MadePage>& pages,
                           std::endian order = std::endian::little) {
  TiffWriter writer(order);
  for (const MadePage& page : pages) writer.add(page);
  return writer.file();
}

}  // namespace loft::io::testing
