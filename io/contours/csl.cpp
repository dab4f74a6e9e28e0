// SPDX-License-Identifier: MIT
#include "io/contours/csl.h"

#include <map>
#include <optional>
#include <utility>

#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/text_reader.h"
#include "io/contours/coordinate.h"
#include "io/contours/edge_loops.h"
#include "io/contours/planes.h"

namespace loft::io {

namespace {

/// What both formats have: planes with vertices.
class PlaneReader {
 public:
  PlaneReader(std::string_view text, std::string_view name)
      : text_(without_mark(text), name), name_(name), size_(text.size()) {}

  TextReader& text() { return text_; }

  /// Reads all of the file; what stops `read_planes` is listed with what was noted before.
  template <class ReadPlanes>
  void read(const ReadPlanes& read_planes) {
    try {
      read_planes();
      if (text_.next_line())
        text_.fail("expected the end of the file, found " + in_quotes(text_.rest()));
    } catch (const InputError& error) {
      problems_.add(error.what());
    }
    problems_.raise(name_);
  }

  /// A count of things that take so many letters each, at least.
  std::size_t count(std::string_view what, std::size_t letters = 2) {
    return to_count(text_.any_word(what), what, letters);
  }
  [[nodiscard]] std::size_t to_count(std::string_view word, std::string_view what,
                                     std::size_t letters = 2) const {
    const std::int64_t number = text_.to_integer(word, what);
    if (number < 0) text_.fail("expected " + std::string(what) + ", found " + in_quotes(word));
    if (static_cast<std::uint64_t>(number) > size_ / letters + 1)
      text_.fail(std::string(what) + ": " + std::to_string(number) +
                 " is more than the file has room for; it is cut off or damaged");
    return static_cast<std::size_t>(number);
  }

  /// The number of one of so many vertices.
  std::uint32_t index(std::size_t vertices) {
    const std::string_view word = text_.any_word("the number of a vertex");
    const std::int64_t number = text_.to_integer(word, "the number of a vertex");
    if (number < 0 || static_cast<std::uint64_t>(number) >= vertices)
      text_.fail("vertex " + in_quotes(word) + " is none of the plane's " +
                 std::to_string(vertices) + ", which are counted from 0");
    return static_cast<std::uint32_t>(number);
  }

  /// a b c d.
  ContourPlane plane() {
    ContourPlane result;
    for (double& part : result.normal) part = coordinate("a plane a b c d");
    result.offset = coordinate("a plane a b c d");
    if (result.normal == Vec3{}) text_.fail("a plane has the normal 0 0 0, which has no direction");
    return result;
  }

  std::vector<Vec3> vertices(std::size_t count) {
    std::vector<Vec3> result(count);
    for (Vec3& vertex : result)
      for (double& part : vertex) part = coordinate("a coordinate");
    return result;
  }

 private:
  double coordinate(std::string_view what) {
    return coordinate_in(text_, text_.any_word(what), what, problems_);
  }

  TextReader text_;
  std::string_view name_;
  std::size_t size_;
  Problems problems_;
};

std::string source(std::size_t plane, std::size_t contour) {
  return "plane " + std::to_string(plane + 1) + " contour " + std::to_string(contour + 1);
}

/// `25`, a count of points, or `25h3`: those of a hole in component 3.
struct Component {
  std::size_t points = 0;
  std::optional<std::size_t> outline;
};

Component read_component(PlaneReader& in, std::size_t components) {
  const std::string_view word = in.text().any_word("a count of points");
  const std::size_t h = word.find('h');
  Component result{in.to_count(word.substr(0, h), "a count of points"), {}};
  if (h == std::string_view::npos) return result;
  result.outline = in.to_count(word.substr(h + 1), "the number of an outline");
  if (*result.outline >= components)
    in.text().fail("a hole is in component " + std::to_string(*result.outline) +
                   ", which is none of the plane's " + std::to_string(components));
  return result;
}

ContourPlane read_csl_plane(PlaneReader& in, std::size_t plane) {
  static_cast<void>(in.text().any_word("the number of a plane"));
  const std::size_t vertex_count = in.count("a count of vertices", 6);
  const std::size_t components = in.count("a count of components");
  ContourPlane result = in.plane();
  const std::vector<Vec3> vertices = in.vertices(vertex_count);
  std::vector<std::optional<std::size_t>> outlines;
  for (std::size_t i = 0; i < components; ++i) {
    const Component component = read_component(in, components);
    outlines.push_back(component.outline);
    PlaneContour contour{{}, in.count("a material"), source(plane, i)};
    contour.points.reserve(component.points);
    for (std::size_t k = 0; k < component.points; ++k)
      contour.points.push_back(vertices[in.index(vertices.size())]);
    result.contours.push_back(std::move(contour));
  }
  // What writers call a hole's material is now what is around it, now what is in it.
  for (std::size_t i = 0; i < components; ++i)
    if (outlines[i]) result.contours[i].material = result.contours[*outlines[i]].material;
  return result;
}

using Edges = std::vector<std::array<std::uint32_t, 2>>;

/// The edges of each material: those that have it on one side only.
std::map<std::size_t, Edges> read_edges(PlaneReader& in, std::size_t edge_count,
                                        std::size_t vertices) {
  std::map<std::size_t, Edges> edges;
  for (std::size_t i = 0; i < edge_count; ++i) {
    const std::uint32_t from = in.index(vertices);
    const std::uint32_t to = in.index(vertices);
    const std::size_t left = in.count("a material");
    const std::size_t right = in.count("a material");
    if (left == right) continue;
    if (left != 0) edges[left].push_back({from, to});
    if (right != 0) edges[right].push_back({from, to});
  }
  return edges;
}

ContourPlane read_contour_plane(PlaneReader& in, std::size_t plane, std::size_t& open_lines) {
  ContourPlane result = in.plane();
  const std::size_t vertex_count = in.count("a count of vertices", 6);
  const std::size_t edge_count = in.count("a count of edges", 8);
  const std::vector<Vec3> vertices = in.vertices(vertex_count);
  for (auto& [material, edges] : read_edges(in, edge_count, vertices.size())) {
    const EdgeLoops loops = join_edges(std::move(edges));
    open_lines += loops.open_lines;
    for (const auto& loop : loops.loops) {
      PlaneContour contour{{}, material, source(plane, result.contours.size())};
      contour.points.reserve(loop.size());
      for (const std::uint32_t v : loop) contour.points.push_back(vertices[v]);
      result.contours.push_back(std::move(contour));
    }
  }
  return result;
}

}  // namespace

Stack read_csl(const StackInput& input, const ReadOptions&) {
  PlaneReader in(input.bytes, input.name);
  std::vector<ContourPlane> planes;
  in.read([&] {
    const std::string_view magic = in.text().any_word("the word CSLC");
    if (magic != "CSLC") in.text().fail("expected 'CSLC', found " + in_quotes(magic));
    const std::size_t count = in.count("a count of planes");
    static_cast<void>(in.count("a count of materials"));
    for (std::size_t i = 0; i < count; ++i) planes.push_back(read_csl_plane(in, i));
  });
  return stack_of_planes(std::move(planes), 0, input.name);
}

bool begins_like_csl(std::string_view bytes) { return without_mark(bytes).starts_with("CSLC"); }

Stack read_contour(const StackInput& input, const ReadOptions&) {
  PlaneReader in(input.bytes, input.name);
  std::vector<ContourPlane> planes;
  std::size_t open_lines = 0;
  in.read([&] {
    const std::size_t count = in.count("a count of planes");
    for (std::size_t i = 0; i < count; ++i) planes.push_back(read_contour_plane(in, i, open_lines));
  });
  return stack_of_planes(std::move(planes), open_lines, input.name);
}

}  // namespace loft::io
