// SPDX-License-Identifier: MIT
#include "io/images/image_distances.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "io/bytes/words.h"
#include "io/unit.h"
#include "reconstruct/defect.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

struct LengthUnit {
  std::string_view name;
  std::string_view written;  // as metres_per_unit() knows it
};
/// By the names that programs write; a micro sign is one of two characters, as UTF-8, Latin-1 or
/// escaped.
constexpr std::array length_units{
    LengthUnit{"m", "m"},           LengthUnit{"cm", "cm"},        LengthUnit{"mm", "mm"},
    LengthUnit{"um", "um"},         LengthUnit{"micron", "um"},    LengthUnit{"microns", "um"},
    LengthUnit{"micrometer", "um"}, LengthUnit{"\xC2\xB5m", "um"}, LengthUnit{"\xCE\xBCm", "um"},
    LengthUnit{"\xB5m", "um"},      LengthUnit{"\\u00B5m", "um"},  LengthUnit{"&#181;m", "um"},
    LengthUnit{"&#xB5;m", "um"},    LengthUnit{"nm", "nm"},        LengthUnit{"inch", "in"},
    LengthUnit{"in", "in"},
};

const LengthUnit* find_unit(std::string_view name) {
  const auto found = std::ranges::find(length_units, name, &LengthUnit::name);
  return found == length_units.end() ? nullptr : &*found;
}

std::optional<double> as_distance(std::optional<double> number) {
  if (!number || !std::isfinite(*number) || *number == 0) return {};
  return std::abs(*number);
}

/// By a resolution, of which libtiff gives no more than the digits of a float.
std::optional<double> distance_by(double resolution, double length = 1) {
  std::array<char, 32> digits{};
  constexpr int of_float = 7;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), length / resolution,
                                 std::chars_format::general, of_float)
                       .ptr;
  return as_distance(number_in({digits.data(), static_cast<std::size_t>(end - digits.data())}));
}

/// The value in a line `key=value`.
std::string_view value_in(std::string_view description, std::string_view key) {
  while (!description.empty()) {
    const std::size_t end = std::min(description.find('\n'), description.size());
    const std::string_view line = description.substr(0, end);
    if (line.size() > key.size() && line.starts_with(key) && line[key.size()] == '=')
      return without_blanks(line.substr(key.size() + 1));
    description.remove_prefix(std::min(end + 1, description.size()));
  }
  return {};
}

std::uint64_t count_of(std::string_view text, std::uint64_t otherwise) {
  const auto number = number_in(text);
  constexpr double most = 1e15;
  if (!number || !(*number >= 0 && *number <= most)) return otherwise;
  return static_cast<std::uint64_t>(*number);
}

ImageDistances of_image_j(std::string_view description, const TiffResolution& resolution) {
  ImageDistances result;
  result.is_image_j = result.is_described = true;
  result.images = count_of(value_in(description, "images"), 0);
  result.channels = count_of(value_in(description, "channels"), 1);
  result.times = count_of(value_in(description, "frames"), 1);
  if (const LengthUnit* const unit = find_unit(value_in(description, "unit")))
    result.unit = unit->written;
  // In that unit, whatever the tag says.
  result.x = distance_by(resolution.x);
  result.y = distance_by(resolution.y);
  result.z = as_distance(number_in(value_in(description, "spacing")));
  return result;
}

/// The value of an attribute in the inside of a tag.
std::string_view attribute(std::string_view tag, std::string_view name) {
  for (std::size_t at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1)) {
    const std::size_t behind = at + name.size();
    const bool begins =
        at > 0 && std::string_view(" \t\r\n").find(tag[at - 1]) != std::string_view::npos;
    if (!begins || tag.substr(behind, 1) != "=" || behind + 1 >= tag.size()) continue;
    const std::string_view rest = tag.substr(behind + 2);
    return rest.substr(0, rest.find(tag[behind + 1]));
  }
  return {};
}

ImageDistances of_ome(std::string_view pixels) {
  ImageDistances result;
  result.is_described = true;
  result.images = count_of(attribute(pixels, "SizeZ"), 0);
  result.channels = count_of(attribute(pixels, "SizeC"), 1);
  result.times = count_of(attribute(pixels, "SizeT"), 1);
  const auto unit = [&](std::string_view name) {
    const std::string_view text = attribute(pixels, name);
    return text.empty() ? find_unit("um") : find_unit(text);
  };
  const LengthUnit* const first = unit("PhysicalSizeXUnit");
  if (first != nullptr) result.unit = first->written;
  const auto distance = [&](std::string_view name, const LengthUnit* own) -> std::optional<double> {
    const auto number = as_distance(number_in(attribute(pixels, name)));
    if (!number || own == first) return number;
    if (own == nullptr || first == nullptr) return {};  // of pixels or the like
    return *number *
           (metres_per_unit(own->written).value() / metres_per_unit(first->written).value());
  };
  result.x = distance("PhysicalSizeX", first);
  result.y = distance("PhysicalSizeY", unit("PhysicalSizeYUnit"));
  result.z = distance("PhysicalSizeZ", unit("PhysicalSizeZUnit"));
  return result;
}

/// The inside of a tag of XML.
std::string_view tag_in(std::string_view xml, std::string_view name) {
  for (std::size_t at = xml.find(name); at != std::string_view::npos; at = xml.find(name, at + 1)) {
    if (at == 0 || (xml[at - 1] != '<' && xml[at - 1] != ':')) continue;
    const std::string_view rest = xml.substr(at + name.size());
    if (!rest.empty() && std::string_view(" \t\r\n").find(rest[0]) != std::string_view::npos)
      return rest.substr(0, rest.find('>'));
  }
  return {};
}

ImageDistances of_resolution(const TiffResolution& resolution) {
  ImageDistances result;
  if (resolution.unit != 2 && resolution.unit != 3) return result;
  const double unit_mm = resolution.unit == 2 ? 25.4 : 10;
  result.x = distance_by(resolution.x, unit_mm);
  result.y = distance_by(resolution.y, unit_mm);
  result.unit = "mm";
  return result;
}

}  // namespace

ImageDistances read_image_distances(std::string_view description,
                                    const TiffResolution& resolution) {
  if (description.starts_with("ImageJ=")) return of_image_j(description, resolution);
  const bool is_ome = description.find("OME") != std::string_view::npos;
  if (const std::string_view pixels = tag_in(description, "Pixels"); is_ome && !pixels.empty())
    return of_ome(pixels);
  return of_resolution(resolution);
}

void set_distances(Volume& volume, const ImageDistances& distances, const ReadOptions& options) {
  const bool has_all = distances.x && distances.y && distances.z;
  if (distances.is_described) volume.unit = distances.unit;
  volume.has_spacing = has_all;
  if (has_all) {
    volume.to_world[0][0] = *distances.x;
    volume.to_world[1][1] = *distances.y;
    volume.to_world[2][2] = *distances.z;
  }
  if (has_all || options.spacing) return;
  std::string what = "it does not say how far its slices are apart";
  if (distances.x && distances.y)
    what += "; its pixels are " + exact(*distances.x) + " (x) and " + exact(*distances.y) +
            " (y) " + (distances.unit.empty() ? "" : distances.unit + ' ') + "apart";
  else if (distances.z)
    what = "it does not say how far its pixels are apart";
  if (distances.is_image_j && !distances.z) what += " (ImageJ leaves out a distance of 1)";
  throw InputError(volume.name + ": " + what + "; give all distances with --spacing x,y,z");
}

}  // namespace loft::io
