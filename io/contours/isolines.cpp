// SPDX-License-Identifier: MIT
#include "io/contours/isolines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "io/contours/stack_builder.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

using Points = std::vector<cdt::Point>;

/// The box of the data, and places along its border: from its first corner, counter-clockwise.
class Border {
 public:
  explicit Border(const std::vector<Isoline>& lines)
      : least_(lines.front().points.front()), most_(least_) {
    for (const Isoline& line : lines)
      for (const cdt::Point& point : line.points) {
        least_ = {std::min(least_.x, point.x), std::min(least_.y, point.y)};
        most_ = {std::max(most_.x, point.x), std::max(most_.y, point.y)};
      }
    width_ = most_.x - least_.x;
    height_ = most_.y - least_.y;
  }

  /// None where a point is inside.
  [[nodiscard]] std::optional<double> place(const cdt::Point& point) const {
    constexpr double rounding_of_border = 1e-7;
    const double near = rounding_of_border * (width_ + height_);
    if (point.y - least_.y <= near) return point.x - least_.x;
    if (most_.x - point.x <= near) return width_ + point.y - least_.y;
    if (most_.y - point.y <= near) return width_ + height_ + most_.x - point.x;
    if (point.x - least_.x <= near) return 2 * width_ + height_ + most_.y - point.y;
    return {};
  }

  [[nodiscard]] Points corners() const {
    return {least_, {most_.x, least_.y}, most_, {least_.x, most_.y}};
  }

  /// Appends the corners between two places, going counter-clockwise from one to the other.
  void append_corners(double from, double to, Points& points) const {
    const double places[] = {0, width_, width_ + height_, 2 * width_ + height_};
    const double round = 2 * (width_ + height_);
    if (to < from) to += round;
    const Points all = corners();
    for (std::size_t i = 0; i < 8; ++i) {
      const double corner = places[i % 4] + (i < 4 ? 0 : round);
      if (corner > from && corner < to) points.push_back(all[i % 4]);
    }
  }

 private:
  cdt::Point least_;
  cdt::Point most_;
  double width_;
  double height_;
};

/// Whether a point is in an odd number of rings.
bool is_inside(const std::vector<Contour>& rings, const cdt::Point& point) {
  bool inside = false;
  for (const Contour& ring : rings) {
    const Points& p = ring.points;
    for (std::size_t i = 0, k = p.size() - 1; i < p.size(); k = i++) {
      if ((p[i].y > point.y) == (p[k].y > point.y)) continue;
      const double x = p[k].x + (point.y - p[k].y) / (p[i].y - p[k].y) * (p[i].x - p[k].x);
      if (point.x < x) inside = !inside;
    }
  }
  return inside;
}

/// The end of a line at the border.
struct LineEnd {
  double place;
  std::size_t line;
  bool is_last;
};

class Level {
 public:
  /// `lines` are those of one height, `ends` their ends at the border.
  Level(std::vector<const Isoline*> lines, std::vector<LineEnd> ends, const Border& border)
      : lines_(std::move(lines)), ends_(std::move(ends)), border_(border) {
    std::ranges::sort(
        ends_, {}, [](const LineEnd& end) { return std::tuple(end.place, end.line, end.is_last); });
  }

  /// The outlines of one side, and of the other.
  [[nodiscard]] std::vector<Contour> side(bool is_other) const {
    std::vector<Contour> rings;
    for (const Isoline* line : lines_)
      if (line->is_closed) rings.push_back({line->points, "", line->source});
    if (ends_.empty() && is_other) rings.push_back({border_.corners(), "", "border"});
    const std::size_t count = ends_.size();
    const std::vector<std::size_t> partners = find_partners();
    std::vector<bool> used(count);
    for (std::size_t first = 0; first < count; ++first) {
      if (used[first]) continue;
      Contour ring{{}, "", lines_[ends_[first].line]->source};
      for (std::size_t at = first; !used[at];) {
        const std::size_t far = partners[at];
        used[at] = used[far] = true;
        append_line(ends_[at], ring.points);
        // Along the border to the neighbour with which this side shares it.
        const bool goes_on = (far % 2 == 0) != is_other;
        const std::size_t next = goes_on ? (far + 1) % count : (far + count - 1) % count;
        append_border(far, next, goes_on, ring.points);
        at = next;
      }
      rings.push_back(std::move(ring));
    }
    return rings;
  }

 private:
  /// Of each end the other one of its line.
  [[nodiscard]] std::vector<std::size_t> find_partners() const {
    constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::vector<std::size_t> result(ends_.size());
    std::vector<std::size_t> seen(lines_.size(), none);
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      std::size_t& other = seen[ends_[i].line];
      if (other != none) {
        result[i] = other;
        result[other] = i;
      }
      other = i;
    }
    return result;
  }

  /// All of a line, from that end.
  void append_line(const LineEnd& from, Points& points) const {
    const Points& line = lines_[from.line]->points;
    if (from.is_last) {
      points.insert(points.end(), line.rbegin(), line.rend());
    } else {
      points.insert(points.end(), line.begin(), line.end());
    }
  }

  void append_border(std::size_t from, std::size_t to, bool goes_on, Points& points) const {
    if (goes_on) return border_.append_corners(ends_[from].place, ends_[to].place, points);
    Points corners;
    border_.append_corners(ends_[to].place, ends_[from].place, corners);
    points.insert(points.end(), corners.rbegin(), corners.rend());
  }

  std::vector<const Isoline*> lines_;
  std::vector<LineEnd> ends_;
  const Border& border_;
};

/// Joins pieces of lines, in one go over them.
class LineJoiner {
 public:
  explicit LineJoiner(std::vector<Isoline>& pieces) : pieces_(pieces), is_used_(pieces.size()) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].is_closed) continue;
      ends_[place_of({i, false})].push_back({i, false});
      ends_[place_of({i, true})].push_back({i, true});
    }
  }

  std::vector<Isoline> join() {
    std::vector<Isoline> lines;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (is_used_[i]) continue;
      lines.push_back(pieces_[i].is_closed ? std::move(pieces_[i]) : joined(first_of(i)));
    }
    return lines;
  }

 private:
  struct End {
    std::size_t piece;
    bool is_last;
  };
  using Place = std::tuple<double, double, double>;

  [[nodiscard]] Place place_of(const End& end) const {
    const Isoline& piece = pieces_[end.piece];
    const cdt::Point& point = end.is_last ? piece.points.back() : piece.points.front();
    return {piece.z, point.x, point.y};
  }
  static End across(const End& end) { return {end.piece, !end.is_last}; }

  /// The one end that meets this one.
  [[nodiscard]] std::optional<End> partner(const End& end) const {
    const std::vector<End>& there = ends_.find(place_of(end))->second;
    if (there.size() != 2) return {};
    const bool is_first = there[0].piece == end.piece && there[0].is_last == end.is_last;
    return there[is_first ? 1 : 0];
  }

  /// The end at which the line of a piece begins; any of a closed one.
  [[nodiscard]] End first_of(std::size_t piece) const {
    End end{piece, false};
    for (auto next = partner(end); next && next->piece != piece; next = partner(end))
      end = across(*next);
    return end;
  }

  Isoline joined(End end) {
    const std::size_t first = end.piece;
    Isoline line{{}, pieces_[first].z, false, pieces_[first].source, pieces_[first].label};
    while (true) {
      is_used_[end.piece] = true;
      Points& points = pieces_[end.piece].points;
      if (end.is_last) std::ranges::reverse(points);
      line.points.insert(line.points.end(), points.begin() + (line.points.empty() ? 0 : 1),
                         points.end());
      if (end.is_last) std::ranges::reverse(points);  // places of ends are looked up again
      const auto next = partner(across(end));
      if (!next || is_used_[next->piece]) {
        line.is_closed = next && next->piece == first;
        if (line.is_closed) line.points.pop_back();
        return line;
      }
      end = *next;
    }
  }

  std::vector<Isoline>& pieces_;
  std::vector<bool> is_used_;
  std::map<Place, std::vector<End>> ends_;
};

class Terrain {
 public:
  Terrain(const std::vector<Isoline>& lines, std::string_view name)
      : lines_(lines), border_(lines), name_(name) {
    for (const Isoline& line : lines) levels_[line.z].push_back(&line);
  }

  std::vector<Slice> slices() {
    require_ends_at_border();
    std::vector<Slice> result;
    for (const auto& [z, lines] : levels_) {
      const Level level(lines, ends_of(lines), border_);
      std::vector<Contour> rings = level.side(false);
      if (!is_higher_inside(rings, z)) rings = level.side(true);
      result.push_back({z, std::move(rings)});
    }
    return result;
  }

 private:
  void require_ends_at_border() const {
    std::size_t inside = 0;
    const Isoline* first = nullptr;
    for (const Isoline& line : lines_) {
      if (line.is_closed ||
          (border_.place(line.points.front()) && border_.place(line.points.back())))
        continue;
      if (++inside == 1) first = &line;
    }
    if (inside == 0) return;
    throw InputError(std::string(name_) + ": " + counted(inside, "isoline") + " of " +
                     std::to_string(lines_.size()) +
                     " that end inside the data, not at its border, the first one in " +
                     first->source +
                     "; clip the data to a rectangle, or draw bands by "
                     "gdal_contour -p -amin EMIN -amax EMAX");
  }

  [[nodiscard]] std::vector<LineEnd> ends_of(const std::vector<const Isoline*>& lines) const {
    std::vector<LineEnd> ends;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i]->is_closed) continue;
      ends.push_back({*border_.place(lines[i]->points.front()), i, false});
      ends.push_back({*border_.place(lines[i]->points.back()), i, true});
    }
    return ends;
  }

  /// Whether what is higher is inside, by points of lines of other heights.
  [[nodiscard]] bool is_higher_inside(const std::vector<Contour>& rings, double z) const {
    constexpr std::size_t most_work = 10'000'000;
    std::size_t points = 1;
    for (const Contour& ring : rings) points += ring.points.size();
    const std::size_t most = std::clamp<std::size_t>(most_work / points, 5, 200);
    const std::size_t step = lines_.size() / most + 1;
    std::ptrdiff_t agree = 0;
    for (std::size_t i = 0; i < lines_.size(); i += step) {
      if (lines_[i].z == z) continue;
      const cdt::Point& witness = lines_[i].points[lines_[i].points.size() / 2];
      if (border_.place(witness)) continue;
      agree += is_inside(rings, witness) == (lines_[i].z > z) ? 1 : -1;
    }
    return agree >= 0;
  }

  const std::vector<Isoline>& lines_;
  Border border_;
  std::string_view name_;
  std::map<double, std::vector<const Isoline*>> levels_;
};

}  // namespace

void join_isolines(std::vector<Isoline>& lines) { lines = LineJoiner(lines).join(); }

std::vector<Slice> close_along_border(const std::vector<Isoline>& lines, std::string_view name) {
  return Terrain(lines, name).slices();
}

}  // namespace loft::io
