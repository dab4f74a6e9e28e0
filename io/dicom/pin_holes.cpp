// SPDX-License-Identifier: MIT
#include "io/dicom/pin_holes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace loft::io {

namespace {

/// Between the sides, in pixels: of one line, and the most of several side by side.
constexpr std::int64_t line_width = 4;
constexpr std::int64_t most_width = 2 * line_width;
/// How long channels of several lines are at least, compared to their width.
constexpr double wide_length = 1.5;

constexpr std::size_t steps_per_point = 2000;
constexpr std::size_t steps_per_pair = 100;  // of sides: so they are few for each point

/// Where the centres of pixels are along an axis.
class Lattice {
 public:
  /// None if the points are on no lattice. All their distances are multiples of a pixel's.
  static std::optional<Lattice> of(const std::vector<SpaceContour>& contours, std::size_t axis) {
    constexpr double rounding = 1e-6;  // of decimals, compared to the largest
    std::vector<double> places;
    for (const SpaceContour& contour : contours)
      for (const Vec3& point : contour.points) places.push_back(point[axis]);
    if (places.empty()) return {};
    std::ranges::sort(places);
    const double width = places.back() - places.front();
    const double least =
        rounding * std::max({std::abs(places.front()), std::abs(places.back()), width});
    std::vector<double> gaps;
    for (std::size_t i = 1; i < places.size(); ++i)
      if (places[i] - places[i - 1] > least) gaps.push_back(places[i] - places[i - 1]);
    if (gaps.empty()) return {};
    double pitch = *std::ranges::min_element(gaps);
    for (const double gap : gaps) pitch = common_measure(gap, pitch, least);
    if (!(pitch > least)) return {};
    const Lattice lattice{places.front(), width / std::round(width / pitch)};
    for (const double place : places)
      if (!lattice.has(place)) return {};
    return lattice;
  }

  [[nodiscard]] std::int64_t index(double place) const {
    return std::llround((place - origin) / pitch);
  }

  double origin;
  double pitch;

 private:
  static constexpr double off = 0.01;  // of a pixel

  /// Of a length and a shorter one, by Euclid's algorithm; not more than `least` if there is none.
  static double common_measure(double length, double measure, double least) {
    while (measure > least) {
      const double rest = std::abs(length - std::round(length / measure) * measure);
      if (rest <= off * measure) break;
      length = std::exchange(measure, rest);
    }
    return measure;
  }

  [[nodiscard]] bool has(double place) const {
    const double lines = (place - origin) / pitch;
    return std::abs(lines - std::round(lines)) <= off;
  }
};

/// The contours of one slice, on a lattice, as a network of points in which ways can be changed.
class PixelOutlines {
 public:
  PixelOutlines(const Lattice& x, const Lattice& y, std::size_t& steps)
      : x_(x), y_(y), steps_(steps) {}

  void add(const SpaceContour& contour, std::size_t number) {
    const std::size_t first = nodes_.size();
    for (const Vec3& point : contour.points) {
      const Node node{x_.index(point[0]), y_.index(point[1]), point, nodes_.size() + 1, number};
      if (nodes_.size() > first && node.is_at(nodes_.back())) continue;
      nodes_.push_back(node);
    }
    if (nodes_.size() > first) nodes_.back().next = first;
  }

  /// Closes the channels one after the other, the narrowest first, then the longest: what is left
  /// of a side may be one of others.
  std::size_t close() {
    std::size_t count = 0;
    while (const auto channel = find()) {
      close(*channel);
      ++count;
    }
    return count;
  }

  /// The numbers of contours with a channel, and the closed lines that are in their place.
  [[nodiscard]] const std::set<std::size_t>& changed() const { return changed_; }
  [[nodiscard]] std::vector<SpaceContour> lines(const std::vector<SpaceContour>& contours) const {
    std::vector<SpaceContour> result;
    std::vector<bool> is_done(nodes_.size());
    for (std::size_t first = 0; first < nodes_.size(); ++first) {
      if (is_done[first] || !changed_.contains(nodes_[first].contour)) continue;
      const SpaceContour& from = contours[nodes_[first].contour];
      SpaceContour& line = result.emplace_back(SpaceContour{{}, from.label, from.source});
      for (std::size_t i = first; !is_done[i]; i = nodes_[i].next) {
        is_done[i] = true;
        line.points.push_back(nodes_[i].place);
      }
    }
    return result;
  }

 private:
  struct Node {
    std::int64_t x;
    std::int64_t y;
    Vec3 place;
    std::size_t next;
    std::size_t contour;  ///< that it came with

    [[nodiscard]] bool is_at(const Node& other) const { return x == other.x && y == other.y; }
  };

  /// From a node to the next, along y.
  struct Side {
    std::int64_t x;
    std::int64_t low;
    std::int64_t high;
    bool is_up;
    std::size_t from;
  };

  struct Channel {
    std::int64_t width;
    std::int64_t low;  ///< where the sides begin to be alongside each other
    std::int64_t high;
    std::size_t left;  ///< where the sides start
    std::size_t right;

    /// Of two, which is looked at first.
    [[nodiscard]] auto rank() const {
      return std::tuple(width > line_width ? width : 0, low - high, left, right);
    }
  };

  [[nodiscard]] bool is_long(std::int64_t length, std::int64_t width) const {
    const double long_enough = static_cast<double>(length) * y_.pitch;
    const double wide = static_cast<double>(width) * x_.pitch;
    return width == line_width ? long_enough > 1.001 * wide
                               : long_enough > wide_length * 0.999 * wide;
  }

  [[nodiscard]] std::vector<Side> long_sides() const {
    std::vector<Side> sides;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Node& a = nodes_[i];
      const Node& b = nodes_[a.next];
      if (a.x == b.x && is_long(std::abs(a.y - b.y), line_width))
        sides.push_back({a.x, std::min(a.y, b.y), std::max(a.y, b.y), b.y > a.y, i});
    }
    std::ranges::sort(sides, {},
                      [](const Side& side) { return std::tuple(side.x, side.low, side.from); });
    return sides;
  }

  [[nodiscard]] std::optional<Channel> find() {
    std::vector<Channel> channels;
    const std::vector<Side> sides = long_sides();
    for (const Side& left : sides) {
      auto right = std::ranges::lower_bound(sides, left.x + line_width, {}, &Side::x);
      for (; right != sides.end() && right->x <= left.x + most_width && take_steps(steps_per_pair);
           ++right) {
        const Channel channel{right->x - left.x, std::max(left.low, right->low),
                              std::min(left.high, right->high), left.from, right->from};
        if (left.is_up != right->is_up && is_long(channel.high - channel.low, channel.width))
          channels.push_back(channel);
      }
    }
    std::ranges::sort(channels, {}, &Channel::rank);
    for (const Channel& channel : channels)
      if (take_steps(4 * nodes_.size()) && is_open(channel) && !is_long_hole(channel))
        return channel;
    return {};
  }

  /// Whether there are as many left: then they are taken.
  bool take_steps(std::size_t count) {
    if (steps_ < count) return false;
    steps_ -= count;
    return true;
  }

  /// Whether nothing is between the sides, and that is outside.
  [[nodiscard]] bool is_open(const Channel& channel) const {
    const std::int64_t left = nodes_[channel.left].x;
    const std::int64_t right = nodes_[channel.right].x;
    bool is_odd = false;
    for (const Node& a : nodes_) {
      const Node& b = nodes_[a.next];
      if (std::max(a.x, b.x) > left && std::min(a.x, b.x) < right &&
          std::max(a.y, b.y) > channel.low && std::min(a.y, b.y) < channel.high)
        return false;
      // Half a pixel into the channel, where no point can be.
      if (is_right_of(a, b, 2 * left + 1, 2 * channel.low + 1)) is_odd = !is_odd;
    }
    return !is_odd;
  }

  /// Whether the way from a to b crosses the ray to the right of a place, given doubled (exact).
  static bool is_right_of(const Node& a, const Node& b, std::int64_t x, std::int64_t y) {
    const Node& low = a.y < b.y ? a : b;
    const Node& high = a.y < b.y ? b : a;
    if (2 * low.y > y || 2 * high.y < y || low.y == high.y) return false;
    return (y - 2 * low.y) * (high.x - low.x) > (x - 2 * low.x) * (high.y - low.y);
  }

  /// Whether the sides are those of one hole that has nothing but a tip at one of its ends.
  [[nodiscard]] bool is_long_hole(const Channel& channel) const {
    const std::size_t left_end = nodes_[channel.left].next;
    const auto one = twice_area(left_end, channel.right);
    const auto other = twice_area(nodes_[channel.right].next, channel.left);
    if (!one || !other) return false;  // they are of two contours
    const bool turns_left = *twice_area(left_end, channel.left) > 0;
    const bool is_hole = turns_left != (nodes_[left_end].y > nodes_[channel.left].y);
    const std::int64_t tip = channel.width * channel.width;
    return is_hole && std::min(std::abs(*one), std::abs(*other)) <= tip;
  }

  /// Of what a way to another node and straight back encloses; none if it does not get there.
  [[nodiscard]] std::optional<std::int64_t> twice_area(std::size_t from, std::size_t to) const {
    const auto turned = [this](std::size_t i, std::size_t j) {
      return nodes_[i].x * nodes_[j].y - nodes_[j].x * nodes_[i].y;
    };
    std::int64_t sum = 0;
    for (std::size_t i = from; i != to; i = nodes_[i].next) {
      sum += turned(i, nodes_[i].next);
      if (nodes_[i].next == from) return {};
    }
    return sum + turned(to, from);
  }

  void close(const Channel& channel) {
    const std::size_t left_end = nodes_[channel.left].next;
    const std::size_t right_end = nodes_[channel.right].next;
    changed_.insert(nodes_[channel.left].contour);
    changed_.insert(nodes_[channel.right].contour);
    lead_across(channel.left, right_end, channel);
    lead_across(channel.right, left_end, channel);
  }

  /// From one side's point at an end to the other's.
  void lead_across(std::size_t from, std::size_t to, const Channel& channel) {
    const Node a = nodes_[from];
    const Node b = nodes_[to];
    const double apart = static_cast<double>(std::abs(a.y - b.y)) * y_.pitch;
    if (apart <= static_cast<double>(line_width) * x_.pitch * 1.001) {
      nodes_[from].next = to;
      return;
    }
    const bool is_high = std::max(a.y, b.y) > channel.high;
    const bool is_longer = is_high ? a.y > b.y : a.y < b.y;
    Node corner = is_longer ? a : b;
    corner.y = is_longer ? b.y : a.y;
    corner.place[1] = is_longer ? b.place[1] : a.place[1];
    corner.next = to;
    nodes_[from].next = nodes_.size();
    nodes_.push_back(corner);
  }

  const Lattice& x_;
  const Lattice& y_;
  std::size_t& steps_;
  std::vector<Node> nodes_;
  std::set<std::size_t> changed_;
};

/// The contours that are level, by height.
std::map<double, std::vector<std::size_t>> level_contours(
    const std::vector<SpaceContour>& contours) {
  std::map<double, std::vector<std::size_t>> result;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const std::vector<Vec3>& points = contours[i].points;
    if (points.empty()) continue;
    if (std::ranges::all_of(points, [&](const Vec3& p) { return p[2] == points.front()[2]; }))
      result[points.front()[2]].push_back(i);
  }
  return result;
}

}  // namespace

PinHoles close_pin_holes(std::vector<SpaceContour>& contours) {
  const auto x = Lattice::of(contours, 0);
  const auto y = Lattice::of(contours, 1);
  if (!x || !y) return {};
  PinHoles result{0, line_width * x->pitch};
  std::size_t steps = 0;
  for (const SpaceContour& contour : contours) steps += steps_per_point * contour.points.size();
  std::vector<bool> is_changed(contours.size());
  std::vector<SpaceContour> closed;
  for (const auto& [z, numbers] : level_contours(contours)) {
    PixelOutlines outlines(*x, *y, steps);
    for (const std::size_t number : numbers) outlines.add(contours[number], number);
    result.count += outlines.close();
    for (const std::size_t number : outlines.changed()) is_changed[number] = true;
    for (SpaceContour& line : outlines.lines(contours)) closed.push_back(std::move(line));
  }
  std::vector<SpaceContour> all;
  for (std::size_t i = 0; i < contours.size(); ++i)
    if (!is_changed[i]) all.push_back(std::move(contours[i]));
  std::ranges::move(closed, std::back_inserter(all));
  contours = std::move(all);
  return result;
}

}  // namespace loft::io
