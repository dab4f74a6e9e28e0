// SPDX-License-Identifier: MIT
#include "io/planar/field_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>

#include "cdt/queries.h"
#include "fields/isolines.h"
#include "io/planar/palette.h"
#include "io/planar/svg_frame.h"
#include "io/planar/svg_path.h"

namespace loft::io {

namespace {

using cdt::Point;
using cdt::Triangulation;
using fields::Field;
using fields::LineKind;

class FieldSvgWriter {
 public:
  FieldSvgWriter(std::ostream& out, const FieldPicture& picture, double width)
      : out_(out),
        picture_(picture),
        field_(*picture.field),
        frame_(cdt::bounding_box(field_.mesh()), width) {}

  void write() {
    out_ << frame_.opening() << "<title>Values over the plane</title>\n";
    write_bands();
    if (picture_.has_triangles) write_triangles();
    write_isolines();
    for (const LineKind kind :
         {LineKind::soft, LineKind::feature, LineKind::barrier, LineKind::wall})
      write_lines(kind);
    if (picture_.has_samples) write_samples();
    out_ << "</svg>\n";
  }

 private:
  static constexpr double pixel = SvgFrame::steps_per_pixel;

  void write_bands() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> bounds{-infinity};
    bounds.insert(bounds.end(), picture_.levels.begin(), picture_.levels.end());
    bounds.push_back(infinity);
    const std::vector<fields::Band> bands = fields::bands(field_, bounds);
    out_ << "<g class=\"bands\" fill-rule=\"evenodd\">\n";
    for (std::size_t i = 0; i < bands.size(); ++i) {
      const double share =
          bands.size() > 1 ? static_cast<double>(i) / static_cast<double>(bands.size() - 1) : 0.5;
      SvgPath path;
      for (const overlay::Polygon& polygon : bands[i].polygons) {
        path.allow_cut();
        path.loop(places_of(polygon.outer));
        for (const overlay::Ring& hole : polygon.holes) path.loop(places_of(hole));
      }
      path.write(out_, "fill=\"" + to_hex(value_colour(share)) + '"');
    }
    out_ << "</g>\n";
  }

  void write_isolines() {
    SvgPath path;
    for (const fields::Isoline& line : fields::isolines(field_, picture_.levels)) {
      path.allow_cut();
      if (line.is_closed)
        path.loop(places_of(line.points));
      else
        draw(path, line.points);
    }
    write_group("isolines", path, 0.6, "stroke=\"#000\" stroke-opacity=\"0.45\"");
  }

  void write_triangles() {
    const Triangulation& mesh = field_.mesh();
    SvgPath path;
    for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
      const cdt::EdgeId e(i);
      if (!mesh.is_triangle(Triangulation::triangle(e)) || mesh.twin(e) < e) continue;
      if (mesh.from(e) == Triangulation::infinite || mesh.to(e) == Triangulation::infinite)
        continue;
      path.allow_cut();
      draw(path, {mesh.point(mesh.from(e)), mesh.point(mesh.to(e))});
    }
    write_group("triangles", path, 0.5, "stroke=\"#fff\" stroke-opacity=\"0.5\"");
  }

  void write_lines(LineKind kind) {
    constexpr std::array<std::string_view, 4> looks{
        "stroke=\"#b02a2a\"", "stroke=\"#333\" stroke-dasharray=\"100 300\"", "stroke=\"#111\"",
        "stroke=\"#111\" stroke-dasharray=\"800 400\""};
    constexpr std::array<double, 4> widths{1.5, 1.5, 3, 2.5};
    const auto which = static_cast<std::size_t>(kind);
    SvgPath path;
    for (std::uint32_t i = 0; i < field_.id_bound(); ++i) {
      const fields::LineId line(i);
      if (!field_.is_line(line) || field_.kind(line) != kind) continue;
      std::vector<Point> points = field_.points(line);
      if (field_.mesh().ends(cdt::ConstraintId(i)) == cdt::closed) points.push_back(points.front());
      path.allow_cut();
      draw(path, points);
    }
    write_group(fields::name_of(kind), path, widths[which], looks[which]);
  }

  void write_samples() {
    SvgPath path;
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < field_.id_bound(); ++i) {
      if (!field_.is_sample(fields::SampleId(i))) continue;
      path.allow_cut();
      path.dot(frame_(field_.sample(fields::SampleId(i)).place));
      ++count;
    }
    // Dots must be small to be told apart where there are many.
    const double spacing =
        std::sqrt(frame_.width() * frame_.height() / static_cast<double>(count + 1));
    write_group("samples", path, std::clamp(0.15 * spacing / pixel, 1.0, 5.0),
                "stroke=\"#fff\" stroke-opacity=\"0.8\"");
  }

  void write_group(std::string_view name, const SvgPath& path, double width,
                   std::string_view look) {
    out_ << "<g class=\"" << name << "\" stroke-width=\"" << whole_steps(width * pixel) << "\">\n";
    path.write(out_, "fill=\"none\" " + std::string(look));
    out_ << "</g>\n";
  }

  void draw(SvgPath& path, const std::vector<Point>& points) const {
    path.move(frame_(points.front()));
    for (const Point& p : points) path.line(frame_(p));
  }

  [[nodiscard]] std::vector<GridPoint> places_of(const std::vector<Point>& points) const {
    std::vector<GridPoint> places;
    for (const Point& p : points) places.push_back(frame_(p));
    return places;
  }

  std::ostream& out_;
  const FieldPicture& picture_;
  const Field& field_;
  SvgFrame frame_;
};

}  // namespace

void write_field_svg(std::ostream& out, const FieldPicture& picture, double width) {
  FieldSvgWriter(out, picture, width).write();
}

}  // namespace loft::io
