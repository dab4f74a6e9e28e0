// SPDX-License-Identifier: MIT
#include "tests/reconstruct/any_stack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "mesh/check.h"
#include "reconstruct/clean/cleaning.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/number_text.h"
#include "reconstruct/reconstruct.h"
#include "tests/reconstruct/exact_area.h"

namespace loft::stacks {

namespace {

using cdt::Point;

class Decoder {
 public:
  explicit Decoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  AnyStack stack() {
    AnyStack any;
    any.options = options();
    unit_ = std::array{0.1, 0.3, 1.0, 1.0 / 3}[byte() % 4];
    const unsigned count = 2 + byte() % 3;
    for (unsigned i = 0; i < count; ++i)
      any.slices.push_back({0.1 * (1 + i + (byte() % 8) * 0.1), contours()});
    for (unsigned left = byte() % 8; left > 3; --left) add_tip(any.slices);
    return any;
  }

 private:
  unsigned byte() {
    if (bytes_.empty()) return 0;
    const unsigned first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
  }

  Options options() {
    Options options;
    const unsigned rules = byte();
    options.fill = std::array{Fill::even_odd, Fill::nonzero, Fill::keyhole_aware}[rules % 3];
    options.cap = std::array{Cap::flat, Cap::dome, Cap::open}[rules / 3 % 3];
    options.link =
        std::array{LinkRule::automatic, LinkRule::overlap, LinkRule::none}[rules / 9 % 3];
    options.smooth = rules / 27 % 4 == 3;
    options.threads = 1;
    const unsigned shape = byte() % 16;
    if (shape == 1) options.max_edge = 0.7 * unit_;
    if (shape == 2) options.target_edge = 0.5 * unit_;
    if (shape == 3) options.simplify = 0;
    if (shape == 4) options.simplify = 0.05;
    if (shape == 5) options.max_shift = 0.3;
    if (shape == 6) options.smooth_tolerance = 0.01 * unit_;
    return options;
  }

  std::vector<Contour> contours() {
    std::vector<Contour> made;
    const unsigned count = 1 + byte() % 4;
    for (unsigned i = 0; i < count; ++i) add(made);
    return made;
  }

  void add(std::vector<Contour>& made) {
    switch (byte() % 6) {
      case 0:
        return add_corridor(made);
      case 1:
        return add_outlines(made);
      case 2:
        return made.push_back(polygon([&] { return grid(); }));
      case 3:
        return made.push_back(polygon([&] { return beside(made); }));
      case 4:
        return made.push_back(in_pieces(polygon([&] { return grid(); })));
      default:
        return made.push_back(polygon([&] { return turned(grid()); }));
    }
  }

  /// A point or a line for what a neighbouring slice has; that of its own slice may be gone.
  void add_tip(std::vector<Slice>& slices) {
    const std::size_t at = byte() % slices.size();
    const Slice& other = slices[at == 0 ? 1 : at - 1];
    if (byte() % 2 == 0) slices[at].contours.clear();
    Contour tip;
    for (unsigned left = 1 + byte() % 3 / 2; left > 0; --left)
      tip.points.push_back(byte() % 2 == 0 ? grid() : beside(other.contours));
    slices[at].contours.push_back(std::move(tip));
  }

  Point grid() {
    const unsigned both = byte();
    return {unit_ * (both % 16), unit_ * (both / 16)};
  }

  /// By an angle that is no fraction of a turn: sides that were in line are so but for rounding.
  static Point turned(Point p) {
    return {0.8 * p.x - 0.6 * p.y + 0.1, 0.6 * p.x + 0.8 * p.y - 0.7};
  }

  template <class Place>
  Contour polygon(Place place) {
    Contour contour;
    contour.points.resize(3 + byte() % 4);
    for (Point& p : contour.points) p = place();
    return contour;
  }

  /// On a side of another outline but for a few last places.
  Point beside(const std::vector<Contour>& made) {
    if (made.empty() || byte() % 4 == 0) return grid();
    const auto& points = made[byte() % made.size()].points;
    const std::size_t side = byte() % points.size();
    const Point a = points[side];
    const Point b = points[(side + 1) % points.size()];
    const double t = byte() / 255.0;
    return {nudged(a.x + t * (b.x - a.x)), nudged(a.y + t * (b.y - a.y))};
  }

  double nudged(double x) {
    const unsigned steps = byte() % 16;
    const double to = std::numeric_limits<double>::infinity() * (steps % 2 == 0 ? 1 : -1);
    for (unsigned i = 0; i < steps / 2; ++i) x = std::nextafter(x, to);
    return std::abs(x) < 1e-30 ? 0 : x;
  }

  /// Sides of several points in one line, as far as rounding lets them.
  Contour in_pieces(const Contour& whole) {
    Contour contour;
    for (std::size_t i = 0; i < whole.points.size(); ++i) {
      const Point a = whole.points[i];
      const Point b = whole.points[(i + 1) % whole.points.size()];
      const unsigned pieces = 1 + byte() % 3;
      for (unsigned k = 0; k < pieces; ++k) {
        const double t = k / double(pieces);
        contour.points.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
      }
    }
    return contour;
  }

  /// Rooms on both sides of a corridor, flush with it.
  void add_corridor(std::vector<Contour>& made) {
    const bool is_turned = byte() % 2 == 1;
    const double y = unit_ * (byte() % 8 + 0.7);
    const double length = unit_ * 7.3;
    const auto box = [&](double left, double low, double right, double high) {
      Contour contour{{{left, low}, {right, low}, {right, high}, {left, high}}, ""};
      if (is_turned) std::ranges::transform(contour.points, contour.points.begin(), turned);
      made.push_back(std::move(contour));
    };
    box(0, y, length, y + 0.4 * unit_);
    const unsigned rooms = byte() % 4;
    for (unsigned i = 0; i < rooms; ++i) {
      const double left = unit_ * 0.7 * (2 * i + byte() % 2);
      const double right = left + unit_ * (0.1 + 0.1 * (byte() % 14));
      if (byte() % 2 == 0) {
        box(left, y + 0.4 * unit_, right, y + 1.3 * unit_);
      } else {
        box(left, y - 0.6 * unit_, right, y);
      }
    }
  }

  /// What a label of a mask is outlined by: unit steps, holes that touch at corners.
  void add_outlines(std::vector<Contour>& made) {
    std::array<std::array<bool, 6>, 6> mask{};
    for (std::size_t row = 1; row < 5; ++row) {
      const unsigned bits = byte();
      for (std::size_t column = 1; column < 5; ++column)
        mask[row][column] = (bits >> column & 1) != 0;
    }
    for (std::size_t row = 1; row < 5; ++row) {
      for (std::size_t column = 1; column < 5; ++column) {
        if (!mask[row][column]) continue;
        const auto at = [&](std::size_t i) { return unit_ * static_cast<double>(i); };
        const double left = at(column);
        const double low = at(row);
        made.push_back({{{left, low},
                         {at(column + 1), low},
                         {at(column + 1), at(row + 1)},
                         {left, at(row + 1)}},
                        ""});
      }
    }
  }

  std::span<const std::uint8_t> bytes_;
  double unit_ = 1;
};

/// The same for contours of the same points in a circle, in either direction.
std::vector<Point> normal_form(std::vector<Point> points) {
  const auto from_first = [](std::vector<Point> some) {
    std::ranges::rotate(some, std::ranges::min_element(some));
    return some;
  };
  std::vector<Point> back(points.rbegin(), points.rend());
  return std::min(from_first(std::move(points)), from_first(std::move(back)));
}

/// As cleaning, which keeps one of each contour.
std::vector<Contour> without_copies(const std::vector<Contour>& contours) {
  std::set<std::vector<Point>> seen;
  std::vector<Contour> kept;
  for (const Contour& contour : contours)
    if (seen.insert(normal_form(contour.points)).second) kept.push_back(contour);
  return kept;
}

/// Of a region made from the slice alone.
std::string area_complaint(const Slice& slice, Fill fill) {
  if (fill == Fill::keyhole_aware) return {};
  std::vector<ContourSource> contours;
  for (std::uint32_t i = 0; i < slice.contours.size(); ++i)
    contours.push_back({slice.contours[i].points, 0, i});
  std::vector<Defect> repairs;
  cdt::Triangulation memory;
  const Region region = clean(contours, slice.z, {fill, {}}, repairs, memory);
  const double off = area_error(region, without_copies(slice.contours), fill);
  return off > 1e-12 ? "the area of slice z = " + exact(slice.z) + " is off by " + exact(off) : "";
}

// A cavity is closed, what it is in may be open: then check() cannot tell that it is one.
bool is_open_alone(const std::set<std::string>& faults) {
  return faults == std::set<std::string>{"boundary_edge"} ||
         faults == std::set<std::string>{"boundary_edge", "inside_out"};
}

}  // namespace

AnyStack stack_from_bytes(std::span<const std::uint8_t> bytes) { return Decoder(bytes).stack(); }

AnyStack stack_from_seed(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::uint8_t> bytes(512);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 32U);
  return stack_from_bytes(bytes);
}

std::string complaint(const AnyStack& any) {
  for (const Slice& slice : any.slices)
    if (std::string wrong = area_complaint(slice, any.options.fill); !wrong.empty()) return wrong;
  try {
    std::set<std::string> faults;
    for (const Finding& finding : check(to_mesh(reconstruct(any.slices, any.options).surface)))
      faults.insert(name(finding.fault));
    if (faults.empty() || (any.options.cap == Cap::open && is_open_alone(faults))) return {};
    std::string words;
    for (const std::string& fault : faults) words += fault + ' ';
    return words;
  } catch (const InputError& error) {
    // Fewer than two slices with an area: nothing to make a solid of.
    const auto& defects = error.defects();
    return defects.size() == 1 && defects[0].kind == DefectKind::too_few_slices ? "" : error.what();
  }
}

std::string as_words(const AnyStack& any) {
  const Options& o = any.options;
  const auto length = [](const std::optional<double>& value) {
    return value ? exact(*value) : "-";
  };
  std::string words = "fill " + std::to_string(static_cast<int>(o.fill)) + " cap " +
                      std::to_string(static_cast<int>(o.cap)) + " link " +
                      std::to_string(static_cast<int>(o.link)) + (o.smooth ? " smooth" : "") +
                      " max_edge " + length(o.max_edge) + " target_edge " + length(o.target_edge) +
                      " simplify " + length(o.simplify) + " max_shift " + length(o.max_shift) +
                      " smooth_tolerance " + length(o.smooth_tolerance);
  for (const Slice& slice : any.slices) {
    words += "\n{\"z\":" + exact(slice.z) + ",\"contours\":[";
    for (std::size_t c = 0; c < slice.contours.size(); ++c) {
      words += c == 0 ? "[" : ",[";
      const auto& points = slice.contours[c].points;
      for (std::size_t i = 0; i < points.size(); ++i)
        words += (i == 0 ? "[" : ",[") + exact(points[i].x) + ',' + exact(points[i].y) + ']';
      words += ']';
    }
    words += "]}";
  }
  return words;
}

}  // namespace loft::stacks
