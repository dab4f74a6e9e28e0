// SPDX-License-Identifier: MIT
#include "io/volumes/mask_outlines.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace loft::io {

namespace {

constexpr std::uint32_t none = SparseTable::none;
/// Beside the next crossing: the corner between is cut off, as its pixels meet others there.
constexpr std::uint32_t is_cut = std::uint32_t{1} << 31;

constexpr bool is_above(std::uint32_t crossing) { return (crossing & 2) != 0; }
constexpr bool is_second(std::uint32_t crossing) { return (crossing & 1) != 0; }

/// Of labels around a square, whether two of the same that are opposite of each other are cut off
/// there, the one at that corner and the one opposite; none: lines meet in one point, if at all.
/// Others go through between them: the smaller label, and what is outside of all.
std::optional<std::size_t> cut_corner(const std::array<std::uint32_t, 4>& corners) {
  const bool is_first = corners[0] == corners[2];
  const bool is_second = corners[1] == corners[3];
  const auto differs = [&](std::size_t corner) {
    return corners[corner] != corners[corner + 1] && corners[corner] != corners[(corner + 3) % 4];
  };
  if (is_first && differs(0)) return corners[0] < corners[1] && (is_second || corners[0] == 0);
  if (is_second && differs(1)) return corners[1] == 0 ? 0 : 1;
  return {};
}

}  // namespace

bool MaskOutlines::size_fits(std::uint32_t columns, std::uint32_t rows) {
  constexpr std::uint64_t most = std::uint64_t{1} << 28;
  return columns > 0 && rows > 0 && columns < most && rows < most &&
         (std::uint64_t{columns} + 2) * (std::uint64_t{rows} + 2) <= most;
}

MaskOutlines::MaskOutlines(std::uint32_t columns, std::uint32_t rows, Outline outline)
    : columns_(columns),
      rows_(rows),
      width_(std::size_t{columns} + 2),
      outline_(outline),
      labels_(width_ * (std::size_t{rows} + 2)),
      next_(4 * labels_.size()) {}

std::span<std::uint32_t> MaskOutlines::row(std::uint32_t row) {
  return std::span(labels_).subspan((std::size_t{row} + 1) * width_ + 1, columns_);
}

std::vector<PixelOutline> MaskOutlines::trace(std::span<const double> values,
                                              std::optional<double> level) {
  values_ = values;
  level_ = level;
  starts_.clear();
  next_.clear();
  for (std::size_t y = 0; y <= rows_; ++y) {
    const std::uint32_t* const low = &labels_[y * width_];
    const std::uint32_t* const high = low + width_;
    for (std::size_t x = 0; x <= columns_; ++x)
      if (low[x] != low[x + 1] || low[x] != high[x] || low[x] != high[x + 1])
        cross_cell(y * width_ + x);
  }
  if (outline_ == Outline::fair) return trace_fair();
  std::vector<PixelOutline> outlines;
  for (const Start& start : starts_) {
    if (next_[start.crossing] == none) continue;  // on an outline already
    const std::vector<Crossing> loop = take_loop(start.crossing);
    outlines.push_back(
        {start.label, outline_ == Outline::edges ? edge_points(loop) : iso_points(loop)});
  }
  return outlines;
}

/// Lines through the square between four centres: each run of corners of a label, going round to
/// the left, is cut off from where it is left back to where it is entered. Corners of a label that
/// are opposite of each other are two runs.
void MaskOutlines::cross_cell(std::size_t place) {
  const std::array corners = this->corners(place);
  const auto crossing = [](std::size_t pixel, std::uint32_t above, std::uint32_t second) {
    return static_cast<Crossing>(4 * pixel + 2 * above + second);
  };
  // The side from corner i to the next, left at the former and entered at the latter.
  const std::array leave{crossing(place, 0, 0), crossing(place + 1, 1, 0),
                         crossing(place + width_, 0, 1), crossing(place, 1, 1)};
  const std::array enter{crossing(place, 0, 1), crossing(place + 1, 1, 1),
                         crossing(place + width_, 0, 0), crossing(place, 1, 0)};
  const auto cut = outline_ == Outline::fair ? cut_corner(corners) : std::nullopt;
  for (std::size_t first = 0; first < 4; ++first) {
    const std::uint32_t label = corners[first];
    if (label == 0 || label == corners[(first + 3) % 4]) continue;
    std::size_t last = first;
    while (corners[(last + 1) % 4] == label) last = (last + 1) % 4;
    if (cut && first % 2 != *cut && corners[(first + 2) % 4] == label) {  // goes through
      next_.set(leave[first], enter[(first + 1) % 4]);
      starts_.push_back({leave[first], label});
      continue;
    }
    const bool meets = last == first && corners[(first + 2) % 4] == label;
    next_.set(leave[last],
              enter[(first + 3) % 4] | (meets && outline_ == Outline::edges ? is_cut : 0));
    starts_.push_back({leave[last], label});
  }
}

std::array<std::uint32_t, 4> MaskOutlines::corners(std::size_t place) const {
  return {labels_[place], labels_[place + 1], labels_[place + width_ + 1], labels_[place + width_]};
}

std::vector<PixelOutline> MaskOutlines::trace_fair() {
  SquareOutlines squares;
  std::vector<PixelOutline> outlines;
  for (const Start& start : starts_) {
    if (next_[start.crossing] == none) continue;  // on an outline already
    add_squares(take_loop(start.crossing), squares);
    outlines.push_back({start.label, {}});
  }
  const std::vector<cdt::Point> places = squares.fair();
  for (std::size_t i = 0; i < outlines.size(); ++i)
    for (const std::uint32_t point : squares.net().loop(i))
      outlines[i].points.push_back(places[point]);
  return outlines;
}

/// The squares that an outline goes through.
void MaskOutlines::add_squares(std::span<const Crossing> loop, SquareOutlines& squares) const {
  using Half = SquareOutlines::Half;
  constexpr std::array halves{Half::lower_left, Half::lower_right, Half::upper_right,
                              Half::upper_left};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Crossing from = loop[i];
    const Crossing to = loop[(i + 1) % loop.size()];
    // The sides are those that the square was entered and left by in cross_cell().
    const std::size_t from_side =
        is_above(from) ? (is_second(from) ? 3 : 1) : (is_second(from) ? 2 : 0);
    const std::size_t to_side = is_above(to) ? (is_second(to) ? 1 : 3) : (is_second(to) ? 0 : 2);
    const std::size_t place = from / 4 - (from_side == 1 ? 1 : 0) - (from_side == 2 ? width_ : 0);
    const auto x = static_cast<std::uint32_t>(place % width_);
    const auto y = static_cast<std::uint32_t>(place / width_);
    const auto cut = cut_corner(corners(place));
    if (!cut) {
      squares.add(x, y, Half::none);
      continue;
    }
    const auto corner_at = [&](std::size_t side) {
      return side % 2 == *cut ? side : (side + 1) % 4;
    };
    squares.add(x, y, halves[corner_at(from_side)]);
    if (corner_at(from_side) != corner_at(to_side)) squares.add(x, y, halves[corner_at(to_side)]);
  }
  squares.end_outline();
}

/// The crossings of an outline, each marked if the corner before the next is cut off. Nobody else
/// meets them again.
std::vector<MaskOutlines::Crossing> MaskOutlines::take_loop(Crossing start) {
  std::vector<Crossing> loop;
  for (Crossing crossing = start; next_[crossing] != none;) {
    const Crossing next = next_[crossing];
    next_.set(crossing, none);
    loop.push_back(crossing | (next & is_cut));
    crossing = next & ~is_cut;
  }
  return loop;
}

/// How far an outline crosses from one pixel to the other.
double MaskOutlines::share(std::size_t first, std::size_t second) const {
  const auto value = [&](std::size_t pixel) {
    const std::size_t x = pixel % width_;
    const std::size_t y = pixel / width_;
    if (x == 0 || y == 0 || x > columns_ || y > rows_) return std::nan("");  // beyond the image
    return values_[(y - 1) * columns_ + x - 1];
  };
  constexpr double half = 0.5;
  constexpr double nearest = 1.0 / 64;
  if (!level_) return half;
  const double share = (*level_ - value(first)) / (value(second) - value(first));
  return std::isfinite(share) ? std::clamp(share, nearest, 1 - nearest) : half;
}

cdt::Point MaskOutlines::centre(std::size_t pixel) const {
  const std::size_t row = pixel / width_;
  return {static_cast<double>(pixel % width_) - 1, static_cast<double>(row) - 1};
}

cdt::Point MaskOutlines::iso_point(Crossing crossing) const {
  const std::size_t pixel = (crossing & ~is_cut) / 4;
  const auto [x, y] = centre(pixel);
  if (is_above(crossing)) return {x, y + share(pixel, pixel + width_)};
  return {x + share(pixel, pixel + 1), y};
}

std::vector<cdt::Point> MaskOutlines::iso_points(std::span<const Crossing> loop) const {
  std::vector<cdt::Point> points;
  points.reserve(loop.size());
  for (const Crossing crossing : loop) points.push_back(iso_point(crossing));
  return points;
}

/// Corners of pixels that an outline turns at: between a crossing to the side and one above.
std::vector<cdt::Point> MaskOutlines::edge_points(std::span<const Crossing> loop) const {
  constexpr double cut = 0.25;  // of the way back to the middles of the edges
  std::vector<cdt::Point> points;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Crossing here = loop[i];
    const Crossing next = loop[(i + 1) % loop.size()];
    if (is_above(here) == is_above(next)) continue;
    const auto middle = [this](Crossing crossing) {
      const auto [x, y] = centre((crossing & ~is_cut) / 4);
      const double half = 0.5;
      return cdt::Point{x + (is_above(crossing) ? 0 : half), y + (is_above(crossing) ? half : 0)};
    };
    const cdt::Point from = middle(here);
    const cdt::Point to = middle(next);
    const cdt::Point corner = is_above(here) ? cdt::Point{to.x, from.y} : cdt::Point{from.x, to.y};
    if ((here & is_cut) == 0) {
      points.push_back(corner);
      continue;
    }
    points.push_back({corner.x + cut * (from.x - corner.x), corner.y + cut * (from.y - corner.y)});
    points.push_back({corner.x + cut * (to.x - corner.x), corner.y + cut * (to.y - corner.y)});
  }
  return points;
}

}  // namespace loft::io
