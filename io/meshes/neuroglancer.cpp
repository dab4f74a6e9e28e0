// SPDX-License-Identifier: MIT
#include "io/meshes/neuroglancer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "io/bytes/json_reader.h"
#include "io/bytes/little_endian.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

/// None where the digits are no number that a segment can have.
std::optional<std::uint64_t> segment_number(std::string_view digits) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size() || number == 0) return {};
  return number;
}

/// The only run of digits in a name.
std::optional<std::uint64_t> number_in_name(std::string_view name) {
  const auto first = std::ranges::find_if(name, is_digit);
  const auto end = std::find_if_not(first, name.end(), is_digit);
  if (first == name.end() || std::any_of(end, name.end(), is_digit)) return {};
  return segment_number({first, end});
}

/// Deals out numbers, each once.
class Numbers {
 public:
  void want(const std::string& label, std::optional<std::uint64_t> number) {
    if (!number || numbers_.contains(label) || !taken_.insert(*number).second) return;
    numbers_[label] = *number;
  }
  void give(const std::string& label) {
    while (taken_.contains(next_)) ++next_;
    want(label, next_);
  }
  [[nodiscard]] std::uint64_t of(const std::string& label) const { return numbers_.at(label); }

 private:
  std::map<std::string, std::uint64_t> numbers_;
  std::set<std::uint64_t> taken_;
  std::uint64_t next_ = 1;
};

/// A list of strings.
template <class Text>
std::string string_list(std::span<const Segment> segments, const Text& text) {
  std::string list = "[";
  for (const Segment& segment : segments) {
    if (list.size() > 1) list += ',';
    append_json_string(list, json_text(text(segment)));
  }
  return list + ']';
}

/// Writes numbers of 4 bytes in blocks.
class Words {
 public:
  explicit Words(std::ostream& out) : out_(out) {}
  ~Words() { flush(); }
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;

  template <class Number>
  void add(Number number) {
    static_assert(sizeof(Number) == 4);
    if (bytes_.size() > 65'532) flush();
    bytes_.resize(bytes_.size() + 4);
    put(bytes_.data() + bytes_.size() - 4, number);
  }

 private:
  void flush() {
    out_.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    bytes_.clear();
  }

  std::ostream& out_;
  std::string bytes_;
};

}  // namespace

std::vector<Segment> segments_of(std::vector<std::string> labels,
                                 std::span<const StackLabel> known) {
  std::ranges::sort(labels);
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  std::map<std::string_view, std::string_view> ids;
  for (const StackLabel& label : known) ids.try_emplace(label.name, label.id);
  Numbers numbers;
  for (const std::string& label : labels)
    if (ids.contains(label)) numbers.want(label, segment_number(ids.at(label)));
  for (const std::string& label : labels) numbers.want(label, number_in_name(label));
  for (const std::string& label : labels) numbers.give(label);
  std::vector<Segment> segments;
  for (std::string& label : labels) segments.push_back({numbers.of(label), std::move(label)});
  return segments;
}

void write_fragment(std::ostream& out, const Part& part, double metres_per_unit) {
  const double factor = nanometres(metres_per_unit);
  const Mesh mesh = to_mesh(*part.surface);
  Words words(out);
  words.add(static_cast<std::uint32_t>(mesh.points.size()));
  for (const Vec3& point : mesh.points)
    for (const double coordinate : point) {
      const float rounded = static_cast<float>(coordinate * factor) + 0.0F;  // -0 is 0
      if (!std::isfinite(rounded))
        throw Error(
            "coordinates are too large for a mesh of Neuroglancer, in nanometres as "
            "32-bit floats; is --unit right?");
      words.add(rounded);
    }
  for (const auto& face : mesh.faces)
    for (const std::uint32_t corner : face) words.add(corner);
}

Mesh read_fragment(const std::string& content, std::string_view name) {
  const auto fail = [name](const char* words) {
    throw InputError(std::string(name) + ": no mesh fragment of Neuroglancer: " + words);
  };
  const std::size_t size = content.size();
  if (size < 4 || (size - 4) % 12 != 0) fail("of no size that one has");
  const std::size_t triples = (size - 4) / 12;
  const auto count = get<std::uint32_t>(content.data());
  if (count > triples) fail("it ends before its vertices do; is it cut off?");
  const auto place = [&](std::size_t triple, std::size_t i) {
    return content.data() + 4 + 12 * triple + 4 * i;
  };
  Mesh mesh;
  for (std::size_t v = 0; v < count; ++v) {
    Vec3& point = mesh.points.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) point[i] = static_cast<double>(get<float>(place(v, i)));
    if (!std::ranges::all_of(point, [](double x) { return std::isfinite(x); }))
      fail("a coordinate is no number");
  }
  for (std::size_t f = count; f < triples; ++f) {
    auto& face = mesh.faces.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) face[i] = get<std::uint32_t>(place(f, i));
    if (std::ranges::any_of(face, [count](std::uint32_t corner) { return corner >= count; }))
      fail("a corner is none of its vertices");
  }
  if (mesh.faces.empty()) fail("it has no triangles");
  return mesh;
}

namespace neuroglancer {

std::string manifest_name(std::uint64_t segment) { return std::to_string(segment) + ":0"; }

std::string fragment_name(std::uint64_t segment) { return std::to_string(segment) + ":0:1"; }

std::string info() {
  return R"({"@type":"neuroglancer_legacy_mesh","segment_properties":")" +
         std::string(properties_folder) + "\"}\n";
}

std::string manifest(std::uint64_t segment) {
  return R"({"fragments":[")" + fragment_name(segment) + "\"]}\n";
}

std::string properties(std::span<const Segment> segments) {
  const auto id = [](const Segment& segment) { return std::to_string(segment.id); };
  const auto label = [](const Segment& segment) { return segment.label; };
  return R"({"@type":"neuroglancer_segment_properties","inline":{"ids":)" +
         string_list(segments, id) + R"(,"properties":[{"id":"label","type":"label","values":)" +
         string_list(segments, label) + "}]}}\n";
}

}  // namespace neuroglancer

}  // namespace loft::io
