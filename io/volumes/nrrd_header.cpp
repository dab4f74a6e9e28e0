// SPDX-License-Identifier: MIT
#include "io/volumes/nrrd_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "io/bytes/words.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

/// Vectors are words, too.
std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> all;
  for (text = without_blanks(text); !text.empty(); text = without_blanks(text)) {
    std::size_t end = text.front() == '(' ? text.find(')') : text.find_first_of(" \t");
    if (end == std::string_view::npos) end = text.size();
    if (end < text.size() && text[end] == ')') ++end;
    all.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return all;
}

/// `(1,0,0)`: its numbers; none for `none` and what is no vector.
std::vector<double> vector_of(std::string_view word) {
  std::vector<double> numbers;
  if (!word.starts_with('(') || !word.ends_with(')')) return {};
  word = word.substr(1, word.size() - 2);
  while (!word.empty()) {
    const std::size_t end = std::min(word.find(','), word.size());
    const auto value = number_in(word.substr(0, end));
    if (!value) return {};
    numbers.push_back(*value);
    word.remove_prefix(std::min(end + 1, word.size()));
  }
  return numbers;
}

constexpr std::array nrrd_types{PixelTypeName{"uchar", PixelType::u8},
                                PixelTypeName{"unsigned char", PixelType::u8},
                                PixelTypeName{"uint8", PixelType::u8},
                                PixelTypeName{"uint8_t", PixelType::u8},
                                PixelTypeName{"signed char", PixelType::i8},
                                PixelTypeName{"int8", PixelType::i8},
                                PixelTypeName{"int8_t", PixelType::i8},
                                PixelTypeName{"short", PixelType::i16},
                                PixelTypeName{"short int", PixelType::i16},
                                PixelTypeName{"signed short", PixelType::i16},
                                PixelTypeName{"int16", PixelType::i16},
                                PixelTypeName{"int16_t", PixelType::i16},
                                PixelTypeName{"ushort", PixelType::u16},
                                PixelTypeName{"unsigned short", PixelType::u16},
                                PixelTypeName{"uint16", PixelType::u16},
                                PixelTypeName{"uint16_t", PixelType::u16},
                                PixelTypeName{"int", PixelType::i32},
                                PixelTypeName{"signed int", PixelType::i32},
                                PixelTypeName{"int32", PixelType::i32},
                                PixelTypeName{"int32_t", PixelType::i32},
                                PixelTypeName{"uint", PixelType::u32},
                                PixelTypeName{"unsigned int", PixelType::u32},
                                PixelTypeName{"uint32", PixelType::u32},
                                PixelTypeName{"uint32_t", PixelType::u32},
                                PixelTypeName{"longlong", PixelType::i64},
                                PixelTypeName{"long long", PixelType::i64},
                                PixelTypeName{"int64", PixelType::i64},
                                PixelTypeName{"int64_t", PixelType::i64},
                                PixelTypeName{"ulonglong", PixelType::u64},
                                PixelTypeName{"unsigned long long", PixelType::u64},
                                PixelTypeName{"uint64", PixelType::u64},
                                PixelTypeName{"uint64_t", PixelType::u64},
                                PixelTypeName{"float", PixelType::f32},
                                PixelTypeName{"double", PixelType::f64}};

struct SpaceName {
  std::string_view name;
  std::string_view axes;
};
constexpr std::array space_names{
    SpaceName{"left-posterior-superior", "LPS"}, SpaceName{"lps", "LPS"},
    SpaceName{"right-anterior-superior", "RAS"}, SpaceName{"ras", "RAS"},
    SpaceName{"left-anterior-superior", "LAS"},  SpaceName{"las", "LAS"}};

class NrrdHeaderReader {
 public:
  NrrdHeaderReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  NrrdHeader read() {
    split_lines();
    read_axes();
    read_pixels();
    read_places();
    header_.volume.name = name_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& what) const {
    throw InputError(name_ + ": " + field + ": " + what);
  }

  /// Fields and pairs, up to an empty line or the end.
  void split_lines() {
    std::size_t at = 0;
    for (std::size_t line = 1;; ++line) {
      const std::size_t end = bytes_.find('\n', at);
      if (end == std::string_view::npos || end > longest_header) {
        if (end != std::string_view::npos)
          fail("line " + std::to_string(line), "no header of NRRD is so long");
        take_line(bytes_.substr(std::min(at, bytes_.size())), line);
        header_.size = bytes_.size();
        return;
      }
      const std::string_view text = bytes_.substr(at, end - at);
      at = end + 1;
      if (without_blanks(text).empty()) break;
      take_line(text, line);
    }
    header_.size = at;
  }

  void take_line(std::string_view text, std::size_t line) {
    if (line == 1 || text.starts_with('#') || without_blanks(text).empty()) return;
    if (const std::size_t pair = text.find(":="); pair != std::string_view::npos) {
      header_.pairs[std::string(text.substr(0, pair))] =
          std::string(without_blanks(text.substr(pair + 2)));
      return;
    }
    const std::size_t colon = text.find(": ");
    if (colon == std::string_view::npos)
      fail("line " + std::to_string(line), "neither 'field: value' nor 'key:=value'");
    fields_[in_lower_case(without_blanks(text.substr(0, colon)))] =
        std::string(without_blanks(text.substr(colon + 2)));
  }

  [[nodiscard]] std::string_view field(const std::string& name) const {
    const auto found = fields_.find(name);
    return found == fields_.end() ? std::string_view() : found->second;
  }
  [[nodiscard]] std::string_view field(const std::string& name, const std::string& other) const {
    return field(name).empty() ? field(other) : field(name);
  }

  /// Sizes, and which axis is that of layers, if there are four.
  void read_axes() {
    const auto dimension = number_in(field("dimension"));
    if (!dimension || (*dimension != 3 && *dimension != 4))
      fail("dimension",
           in_quotes(field("dimension")) + " cannot be read; a volume has 3, or 4 with its layers");
    const auto sizes = words(field("sizes"));
    if (sizes.size() != static_cast<std::size_t>(*dimension))
      fail("sizes", "has " + std::to_string(sizes.size()) + " numbers for the dimension " +
                        std::string(field("dimension")));
    directions_ = words(field("space directions"));
    kinds_ = words(field("kinds"));
    if (sizes.size() == 4) {
      const bool is_first = (!kinds_.empty() && (kinds_[0] == "list" || kinds_[0] == "vector")) ||
                            (!directions_.empty() && directions_[0] == "none");
      layer_axis_ = is_first ? 0 : 3;
      header_.pixels.layers_first = is_first;
      header_.volume.layers = count(sizes[*layer_axis_]);
    }
    std::array<std::uint32_t*, 3> counts{&header_.volume.columns, &header_.volume.rows,
                                         &header_.volume.slices};
    for (std::size_t i = 0, axis = 0; i < sizes.size(); ++i)
      if (i != layer_axis_) *counts[axis++] = count(sizes[i]);
  }

  [[nodiscard]] std::uint32_t count(std::string_view word) const {
    const auto value = number_in(word);
    if (!value || !(*value >= 1 && *value <= std::numeric_limits<std::uint32_t>::max()) ||
        *value != std::floor(*value))
      fail("sizes", in_quotes(word) + " is no size");
    return static_cast<std::uint32_t>(*value);
  }

  [[nodiscard]] std::uint64_t skip(const std::string& name, const std::string& other) const {
    const std::string_view text = field(name, other);
    if (text.empty()) return 0;
    const auto value = number_in(text);
    if (!value || !(*value >= 0 && *value <= 1e15) || *value != std::floor(*value))
      fail(name, in_quotes(text) + " is no count" +
                     (value && *value < 0 ? "; write where the pixels begin" : ""));
    return static_cast<std::uint64_t>(*value);
  }

  void read_pixels() {
    const auto type =
        std::ranges::find(nrrd_types, in_lower_case(field("type")), &PixelTypeName::name);
    if (type == nrrd_types.end())
      fail("type", in_quotes(field("type")) + " cannot be read; save labels as unsigned short");
    header_.pixels.type = type->type;
    const std::string endian = in_lower_case(field("endian"));
    if (endian == "big") {
      header_.pixels.order = std::endian::big;
    } else if (!endian.empty() && endian != "little") {
      fail("endian", in_quotes(endian) + " is neither little nor big");
    }
    const std::string encoding = in_lower_case(field("encoding"));
    if (encoding == "gzip" || encoding == "gz") {
      header_.encoding = NrrdHeader::Encoding::gzip;
    } else if (encoding == "txt" || encoding == "text" || encoding == "ascii") {
      header_.encoding = NrrdHeader::Encoding::text;
    } else if (encoding != "raw") {
      fail("encoding", in_quotes(encoding) + " cannot be read; save it raw or with gzip");
    }
    header_.data_file = std::string(field("data file", "datafile"));
    header_.line_skip = skip("line skip", "lineskip");
    header_.byte_skip = skip("byte skip", "byteskip");
  }

  /// The matrix: directions and origin, or spacings alone.
  void read_places() {
    Volume& volume = header_.volume;
    const auto space =
        std::ranges::find(space_names, in_lower_case(field("space")), &SpaceName::name);
    if (space != space_names.end()) header_.space = std::string(space->axes);
    if (!header_.space.empty()) volume.unit = "mm";
    if (directions_.empty()) return read_spacings();
    for (std::size_t i = 0, axis = 0; i < directions_.size() && axis < 3; ++i) {
      if (i == layer_axis_) continue;
      const std::vector<double> direction = vector_of(directions_[i]);
      if (direction.size() < 3)
        fail("space directions", in_quotes(directions_[i]) + " is no vector (x,y,z)");
      for (std::size_t row = 0; row < 3; ++row) volume.to_world[row][axis] = direction[row];
      ++axis;
    }
    const std::vector<double> origin = vector_of(field("space origin"));
    for (std::size_t row = 0; row < 3 && origin.size() >= 3; ++row)
      volume.to_world[row][3] = origin[row];
  }

  void read_spacings() {
    Volume& volume = header_.volume;
    const auto spacings = words(field("spacings"));
    std::size_t known = 0;
    for (std::size_t i = 0, axis = 0; i < spacings.size() && axis < 3; ++i) {
      if (i == layer_axis_) continue;
      const auto spacing = number_in(spacings[i]);
      if (spacing && std::isfinite(*spacing)) {
        volume.to_world[axis][axis] = *spacing;
        ++known;
      }
      ++axis;
    }
    volume.has_spacing = known == 3;
  }

  std::string_view bytes_;
  const std::string& name_;
  NrrdHeader header_;
  std::map<std::string, std::string> fields_;
  std::vector<std::string_view> directions_;
  std::vector<std::string_view> kinds_;
  std::optional<std::size_t> layer_axis_;
};

/// Three shares of 1.
std::optional<Colour> colour_of_shares(std::string_view text) {
  const auto parts = words(text);
  if (parts.size() != 3) return {};
  std::array<std::uint8_t, 3> channels{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto share = number_in(parts[i]);
    if (!share || !(*share >= 0 && *share <= 1)) return {};
    channels[i] = static_cast<std::uint8_t>(std::lround(*share * 255));
  }
  return Colour{channels[0], channels[1], channels[2]};
}

}  // namespace

NrrdHeader read_nrrd_header(std::string_view bytes, const std::string& name) {
  return NrrdHeaderReader(bytes, name).read();
}

std::vector<VolumeLabel> segments_of(const NrrdHeader& header) {
  std::vector<VolumeLabel> segments;
  const auto value = [&](const std::string& key) {
    const auto found = header.pairs.find(key);
    return found == header.pairs.end() ? std::string() : found->second;
  };
  for (std::uint32_t i = 0;; ++i) {
    const std::string prefix = "Segment" + std::to_string(i) + '_';
    const std::string id = value(prefix + "ID");
    std::string name = json_text(one_line(value(prefix + "Name")));
    if (id.empty() && name.empty()) return segments;
    // Old SlicerRT wrote neither value nor layer: each segment is a layer of its own.
    const double layer =
        number_in(value(prefix + "Layer")).value_or(header.volume.layers > 1 ? i : 0);
    const double pixel = number_in(value(prefix + "LabelValue")).value_or(1);
    if (!(layer >= 0 && layer < header.volume.layers))
      throw InputError(header.volume.name + ": " + prefix + "Layer: there are only " +
                       std::to_string(header.volume.layers) + " layers");
    if (name.empty()) name = json_text(one_line(id));
    std::optional<Colour> colour = colour_of_shares(value(prefix + "Color"));
    if (!colour) colour = colour_of_shares(value(prefix + "DefaultColor"));
    segments.push_back({{std::move(name), colour, json_text(one_line(id))},
                        static_cast<std::uint32_t>(layer),
                        pixel});
  }
}

}  // namespace loft::io
