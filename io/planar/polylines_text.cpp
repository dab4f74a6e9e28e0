// SPDX-License-Identifier: MIT
#include "io/planar/polylines_text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/text_reader.h"
#include "io/planar/coordinate.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

constexpr std::string_view head_form = "a line `n closed`: a count of points, then 0 or 1";

/// The line `n closed` in front of a polyline's points.
struct Head {
  std::int64_t count = 0;
  cdt::Ends ends = cdt::open;
};

class PolylineTextReader {
 public:
  PolylineTextReader(std::string_view text, std::string_view name)
      : text_(text, name), name_(name), size_(text.size()) {
    text_.set_comments();
  }

  std::vector<Polyline> read() {
    try {
      while (text_.next_line()) read_polyline();
    } catch (const InputError& error) {
      problems_.add(error.what());  // the lines behind cannot be told apart
    }
    problems_.raise(name_);
    if (polylines_.empty()) {
      throw InputError(std::string(name_) + ": no polylines in it; expected " +
                       std::string(head_form) + ", then n lines `x y`");
    }
    return std::move(polylines_);
  }

 private:
  void read_polyline() {
    const Head head = read_head();
    Polyline polyline;
    polyline.ends = head.ends;
    constexpr std::size_t shortest_line = 4;
    polyline.points.reserve(
        std::min(static_cast<std::size_t>(head.count), size_ / shortest_line + 1));
    for (std::int64_t i = 0; i < head.count; ++i) {
      if (!text_.next_line()) {
        text_.fail("the file ends where point " + std::to_string(i) + " of " +
                   std::to_string(head.count) + " of polyline " +
                   std::to_string(polylines_.size()) + " should be");
      }
      polyline.points.push_back(read_point());
    }
    polylines_.push_back(std::move(polyline));
  }

  Head read_head() {
    const auto count = text_.word();
    const auto closed = text_.word();
    if (!closed || text_.word()) text_.fail("expected " + std::string(head_form));
    Head head;
    head.count = text_.to_integer(*count, "a count of points");
    if (head.count < 1) text_.fail("expected a count of 1 or more, found " + in_quotes(*count));
    if (*closed != "0" && *closed != "1") {
      text_.fail("expected 0 for open or 1 for closed, found " + in_quotes(*closed));
    }
    head.ends = *closed == "1" ? cdt::closed : cdt::open;
    return head;
  }

  /// A bad point is noted, and stands for itself until all is read.
  cdt::Point read_point() {
    try {
      const double x = read_coordinate("x");
      const double y = read_coordinate("y");
      if (const auto more = text_.word()) {
        text_.fail("expected a line `x y`, found a third word " + in_quotes(*more));
      }
      return {x, y};
    } catch (const InputError& error) {
      problems_.add(error.what());
      return {};
    }
  }

  double read_coordinate(std::string_view wanted) {
    const double value = text_.number(wanted);
    if (!is_coordinate(value)) text_.fail(std::string(wanted) + ": " + why_no_coordinate(value));
    return value;
  }

  TextReader text_;
  std::string_view name_;
  std::size_t size_;
  Problems problems_;
  std::vector<Polyline> polylines_;
};

}  // namespace

std::vector<Polyline> read_polylines_text(std::string_view text, std::string_view name) {
  return PolylineTextReader(without_mark(text), name).read();
}

void write_polylines_text(std::ostream& out, std::span<const Polyline> polylines) {
  for (const Polyline& polyline : polylines) {
    std::string text = std::to_string(polyline.points.size());
    text += polyline.ends == cdt::closed ? " 1\n" : " 0\n";
    for (const cdt::Point& point : polyline.points) {
      append_number(text, point.x);
      text += ' ';
      append_number(text, point.y);
      text += '\n';
    }
    out << text;
  }
}

}  // namespace loft::io
