// SPDX-License-Identifier: MIT
#include "io/planar/classes_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "io/planar/svg_frame.h"
#include "io/planar/svg_path.h"

namespace loft::io {

namespace {

using cdt::Point;

class ClassesSvgWriter {
 public:
  ClassesSvgWriter(std::ostream& out, const ClassPicture& picture, double width)
      : out_(out), picture_(picture), frame_(picture.box, width) {
    // Dots must be small to be told apart where there are many.
    const double area = frame_.width() * frame_.height();
    const double spacing = std::sqrt(area / static_cast<double>(picture.dots.size() + 1));
    dot_width_ = std::clamp(0.4 * spacing, 1.5 * pixel, 8 * pixel);
  }

  void write() {
    out_ << frame_.opening() << "<title>" << picture_.dots.size() << " points, "
         << picture_.separators.size() << " separators</title>\n";
    write_faces();
    write_separators();
    write_dots();
    out_ << "</svg>\n";
  }

 private:
  static constexpr double pixel = SvgFrame::steps_per_pixel;

  void write_faces() {
    std::map<std::string, SvgPath> paths;  // by colour
    for (const fields::ClassFace& face : picture_.faces) {
      SvgPath& path = paths["fill=\"" + to_hex(pale_tone(class_hue(face.signs))) + '"'];
      path.allow_cut();
      path.loop(places_of(face.polygon.outer));
      for (const overlay::Ring& hole : face.polygon.holes) path.loop(places_of(hole));
    }
    out_ << "<g class=\"classes\" fill-rule=\"evenodd\">\n";
    for (const auto& [fill, path] : paths) path.write(out_, fill);
    out_ << "</g>\n";
  }

  /// Where the picture is left for good, on the way from a over b.
  [[nodiscard]] Point far_point(Point a, Point b) const {
    const double across = picture_.box.high.x - picture_.box.low.x;
    const double up = picture_.box.high.y - picture_.box.low.y;
    const double longest = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
    const double times = 2 * std::max(across, up) / longest;
    return {b.x + times * (b.x - a.x), b.y + times * (b.y - a.y)};
  }

  void write_separators() {
    SvgPath path;
    for (const auto& points : picture_.separators) {
      path.allow_cut();
      path.move(frame_(far_point(points[1], points[0])));
      for (const Point& p : points) path.line(frame_(p));
      path.line(frame_(far_point(points[points.size() - 2], points.back())));
    }
    out_ << "<g class=\"separators\" stroke-width=\"" << whole_steps(2 * pixel) << "\">\n";
    path.write(out_, "stroke=\"" + to_hex(shared_tone) + '"');
    out_ << "</g>\n";
  }

  /// One path for dots with the same colour that follow one another: later ones lie above.
  void write_dots() {
    out_ << "<g class=\"points\" stroke-width=\"" << whole_steps(dot_width_) << "\">\n";
    SvgPath path;
    Colour colour;
    const auto finish = [&] {
      path.write(out_, "stroke=\"" + to_hex(colour) + '"');
      path = {};
    };
    for (const ClassDot& dot : picture_.dots) {
      const Colour next = class_colour(dot.signs, dot.share);
      if (next != colour) finish();
      colour = next;
      path.dot(frame_(dot.place));
    }
    finish();
    out_ << "</g>\n";
  }

  [[nodiscard]] std::vector<GridPoint> places_of(const std::vector<Point>& points) const {
    std::vector<GridPoint> places;
    for (const Point& p : points) places.push_back(frame_(p));
    return places;
  }

  std::ostream& out_;
  const ClassPicture& picture_;
  SvgFrame frame_;
  double dot_width_ = 0;
};

}  // namespace

std::size_t class_hue(std::span<const fields::Sign> signs) {
  // None is 0, so that one sign always makes a difference; of the first three all sums differ.
  constexpr std::array<std::size_t, 7> steps{1, 2, 4, 3, 5, 7, 6};
  std::size_t hue = 7;
  for (std::size_t i = 0; i < signs.size(); ++i)
    if (signs[i] == fields::Sign::left) hue += steps[i % steps.size()];
  return hue % hue_count;
}

Colour class_colour(std::span<const fields::Sign> signs, double share) {
  const bool is_on = std::ranges::find(signs, fields::Sign::on) != signs.end();
  const std::size_t hue = class_hue(signs);
  const Colour dark = is_on ? shared_tone : dark_tone(hue);
  const Colour light = is_on ? edge_tone : full_tone(hue);
  constexpr double steps = 15;  // as many as can be told apart, so that pictures stay small
  return mixed(light, dark, std::round(share * steps) / steps);
}

void write_classes_svg(std::ostream& out, const ClassPicture& picture, double width) {
  ClassesSvgWriter(out, picture, width).write();
}

}  // namespace loft::io
