// SPDX-License-Identifier: MIT
// What several samples need: numbers that look random and are the same everywhere, shapes, pictures
// of several panels, triangulations drawn in them, and main().
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "cdt/triangulation.h"
#include "io/bytes/atomic_file.h"
#include "io/planar/palette.h"
#include "io/planar/svg_frame.h"
#include "io/planar/svg_path.h"

namespace samples {

using loft::Colour;
using loft::cdt::Point;

/// The same numbers everywhere.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11U) * 0x1p-53;
  }

 private:
  std::mt19937_64 random_;
};

/// Corners on circles around a place, in turn on an outer and an inner one.
inline std::vector<Point> star(Point centre, double outer, double inner, int corners,
                               double turn = 0) {
  std::vector<Point> ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 2 * std::numbers::pi * i / corners;
    const double radius = i % 2 == 0 ? outer : inner;
    ring.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return ring;
}

constexpr double pixel = loft::io::SvgFrame::steps_per_pixel;
constexpr Colour paper_tone{0xfb, 0xfa, 0xf6};
constexpr Colour solid_tone{0xc9, 0xcf, 0xd6};
constexpr Colour border_tone{0x7d, 0x87, 0x93};
constexpr Colour ink_tone{0x3a, 0x43, 0x50};

/// A colour between others that are evenly spread from 0 to 1.
inline Colour between(const std::vector<Colour>& stops, double part) {
  const double place = std::clamp(part, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const std::size_t first = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double share = place - static_cast<double>(first);
  const auto mixed = [share](double low, double high) {
    return static_cast<std::uint8_t>(std::lround(low + share * (high - low)));
  };
  const Colour low = stops[first];
  const Colour high = stops[first + 1];
  return {mixed(low.red, high.red), mixed(low.green, high.green), mixed(low.blue, high.blue)};
}

// Attributes of what is drawn; widths are in pixels.
inline std::string fill(Colour tone) { return "fill=\"" + loft::io::to_hex(tone) + "\" "; }
inline std::string stroke(Colour tone, double across) {
  return "stroke=\"" + loft::io::to_hex(tone) + "\" stroke-width=\"" +
         loft::io::whole_steps(across * pixel) + "\" ";
}

/// What a picture is made of: panels in rows, from the upper left one; each shows the same box of
/// the plane.
struct Panels {
  loft::cdt::Box shown;
  int columns = 1;
  int rows = 1;
  double width = 900;        ///< of the picture, in pixels
  double gap = 8;            ///< between two panels, in pixels
  double caption_size = 15;  ///< of the letters below each panel, in pixels; 0: there are none
};

/// A picture that is being drawn, into an SVG file that appears when it is finished.
class Drawing {
 public:
  Drawing(const std::string& path, const std::string& title, const Panels& panels)
      : file_(path), panels_(panels), frame_(whole(panels), panels.width) {
    out() << frame_.opening() << "<title>" << title << "</title>\n"
          << "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    const auto [low, high] = panels_.shown;
    for (int panel = panels.columns * panels.rows; panel-- > 0;) {
      turn_to(panel);
      area({{low, {high.x, low.y}, high, {low.x, high.y}}},
           fill(paper_tone) + stroke(border_tone, 0.8));
    }
  }

  /// What follows is drawn in the panel with that number.
  void turn_to(int panel) {
    const int row = panel / panels_.columns;
    shift_ = {column_step(panels_) * (panel % panels_.columns), -row_step(panels_) * row};
  }

  /// What an odd number of rings is around.
  void area(const std::vector<std::vector<Point>>& rings, const std::string& attributes) {
    loft::io::SvgPath path;
    for (const auto& ring : rings) {
      std::vector<loft::io::GridPoint> places;
      for (const Point p : ring) places.push_back(place(p));
      path.loop(places);
    }
    path.write(out(), "fill-rule=\"evenodd\" " + attributes);
  }

  void line(const std::vector<Point>& points, const std::string& attributes) {
    if (points.size() < 2) return;
    loft::io::SvgPath path;
    path.move(place(points.front()));
    for (const Point p : points) path.line(place(p));
    path.write(out(), attributes);
  }

  void lines(const std::vector<std::pair<Point, Point>>& pieces, const std::string& attributes) {
    loft::io::SvgPath path;
    for (const auto& [from, to] : pieces) {
      path.move(place(from));
      path.line(place(to));
    }
    path.write(out(), attributes);
  }

  void dots(const std::vector<Point>& points, Colour tone, double across) {
    loft::io::SvgPath path;
    for (const Point p : points) path.dot(place(p));
    path.write(out(), stroke(tone, across));
  }

  /// Below the panel, in its middle.
  void caption(const std::string& words) {
    const auto [low, high] = panels_.shown;
    const auto at = place({(low.x + high.x) / 2, low.y});
    out() << "<text x=\"" << at.x << "\" y=\""
          << at.y + std::llround(1.35 * panels_.caption_size * pixel)
          << "\" text-anchor=\"middle\" font-family=\"sans-serif\" font-size=\""
          << loft::io::whole_steps(panels_.caption_size * pixel) << "\" " << fill(ink_tone) << ">"
          << words << "</text>\n";
  }

  /// Small cells that fill the panel, in bands of equal colour: `band(p)` is the number of a
  /// colour, or negative where there is none.
  template <class Band>
  void cells(const std::vector<Colour>& colours, double cell, Band band) {
    const auto [low, high] = panels_.shown;
    std::vector<loft::io::SvgPath> paths(colours.size());
    for (double y = low.y; y < high.y; y += cell) {
      const double top = std::min(y + cell, high.y);
      int here = -1;
      double begin = low.x;
      const auto end_run = [&](double x) {
        if (here >= 0)
          paths[static_cast<std::size_t>(here)].loop(
              {place({begin, y}), place({x, y}), place({x, top}), place({begin, top})});
        begin = x;
      };
      for (double x = low.x; x < high.x; x += cell) {
        const int next = band(Point{x + cell / 2, y + cell / 2});
        if (next == here) continue;
        end_run(x);
        here = next;
      }
      end_run(high.x);
    }
    for (std::size_t i = 0; i < paths.size(); ++i)
      paths[i].write(out(), "shape-rendering=\"crispEdges\" " + fill(colours[i]));
  }

  /// How many pixels a length in the plane is.
  [[nodiscard]] double pixels(double length) const { return frame_.length(length) / pixel; }

  void finish() {
    out() << "</svg>\n";
    file_.commit();
  }

 private:
  /// How long a pixel is in the plane.
  static double unit(const Panels& panels) {
    const double across = panels.shown.high.x - panels.shown.low.x;
    return across * panels.columns / (panels.width - panels.gap * (panels.columns - 1));
  }
  static double column_step(const Panels& panels) {
    return panels.shown.high.x - panels.shown.low.x + panels.gap * unit(panels);
  }
  static double caption_height(const Panels& panels) { return 1.8 * panels.caption_size; }
  static double row_step(const Panels& panels) {
    return panels.shown.high.y - panels.shown.low.y +
           (panels.gap + caption_height(panels)) * unit(panels);
  }
  static loft::cdt::Box whole(const Panels& panels) {
    loft::cdt::Box box = panels.shown;
    box.high.x += column_step(panels) * (panels.columns - 1);
    box.low.y -= row_step(panels) * (panels.rows - 1) + caption_height(panels) * unit(panels);
    return box;
  }

  [[nodiscard]] std::ostream& out() { return file_.stream(); }
  [[nodiscard]] loft::io::GridPoint place(Point p) const {
    return frame_({p.x + shift_.x, p.y + shift_.y});
  }

  loft::io::AtomicFile file_;
  Panels panels_;
  loft::io::SvgFrame frame_;
  Point shift_{};
};

/// The edges of a triangulation that are no part of a constraint.
inline void draw_free_edges(Drawing& drawing, const loft::cdt::Triangulation& mesh,
                            const std::string& attributes = stroke(loft::io::edge_tone, 0.6) +
                                                            "stroke-opacity=\"0.5\"") {
  using loft::cdt::EdgeId;
  using loft::cdt::Triangulation;
  std::vector<std::pair<Point, Point>> edges;
  for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
    const EdgeId e(i);
    if (!mesh.is_triangle(Triangulation::triangle(e)) || mesh.twin(e) < e) continue;
    const auto from = mesh.from(e);
    const auto to = mesh.to(e);
    if (from != Triangulation::infinite && to != Triangulation::infinite && !mesh.is_constrained(e))
      edges.emplace_back(mesh.point(from), mesh.point(to));
  }
  drawing.lines(edges, attributes);
}

/// The pieces that a constraint is made of; a dot where it is a point.
inline void draw_constraint(Drawing& drawing, const loft::cdt::Triangulation& mesh,
                            loft::cdt::ConstraintId id, Colour tone, double across = 2) {
  std::vector<std::pair<Point, Point>> edges;
  for (const auto e : mesh.pieces(id))
    edges.emplace_back(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)));
  if (edges.empty()) {
    drawing.dots({mesh.point(mesh.first_vertex(id))}, tone, 3 * across);
  } else {
    drawing.lines(edges, stroke(tone, across));
  }
}

/// The vertices of a triangulation.
inline std::vector<Point> vertices(const loft::cdt::Triangulation& mesh) {
  std::vector<Point> points;
  for (std::uint32_t i = 1; i < mesh.vertex_bound(); ++i)
    if (mesh.is_vertex(loft::cdt::VertexId(i)))
      points.push_back(mesh.point(loft::cdt::VertexId(i)));
  return points;
}

/// How many triangles there are, without those beyond the hull.
inline std::size_t count_triangles(const loft::cdt::Triangulation& mesh) {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i)
    if (const loft::cdt::TriangleId t(i); mesh.is_triangle(t) && !mesh.is_infinite(t)) ++count;
  return count;
}

/// main() of a sample that writes where its argument says, or else there.
template <class Run>
int run_sample(int argc, char** argv, const char* otherwise, Run run) {
  try {
    run(std::string(argc > 1 ? argv[1] : otherwise));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace samples
