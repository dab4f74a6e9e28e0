// SPDX-License-Identifier: MIT
#include "io/planar/paths_svg.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "io/planar/palette.h"
#include "io/planar/svg_path.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

using cdt::Point;
using paths::Path;
using paths::Turn;

constexpr Colour blocked_tone{0xc9, 0xcf, 0xd6};
constexpr Colour free_tone{0xfb, 0xfa, 0xf6};
constexpr Colour border_tone{0x7d, 0x87, 0x93};

/// The first one is that of rivers on maps.
Colour tone_of(const DrawnPath& way) { return dark_tone((way.hue + hue_count - 1) % hue_count); }

cdt::Box picture_box(const PathPicture& picture) {
  cdt::Box box;
  const auto add_all = [&](const std::vector<Point>& points) {
    for (const Point& p : points) box.add(p);
  };
  for (const overlay::Polygon& polygon : picture.free) add_all(polygon.outer);
  for (const auto& wall : picture.walls) add_all(wall);
  for (const DrawnPath& way : picture.paths) add_all({way.query.from, way.query.to});
  return box;
}

class PathsSvgWriter {
 public:
  PathsSvgWriter(std::ostream& out, const PathPicture& picture, double width)
      : out_(out), picture_(picture), frame_(picture_box(picture), width, picture.upwards) {}

  void write() {
    out_ << frame_.opening() << "<title>" << picture_.paths.size()
         << (picture_.paths.size() == 1 ? " path" : " paths") << "</title>\n"
         << "<rect width=\"100%\" height=\"100%\" fill=\"" << to_hex(blocked_tone) << "\"/>\n";
    write_free();
    write_walls();
    for (const DrawnPath& way : picture_.paths) write_band(way);
    for (const DrawnPath& way : picture_.paths) write_way(way);
    out_ << "</svg>\n";
  }

 private:
  static constexpr double pixel = SvgFrame::steps_per_pixel;

  void write_free() {
    SvgPath path;
    for (const overlay::Polygon& polygon : picture_.free) {
      path.allow_cut();
      path.loop(places_of(polygon.outer));
      for (const overlay::Ring& hole : polygon.holes) path.loop(places_of(hole));
    }
    out_ << "<g class=\"free\" fill-rule=\"evenodd\">\n";
    path.write(out_, "fill=\"" + to_hex(free_tone) + "\" stroke=\"" + to_hex(border_tone) +
                         "\" stroke-width=\"" + whole_steps(0.8 * pixel) + '"');
    out_ << "</g>\n";
  }

  void write_walls() {
    SvgPath path;
    for (const auto& wall : picture_.walls) {
      path.allow_cut();
      path.move(frame_(wall.front()));
      for (const Point& p : wall) path.line(frame_(p));
    }
    out_ << "<g class=\"walls\" stroke-width=\"" << whole_steps(2 * pixel) << "\">\n";
    path.write(out_, "stroke=\"" + to_hex(shared_tone) + '"');
    out_ << "</g>\n";
  }

  [[nodiscard]] std::vector<GridPoint> places_of(const std::vector<Point>& points) const {
    std::vector<GridPoint> places;
    for (const Point& p : points) places.push_back(frame_(p));
    return places;
  }

  /// What the disc sweeps.
  void write_band(const DrawnPath& way) {
    if (way.is_faint || way.query.radius == 0 || way.path.pieces.empty()) return;
    out_ << "<path class=\"band\" stroke=\"" << to_hex(tone_of(way))
         << "\" stroke-opacity=\"0.2\" stroke-width=\""
         << whole_steps(frame_.length(2 * way.query.radius)) << "\" d=\"" << course_of(way)
         << "\"/>\n";
  }

  void write_way(const DrawnPath& way) {
    const std::string stroke =
        "stroke=\"" + to_hex(tone_of(way)) + '"' + (way.is_faint ? " stroke-opacity=\"0.25\"" : "");
    if (!way.path.pieces.empty())
      out_ << "<path class=\"path\" " << stroke << " stroke-width=\"" << whole_steps(2 * pixel)
           << "\" d=\"" << course_of(way) << "\"/>\n";
    SvgPath ends;
    ends.dot(frame_(way.query.from));
    ends.dot(frame_(way.query.to));
    ends.write(out_,
               "class=\"ends\" " + stroke + " stroke-width=\"" + whole_steps(7 * pixel) + '"');
  }

  [[nodiscard]] std::string course_of(const DrawnPath& way) const {
    std::string course = "M" + text_of(way.path.pieces.front().from);
    for (const paths::Piece& piece : way.path.pieces)
      course += (piece.turn == Turn::straight ? "L" : arc_to(piece)) + text_of(piece.to);
    return course;
  }

  /// Less than half a turn, so never the larger of the two arcs of SVG.
  [[nodiscard]] std::string arc_to(const paths::Piece& piece) const {
    const Point spoke{piece.from.x - piece.centre.x, piece.from.y - piece.centre.y};
    const double radius = std::sqrt(spoke.x * spoke.x + spoke.y * spoke.y);
    const std::string steps = whole_steps(frame_.length(radius));
    const bool is_right = (piece.turn == Turn::right) == (picture_.upwards == Upwards::y);
    return "A" + steps + ' ' + steps + " 0 0 " + (is_right ? "1 " : "0 ");
  }

  [[nodiscard]] std::string text_of(Point point) const {
    const GridPoint place = frame_(point);
    std::string text;
    append_number(text, place.x);
    text += ' ';
    append_number(text, place.y);
    return text;
  }

  std::ostream& out_;
  const PathPicture& picture_;
  SvgFrame frame_;
};

}  // namespace

void write_paths_svg(std::ostream& out, const PathPicture& picture, double width) {
  PathsSvgWriter(out, picture, width).write();
}

}  // namespace loft::io
