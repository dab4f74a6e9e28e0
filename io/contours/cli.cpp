// SPDX-License-Identifier: MIT
#include "io/contours/cli.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "io/bytes/byte_reader.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/contours/cli_header.h"
#include "io/contours/stack_builder.h"
#include "io/contours/winding.h"
#include "mesh/admitted.h"
#include "reconstruct/number_text.h"
#include "reconstruct/usable.h"

namespace loft::io {

namespace {

enum Direction : std::int64_t { inner = 0, outer = 1, open = 2 };

/// What the commands of a file, of either kind, make.
class Layers {
 public:
  Layers(const CliHeader& header, std::string_view name)
      : header_(header), name_(name), builder_(name) {}

  /// `place` is how messages name it: `line 12`.
  void begin_layer(double units, const std::string& place) {
    z_ = units * header_.units;
    ++layers_;
    if (check(z_, "a layer's height", place)) builder_.add_height(z_);
  }

  void add_polyline(std::int64_t id, std::int64_t direction, std::vector<cdt::Point> points,
                    const std::string& place) {
    if (layers_ == 0) complain(place, "a polyline comes before the first layer");
    if (direction < inner || direction > open)
      return complain(place, "the direction " + std::to_string(direction) +
                                 " of a polyline is none; 0 is inside, 1 outside, 2 open");
    if (direction == open) return builder_.skip(label(id), "open polyline");
    bool is_good = true;
    for (cdt::Point& point : points) {
      point = {point.x * header_.units, point.y * header_.units};
      is_good = is_good && check(point.x, "x", place) && check(point.y, "y", place);
    }
    if (!is_good) return;
    if ((doubled_area(points) < 0) == (direction == outer))
      std::reverse(points.begin(), points.end());
    builder_.add({std::move(points), label(id), place}, z_);
  }

  void add_hatches(std::int64_t id, std::size_t count) {
    builder_.skip(label(id), "hatch line", count);
  }

  void complain(const std::string& place, const std::string& problem) {
    problems_.add(std::string(name_) + ": " + place + ": " + problem);
  }

  Stack finish() {
    problems_.raise(name_);
    Stack stack;
    stack.unit = "mm";
    stack.fill = Fill::nonzero;
    builder_.finish(
        stack, "hatches and supports enclose nothing: export the outlines of the part's layers");
    if (header_.layers && static_cast<double>(layers_) < *header_.layers)
      stack.notes.push_back("only " + std::to_string(layers_) + " of the " +
                            exact(*header_.layers) +
                            " layers that the header counts are there; was the file cut off?");
    for (const auto& [id, name] : header_.labels)
      if (used_.contains(id)) stack.labels.push_back({label(id), {}, std::to_string(id), "", {}});
    return stack;
  }

 private:
  bool check(double value, const char* what, const std::string& place) {
    if (admitted::slice.admits(value)) return true;
    complain(place, std::string(what) + ": " + why_not_admitted(value, admitted::slice));
    return false;
  }

  /// Parts of the same name are not one.
  std::string label(std::int64_t id) {
    used_.insert(id);
    const auto found = header_.labels.find(id);
    if (found == header_.labels.end() || found->second.empty())
      return header_.labels.empty() ? "" : "part " + std::to_string(id);
    const auto shares = [&](const auto& other) { return other.second == found->second; };
    if (std::ranges::count_if(header_.labels, shares) == 1) return found->second;
    return found->second + " (part " + std::to_string(id) + ')';
  }

  const CliHeader& header_;
  std::string_view name_;
  StackBuilder builder_;
  Problems problems_;
  std::set<std::int64_t> used_;
  double z_ = 0;
  std::size_t layers_ = 0;
};

/// The commands of an ASCII file.
class AsciiReader {
 public:
  AsciiReader(std::string_view bytes, const CliHeader& header, Layers& layers)
      : bytes_(bytes), layers_(layers), counted_(header.end) {
    line_ += static_cast<std::size_t>(std::ranges::count(bytes_.substr(0, counted_), '\n'));
  }

  void read() {
    for (std::size_t begin = bytes_.find("$$", counted_); begin < bytes_.size();) {
      const std::size_t next = std::min(bytes_.find("$$", begin + 2), bytes_.size());
      line_ += static_cast<std::size_t>(
          std::ranges::count(bytes_.substr(counted_, begin - counted_), '\n'));
      counted_ = begin;
      read_command(bytes_.substr(begin + 2, next - begin - 2));
      begin = next;
    }
  }

 private:
  [[nodiscard]] std::string place() const { return "line " + std::to_string(line_); }
  void complain(const std::string& problem) { layers_.complain(place(), problem); }

  void read_command(std::string_view text) {
    text = text.substr(0, text.find("//"));
    const std::size_t slash = std::min(text.find('/'), text.size());
    const std::string_view name = text.substr(0, slash);
    std::string_view parameters = text.substr(std::min(slash + 1, text.size()));
    if (name == "LAYER") {
      if (const auto z = number(parameters, "a height")) layers_.begin_layer(*z, place());
    } else if (name == "POLYLINE") {
      read_polyline(parameters);
    } else if (name == "HATCHES") {
      const auto id = whole(parameters, "a part's number");
      const auto count = whole(parameters, "a count of hatches");
      if (id && count && *count >= 0) layers_.add_hatches(*id, static_cast<std::size_t>(*count));
    }
  }

  std::optional<double> number(std::string_view& parameters, const char* wanted) {
    std::string_view word = next_parameter(parameters);
    word = word.substr(0, word.find_last_not_of(" \t\r\n") + 1);
    const auto value = cli_number(word);
    if (!value) complain("expected " + std::string(wanted) + ", found " + in_quotes(word));
    return value;
  }
  std::optional<std::int64_t> whole(std::string_view& parameters, const char* wanted) {
    const auto value = number(parameters, wanted);
    constexpr double most = 1e15;
    if (!value || (std::abs(*value) < most && *value == std::floor(*value)))
      return value ? std::optional(static_cast<std::int64_t>(*value)) : std::nullopt;
    complain("expected " + std::string(wanted) + ", found a number that is none");
    return {};
  }

  void read_polyline(std::string_view parameters) {
    const auto id = whole(parameters, "a part's number");
    const auto direction = id ? whole(parameters, "a direction") : id;
    const auto count = direction ? whole(parameters, "a count of points") : id;
    if (!id || !direction || !count) return;
    const auto there = parameters.empty() ? 0 : std::ranges::count(parameters, ',') + 1;
    if (there != 2 * *count)
      return complain("a polyline of " + std::to_string(*count) + " points has " +
                      std::to_string(there) + " coordinates; it is cut off or damaged");
    std::vector<cdt::Point> points;
    points.reserve(static_cast<std::size_t>(*count));
    while (!parameters.empty()) {
      const auto x = number(parameters, "x");
      const auto y = x ? number(parameters, "y") : x;
      if (!x || !y) return;
      points.push_back({*x, *y});
    }
    layers_.add_polyline(*id, *direction, std::move(points), place());
  }

  std::string_view bytes_;
  Layers& layers_;
  std::size_t counted_;  // to where lines were counted
  std::size_t line_ = 1;
};

/// Whether short coordinates are signed, by what they span either way.
class Signs {
 public:
  void add(std::uint16_t x, std::uint16_t y) {
    unsigned_.add(x, y);
    signed_.add(static_cast<std::int16_t>(x), static_cast<std::int16_t>(y));
  }
  [[nodiscard]] bool is_signed(const CliHeader& header) const {
    if (header.dimension) return signed_.distance(header) <= unsigned_.distance(header);
    return signed_.span() <= unsigned_.span();
  }

 private:
  struct Box {
    double least[2] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    double most[2] = {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};

    void add(double x, double y) {
      const double place[] = {x, y};
      for (int i = 0; i < 2; ++i) {
        least[i] = std::min(least[i], place[i]);
        most[i] = std::max(most[i], place[i]);
      }
    }
    [[nodiscard]] double span() const { return most[0] - least[0] + (most[1] - least[1]); }
    /// From the box of the header.
    [[nodiscard]] double distance(const CliHeader& header) const {
      double sum = 0;
      for (std::size_t i = 0; i < 2; ++i)
        sum += std::abs(least[i] * header.units - (*header.dimension)[i]) +
               std::abs(most[i] * header.units - (*header.dimension)[i + 3]);
      return sum;
    }
  };
  Box unsigned_;
  Box signed_;
};

/// The commands of a binary file. They are read twice: first for what is to be known of all.
class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, std::string_view name, const CliHeader& header)
      : bytes_(bytes), name_(name), header_(header) {}

  void read(Layers& layers) {
    read_all(nullptr);
    is_signed_ = signs_.is_signed(header_);
    read_all(&layers);
  }

 private:
  enum Command : std::uint16_t {
    long_layer = 127,
    short_layer = 128,
    short_polyline = 129,
    long_polyline = 130,
    short_hatches = 131,
    long_hatches = 132
  };

  void read_all(Layers* layers) {
    ByteReader in(bytes_, name_, std::endian::little);
    static_cast<void>(in.take(header_.end, "the header"));
    while (in.left() > 0) read_command(in, layers);
  }

  void read_command(ByteReader& in, Layers* layers) {
    const std::size_t begin = in.place();
    const auto command = in.number<std::uint16_t>("a command");
    if (header_.is_aligned) static_cast<void>(in.take(2, "a command"));
    const std::string place = "byte " + std::to_string(begin);
    if (command == long_layer || command == short_layer) {
      const double z = command == long_layer
                           ? static_cast<double>(in.number<float>("a layer's height"))
                           : in.number<std::uint16_t>("a layer's height");
      if (layers != nullptr) layers->begin_layer(z, place);
    } else if (command == short_polyline) {
      read_polyline<std::uint16_t, std::uint16_t>(in, layers, place);
    } else if (command == long_polyline) {
      read_polyline<std::int32_t, float>(in, layers, place);
    } else if (command == short_hatches) {
      read_hatches<std::uint16_t, std::uint16_t>(in, layers);
    } else if (command == long_hatches) {
      read_hatches<std::int32_t, float>(in, layers);
    } else {
      in.fail(begin, "the command " + std::to_string(command) +
                         " is unknown, and where it ends; save the file as ASCII");
    }
  }

  template <class Whole>
  static std::uint64_t read_count(ByteReader& in, const char* what) {
    const auto count = in.number<Whole>(what);
    if (count < 0) in.fail(in.place() - sizeof(Whole), std::string(what) + " is negative");
    return static_cast<std::uint64_t>(count);
  }

  template <class Whole, class Coordinate>
  void read_polyline(ByteReader& in, Layers* layers, const std::string& place) {
    const std::int64_t id = in.number<Whole>("a polyline");
    const std::int64_t direction = in.number<Whole>("a polyline");
    const std::uint64_t count = read_count<Whole>(in, "a count of points");
    const std::string_view taken =
        in.take(count * 2 * sizeof(Coordinate), "the points of a polyline");
    std::vector<cdt::Point> points;
    if (layers != nullptr) points.reserve(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < count; ++i) {
      const auto x = in.number_in<Coordinate>(taken, 2 * i);
      const auto y = in.number_in<Coordinate>(taken, 2 * i + 1);
      if (layers != nullptr) {
        points.push_back({value(x), value(y)});
      } else if constexpr (sizeof(Coordinate) == 2) {
        signs_.add(x, y);
      }
    }
    if (layers != nullptr) layers->add_polyline(id, direction, std::move(points), place);
  }

  template <class Whole, class Coordinate>
  static void read_hatches(ByteReader& in, Layers* layers) {
    const std::int64_t id = in.number<Whole>("hatches");
    const std::uint64_t count = read_count<Whole>(in, "a count of hatches");
    static_cast<void>(in.take(count * 4 * sizeof(Coordinate), "hatches"));
    if (layers != nullptr) layers->add_hatches(id, static_cast<std::size_t>(count));
  }

  [[nodiscard]] double value(std::uint16_t number) const {
    return is_signed_ ? static_cast<std::int16_t>(number) : number;
  }
  [[nodiscard]] static double value(float number) { return static_cast<double>(number); }

  std::string_view bytes_;
  std::string_view name_;
  const CliHeader& header_;
  Signs signs_;
  bool is_signed_ = true;
};

}  // namespace

Stack read_cli(const StackInput& input, const ReadOptions&) {
  const CliHeader header = read_cli_header(input.bytes, input.name);
  Layers layers(header, input.name);
  if (header.is_binary) {
    BinaryReader(input.bytes, input.name, header).read(layers);
  } else {
    AsciiReader(input.bytes, header, layers).read();
  }
  return layers.finish();
}

bool begins_like_cli(std::string_view bytes) { return bytes.starts_with("$$HEADERSTART"); }

}  // namespace loft::io
