// SPDX-License-Identifier: MIT
#include "io/planar/moving_ai.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/words.h"
#include "io/planar/coordinate.h"

namespace loft::io {

namespace {

using cdt::Point;

/// Lines one by one, with their number for messages.
class NumberedLines {
 public:
  NumberedLines(std::string_view text, std::string_view name)
      : text_(without_mark(text)), name_(name) {}

  /// None at the end.
  std::optional<std::string_view> next() {
    if (text_.empty()) return {};
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  [[nodiscard]] std::string place() const {
    return std::string(name_) + ':' + std::to_string(number_) + ": ";
  }

 private:
  std::string_view text_;  // what is left of it
  std::string_view name_;
  std::size_t number_ = 0;
};

std::optional<std::uint64_t> count_in(std::string_view word) {
  constexpr double most = 1e9;
  const auto number = number_in(word);
  if (!number || !(*number >= 0 && *number <= most)) return {};
  const auto count = static_cast<std::uint64_t>(*number);
  if (static_cast<double>(count) != *number) return {};
  return count;
}

/// Rows of cells, views into the text.
struct Cells {
  std::vector<std::string_view> rows = {};
  std::size_t width = 0;

  [[nodiscard]] bool is_free(std::size_t column, std::size_t row) const {
    if (row >= rows.size() || column >= width) return false;  // those at -1, too
    const char cell = rows[row][column];
    return cell == '.' || cell == 'G' || cell == 'S';
  }
};

class CellsReader {
 public:
  CellsReader(std::string_view text, std::string_view name) : lines_(text, name), name_(name) {}

  Cells read() {
    if (read_head()) read_rows();
    problems_.raise(name_);
    return std::move(cells_);
  }

 private:
  /// Whether rows follow.
  bool read_head() {
    while (const auto line = lines_.next()) {
      const auto words = words_of(*line);
      if (words.empty()) continue;
      if (words.front() == "map") return has_sizes();
      if (words.front() == "height") {
        height_ = read_size(words);
      } else if (words.front() == "width") {
        width_ = read_size(words);
      } else if (words.front() != "type") {
        problems_.add(lines_.place() + "expected `type`, `height`, `width` or `map`, found " +
                      in_quotes(words.front()));
      }
    }
    problems_.add(std::string(name_) + ": no line `map`, with the rows of cells behind it");
    return false;
  }

  std::optional<std::uint64_t> read_size(const std::vector<std::string_view>& words) {
    const auto size = words.size() == 2 ? count_in(words[1]) : std::nullopt;
    if (!size || *size == 0) {
      problems_.add(lines_.place() + "expected `" + std::string(words.front()) +
                    "` and a number of cells from 1 on");
      return std::nullopt;
    }
    return size;
  }

  bool has_sizes() {
    if (!problems_.is_empty()) return false;
    if (!height_) problems_.add(lines_.place() + "no line `height` before it");
    if (!width_) problems_.add(lines_.place() + "no line `width` before it");
    return height_ && width_;
  }

  void read_rows() {
    cells_.width = *width_;
    while (cells_.rows.size() < *height_) {
      const auto line = lines_.next();
      if (!line) {
        problems_.add(std::string(name_) + ": the file ends where row " +
                      std::to_string(cells_.rows.size()) + " of " + std::to_string(*height_) +
                      " should be");
        return;
      }
      read_row(*line);
    }
    while (const auto line = lines_.next())
      if (!without_blanks(*line).empty())
        return problems_.add(lines_.place() + "more rows than the " + std::to_string(*height_) +
                             " that `height` says");
  }

  void read_row(std::string_view line) {
    if (line.size() != *width_)
      problems_.add(lines_.place() + "row " + std::to_string(cells_.rows.size()) + " has " +
                    std::to_string(line.size()) + " cells instead of " + std::to_string(*width_));
    cells_.rows.push_back(line);
  }

  NumberedLines lines_;
  std::string_view name_;
  Problems problems_;
  std::optional<std::uint64_t> height_;
  std::optional<std::uint64_t> width_;
  Cells cells_;
};

/// The outlines of what is free, found from the upright sides of cells: each belongs to one ring.
class OutlineTracer {
 public:
  explicit OutlineTracer(const Cells& cells)
      : cells_(cells), stride_(cells.width + 1), rings_(stride_ * cells.rows.size(), none) {}

  overlay::MultiPolygon trace() {
    for (std::size_t row = 0; row < cells_.rows.size(); ++row)
      for (std::size_t column = 0; column < stride_; ++column)
        if (is_side(column, row) && ring_at(column, row) == none) trace_from(column, row);
    return std::move(polygons_);
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  enum Heading : std::uint8_t { east, south, west, north };  // south: to greater y

  /// A step along the sides of cells: from a corner, in a direction, with what is free on the side
  /// where south is as one goes east.
  struct Walker {
    std::size_t x;
    std::size_t y;
    Heading heading;
  };

  [[nodiscard]] bool is_side(std::size_t column, std::size_t row) const {
    return cells_.is_free(column - 1, row) != cells_.is_free(column, row);
  }
  [[nodiscard]] std::uint32_t& ring_at(std::size_t column, std::size_t row) {
    return rings_[row * stride_ + column];
  }

  /// The first side of a ring that is met, row by row. What is free is on its right for an outer
  /// ring, and for a hole on its left, where the ring of the next side to the left has its polygon.
  void trace_from(std::size_t column, std::size_t row) {
    const bool is_outer = cells_.is_free(column, row);
    const auto ring = static_cast<std::uint32_t>(polygon_of_.size());
    polygon_of_.push_back(is_outer ? polygons_.size() : polygon_left_of(column, row));
    overlay::Ring points =
        walk(is_outer ? Walker{column, row + 1, north} : Walker{column, row, south}, ring);
    if (is_outer)
      polygons_.push_back({.outer = std::move(points), .holes = {}});
    else
      polygons_[polygon_of_.back()].holes.push_back(std::move(points));
  }

  [[nodiscard]] std::size_t polygon_left_of(std::size_t column, std::size_t row) {
    do --column;
    while (!is_side(column, row));
    return polygon_of_[ring_at(column, row)];
  }

  overlay::Ring walk(const Walker& start, std::uint32_t ring) {
    overlay::Ring points;
    Walker at = start;
    do {
      if (at.heading == north) ring_at(at.x, at.y - 1) = ring;
      if (at.heading == south) ring_at(at.x, at.y) = ring;
      step(at);
      const Heading next = next_heading(at);
      if (next != at.heading)
        points.push_back({static_cast<double>(at.x), static_cast<double>(at.y)});
      at.heading = next;
    } while (at.x != start.x || at.y != start.y || at.heading != start.heading);
    return points;
  }

  static void step(Walker& at) {
    if (at.heading == east) ++at.x;
    if (at.heading == south) ++at.y;
    if (at.heading == west) --at.x;
    if (at.heading == north) --at.y;
  }

  /// What is free stays on the same side. Where two free cells touch in a corner alone, the way
  /// goes on around the one that it came along.
  [[nodiscard]] Heading next_heading(const Walker& at) const {
    const auto turned = [&](unsigned by) {
      return static_cast<Heading>((static_cast<unsigned>(at.heading) + by) % 4);
    };
    const bool is_beside_free = is_free_ahead(at, at.heading);
    if (!is_beside_free) return turned(1);
    return is_free_ahead(at, turned(3)) ? turned(3) : at.heading;
  }

  /// Whether the cell beside the way, ahead of the corner and on the side that has to be free, is.
  [[nodiscard]] bool is_free_ahead(const Walker& at, Heading heading) const {
    if (heading == east) return cells_.is_free(at.x, at.y);
    if (heading == south) return cells_.is_free(at.x - 1, at.y);
    if (heading == west) return cells_.is_free(at.x - 1, at.y - 1);
    return cells_.is_free(at.x, at.y - 1);
  }

  const Cells& cells_;
  std::size_t stride_;                   // sides a row
  std::vector<std::uint32_t> rings_;     // by side
  std::vector<std::size_t> polygon_of_;  // by ring
  overlay::MultiPolygon polygons_;
};

/// One line of a scenario. What is a map's name may have blanks.
std::optional<PathQuery> read_scenario_line(std::string_view line, const std::string& place,
                                            Problems& problems) {
  constexpr std::array<std::string_view, 4> names{"x0", "y0", "x1", "y1"};
  const auto words = words_of(line);
  if (words.size() < 9) {
    problems.add(place + "expected `bucket map width height x0 y0 x1 y1 length`, found " +
                 std::to_string(words.size()) + (words.size() == 1 ? " word" : " words"));
    return {};
  }
  std::array<double, 4> ends{};
  bool is_good = true;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const std::string_view word = words[words.size() - 5 + i];
    const auto number = number_in(word);
    if (number && is_coordinate(*number)) {
      ends[i] = *number;
      continue;
    }
    is_good = false;
    problems.add(place + (number ? std::string(names[i]) + ": " + why_no_coordinate(*number)
                                 : "expected a number for " + std::string(names[i]) + ", found " +
                                       in_quotes(word)));
  }
  if (!is_good) return {};
  return PathQuery{.from = {ends[0], ends[1]}, .to = {ends[2], ends[3]}};
}

}  // namespace

Map read_moving_ai_map(std::string_view text, std::string_view name) {
  const Cells cells = CellsReader(text, name).read();
  Feature free{.polygons = OutlineTracer(cells).trace(), .properties = R"({"layer":"free"})"};
  if (free.polygons.empty()) throw InputError(std::string(name) + ": no cell of it is free");
  return {.features = {std::move(free)}};
}

std::vector<PathQuery> read_moving_ai_scenario(std::string_view text, std::string_view name) {
  NumberedLines lines(text, name);
  const auto head = words_of(lines.next().value_or(""));
  if (head.size() != 2 || head[0] != "version" || number_in(head[1]) != 1.0)
    throw InputError(std::string(name) + ":1: expected `version 1`");
  std::vector<PathQuery> queries;
  Problems problems;
  while (const auto line = lines.next()) {
    if (without_blanks(*line).empty()) continue;
    if (auto query = read_scenario_line(*line, lines.place(), problems)) queries.push_back(*query);
  }
  problems.raise(name);
  if (queries.empty()) throw InputError(std::string(name) + ": no queries in it");
  return queries;
}

}  // namespace loft::io
