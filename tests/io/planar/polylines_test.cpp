// SPDX-License-Identifier: MIT
#include "io/polylines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "io/bytes/file.h"
#include "io/planar/polylines_geojson.h"
#include "io/planar/polylines_text.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using cdt::closed;
using cdt::open;
using testing::Folder;
using testing::message_of;

std::vector<Polyline> geojson(const std::string& text) {
  return read_polylines_geojson(text, "a.geojson");
}

std::vector<Polyline> text(const std::string& text) { return read_polylines_text(text, "a.txt"); }

std::string geojson_problem(const std::string& text) {
  return message_of<InputError>([&] { static_cast<void>(geojson(text)); });
}

std::string text_problem(const std::string& content) {
  return message_of<InputError>([&] { static_cast<void>(text(content)); });
}

struct Read {
  const char* text;
  std::vector<Polyline> polylines;
};

TEST(GeoJson, ReadsEveryKindOfGeometry) {
  const Read cases[] = {
      {R"({"type":"Point","coordinates":[1,2]})", {{{{1, 2}}, open}}},
      {R"({"type":"MultiPoint","coordinates":[[1,2],[3,4]]})",
       {{{{1, 2}}, open}, {{{3, 4}}, open}}},
      {R"({"type":"LineString","coordinates":[[1,2],[3,4],[1,2]]})",
       {{{{1, 2}, {3, 4}, {1, 2}}, open}}},
      {R"({"type":"MultiLineString","coordinates":[[[1,2],[3,4]],[[5,6],[7,8]]]})",
       {{{{1, 2}, {3, 4}}, open}, {{{5, 6}, {7, 8}}, open}}},
      {R"({"type":"Polygon","coordinates":[[[0,0],[9,0],[0,9],[0,0]],[[1,1],[1,2],[2,1],[1,1]]]})",
       {{{{0, 0}, {9, 0}, {0, 9}}, closed}, {{{1, 1}, {1, 2}, {2, 1}}, closed}}},
      {R"({"type":"MultiPolygon","coordinates":[[[[0,0],[9,0],[0,9],[0,0]]],[[[1,1],[1,2],[2,1],[1,1]]]]})",
       {{{{0, 0}, {9, 0}, {0, 9}}, closed}, {{{1, 1}, {1, 2}, {2, 1}}, closed}}},
      {R"({"type":"GeometryCollection","geometries":[{"type":"Point","coordinates":[1,2]},
           {"type":"GeometryCollection","geometries":[{"type":"Point","coordinates":[3,4]}]}]})",
       {{{{1, 2}}, open}, {{{3, 4}}, open}}},
  };
  for (const auto& [content, polylines] : cases) EXPECT_EQ(geojson(content), polylines) << content;
}

TEST(GeoJson, NamesWhatAFeatureNames) {
  const std::vector<Polyline> expected{
      {{{1, 2}}, open, "caf\xc3\xa9"}, {{{3, 4}}, open, "caf\xc3\xa9"}, {{{5, 6}}, open, ""}};
  EXPECT_EQ(geojson(R"({"type":"FeatureCollection","features":[
      {"type":"Feature","properties":{"id":7,"name":"caf\u00e9"},
       "geometry":{"type":"MultiPoint","coordinates":[[1,2],[3,4]]}},
      {"type":"Feature","properties":{"name":8},
       "geometry":{"type":"Point","coordinates":[5,6]}}]})"),
            expected);
}

TEST(GeoJson, MembersComeInAnyOrder) {
  const std::vector<Polyline> expected{{{{1, 2}, {3, 4}}, open, "river"}};
  EXPECT_EQ(geojson(R"({"geometry":{"coordinates":[[1,2],[3,4]],"type":"LineString"},
                        "properties":{"name":"river"},"type":"Feature"})"),
            expected);
}

TEST(GeoJson, IgnoresWhatDoesNoHarm) {
  const std::vector<Polyline> expected{{{{1, 2}, {3, 4}}, open},
                                       {{{0, 0}, {1, 0}, {0, 1}}, closed}};
  EXPECT_EQ(geojson("\xEF\xBB\xBF"
                    R"({"type":"FeatureCollection","crs":{"a":[{}]},"features":[
      {"type":"Feature","bbox":[0,0,1,1],"geometry":null,"properties":null},
      {"type":"Feature","geometry":{"type":"LineString","coordinates":[]}},
      {"type":"Feature","geometry":{"type":"LineString","coordinates":[[1,2,300],[3,4,null,0]]}},
      {"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[0,1]]]}}]}
      )"),
            expected);
}

struct Bad {
  const char* text;
  const char* message;  ///< the whole of it
};

TEST(GeoJson, NamesFeaturePartAndPoint) {
  const Bad cases[] = {
      {"", "a.geojson:1:1: broken JSON: expected a value, but the text ends"},
      {"[]", "a.geojson: expected an object of GeoJSON {\"type\": ...}, found a list"},
      {"{}", "a.geojson: \"type\" is missing"},
      {"{\"type\":\"Point\",\n  \"coordinates\":[1 2]}", "a.geojson:2:20: broken JSON: expected ,"},
      {"{\"type\":\"Point\",\"coordinates\":[1,2]} x",
       "a.geojson:1:38: broken JSON: something behind the closing bracket"},
      {R"({"type":"Circle","coordinates":[1,2]})", "a.geojson: the type 'Circle' is unknown here"},
      {R"({"type":"Topology","objects":{},"arcs":[]})",
       "a.geojson: this is TopoJSON; convert it to GeoJSON, for example by topo2geo"},
      {R"({"type":"Point"})", "a.geojson: \"coordinates\" is missing"},
      {R"({"type":"GeometryCollection"})", "a.geojson: \"geometries\" is missing"},
      {R"({"type":"FeatureCollection"})", "a.geojson: \"features\" is missing"},
      {R"({"type":"FeatureCollection","features":[]})",
       "a.geojson: no point, line or polygon in it"},
      {R"({"type":"FeatureCollection","features":[3,{"type":"Point","coordinates":[1,2]}]})",
       "a.geojson: feature 0: expected a feature, found a number\n"
       "a.geojson: feature 1: its \"type\" is not \"Feature\""},
      {R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"name":"Chile"},
           "geometry":{"type":"MultiPolygon","coordinates":[[],[[[1,2],[NaN,2]]]]}}]})",
       "a.geojson: feature 0 ('Chile') polygon 1 ring 0 point 1: NaN is not a number; write a "
       "finite number"},
      {R"({"type":"Feature","properties":{"name":"Chile"},"geometry":{"type":"LineString",
           "coordinates":[[1,2],[3],4,[5,"6"],[1e76,0]]}})",
       "a.geojson: feature ('Chile') point 1: has 1 coordinates instead of [x, y]\n"
       "a.geojson: feature ('Chile') point 2: expected a point [x, y], found a number\n"
       "a.geojson: feature ('Chile') point 3: expected a finite number, found a string\n"
       "a.geojson: feature ('Chile') point 4: '1e76' is too large for a coordinate"},
      {R"({"type":"GeometryCollection","geometries":[{"type":"MultiLineString",
           "coordinates":[[[1,2],[-Infinity,4]]]},{"type":"Polygon","coordinates":null}]})",
       "a.geojson: geometry 0 line 0 point 1: -Infinity is not a number; write a finite number\n"
       "a.geojson: geometry 1: \"coordinates\" is missing"},
  };
  for (const auto& [content, message] : cases)
    EXPECT_EQ(geojson_problem(content), message) << content;
}

TEST(GeoJson, DepthIsNoDanger) {
  const std::string lists = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  EXPECT_EQ(geojson_problem(R"({"type":"Point","coordinates":)" + lists + "}"),
            "a.geojson: expected a finite number, found a list\n"
            "a.geojson: has 1 coordinates instead of [x, y]");
  std::string collections = R"({"type":"Point","coordinates":[1,2]})";
  for (int i = 0; i < 20'000; ++i) collections += "]}";
  std::string opening;
  for (int i = 0; i < 20'000; ++i) opening += R"({"type":"GeometryCollection","geometries":[)";
  EXPECT_NE(geojson_problem(opening + collections).find("too many collections in one another"),
            std::string::npos);
}

TEST(GeoJson, SurvivesEveryTruncation) {
  const std::string whole = R"({"type":"FeatureCollection","features":[{"type":"Feature",
      "properties":{"name":"a"},"geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[0,1]]]}}]})";
  EXPECT_EQ(geojson(whole).size(), 1U);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(geojson_problem(whole.substr(0, size)).find("broken JSON"), std::string::npos)
        << size;
  }
}

std::vector<Polyline> random_polylines(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(-1e6, 1e6);
  std::vector<Polyline> polylines(1 + random() % 5);
  for (Polyline& polyline : polylines) {
    polyline.ends = random() % 2 == 0 ? open : closed;
    for (auto points = 1 + random() % 6; points > 0; --points) {
      polyline.points.push_back({coordinate(random), coordinate(random) * 1e-50});
    }
  }
  return polylines;
}

TEST(PolylineText, WhatIsWrittenIsReadBackExactly) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const std::vector<Polyline> polylines = random_polylines(seed);
    std::ostringstream out;
    write_polylines_text(out, polylines);
    EXPECT_EQ(text(out.str()), polylines) << "seed " << seed;
  }
}

TEST(PolylineText, IgnoresBlankLinesAndComments) {
  const std::vector<Polyline> expected{{{{1, 2}, {3, 4}}, open}, {{{5, -6e-3}}, closed}};
  EXPECT_EQ(text("\xEF\xBB\xBF# two lines\n2 0\r\n\t1 2\r\n\n3   4 # here\n1 1\n5 -6e-3"),
            expected);
}

TEST(PolylineText, NamesTheLine) {
  const std::string head = "a line `n closed`: a count of points, then 0 or 1";
  const std::string nothing =
      "a.txt: no polylines in it; expected " + head + ", then n lines `x y`";
  const std::pair<const char*, std::string> cases[] = {
      {"", nothing},
      {"# nothing\n\n", nothing},
      {"3\n", "a.txt:1: expected " + head},
      {"3 1 2\n", "a.txt:1: expected " + head},
      {"0.5 0.6\n", "a.txt:1: expected a count of points, found '0.5'"},
      {"0 1\n", "a.txt:1: expected a count of 1 or more, found '0'"},
      {"-3 1\n", "a.txt:1: expected a count of 1 or more, found '-3'"},
      {"1 2\n", "a.txt:1: expected 0 for open or 1 for closed, found '2'"},
      {"2 0\n1 2\n", "a.txt:2: the file ends where point 1 of 2 of polyline 0 should be"},
      {"999999999999999999 0\n1 2\n",
       "a.txt:2: the file ends where point 1 of 999999999999999999 of polyline 0 should be"},
      {"4 0\n1\nx 2\n1 nan\n1 2 3\n1 0\n-inf 2\n",
       "a.txt:2: the line ends where y should be\n"
       "a.txt:3: expected x, found 'x'\n"
       "a.txt:4: y: NaN is not a number\n"
       "a.txt:5: expected a line `x y`, found a third word '3'\n"
       "a.txt:7: x: -inf is not finite"},
      {"1 0\n0 -1e-99\n", "a.txt:2: y: -1e-99 is nearer to 0 than -1e-50, but not 0"},
  };
  for (const auto& [content, message] : cases) EXPECT_EQ(text_problem(content), message) << content;
}

TEST(PolylineText, GathersAllBadLinesButShowsTwenty) {
  std::string content = "25 0\n";
  for (int i = 0; i < 25; ++i) content += "x y\n";
  const std::string message = text_problem(content);
  EXPECT_EQ(std::ranges::count(message, '\n'), 20);
  EXPECT_TRUE(message.ends_with("\na.txt: and 5 more")) << message;
}

TEST(Polylines, ChoosesTheReaderByExtension) {
  const Folder folder;
  const std::string json = R"({"type":"Point","coordinates":[1,2]})";
  const std::vector<Polyline> expected{{{{1, 2}}, open}};
  EXPECT_EQ(read_polylines(folder.write("a.geojson", json)), expected);
  EXPECT_EQ(read_polylines(folder.write("b.JSON", json)), expected);
  EXPECT_EQ(read_polylines(folder.write("c.txt", "1 0\n1 2\n")), expected);
  const auto unknown = folder.write("d.shp", json);
  EXPECT_EQ(message_of<UnknownFormat>([&] { static_cast<void>(read_polylines(unknown)); }),
            unknown.string() + ": unknown extension '.shp'; known are .geojson .json .txt");
}

TEST(Polylines, GathersTheProblemsOfAllFiles) {
  const Folder folder;
  const std::vector<std::filesystem::path> paths{folder.write("a.geojson", "{}"),
                                                 folder.write("b.txt", "x")};
  const std::string message =
      message_of<InputError>([&] { static_cast<void>(read_polylines(paths)); });
  EXPECT_NE(message.find("a.geojson: \"type\" is missing\n"), std::string::npos) << message;
  EXPECT_NE(message.find("b.txt:1: "), std::string::npos) << message;
  const auto none = folder / "none.txt";
  EXPECT_EQ(message_of<FileError>([&] { static_cast<void>(read_polylines(none)); }),
            "cannot read " + none.string() + ": No such file or directory");
}

}  // namespace
}  // namespace loft::io
