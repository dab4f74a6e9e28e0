// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "io/bytes/little_endian.h"
#include "io/bytes/text.h"
#include "io/bytes/text_reader.h"
#include "io/meshes/ply.h"
#include "io/meshes/polygons.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
  std::string name;
  Type type = Type::float64;
  std::optional<Type> count;  ///< of the length in front of it, where it is a list
};

struct Element {
  std::string name;
  std::size_t size = 0;
  std::vector<Property> properties;
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::vector<std::string> labels;
};

Type to_type(std::string_view word, const TextReader& text) {
  struct Name {
    std::string_view word;
    Type type;
  };
  constexpr std::array names{
      Name{"char", Type::int8},      Name{"int8", Type::int8},       Name{"uchar", Type::uint8},
      Name{"uint8", Type::uint8},    Name{"short", Type::int16},     Name{"int16", Type::int16},
      Name{"ushort", Type::uint16},  Name{"uint16", Type::uint16},   Name{"int", Type::int32},
      Name{"int32", Type::int32},    Name{"uint", Type::uint32},     Name{"uint32", Type::uint32},
      Name{"float", Type::float32},  Name{"float32", Type::float32}, Name{"double", Type::float64},
      Name{"float64", Type::float64}};
  for (const Name& name : names) {
    if (name.word == word) return name.type;
  }
  text.fail(in_quotes(word) + " is no number type of PLY");
}

Encoding to_encoding(std::string_view word, const TextReader& text) {
  if (word == "ascii") return Encoding::ascii;
  if (word == "binary_little_endian") return Encoding::little_endian;
  if (word == "binary_big_endian") return Encoding::big_endian;
  text.fail(in_quotes(word) + " is no format of PLY");
}

std::string_view required(TextReader& text, std::string_view wanted) {
  const auto found = text.word();
  if (!found) text.fail("the line ends where " + std::string(wanted) + " should be");
  return *found;
}

Element read_element(TextReader& text) {
  Element element;
  element.name = required(text, "an element's name");
  const std::int64_t size = text.to_integer(required(text, "a count"), "a count");
  if (size < 0) text.fail("a count below zero");
  element.size = static_cast<std::size_t>(size);
  return element;
}

Property read_property(TextReader& text) {
  Property property;
  std::string_view word = required(text, "a type");
  if (word == "list") {
    property.count = to_type(required(text, "a type"), text);
    word = required(text, "a type");
  }
  property.type = to_type(word, text);
  property.name = required(text, "a property's name");
  return property;
}

/// `comment label 0 heart`, as write_ply() writes it.
void read_comment(TextReader& text, std::vector<std::string>& labels) {
  if (text.word() != "label") return;
  const auto number = text.word();
  if (!number || *number != std::to_string(labels.size())) return;
  labels.emplace_back(text.rest());
}

Header read_header(TextReader& text) {
  Header header;
  if (!text.next_line() || text.word() != "ply") text.fail("does not begin with 'ply'");
  while (text.next_line()) {
    const std::string_view word = required(text, "a word");
    if (word == "end_header") return header;
    if (word == "format") {
      header.encoding = to_encoding(required(text, "a format"), text);
    } else if (word == "comment") {
      read_comment(text, header.labels);
    } else if (word == "element") {
      header.elements.push_back(read_element(text));
    } else if (word == "property") {
      if (header.elements.empty()) text.fail("a property before any element");
      header.elements.back().properties.push_back(read_property(text));
    }
  }
  text.fail("the file ends in its header");
}

/// The numbers of an ASCII body, one after the other.
class AsciiValues {
 public:
  explicit AsciiValues(TextReader& text) : text_(text) {}
  double next(Type) { return text_.any_number("a number"); }
  [[noreturn]] void fail(const std::string& message) const { text_.fail(message); }

 private:
  TextReader& text_;
};

/// The numbers of a binary body.
class BinaryValues {
 public:
  BinaryValues(std::string_view bytes, std::size_t begin, std::endian order, std::string_view name)
      : bytes_(bytes), place_(begin), order_(order), name_(name) {}

  double next(Type type) {
    switch (type) {
      case Type::int8:
        return take<std::int8_t>();
      case Type::uint8:
        return take<std::uint8_t>();
      case Type::int16:
        return take<std::int16_t>();
      case Type::uint16:
        return take<std::uint16_t>();
      case Type::int32:
        return take<std::int32_t>();
      case Type::uint32:
        return take<std::uint32_t>();
      case Type::float32:
        return static_cast<double>(take<float>());
      case Type::float64:
        break;
    }
    return take<double>();
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(std::string(name_) + ": byte " + std::to_string(place_) + ": " + message);
  }

 private:
  template <class Number>
  Number take() {
    if (bytes_.size() - place_ < sizeof(Number)) fail("the file ends in the middle");
    const Number number = get<Number>(bytes_.data() + place_, order_);
    place_ += sizeof(Number);
    return number;
  }

  std::string_view bytes_;
  std::size_t place_;
  std::endian order_;
  std::string_view name_;
};

/// A whole number from 0 to one below the largest of 32 bits.
template <class Values>
std::uint32_t to_index(double number, const Values& values) {
  constexpr double limit = std::numeric_limits<std::uint32_t>::max();
  if (number >= 0 && number < limit && std::trunc(number) == number) {
    return static_cast<std::uint32_t>(number);
  }
  values.fail("a count or vertex number that is none");
}

template <class Values>
void skip(const Property& property, Values& values) {
  std::uint32_t count = 1;
  if (property.count) count = to_index(values.next(*property.count), values);
  for (std::uint32_t i = 0; i < count; ++i) values.next(property.type);
}

/// The place of a property in its element; throws if it is not there.
template <class Values>
std::size_t find_property(const Element& element, std::string_view name, const Values& values) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (element.properties[i].name == name && !element.properties[i].count) return i;
  }
  values.fail("element " + element.name + " has no property " + std::string(name));
}

/// Where a share of a colour goes; null: nowhere. Shares of 255, as all programs write them.
std::uint8_t* share_of(Colour& colour, const Property& property) {
  if (property.count || property.type != Type::uint8) return nullptr;
  if (property.name == "red") return &colour.red;
  if (property.name == "green") return &colour.green;
  return property.name == "blue" ? &colour.blue : nullptr;
}

bool has_colour(const Element& element) {
  Colour colour;
  return std::ranges::count_if(element.properties, [&](const Property& property) {
           return share_of(colour, property) != nullptr;
         }) == 3;
}

template <class Values>
void read_vertices(const Element& element, Values& values, Polygons& polygons,
                   std::vector<Colour>& colours) {
  const bool is_coloured = has_colour(element);
  const std::array places{find_property(element, "x", values), find_property(element, "y", values),
                          find_property(element, "z", values)};
  for (std::size_t i = 0; i < element.size; ++i) {
    Vec3 point{};
    Colour colour;
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const auto axis = std::ranges::find(places, k);
      if (std::uint8_t* const share = share_of(colour, element.properties[k]); share != nullptr) {
        const double value = values.next(Type::uint8);  // as text it may be anything
        *share = value >= 0 && value <= 255 ? static_cast<std::uint8_t>(value) : std::uint8_t{0};
      } else if (axis == places.end()) {
        skip(element.properties[k], values);
      } else {
        point[static_cast<std::size_t>(axis - places.begin())] =
            values.next(element.properties[k].type);
      }
    }
    polygons.mesh.points.push_back(point);
    if (is_coloured) colours.push_back(colour);
  }
}

bool is_corner_list(const Property& property) {
  return property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
}

bool is_label(const Property& property) { return !property.count && property.name == "label"; }

template <class Values>
void read_corners(const Property& property, Values& values, std::vector<std::uint32_t>& corners) {
  const std::uint32_t count = to_index(values.next(*property.count), values);
  if (count < 3) values.fail("a face of " + std::to_string(count) + " corners");
  corners.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    corners.push_back(to_index(values.next(property.type), values));
  }
}

template <class Values>
void read_faces(const Element& element, Values& values, Polygons& polygons) {
  if (std::ranges::none_of(element.properties, is_corner_list)) {
    values.fail("element face has no list vertex_indices");
  }
  const bool labelled = !polygons.labels.empty();
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < element.size; ++i) {
    std::uint32_t label = 0;
    for (const Property& property : element.properties) {
      if (is_corner_list(property)) {
        read_corners(property, values, corners);
      } else if (labelled && is_label(property)) {
        label = to_index(values.next(property.type), values);
      } else {
        skip(property, values);
      }
    }
    polygons.add(corners, label);
  }
}

template <class Values>
void read_body(const Header& header, Values& values, Polygons& polygons,
               std::vector<Colour>& colours) {
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;  // nothing to read, however many there may be
    if (element.name == "vertex") {
      read_vertices(element, values, polygons, colours);
    } else if (element.name == "face") {
      read_faces(element, values, polygons);
    } else {
      for (std::size_t i = 0; i < element.size; ++i) {
        for (const Property& property : element.properties) skip(property, values);
      }
    }
  }
}

/// Of each face, where its corners have the same one. Precondition: the indices are valid.
void colour_faces(Polygons& polygons, std::span<const Colour> colours) {
  if (colours.size() != polygons.mesh.points.size()) return;
  for (const auto& [a, b, c] : polygons.mesh.faces) {
    const bool is_one = colours[a] == colours[b] && colours[b] == colours[c];
    polygons.colours.push_back(is_one ? std::optional(colours[a]) : std::nullopt);
  }
}

/// Where a vertex comes from, if it is a point of a contour.
struct ContourPoint {
  double slice = -1;
  double contour = -1;
  double point = -1;
  double label = -1;
  Vec3 place{};

  [[nodiscard]] bool is_whole() const { return slice >= 0 && contour >= 0 && point >= 0; }
  [[nodiscard]] auto order() const { return std::tuple(slice, contour, point); }
  [[nodiscard]] bool is_beside(const ContourPoint& other) const {
    return slice == other.slice && contour == other.contour;
  }
};

/// Where a property of a vertex goes; null: nowhere.
double* member(ContourPoint& point, std::string_view name) {
  if (name == "x") return &point.place[0];
  if (name == "y") return &point.place[1];
  if (name == "z") return &point.place[2];
  if (name == "slice") return &point.slice;
  if (name == "contour") return &point.contour;
  if (name == "point") return &point.point;
  return name == "label" ? &point.label : nullptr;
}

bool knows_contours(const Element& element) {
  const auto has = [&](std::string_view name) {
    return std::ranges::any_of(element.properties, [name](const Property& property) {
      return property.name == name && !property.count;
    });
  };
  return element.name == "vertex" && has("x") && has("y") && has("z") && has("slice") &&
         has("contour") && has("point");
}

template <class Values>
std::vector<ContourPoint> read_contour_points(const Header& header, Values& values) {
  std::vector<ContourPoint> points;
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    const bool is_wanted = knows_contours(element);
    for (std::size_t i = 0; i < element.size; ++i) {
      ContourPoint point;
      for (const Property& property : element.properties) {
        double* const place = property.count ? nullptr : member(point, property.name);
        if (place == nullptr) {
          skip(property, values);
        } else {
          *place = values.next(property.type);
        }
      }
      if (is_wanted && point.is_whole()) points.push_back(point);
    }
    if (is_wanted) break;  // nothing else matters
  }
  return points;
}

/// Parts that touch have vertices of their own at one point.
void sort_and_make_unique(std::vector<ContourPoint>& points) {
  std::ranges::stable_sort(points, {}, &ContourPoint::order);
  const auto is_same = [](const ContourPoint& a, const ContourPoint& b) {
    return a.order() == b.order();
  };
  points.erase(std::unique(points.begin(), points.end(), is_same), points.end());
}

std::vector<Slice> to_slices(std::vector<ContourPoint> points,
                             const std::vector<std::string>& labels) {
  sort_and_make_unique(points);
  std::vector<Slice> slices;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContourPoint& point = points[i];
    const bool is_other_slice = i == 0 || points[i - 1].slice != point.slice;
    if (is_other_slice) slices.push_back({point.place[2], {}});
    std::vector<Contour>& contours = slices.back().contours;
    if (is_other_slice || !points[i - 1].is_beside(point)) {
      contours.emplace_back();
      const bool is_named = point.label >= 0 && point.label < static_cast<double>(labels.size());
      if (is_named) contours.back().label = labels[static_cast<std::size_t>(point.label)];
    }
    contours.back().points.push_back({point.place[0], point.place[1]});
  }
  std::ranges::stable_sort(slices, {}, &Slice::z);
  return slices;
}

/// Calls read(header, values) for the values behind the header.
template <class Read>
auto with_values(const std::string& content, std::string_view name, Read read) {
  TextReader text(content, name);
  const Header header = read_header(text);
  if (header.encoding == Encoding::ascii) {
    AsciiValues values(text);
    return read(header, values);
  }
  const std::endian order =
      header.encoding == Encoding::little_endian ? std::endian::little : std::endian::big;
  BinaryValues values(content, text.next_line_begin(), order, name);
  return read(header, values);
}

}  // namespace

std::vector<Slice> read_ply_contours(const std::string& content, std::string_view name) {
  return with_values(content, name, [](const Header& header, auto& values) {
    if (std::ranges::none_of(header.elements, knows_contours)) return std::vector<Slice>();
    return to_slices(read_contour_points(header, values), header.labels);
  });
}

std::vector<LabelledMesh> read_ply(const std::string& content, std::string_view name) {
  std::vector<Colour> colours;  // of vertices
  Polygons polygons = with_values(content, name, [&](const Header& header, auto& values) {
    Polygons read;
    read.labels = header.labels;
    read_body(header, values, read, colours);
    return read;
  });
  require_valid(polygons.mesh, name);
  colour_faces(polygons, colours);
  return split(std::move(polygons));
}

}  // namespace loft::io
