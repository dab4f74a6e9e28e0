// SPDX-License-Identifier: MIT
#include "io/volumes/meta_image_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "io/bytes/text.h"
#include "io/bytes/words.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

/// Those of long have four bytes, whatever the machine.
constexpr std::array meta_image_types{
    PixelTypeName{"MET_UCHAR", PixelType::u8},      PixelTypeName{"MET_CHAR", PixelType::i8},
    PixelTypeName{"MET_ASCII_CHAR", PixelType::i8}, PixelTypeName{"MET_USHORT", PixelType::u16},
    PixelTypeName{"MET_SHORT", PixelType::i16},     PixelTypeName{"MET_UINT", PixelType::u32},
    PixelTypeName{"MET_INT", PixelType::i32},       PixelTypeName{"MET_ULONG", PixelType::u32},
    PixelTypeName{"MET_LONG", PixelType::i32},      PixelTypeName{"MET_ULONG_LONG", PixelType::u64},
    PixelTypeName{"MET_LONG_LONG", PixelType::i64}, PixelTypeName{"MET_FLOAT", PixelType::f32},
    PixelTypeName{"MET_DOUBLE", PixelType::f64}};

class MetaImageHeaderReader {
 public:
  MetaImageHeaderReader(std::string_view bytes, const std::string& name)
      : bytes_(bytes), name_(name) {}

  MetaImageHeader read() {
    split_lines();
    header_.volume.name = name_;
    read_sizes();
    read_type();
    read_encoding();
    read_place();
    read_files();
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& what) const {
    throw InputError(name_ + ": " + field + ": " + what);
  }

  /// The next line, if there is one.
  std::optional<std::string_view> next_line() {
    if (header_.size >= bytes_.size()) return {};
    const std::string_view rest = bytes_.substr(header_.size);
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    header_.size += std::min(end + 1, rest.size());
    return without_blanks(rest.substr(0, end));
  }

  /// Fields up to the one that is always the last.
  void split_lines() {
    std::size_t number = 0;
    while (const auto line = next_line()) {
      ++number;
      if (header_.size > longest_header)
        fail("line " + std::to_string(number), "no header of a MetaImage is so long");
      if (line->empty()) continue;
      const std::size_t sign = line->find_first_of("=:");
      if (sign == std::string_view::npos)
        fail("line " + std::to_string(number), in_quotes(*line) + " is no 'Field = value'");
      const std::string field(without_blanks(line->substr(0, sign)));
      fields_[field] = without_blanks(line->substr(sign + 1));
      if (field == "ElementDataFile") return;
    }
    fail("ElementDataFile", "is missing; the file was cut off, or is no MetaImage");
  }

  /// The value of the first of some fields that there is.
  [[nodiscard]] std::string_view field(std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names)
      if (const auto found = fields_.find(name); found != fields_.end()) return found->second;
    return {};
  }

  [[nodiscard]] bool is_true(std::initializer_list<std::string_view> names, bool otherwise) const {
    const std::string value = in_lower_case(field(names));
    if (value.empty()) return otherwise;
    return value == "true" || value == "t" || value == "1";
  }

  [[nodiscard]] std::uint32_t count(const std::string& name, std::string_view word) const {
    const auto value = number_in(word);
    if (!value || !(*value >= 1 && *value <= std::numeric_limits<std::uint32_t>::max()) ||
        *value != std::floor(*value))
      fail(name, in_quotes(word) + " is no size");
    return static_cast<std::uint32_t>(*value);
  }

  void read_sizes() {
    if (const auto type = field({"ObjectType"}); !type.empty() && type != "Image")
      fail("ObjectType", in_quotes(type) + " has no pixels; save it as an image");
    const std::string_view dimensions = field({"NDims"});
    const auto number = number_in(dimensions);
    if (!number || (*number != 2 && *number != 3 && *number != 4))
      fail("NDims", in_quotes(dimensions) +
                        " cannot be read; a volume has 3, a slice 2, and one with layers 4");
    axes_ = static_cast<std::size_t>(*number);
    const auto sizes = words_of(field({"DimSize"}));
    if (sizes.size() != axes_)
      fail("DimSize", "has " + std::to_string(sizes.size()) + " numbers for the NDims " +
                          std::string(dimensions));
    Volume& volume = header_.volume;
    volume.slices = 1;
    const std::array counts{&volume.columns, &volume.rows, &volume.slices, &volume.layers};
    for (std::size_t i = 0; i < axes_; ++i) *counts[i] = count("DimSize", sizes[i]);
  }

  void read_type() {
    if (const auto channels = field({"ElementNumberOfChannels"});
        !channels.empty() && number_in(channels) != 1)
      fail("ElementNumberOfChannels",
           in_quotes(channels) + " values a pixel; labels have one: save one channel");
    const std::string_view name = field({"ElementType"});
    const auto type = std::ranges::find(meta_image_types, name, &PixelTypeName::name);
    if (type == meta_image_types.end())
      fail("ElementType", in_quotes(name) + " cannot be read; save labels as MET_USHORT");
    header_.pixels.type = type->type;
    if (is_true({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}, false))
      header_.pixels.order = std::endian::big;
  }

  void read_encoding() {
    if (is_true({"CompressedData"}, false))
      header_.encoding = MetaImageHeader::Encoding::zlib;
    else if (!is_true({"BinaryData"}, true))
      header_.encoding = MetaImageHeader::Encoding::text;
    constexpr double most = 1e15;
    const auto bytes = [&](const char* name) -> std::optional<double> {
      const std::string_view text = field({name});
      if (text.empty()) return {};
      const auto value = number_in(text);
      if (!value || !(*value >= -1 && *value <= most) || *value != std::floor(*value))
        fail(name, in_quotes(text) + " is no count of bytes");
      return value;
    };
    if (const auto packed = bytes("CompressedDataSize"); packed && *packed > 0)
      header_.packed_size = static_cast<std::uint64_t>(*packed);
    const double skip = bytes("HeaderSize").value_or(0);
    header_.skip.reset();
    if (skip >= 0) header_.skip = static_cast<std::uint64_t>(skip);
  }

  /// Numbers of a field: `least` of them or more, or none where there is no field.
  [[nodiscard]] std::vector<double> numbers(std::initializer_list<std::string_view> names,
                                            std::size_t least) const {
    const std::string_view text = field(names);
    std::vector<double> result;
    for (const std::string_view word : words_of(text)) {
      const auto value = number_in(word);
      if (!value || !std::isfinite(*value))
        fail(std::string(*names.begin()), in_quotes(word) + " is no number");
      result.push_back(*value);
    }
    if (!result.empty() && result.size() < least)
      fail(std::string(*names.begin()),
           "has " + std::to_string(result.size()) + " numbers, not " + std::to_string(least));
    return result;
  }

  void read_place() {
    Volume& volume = header_.volume;
    const auto spacing = numbers({"ElementSpacing", "ElementSize"}, axes_);
    const auto origin = numbers({"Offset", "Position", "Origin"}, axes_);
    const auto matrix = numbers({"TransformMatrix", "Rotation", "Orientation"}, axes_ * axes_);
    volume.has_spacing = !spacing.empty();
    for (std::size_t axis = 0; axis < std::min<std::size_t>(axes_, 3); ++axis) {
      const double length = spacing.empty() ? 1 : spacing[axis];
      for (std::size_t row = 0; row < std::min<std::size_t>(axes_, 3); ++row) {
        const double along = matrix.empty() ? (row == axis ? 1 : 0) : matrix[axis * axes_ + row];
        volume.to_world[row][axis] = along == 0 ? 0 : along * length;
      }
      if (!origin.empty()) volume.to_world[axis][3] = origin[axis];
    }
    const std::string_view unit = field({"DistanceUnits"});
    volume.unit = unit == "um" || unit == "cm" ? unit : "mm";
  }

  /// How many files pixels are in, if each has so many dimensions of them.
  [[nodiscard]] std::uint64_t file_count(std::size_t dimensions) const {
    if (dimensions < 2) fail("ElementDataFile", "a file with less than a slice cannot be read");
    const Volume& volume = header_.volume;
    const std::array sizes{volume.columns, volume.rows, volume.slices, volume.layers};
    std::uint64_t count = 1;
    for (std::size_t i = dimensions; i < axes_; ++i) {
      if (count > std::numeric_limits<std::uint32_t>::max())
        fail("DimSize", "more slices than there are files");
      count *= sizes[i];
    }
    return count;
  }

  void read_files() {
    const std::string_view value = field({"ElementDataFile"});
    const auto words = words_of(value);
    if (words.empty()) fail("ElementDataFile", "is empty");
    if (in_lower_case(value) == "local") return;
    if (words[0] == "LIST") return read_list(words.size() > 1 ? words[1] : "");
    if (value.find('%') == std::string_view::npos) {
      header_.files.emplace_back(value);
      return;
    }
    const std::uint64_t count = file_count(axes_ - 1);
    header_.files = names_by_pattern(value, count);
    if (header_.files.empty())
      fail("ElementDataFile", in_quotes(value) + " does not name the files of " +
                                  std::to_string(count) +
                                  " slices, as name%03d.raw FIRST LAST STEP does");
  }

  /// Names in the lines that follow; each file has the pixels of one dimension less, unless that is
  /// said: `2D`.
  void read_list(std::string_view said) {
    std::size_t dimensions = axes_ - 1;
    if (!said.empty() && said[0] >= '1' && static_cast<std::size_t>(said[0] - '0') <= axes_)
      dimensions = static_cast<std::size_t>(said[0] - '0');
    const std::uint64_t count = file_count(dimensions);
    while (const auto line = next_line())
      if (!line->empty() && header_.files.size() <= count) header_.files.emplace_back(*line);
    if (header_.files.size() != count)
      fail("ElementDataFile",
           "the list is to have the names of " + std::to_string(count) +
               " files, one a line, but has " +
               (header_.files.size() > count ? "more" : std::to_string(header_.files.size())));
    if (std::set(header_.files.begin(), header_.files.end()).size() != count)
      fail("ElementDataFile", "the list has a file twice; each has slices of its own");
  }

  std::string_view bytes_;
  const std::string& name_;
  MetaImageHeader header_;
  std::map<std::string, std::string_view, std::less<>> fields_;
  std::size_t axes_ = 3;
};

}  // namespace

MetaImageHeader read_meta_image_header(std::string_view bytes, const std::string& name) {
  return MetaImageHeaderReader(bytes, name).read();
}

}  // namespace loft::io
