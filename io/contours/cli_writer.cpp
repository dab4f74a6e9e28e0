// SPDX-License-Identifier: MIT
#include "io/contours/cli_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <map>
#include <ostream>
#include <set>
#include <span>
#include <utility>

#include "io/bytes/text.h"
#include "io/contours/slice_outlines.h"
#include "io/contours/winding.h"
#include "io/unit.h"
#include "reconstruct/world.h"

namespace loft::io {

namespace {

/// With as few digits as give it back exactly, and no exponent: not all readers know those.
void append_decimal(std::string& text, double number) {
  std::array<char, 400> digits;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed)
          .ptr;
  text.append(digits.data(), end);
}

/// As a name in the header, where `$$` begins an entry.
std::string part_name(const std::string& label) {
  std::string text = one_line(label);
  for (std::size_t i = text.find("$$"); i != std::string::npos; i = text.find("$$", i))
    text[i + 1] = '_';
  return text;
}

/// Whether slices are level in the world.
bool is_level(const Stack& stack) {
  return !stack.frame || (stack.frame->rows[2][0] == 0 && stack.frame->rows[2][1] == 0);
}

/// How many mm a unit is; 1 where the stack does not say.
double millimetres(const std::string& unit) {
  if (unit == "mm") return 1;
  return 1000 * metres_per_unit(unit).value_or(0.001);
}

struct Outline {
  std::string label;
  bool is_outer = true;
  std::vector<cdt::Point> points;
};

struct Layer {
  double z = 0;
  std::vector<Outline> outlines;
};

class CliWriter {
 public:
  CliWriter(std::ostream& out, const Stack& stack)
      : out_(out), stack_(stack), is_level_(is_level(stack)) {}

  std::vector<std::string> write() {
    std::vector<Layer> layers;
    for (std::uint32_t s = 0; s < stack_.slices.size(); ++s) layers.push_back(layer(s));
    std::ranges::stable_sort(layers, {}, &Layer::z);
    write_header(layers);
    for (const Layer& layer : layers) write_layer(layer);
    out_ << "$$GEOMETRYEND\r\n";
    return losses();
  }

 private:
  Layer layer(std::uint32_t s) {
    Layer result{stack_.slices[s].z, {}};
    if (is_level_ && stack_.frame) result.z = stack_.frame->at({0, 0, result.z})[2];
    for (const auto& [label, region] : slice_outlines(stack_, s)) {
      lines_ += region.line_count();
      for (std::size_t i = 0; i < region.loop_count(); ++i) {
        Outline outline{label, true, points(region, region.loop(i))};
        outline.is_outer = doubled_area(outline.points) > 0;
        if (is_mirrored()) {
          outline.is_outer = !outline.is_outer;
          std::ranges::reverse(outline.points);
        }
        result.outlines.push_back(std::move(outline));
      }
      if (region.loop_count() > 0) parts_.try_emplace(label, parts_.size() + 1);
    }
    return result;
  }

  /// Whether an outline that goes counterclockwise in its slice goes clockwise in the world.
  [[nodiscard]] bool is_mirrored() const {
    return is_level_ && stack_.frame && stack_.frame->rows[2][2] < 0;
  }

  [[nodiscard]] std::vector<cdt::Point> points(const Region& region,
                                               std::span<const std::uint32_t> loop) const {
    std::vector<cdt::Point> result;
    for (const std::uint32_t v : loop) {
      const cdt::Point& point = region.points[v];
      if (is_level_) {
        const Vec3 place = world_place(stack_, {point.x, point.y, region.z}, region.origins[v]);
        result.push_back({place[0], place[1]});
      } else {
        result.push_back(point);
      }
    }
    return result;
  }

  void write_header(const std::vector<Layer>& layers) {
    std::string text = "$$HEADERSTART\r\n$$ASCII\r\n$$UNITS/";
    append_decimal(text, millimetres(stack_.unit));
    text += "\r\n$$VERSION/200\r\n";
    for (const auto& [label, id] : parts_)
      if (!label.empty()) text += "$$LABEL/" + std::to_string(id) + ',' + part_name(label) + "\r\n";
    append_dimension(text, layers);
    text += "$$LAYERS/" + std::to_string(layers.size()) + "\r\n$$HEADEREND\r\n$$GEOMETRYSTART\r\n";
    out_ << text;
  }

  void append_dimension(std::string& text, const std::vector<Layer>& layers) const {
    constexpr double largest = std::numeric_limits<double>::max();
    cdt::Point low{largest, largest};
    cdt::Point high{-largest, -largest};
    for (const Layer& layer : layers)
      for (const Outline& outline : layer.outlines)
        for (const cdt::Point& point : outline.points) {
          low = {std::min(low.x, point.x), std::min(low.y, point.y)};
          high = {std::max(high.x, point.x), std::max(high.y, point.y)};
        }
    if (low.x > high.x) return;
    const double unit = millimetres(stack_.unit);
    text += "$$DIMENSION/";
    const char* between = "";
    for (const double side : {low.x, low.y, layers.front().z, high.x, high.y, layers.back().z}) {
      text += std::exchange(between, ",");
      append_decimal(text, side * unit);
    }
    text += "\r\n";
  }

  void write_layer(const Layer& layer) {
    std::string text = "$$LAYER/";
    append_decimal(text, layer.z);
    text += "\r\n";
    for (const Outline& outline : layer.outlines) {
      text += "$$POLYLINE/" + std::to_string(parts_.at(outline.label)) +
              (outline.is_outer ? ",1," : ",0,") + std::to_string(outline.points.size() + 1);
      for (const cdt::Point& point : outline.points) append(text, point);
      append(text, outline.points.front());  // closed by repeating the first, as all files do
      text += "\r\n";
    }
    out_ << text;
  }

  static void append(std::string& text, const cdt::Point& point) {
    text += ',';
    append_decimal(text, point.x);
    text += ',';
    append_decimal(text, point.y);
  }

  [[nodiscard]] std::vector<std::string> losses() const {
    std::vector<std::string> result;
    if (!is_level_)
      result.emplace_back(
          "CLI has no tilted planes: the layers are as the slices have them, and where they lie in "
          "the world is left out");
    if (stack_.unit.empty())
      result.emplace_back("CLI is in mm, and the stack does not say its unit: taken as mm");
    else if (!metres_per_unit(stack_.unit))
      result.push_back("CLI is in mm, and the stack's unit " + in_quotes(stack_.unit) +
                       " is no length: taken as mm");
    if (lines_ > 0)
      result.push_back("contours without an area: " + std::to_string(lines_) + " left out");
    if (std::ranges::any_of(stack_.labels,
                            [](const StackLabel& l) { return l.colour.has_value(); }))
      result.emplace_back("CLI has no colours: left out");
    return result;
  }

  std::ostream& out_;
  const Stack& stack_;
  bool is_level_;
  std::map<std::string, std::size_t> parts_;  // their numbers
  std::size_t lines_ = 0;
};

}  // namespace

std::vector<std::string> write_cli(std::ostream& out, const Stack& stack) {
  return CliWriter(out, stack).write();
}

}  // namespace loft::io
