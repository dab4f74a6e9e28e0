// SPDX-License-Identifier: MIT
// Queries, edits and pictures of scenes for paths.
#include "io/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "io/bytes/file.h"
#include "io/planar/path_points.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using cdt::Point;
using paths::Path;
using paths::Status;
using paths::Turn;
using testing::content;
using testing::Folder;
using testing::message_of;

std::string query_problem(const std::string& text) {
  return message_of<InputError>([&] { static_cast<void>(read_path_queries_csv(text, "q.csv")); });
}

TEST(PathQueries, AreInTheColumnsOfTheHeader) {
  const std::vector<PathQuery> expected{{{1, 2.5}, {-3e-2, 4}, 0.5}, {{0, 0}, {1, 1}}};
  for (const char* text : {"x0,y0,x1,y1,radius\n1,2.5,-3e-2,4,0.5\n0,0,1,1,\n",
                           "radius;Y1;id;X1;y0;x0\n0.5;4;a;-3e-2;2.5;1\n;1;b;1;0;0\n",
                           "1 2.5 -0.03 4 0.5\n\n# none\n0 0 1 1\n"})
    EXPECT_EQ(read_path_queries_csv(text, "q.csv"), expected) << text;
}

TEST(PathQueries, NameTheLine) {
  EXPECT_EQ(query_problem(""), "q.csv: no queries in it");
  EXPECT_EQ(query_problem("x0,y0,x,y1\n1,2,3,4\n"),
            "q.csv: no column x1; the header names x0, y0, x1, y1, and radius or not");
  EXPECT_EQ(query_problem("x0,y0,x1,y1,radius\n1,2\n1,2,a,nan,-1\n1,2,3,4,x\n"),
            "q.csv:2: x1 is missing\n"
            "q.csv:2: y1 is missing\n"
            "q.csv:3: expected a number for x1, found 'a'\n"
            "q.csv:3: y1: NaN is not a number\n"
            "q.csv:3: radius: -1 is below 0\n"
            "q.csv:4: expected a number for radius, found 'x'");
}

std::string edit_problem(const std::string& text) {
  return message_of<InputError>([&] { static_cast<void>(read_scene_edits(text, "m.ndjson")); });
}

TEST(SceneEdits, AreOneALine) {
  using Kind = SceneEdit::Kind;
  const auto edits = read_scene_edits(
      "\xEF\xBB\xBF{\"move\": \"box\", \"by\": [1, -2.5]}\r\n\n"
      R"({"points": [[0,0],[1,0],[0,1],[0,0]], "ring": 7})"
      "\n"
      R"({"remove": "caf\u00e9", "why": null})"
      "\n"
      R"({"insert": {"id": "new", "layer": "water", "points": [[0,0],[1,0],[0,1]]}})"
      "\n"
      R"({"insert": {"line": [[0,0],[1,0]]}})",
      "m.ndjson");
  const std::vector<SceneEdit> expected{
      {.kind = Kind::move, .feature = "box", .by = {1, -2.5}, .place = "m.ndjson:1"},
      {.kind = Kind::reshape,
       .feature = "7",
       .points = {{0, 0}, {1, 0}, {0, 1}, {0, 0}},
       .place = "m.ndjson:3"},
      {.kind = Kind::remove, .feature = "caf\u00e9", .place = "m.ndjson:4"},
      {.kind = Kind::insert,
       .feature = "new",
       .points = {{0, 0}, {1, 0}, {0, 1}},
       .layer = "water",
       .place = "m.ndjson:5"},
      {.kind = Kind::insert, .points = {{0, 0}, {1, 0}}, .ends = cdt::open, .place = "m.ndjson:6"}};
  EXPECT_EQ(edits, expected);
}

TEST(SceneEdits, NameTheLine) {
  EXPECT_EQ(edit_problem("\n"), "m.ndjson: no edits in it");
  EXPECT_EQ(edit_problem(R"([1])"
                         "\n"
                         R"({"mvoe": "a", "by": [1, 2]})"
                         "\n"
                         R"({"move": "a", "remove": "b"})"
                         "\n"
                         R"({"move": null, "by": [1]})"
                         "\n"
                         R"({"ring": "a"})"
                         "\n"
                         R"({"ring": "a", "points": [[0, NaN], [1e80, 2], 3]})"
                         "\n"
                         R"({"insert": {"layer": 3, "points": [], "line": [[1, 2]]}})"
                         "\n"
                         R"({"remove": "a"} x)"),
            "m.ndjson:1: expected an edit {\"move\": ..., \"by\": [dx, dy]}, {\"ring\": ..., "
            "\"points\": [...]}, {\"remove\": ...} or {\"insert\": {\"points\": [...]}}, found a "
            "list\n"
            "m.ndjson:2: unknown key 'mvoe'; write \"move\"\n"
            "m.ndjson:3: expected an edit {\"move\": ..., \"by\": [dx, dy]}, {\"ring\": ..., "
            "\"points\": [...]}, {\"remove\": ...} or {\"insert\": {\"points\": [...]}}\n"
            "m.ndjson:4: expected the id or name of a feature, found null\n"
            "m.ndjson:4: \"by\": has 1 coordinates instead of [dx, dy]\n"
            "m.ndjson:5: \"points\" is missing; write [[x, y], ...]\n"
            "m.ndjson:6: point 0: NaN is not a number; write a finite number\n"
            "m.ndjson:6: point 1: 1e+80 is beyond 1e+75\n"
            "m.ndjson:6: point 2: expected [x, y], found a number\n"
            "m.ndjson:7: \"layer\": expected the name of a layer, found a number\n"
            "m.ndjson:7: \"points\": no point in it\n"
            "m.ndjson:7: \"insert\": needs \"points\", a ring, or \"line\", one of them\n"
            "m.ndjson:8: broken JSON at column 17: something behind the closing bracket; one "
            "edit a line");
}

/// From (0, 0) to (2, 0), around (2, 1) to the right of it, and up.
Path bent_path() {
  return {.status = Status::found,
          .length = 2 + 1.5707963267948966 + 1,
          .pieces = {{.from = {0, 0}, .to = {2, 0}},
                     {.from = {2, 0}, .to = {3, 1}, .turn = Turn::left, .centre = {2, 1}},
                     {.from = {3, 1}, .to = {3, 2}}}};
}

TEST(PathPoints, ComeNearArcs) {
  const std::vector<Point> points = points_along(bent_path(), {0, 0});
  ASSERT_EQ(points.size(), 3U + 32U);
  EXPECT_EQ(points[1], (Point{2, 0}));
  EXPECT_EQ(points[33], (Point{3, 1}));
  EXPECT_EQ(points.back(), (Point{3, 2}));
  for (std::size_t i = 1; i < 33; ++i) {
    const Point middle{(points[i].x + points[i + 1].x) / 2, (points[i].y + points[i + 1].y) / 2};
    EXPECT_NEAR(std::hypot(points[i].x - 2, points[i].y - 1), 1, 1e-15);
    EXPECT_GE(std::hypot(middle.x - 2, middle.y - 1), 0.999);
    EXPECT_GT(points[i + 1].x, points[i].x);
  }
}

TEST(PathPoints, OfNoPathAreNone) {
  EXPECT_TRUE(points_along({}, {1, 2}).empty());
  const Path at_once{.status = Status::found, .length = 0, .pieces = {}};
  EXPECT_EQ(points_along(at_once, {1, 2}), (std::vector<Point>{{1, 2}}));
}

std::string drawn(Upwards upwards) {
  std::ostringstream out;
  write_paths_svg(
      out,
      {.free = {{.outer = {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, .holes = {}}},
       .walls = {{{1, 2}, {1, 3}}},
       .paths = {{.query = {.from = {0, 0}, .to = {3, 2}, .radius = 0.5}, .path = bent_path()},
                 {.query = {.from = {1, 1}, .to = {2, 2}}, .hue = 9}},
       .upwards = upwards},
      100);
  return std::move(out).str();
}

TEST(PathPictures, HaveArcs) {
  EXPECT_EQ(
      drawn(Upwards::y),
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" viewBox="0 0 10000 10000" fill="none" stroke-linecap="round" stroke-linejoin="round">
<title>2 paths</title>
<rect width="100%" height="100%" fill="#c9cfd6"/>
<g class="free" fill-rule="evenodd">
<path fill="#fbfaf6" stroke="#7d8793" stroke-width="80" d="m100 9900 9800 0 0-9800-9800 0z"/>
</g>
<g class="walls" stroke-width="200">
<path stroke="#3a4350" d="m2550 5000 0-2450"/>
</g>
<path class="band" stroke="#375ca0" stroke-opacity="0.2" stroke-width="2450" d="M100 9900L5000 9900A2450 2450 0 0 0 7450 7450L7450 5000"/>
<path class="path" stroke="#375ca0" stroke-width="200" d="M100 9900L5000 9900A2450 2450 0 0 0 7450 7450L7450 5000"/>
<path class="ends" stroke="#375ca0" stroke-width="700" d="m100 9900h0m7350-4900h0"/>
<path class="ends" stroke="#8f6f22" stroke-width="700" d="m2550 7450h0m2450-2450h0"/>
</svg>
)");
  EXPECT_NE(drawn(Upwards::minus_y).find("M100 100L5000 100A2450 2450 0 0 1 7450 2550L7450 5000"),
            std::string::npos);
}

TEST(Scenes, ChooseTheFormatByExtension) {
  const Folder folder;
  const Scene map = read_scene(folder.write("a.map", "height 1\nwidth 1\nmap\n.\n"));
  EXPECT_EQ(map.upwards, Upwards::minus_y);
  EXPECT_EQ(map.map.features.size(), 1U);
  const Scene point = read_scene(folder.write("a.JSON", R"({"type":"Point","coordinates":[1,2]})"));
  EXPECT_EQ(point.upwards, Upwards::y);
  const std::vector<PathQuery> one{{{0, 0}, {1, 1}}};
  EXPECT_EQ(read_path_queries(folder.write("a.scen", "version 1\n0 a 1 1 0 0 1 1 1\n")), one);
  EXPECT_EQ(read_path_queries(folder.write("a.csv", "0,0,1,1\n")), one);
  EXPECT_EQ(read_scene_edits(folder.write("a.ndjson", R"({"remove":"a"})")).size(), 1U);
  EXPECT_EQ(
      message_of<UnknownFormat>([&] { static_cast<void>(read_scene(folder / "a.svg")); }),
      (folder / "a.svg").string() + ": unknown extension '.svg'; known are .geojson .json .map");
  EXPECT_THROW(static_cast<void>(read_path_queries(folder / "a.map")), UnknownFormat);
  EXPECT_THROW(static_cast<void>(read_scene_edits(folder / "a.csv")), UnknownFormat);
  write(folder / "a.svg", PathPicture{.walls = {{{0, 0}, {1, 1}}}}, 200);
  EXPECT_NE(content(folder / "a.svg").find("width=\"200\""), std::string::npos);
}

}  // namespace
}  // namespace loft::io
