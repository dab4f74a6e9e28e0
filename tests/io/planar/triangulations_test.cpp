// SPDX-License-Identifier: MIT
#include "io/triangulations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "io/bytes/file.h"
#include "io/meshes.h"
#include "io/planar/hues.h"
#include "io/planar/palette.h"
#include "io/planar/planar_json.h"
#include "io/planar/planar_ply.h"
#include "io/polylines.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using cdt::closed;
using cdt::open;
using cdt::Point;
using testing::Folder;
using testing::message_of;

Polyline square(double low, double high, const std::string& name = "") {
  return {{{low, low}, {high, low}, {high, high}, {low, high}}, closed, name};
}

/// The planar mesh of polylines that are inserted in the order given, and numbered as they are.
PlanarMesh mesh_of(const std::vector<Polyline>& polylines, const std::vector<std::size_t>& order) {
  cdt::Triangulation triangulation;
  std::vector<NamedConstraint> constraints(polylines.size());
  for (const std::size_t i : order) {
    constraints[i] = {triangulation.insert(polylines[i].points, polylines[i].ends),
                      polylines[i].name};
  }
  return to_planar_mesh(triangulation, constraints);
}

PlanarMesh mesh_of(const std::vector<Polyline>& polylines) {
  std::vector<std::size_t> order(polylines.size());
  std::iota(order.begin(), order.end(), 0U);
  return mesh_of(polylines, order);
}

std::string written(const std::function<void(std::ostream&)>& write) {
  std::ostringstream out;
  write(out);
  return std::move(out).str();
}

std::string svg_of(const PlanarMesh& mesh, const SvgOptions& options = {}) {
  return written([&](std::ostream& out) { write_svg(out, mesh, options); });
}

nlohmann::json json_of(const PlanarMesh& mesh) {
  return nlohmann::json::parse(written([&](std::ostream& out) { write_planar_json(out, mesh); }));
}

/// Squares in squares, one that crosses them, a line and a point.
std::vector<Polyline> some_polylines() {
  return {square(0, 10, "outer"),
          square(2, 8, "inner"),
          square(-3, 4),
          {{{-5, 1}, {5, 20}, {12, 3}}, open, "line"},
          {{{5, 5}}, open, "point"}};
}

std::vector<Polyline> random_rings(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0, 10);
  std::vector<Polyline> rings;
  for (int i = 0; i < 20; ++i) {
    const Point middle{place(random), place(random)};
    Polyline ring{{}, closed};
    for (int corner = 0; corner < 7; ++corner) {
      const double angle = 6.283185307179586 * corner / 7;
      ring.points.push_back({middle.x + std::cos(angle), middle.y + std::sin(angle)});
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

// Planar meshes.

TEST(PlanarMesh, NumbersFollowFromCoordinates) {
  const PlanarMesh mesh = mesh_of({square(0, 1)});
  EXPECT_EQ(mesh.points, (std::vector<Point>{{0, 0}, {0, 1}, {1, 0}, {1, 1}}));
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_TRUE(std::ranges::is_sorted(mesh.triangles));
  for (const auto& [a, b, c] : mesh.triangles) EXPECT_TRUE(a < b && a < c);
  EXPECT_EQ(mesh.constraints[0].vertices, (std::vector<std::uint32_t>{0, 2, 3, 1, 0}));
  EXPECT_EQ(mesh.pieces.size(), 4U);
  EXPECT_EQ(count_constrained_edges(mesh), 4U);
}

TEST(PlanarMesh, TheOrderOfInsertionDoesNotMatter) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::vector<Polyline> polylines = random_rings(seed);
    for (const Polyline& polyline : some_polylines()) polylines.push_back(polyline);
    std::vector<std::size_t> order(polylines.size());
    std::iota(order.begin(), order.end(), 0U);
    const PlanarMesh first = mesh_of(polylines, order);
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    EXPECT_EQ(mesh_of(polylines, order), first) << "seed " << seed;
  }
}

TEST(PlanarMesh, WithoutNamesConstraintsAreNumberedByTheirCourses) {
  std::vector<Polyline> polylines = random_rings(7);
  const auto unnamed = [&] {
    cdt::Triangulation triangulation;
    for (const Polyline& polyline : polylines) triangulation.insert(polyline.points, polyline.ends);
    return to_planar_mesh(triangulation);
  };
  const PlanarMesh first = unnamed();
  std::ranges::reverse(polylines);
  EXPECT_EQ(unnamed(), first);
}

TEST(PlanarMesh, NeighboursAreEachOthers) {
  const PlanarMesh mesh = mesh_of(some_polylines());
  ASSERT_EQ(mesh.neighbours.size(), 3 * mesh.triangles.size());
  for (std::size_t e = 0; e < mesh.neighbours.size(); ++e) {
    const std::uint32_t twin = mesh.neighbours[e];
    if (twin == PlanarMesh::none) continue;
    EXPECT_EQ(mesh.neighbours[twin], e);
    EXPECT_EQ(mesh.start_of(twin), mesh.start_of(PlanarMesh::next(e)));
  }
}

TEST(PlanarMesh, RegionsKnowWhatEnclosesThem) {
  const PlanarMesh nested = mesh_of({square(0, 9), square(1, 8), square(2, 7)});
  std::map<bool, int> parities;
  for (const PlanarMesh::Region& region : nested.regions) ++parities[region.is_odd];
  EXPECT_EQ(nested.regions.size(), 3U);
  EXPECT_EQ(parities[true], 2);
  // A hole of the same name has nothing around it; islands of one name are alike.
  const PlanarMesh named =
      mesh_of({square(0, 9, "a"), square(1, 8, "a"), square(2, 3, "a"), square(4, 5, "b")});
  std::multiset<std::uint64_t> keys;
  for (const PlanarMesh::Region& region : named.regions) keys.insert(region.key);
  EXPECT_EQ(keys.size(), 4U);
  EXPECT_EQ(keys.count(0), 1U);
  EXPECT_EQ(keys.count(named.constraints[0].key), 2U);
  EXPECT_EQ(keys.count(named.constraints[3].key), 1U);
}

TEST(PlanarMesh, OpenLinesDivideRegionsButEncloseNothing) {
  const PlanarMesh mesh = mesh_of({square(0, 2, "a"), {{{0, 0}, {2, 2}}, open}});
  ASSERT_EQ(mesh.regions.size(), 2U);
  EXPECT_TRUE(mesh.regions[0].is_odd && mesh.regions[1].is_odd);
  EXPECT_EQ(mesh.regions[0].key, mesh.regions[1].key);
}

TEST(PlanarMesh, AConstraintThatOverlapsItselfCountsItsPassages) {
  const PlanarMesh mesh = mesh_of({{{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 0}, {0, 4}}, closed}});
  const auto along = mesh.pieces_along(0, 2);  // (0, 0) to (2, 0)
  ASSERT_EQ(along.size(), 1U);
  EXPECT_EQ(along[0].passages, 2U);
}

TEST(PlanarMesh, HasNoNegativeZeros) {
  const PlanarMesh mesh = mesh_of({{{{-0.0, -0.0}, {1, -0.0}, {-0.0, 1}}, closed}});
  EXPECT_FALSE(std::signbit(mesh.points[0].x));
  EXPECT_FALSE(std::signbit(mesh.points[0].y));
}

// Colours.

TEST(Palette, NeighboursDifferAndNamesAgree) {
  const PlanarMesh mesh = mesh_of({{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, closed, "west"},
                                   {{{1, 0}, {2, 0}, {2, 1}, {1, 1}}, closed, "east"},
                                   {{{5, 0}, {6, 0}, {6, 1}, {5, 1}}, closed, "west"}});
  const Hues hues = choose_hues(mesh);
  std::map<std::uint64_t, std::set<int>> hues_of_key;
  for (std::size_t i = 0; i < mesh.regions.size(); ++i)
    hues_of_key[mesh.regions[i].key].insert(hues.of_region[i]);
  const auto west = hues_of_key[mesh.constraints[0].key];
  const auto east = hues_of_key[mesh.constraints[1].key];
  EXPECT_EQ(west.size(), 1U);
  EXPECT_EQ(east.size(), 1U);
  EXPECT_NE(west, east);
  EXPECT_EQ(hues.of_constraint[0], *west.begin());
  EXPECT_EQ(hues.of_constraint[0], hues.of_constraint[2]);
}

// SVG.

/// What is in the attribute `d` of all paths of a group.
std::vector<std::string> paths_of(const std::string& svg, const std::string& group) {
  std::vector<std::string> paths;
  const std::size_t begin = svg.find("<g class=\"" + group + '"');
  if (begin == std::string::npos) return paths;
  const std::size_t end = svg.find("</g>", begin);
  for (std::size_t at = begin; (at = svg.find(" d=\"", at)) < end;) {
    at += 4;
    paths.push_back(svg.substr(at, svg.find('"', at) - at));
  }
  return paths;
}

/// How many lines the path data draw.
std::size_t count_lines(const std::string& data) {
  std::size_t numbers = 0;
  std::size_t moves = 0;
  for (std::size_t i = 0; i < data.size(); ++i) {
    const auto is_part = [](char c) { return (c >= '0' && c <= '9') || c == '-'; };
    if (data[i] == 'm') ++moves;
    if (is_part(data[i]) && (data[i] == '-' || i == 0 || !is_part(data[i - 1]))) ++numbers;
  }
  EXPECT_EQ(numbers % 2, 0U) << data;
  return numbers / 2 - moves;
}

std::size_t count_lines(const std::vector<std::string>& paths) {
  std::size_t count = 0;
  for (const std::string& path : paths) count += count_lines(path);
  return count;
}

/// Whether elements are nested and attributes quoted as XML wants it.
bool is_well_formed(const std::string& xml) {
  std::vector<std::string> elements;
  for (std::size_t at = 0; (at = xml.find('<', at)) != std::string::npos;) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (std::ranges::count(tag, '"') % 2 != 0 || tag.find('<') != std::string::npos) return false;
    if (tag.starts_with('/')) {
      if (elements.empty() || elements.back() != tag.substr(1)) return false;
      elements.pop_back();
    } else if (!tag.ends_with('/')) {
      elements.push_back(tag.substr(0, tag.find(' ')));
    }
    at = end;
  }
  return elements.empty();
}

TEST(Svg, DrawsEveryEdgeOnce) {
  std::vector<std::vector<Polyline>> inputs{some_polylines(), {square(0, 1), square(0, 1)}};
  for (unsigned seed = 0; seed < 5; ++seed) inputs.push_back(random_rings(seed));
  for (const std::vector<Polyline>& polylines : inputs) {
    const PlanarMesh mesh = mesh_of(polylines);
    const std::string svg = svg_of(mesh);
    EXPECT_TRUE(is_well_formed(svg));
    const std::size_t edges = mesh.points.size() + mesh.triangles.size() - 1;  // Euler
    const std::size_t constrained = count_constrained_edges(mesh);
    EXPECT_EQ(count_lines(paths_of(svg, "constraints")), constrained);
    EXPECT_EQ(count_lines(paths_of(svg, "edges")), edges - constrained);
  }
}

TEST(Svg, ShowsRegionsInTheirColours) {
  const PlanarMesh mesh = mesh_of({square(1, 8, "land"),
                                   square(2, 4, "land"),
                                   square(5, 7),
                                   {{{0, 0}}, open},
                                   {{{9, 9}}, open}});
  const std::string svg = svg_of(mesh);
  const Hues hues = choose_hues(mesh);
  std::set<std::string> fills;
  for (std::size_t i = 0; i < mesh.regions.size(); ++i)
    fills.insert(to_hex(fill_of(mesh.regions[i], hues.of_region[i])));
  EXPECT_EQ(fills.size(), 3U);  // land, water around it and in its hole, an unnamed hole
  EXPECT_TRUE(fills.contains(to_hex(outside_tone)));
  for (const std::string& fill : fills)
    EXPECT_NE(svg.find("<path fill=\"" + fill + '"'), std::string::npos) << fill;
  EXPECT_EQ(paths_of(svg, "regions").size(), 3U);
}

TEST(Svg, SharedEdgesAreDark) {
  const std::string dark = "<path stroke=\"" + to_hex(shared_tone);
  EXPECT_EQ(svg_of(mesh_of({square(0, 1)})).find(dark), std::string::npos);
  EXPECT_NE(svg_of(mesh_of({square(0, 1), square(0, 1)})).find(dark), std::string::npos);
}

TEST(Svg, HasYUpwardsAndTheWidthAskedFor) {
  const PlanarMesh mesh = mesh_of({{{{0, 0}, {100, 0}, {100, 50}, {0, 50}}, closed}});
  SvgOptions options;
  options.width = 500;
  const std::string svg = svg_of(mesh, options);
  EXPECT_NE(svg.find("width=\"500\" height=\"255\" viewBox=\"0 0 50000 25500\""), std::string::npos)
      << svg;
  // From the lower left corner to the right, up, back and down.
  EXPECT_EQ(paths_of(svg, "constraints").at(0), "m500 25000 49000 0 0-24500-49000 0 0 24500");
}

TEST(Svg, LeavesOutWhatIsNotWanted) {
  SvgOptions options;
  options.has_fill = false;
  options.has_edges = false;
  const std::string svg = svg_of(mesh_of(some_polylines()), options);
  EXPECT_TRUE(is_well_formed(svg));
  EXPECT_TRUE(paths_of(svg, "regions").empty());
  EXPECT_TRUE(paths_of(svg, "edges").empty());
  EXPECT_FALSE(paths_of(svg, "constraints").empty());
}

TEST(Svg, PointsAreDots) {
  const auto dots = paths_of(svg_of(mesh_of({{{{3, 3}}, open}})), "points");
  ASSERT_EQ(dots.size(), 1U);
  EXPECT_TRUE(dots[0].ends_with("h0")) << dots[0];
}

TEST(Svg, DrawsWhatHasNoArea) {
  const std::vector<std::vector<Polyline>> inputs{
      {{{{3, 3}}, open}},
      {{{{3, 3}, {3, 3}}, open}},
      {{{{0, 0}, {1, 0}, {2, 0}}, open}},
      {{{{0, 0}, {0, 7}}, closed}},
      {{{{-1e75, -1e75}, {1e75, 1e75}}, open}},
      {{{{0, 0}, {1e-50, 0}, {0, 1e-50}}, closed}},
      {{{{1e9, 0}, {1e9, 1e-9}, {1e9 + 1, 1}}, closed}},
  };
  for (const std::vector<Polyline>& polylines : inputs) {
    const PlanarMesh mesh = mesh_of(polylines);
    const std::string svg = svg_of(mesh);
    EXPECT_TRUE(is_well_formed(svg));
    EXPECT_EQ(svg.find("nan"), std::string::npos) << svg;
    EXPECT_FALSE(paths_of(svg, "constraints").empty() && paths_of(svg, "points").empty()) << svg;
    static_cast<void>(json_of(mesh));
  }
  EXPECT_TRUE(is_well_formed(svg_of(to_planar_mesh(cdt::Triangulation()))));
}

TEST(Svg, CutsPathsThatParsersWouldRefuse) {
  std::vector<Polyline> points;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0, 1);
  for (int i = 0; i < 60'000; ++i) points.push_back({{{place(random), place(random)}}, open});
  const auto edges = paths_of(svg_of(mesh_of(points)), "edges");
  EXPECT_GT(edges.size(), 1U);
  for (const std::string& path : edges) {
    EXPECT_LT(path.size(), 5'000'000U);
    EXPECT_EQ(path[0], 'm');
  }
}

// PLY.

TEST(PlanarPly, IsReadAsAMesh) {
  const Folder folder;
  const PlanarMesh mesh = mesh_of(some_polylines());
  write(folder / "a.ply", mesh);
  const std::vector<LabelledMesh> read = read_meshes(folder / "a.ply");
  ASSERT_EQ(read.size(), 1U);
  ASSERT_EQ(read[0].mesh.points.size(), mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_EQ(read[0].mesh.points[i], (Vec3{mesh.points[i].x, mesh.points[i].y, 0}));
  }
  EXPECT_EQ(read[0].mesh.faces, mesh.triangles);
}

TEST(PlanarPly, CarriesRegionsConstraintsAndNames) {
  const std::string ply = written(
      [](std::ostream& out) { write_planar_ply(out, mesh_of({square(0, 1, "two\nlines")})); });
  for (const char* line :
       {"comment constraint 0 two_lines\n", "element vertex 4\n", "element face 2\n",
        "property list uchar int vertex_indices\nproperty int region\nproperty uchar red\n",
        "element edge 4\nproperty int vertex1\nproperty int vertex2\nproperty int constraint\n"}) {
    EXPECT_NE(ply.find(line), std::string::npos) << line;
  }
  const std::size_t body = ply.size() - ply.find("end_header\n") - 11;
  EXPECT_EQ(body, 4U * 24 + 2U * 20 + 4U * 12);
}

// JSON.

TEST(PlanarJson, HoldsEverything) {
  const PlanarMesh mesh = mesh_of(some_polylines());
  const nlohmann::json json = json_of(mesh);
  EXPECT_EQ(json["schema"], "loft-triangulation");
  EXPECT_EQ(json["schema_version"], 1);
  ASSERT_EQ(json["vertices"].size(), mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_EQ(json["vertices"][i][0].get<double>(), mesh.points[i].x);
    EXPECT_EQ(json["vertices"][i][1].get<double>(), mesh.points[i].y);
  }
  EXPECT_EQ(json["triangles"].size(), mesh.triangles.size());
  EXPECT_EQ(json["region_of"].size(), mesh.triangles.size());
  EXPECT_EQ(json["regions"].size(), mesh.regions.size());
  EXPECT_EQ(json["constrained_edges"].size(), count_constrained_edges(mesh));
  ASSERT_EQ(json["constraints"].size(), 5U);
  EXPECT_EQ(json["constraints"][0]["name"], "outer");
  EXPECT_EQ(json["constraints"][0]["closed"], true);
  EXPECT_FALSE(json["constraints"][2].contains("name"));
  EXPECT_EQ(json["constraints"][3]["closed"], false);
  EXPECT_EQ(json["constraints"][4]["vertices"].size(), 1U);
}

/// Law: an edge lists a constraint exactly if the constraint's course passes it.
TEST(PlanarJson, CoursesAndEdgesAgree) {
  const nlohmann::json json = json_of(mesh_of(some_polylines()));
  std::set<std::array<int, 3>> by_edges;
  for (const auto& edge : json["constrained_edges"])
    for (const int constraint : edge["constraints"])
      by_edges.insert({edge["vertices"][0], edge["vertices"][1], constraint});
  std::set<std::array<int, 3>> by_courses;
  for (int c = 0; c < 5; ++c) {
    const std::vector<int> course = json["constraints"][static_cast<std::size_t>(c)]["vertices"];
    for (std::size_t i = 1; i < course.size(); ++i)
      by_courses.insert(
          {std::min(course[i - 1], course[i]), std::max(course[i - 1], course[i]), c});
  }
  EXPECT_EQ(by_edges, by_courses);
}

// Files.

TEST(Triangulations, EqualTriangulationsGiveEqualBytes) {
  const Folder folder;
  const std::vector<Polyline> polylines = some_polylines();
  const PlanarMesh forwards = mesh_of(polylines);
  const PlanarMesh backwards = mesh_of(polylines, {4, 3, 2, 1, 0});
  for (const std::string extension : {".svg", ".ply", ".json"}) {
    write(folder / ("a" + extension), forwards);
    write(folder / ("b" + extension), backwards);
    EXPECT_EQ(testing::content(folder / ("a" + extension)),
              testing::content(folder / ("b" + extension)));
  }
}

TEST(Triangulations, AnUnknownExtensionNamesTheKnownOnes) {
  const Folder folder;
  const auto path = folder / "a.png";
  const std::string message =
      path.string() + ": unknown extension '.png'; known are .svg .ply .json";
  EXPECT_EQ(message_of<UnknownFormat>([&] { write(path, PlanarMesh()); }), message);
  EXPECT_EQ(message_of<UnknownFormat>([&] { check_writable_triangulation(path); }), message);
}

TEST(Triangulations, CheckingLeavesNothingBehind) {
  const Folder folder;
  check_writable_triangulation(folder / "a.svg");
  EXPECT_EQ(folder.size(), 0U);
}

}  // namespace
}  // namespace loft::io
