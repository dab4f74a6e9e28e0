// SPDX-License-Identifier: MIT
#include "io/planar/svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/planar/hues.h"
#include "io/planar/svg_frame.h"
#include "io/planar/svg_path.h"

namespace loft::io {

namespace {

/// The box around all vertices.
cdt::Box box_of(const PlanarMesh& mesh) {
  cdt::Box box;
  for (const cdt::Point& point : mesh.points) box.add(point);
  return box;
}

class SvgWriter {
 public:
  SvgWriter(std::ostream& out, const PlanarMesh& mesh, const SvgOptions& options)
      : out_(out), mesh_(mesh), frame_(box_of(mesh), options.width), hues_(choose_hues(mesh)) {
    places_.reserve(mesh.points.size());
    for (const cdt::Point& point : mesh.points) places_.push_back(frame_(point));
    // Where vertices are a few pixels apart, lines must be thin to be told apart.
    const double area = frame_.width() * frame_.height();
    const double spacing = std::sqrt(area / static_cast<double>(mesh.points.size() + 1));
    line_width_ = std::clamp(0.13 * spacing, 0.35 * SvgFrame::steps_per_pixel,
                             2.2 * SvgFrame::steps_per_pixel);
  }

  void write(const SvgOptions& options) {
    out_ << frame_.opening() << "<title>" << mesh_.points.size() << " vertices, "
         << mesh_.triangles.size() << " triangles, " << mesh_.constraints.size()
         << " constraints</title>\n";
    if (options.has_fill) write_regions();
    if (options.has_edges) write_edges();
    write_constraints();
    write_dots();
    out_ << "</svg>\n";
  }

 private:
  void begin_group(std::string_view name, const std::string& attributes) {
    out_ << "<g class=\"" << name << "\" " << attributes << ">\n";
  }
  void end_group() { out_ << "</g>\n"; }

  static std::string paint(const char* what, Colour colour) {
    return std::string(what) + "=\"" + to_hex(colour) + '"';
  }

  [[nodiscard]] GridPoint start_of(std::size_t edge) const { return places_[mesh_.start_of(edge)]; }

  // Regions: their boundaries, since these are much shorter than all triangles.

  [[nodiscard]] bool is_boundary(std::size_t edge) const {
    const std::uint32_t twin = mesh_.neighbours[edge];
    return twin == PlanarMesh::none || mesh_.region_of[twin / 3] != mesh_.region_of[edge / 3];
  }

  /// The boundary with the same region on the left goes on there.
  [[nodiscard]] std::size_t next_boundary(std::size_t edge) const {
    edge = PlanarMesh::next(edge);
    while (!is_boundary(edge)) edge = PlanarMesh::next(mesh_.neighbours[edge]);
    return edge;
  }

  /// An edge of every loop around every region, by region.
  [[nodiscard]] std::vector<std::size_t> find_loops() const {
    std::vector<std::size_t> starts;
    std::vector<bool> is_found(mesh_.neighbours.size());
    for (std::size_t start = 0; start < is_found.size(); ++start) {
      if (is_found[start] || !is_boundary(start)) continue;
      starts.push_back(start);
      for (std::size_t e = start; !is_found[e]; e = next_boundary(e)) is_found[e] = true;
    }
    std::ranges::sort(starts, {}, [&](std::size_t e) {
      return std::pair(mesh_.region_of[e / 3], e);  // the regions' order, else as found
    });
    return starts;
  }

  [[nodiscard]] std::vector<GridPoint> trace(std::size_t start) const {
    std::vector<GridPoint> loop;
    std::size_t e = start;
    do {
      loop.push_back(start_of(e));
      e = next_boundary(e);
    } while (e != start);
    return loop;
  }

  void write_regions() {
    std::map<std::string, SvgPath> paths;  // by colour
    std::uint32_t last_region = PlanarMesh::none;
    for (const std::size_t start : find_loops()) {
      const std::uint32_t region = mesh_.region_of[start / 3];
      const Colour colour = fill_of(mesh_.regions[region], hues_.of_region[region]);
      SvgPath& path = paths[paint("fill", colour)];
      if (std::exchange(last_region, region) != region) path.allow_cut();
      path.loop(trace(start));
    }
    begin_group("regions", "fill-rule=\"evenodd\"");
    for (const auto& [fill, path] : paths) path.write(out_, fill);
    end_group();
  }

  // Edges without constraint: trails that lead on from edge to edge, since a trail needs one place
  // an edge and separate edges need two.

  [[nodiscard]] std::vector<bool> find_free_edges() const {
    std::vector<bool> is_free(mesh_.neighbours.size());
    for (std::size_t e = 0; e < is_free.size(); ++e) is_free[e] = mesh_.pieces_along(e).empty();
    return is_free;
  }

  /// A free edge that goes on where this one ends, or `edge` itself if a quick look finds none.
  [[nodiscard]] std::size_t find_next(const std::vector<bool>& is_free, std::size_t edge) const {
    constexpr int looks = 8;
    std::size_t e = PlanarMesh::next(edge);
    for (int i = 0; i < looks; ++i) {
      if (is_free[e]) return e;
      if (mesh_.neighbours[e] == PlanarMesh::none) break;
      e = PlanarMesh::next(mesh_.neighbours[e]);
    }
    return edge;
  }

  void write_edges() {
    std::vector<bool> is_free = find_free_edges();
    SvgPath path;
    const auto draw = [&](std::size_t e) {
      is_free[e] = false;
      if (mesh_.neighbours[e] != PlanarMesh::none) is_free[mesh_.neighbours[e]] = false;
      path.line(start_of(PlanarMesh::next(e)));
    };
    for (std::size_t start = 0; start < is_free.size(); ++start) {
      if (!is_free[start]) continue;
      path.allow_cut();
      path.move(start_of(start));
      draw(start);
      for (std::size_t e = start, next = find_next(is_free, e); next != e;) {
        draw(next);
        e = std::exchange(next, find_next(is_free, next));
      }
    }
    begin_group("edges", paint("stroke", edge_tone) + " stroke-opacity=\"0.55\" stroke-width=\"" +
                             whole_steps(0.3 * line_width_) + '"');
    path.write(out_, "");
    end_group();
  }

  // Constraints.

  /// A path and the vertex where it ends.
  struct Pen {
    SvgPath path;
    std::uint32_t at = PlanarMesh::none;
  };

  void write_constraints() {
    std::array<Pen, hue_count> own;
    Pen shared;
    std::vector<bool> is_drawn(mesh_.pieces.size());
    for (std::size_t c = 0; c < mesh_.constraints.size(); ++c) {
      const std::vector<std::uint32_t>& vertices = mesh_.constraints[c].vertices;
      for (std::size_t i = 1; i < vertices.size(); ++i) {
        const auto pieces = mesh_.pieces_along(vertices[i - 1], vertices[i]);
        const auto first = static_cast<std::size_t>(pieces.data() - mesh_.pieces.data());
        if (is_drawn[first]) continue;
        is_drawn[first] = true;
        Pen& pen = pieces.size() > 1 ? shared : own[hues_.of_constraint[c]];
        draw(pen, vertices[i - 1], vertices[i]);
      }
    }
    begin_group("constraints", "stroke-width=\"" + whole_steps(line_width_) + '"');
    for (std::size_t hue = 0; hue < hue_count; ++hue)
      own[hue].path.write(out_, paint("stroke", dark_tone(hue)));
    shared.path.write(out_, paint("stroke", shared_tone));
    end_group();
  }

  void draw(Pen& pen, std::uint32_t from, std::uint32_t to) {
    if (pen.at != from) {
      pen.path.allow_cut();
      pen.path.move(places_[from]);
    }
    pen.path.line(places_[to]);
    pen.at = to;
  }

  void write_dots() {
    std::array<SvgPath, hue_count> paths;
    for (std::size_t c = 0; c < mesh_.constraints.size(); ++c) {
      const std::vector<std::uint32_t>& vertices = mesh_.constraints[c].vertices;
      if (vertices.size() != 1) continue;
      paths[hues_.of_constraint[c]].allow_cut();
      paths[hues_.of_constraint[c]].dot(places_[vertices[0]]);
    }
    begin_group("points", "stroke-width=\"" + whole_steps(3.5 * line_width_) + '"');
    for (std::size_t hue = 0; hue < hue_count; ++hue)
      paths[hue].write(out_, paint("stroke", dark_tone(hue)));
    end_group();
  }

  std::ostream& out_;
  const PlanarMesh& mesh_;
  SvgFrame frame_;
  Hues hues_;
  std::vector<GridPoint> places_;
  double line_width_ = 0;
};

}  // namespace

void write_svg(std::ostream& out, const PlanarMesh& mesh, const SvgOptions& options) {
  SvgWriter(out, mesh, options).write(options);
}

}  // namespace loft::io
