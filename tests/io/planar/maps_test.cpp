// SPDX-License-Identifier: MIT
#include "io/maps.h"

#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "io/bytes/file.h"
#include "io/planar/features_geojson.h"
#include "io/planar/map_svg.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using cdt::Point;
using overlay::Polygon;
using testing::content;
using testing::Folder;
using testing::message_of;

Map read(const std::string& text) { return read_features_geojson(text, "a.geojson"); }

std::string written(const Map& map) {
  std::ostringstream out;
  write_features_geojson(out, map);
  return std::move(out).str();
}

const std::string country = R"({"type":"FeatureCollection","features":[
  {"type":"Feature","id":"716","properties":{"name":"Chile",  "people" : 1.90e7, "tags": ["a b", {"c": null}]},
   "geometry":{"type":"MultiPolygon","coordinates":[
     [[[0,0],[9,0],[0,9],[0,0]],[[1,1],[1,2],[2,1],[1,1]]],
     [[[20,0],[21,0],[20,1]]]]}}]})";

TEST(Features, KeepWhatBelongsTogether) {
  const Map map = read(country);
  ASSERT_EQ(map.features.size(), 1U);
  const Feature& feature = map.features.front();
  EXPECT_EQ(feature.polygons,
            (overlay::MultiPolygon{
                {.outer = {{0, 0}, {9, 0}, {0, 9}}, .holes = {{{1, 1}, {1, 2}, {2, 1}}}},
                {.outer = {{20, 0}, {21, 0}, {20, 1}}, .holes = {}}}));
  EXPECT_EQ(feature.id, "\"716\"");
  EXPECT_EQ(feature.properties, R"({"name":"Chile","people":1.90e7,"tags":["a b",{"c":null}]})");
}

TEST(Features, OfACollectionAreTakenApart) {
  const Map map = read(R"({"type":"GeometryCollection","geometries":[
      {"type":"MultiPoint","coordinates":[[1,2],[3,4]]},
      {"type":"LineString","coordinates":[[1,2,300],[3,4],[1,2]]},
      {"type":"Point","coordinates":[5,6]},
      {"type":"Polygon","coordinates":[[],[[0,0],[1,0],[0,1]],[[7,7]]]}]})");
  ASSERT_EQ(map.features.size(), 1U);
  const Feature& feature = map.features.front();
  EXPECT_EQ(feature.points, (std::vector<Point>{{1, 2}, {3, 4}, {5, 6}}));
  EXPECT_EQ(feature.lines, (std::vector<std::vector<Point>>{{{1, 2}, {3, 4}, {1, 2}}}));
  EXPECT_EQ(feature.polygons,
            (overlay::MultiPolygon{{.outer = {{0, 0}, {1, 0}, {0, 1}}, .holes = {{{7, 7}}}}}));
  EXPECT_EQ(feature.properties, "");
}

TEST(Features, HaveProperties) {
  const Map map = read(R"({"type":"FeatureCollection","features":[
      {"type":"Feature","properties":{"name":"caf\u00e9","n":1.50,"yes":true,"none":null,"list":[1],
       "nan":NaN,"name":"last"},"geometry":{"type":"Point","coordinates":[1,2]}},
      {"type":"Feature","properties":null,"geometry":null}]})");
  ASSERT_EQ(map.features.size(), 2U);
  const Feature& feature = map.features.front();
  EXPECT_EQ(property(feature, "name"), "last");
  EXPECT_EQ(property(feature, "n"), "1.50");
  EXPECT_EQ(property(feature, "yes"), "true");
  for (const char* key : {"none", "list", "nan", "other"})
    EXPECT_EQ(property(feature, key), std::nullopt) << key;
  EXPECT_EQ(property_names(feature).size(), 7U);
  EXPECT_NE(feature.properties.find("\"nan\":null"), std::string::npos);
  EXPECT_EQ(property(map.features[1], "name"), std::nullopt);
  EXPECT_TRUE(property_names(map.features[1]).empty());
}

TEST(Features, AreWrittenOneALine) {
  EXPECT_EQ(written(read(country)),
            R"({"type":"FeatureCollection","features":[
{"type":"Feature","id":"716","properties":{"name":"Chile","people":1.90e7,"tags":["a b",{"c":null}]},"geometry":{"type":"MultiPolygon","coordinates":[[[[0,0],[9,0],[0,9],[0,0]],[[1,1],[1,2],[2,1],[1,1]]],[[[20,0],[21,0],[20,1],[20,0]]]]}}
]}
)");
  EXPECT_EQ(written({.features = {{.points = {{1, 2}}},
                                  {.lines = {{{0.1, 2}, {-3, 4}}}, .points = {{1, 2}, {3, 4}}},
                                  {}},
                     .crs = "{}"}),
            R"({"type":"FeatureCollection","crs":{},"features":[
{"type":"Feature","properties":null,"geometry":{"type":"Point","coordinates":[1,2]}},
{"type":"Feature","properties":null,"geometry":{"type":"GeometryCollection","geometries":[{"type":"LineString","coordinates":[[0.1,2],[-3,4]]},{"type":"MultiPoint","coordinates":[[1,2],[3,4]]}]}},
{"type":"Feature","properties":null,"geometry":null}
]}
)");
}

class RandomMaps {
 public:
  explicit RandomMaps(unsigned seed) : random_(seed) {}

  Map next() {
    Map map{.features = {}, .crs = chance() ? R"({"type":"name"})" : ""};
    for (auto features = 1 + random_() % 4; features > 0; --features) {
      Feature& feature = map.features.emplace_back();
      for (auto i = random_() % 3; i > 0; --i) feature.polygons.push_back(polygon());
      for (auto i = random_() % 3; i > 0; --i) feature.lines.push_back(points(1));
      for (auto i = random_() % 3; i > 0; --i) feature.points.push_back(point());
      if (chance()) feature.id = "7";
      if (chance()) feature.properties = R"({"name":"a\"b\\","x":[1e5,{}]})";
    }
    map.features.front().points.push_back(point());
    return map;
  }

 private:
  bool chance() { return random_() % 2 == 0; }
  Point point() { return {coordinate_(random_), coordinate_(random_) * 1e-50}; }
  std::vector<Point> points(std::size_t least) {
    std::vector<Point> result(least + random_() % 6);
    for (Point& p : result) p = point();
    return result;
  }
  Polygon polygon() {
    Polygon result{.outer = points(1), .holes = {}};
    for (auto holes = random_() % 3; holes > 0; --holes) result.holes.push_back(points(1));
    return result;
  }

  std::mt19937_64 random_;
  std::uniform_real_distribution<double> coordinate_{-1e6, 1e6};
};

TEST(Features, WhatIsWrittenIsReadBackExactly) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Map map = RandomMaps(seed).next();
    EXPECT_EQ(read(written(map)), map) << "seed " << seed;
  }
}

// Found by fuzzing: as an id, such a word was written as null, and read back as none.
TEST(Features, NullAndWhatIsNotFiniteAreNoIdsAndNoProperties) {
  for (const std::string word : {"null", "NaN", "Infinity", "-Infinity", "infinity"}) {
    const Map map = read(R"({"type":"Feature","id":)" + word + R"(,"properties":)" + word +
                         R"(,"geometry":{"type":"Point","coordinates":[1,2]}})");
    EXPECT_EQ(map.features.at(0).id, "") << word;
    EXPECT_EQ(map.features.at(0).properties, "") << word;
    std::ostringstream out;
    write_features_geojson(out, map);
    EXPECT_EQ(read(out.str()), map) << word << ": " << out.str();
  }
}

TEST(Features, NameFeaturePartAndPoint) {
  EXPECT_EQ(message_of<InputError>([] {
              static_cast<void>(read(R"({"type":"FeatureCollection","features":[3,
                {"type":"Feature","properties":{"name":"Chile"},"geometry":{"type":"MultiPolygon",
                 "coordinates":[[[[0,0],[1,NaN]],[[1],[2,3]]]]}}]})"));
            }),
            "a.geojson: feature 0: expected a feature, found a number\n"
            "a.geojson: feature 1 ('Chile') polygon 0 ring 0 point 1: NaN is not a number; write a "
            "finite number\n"
            "a.geojson: feature 1 ('Chile') polygon 0 ring 1 point 0: has 1 coordinates instead of "
            "[x, y]");
}

TEST(MapPictures, GiveNeighboursDifferentColours) {
  const auto square = [](double x, const std::string& name) {
    return Feature{.polygons = {{.outer = {{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}, .holes = {}}},
                   .properties = R"({"name":")" + name + "\"}"};
  };
  const auto fills = [](const Map& map) {
    std::ostringstream out;
    write_map_svg(out, map);
    const std::string svg = out.str();
    EXPECT_EQ(svg.find("class=\"edges\""), std::string::npos);
    std::size_t count = 0;
    for (std::size_t at = 0; (at = svg.find("<path fill=", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(fills({.features = {square(0, "a"), square(1, "b")}}), 2U);
  EXPECT_EQ(fills({.features = {square(0, "a"), square(1, "a")}}), 1U);
  Feature frame = square(0, "a");
  frame.properties = "";
  frame.polygons[0].holes = {{{0.2, 0.2}, {0.2, 0.8}, {0.8, 0.8}}};
  EXPECT_EQ(fills({.features = {frame}}), 2U);  // and the water in its hole
}

TEST(Maps, ChooseTheFormatByExtension) {
  const Folder folder;
  const Map map = read(country);
  EXPECT_EQ(read_map(folder.write("a.JSON", country)), map);
  write(folder / "b.geojson", map);
  EXPECT_EQ(read_map(folder / "b.geojson"), map);
  write(folder / "b.svg", map, {.width = 300});
  EXPECT_NE(content(folder / "b.svg").find("width=\"300\""), std::string::npos);
  EXPECT_EQ(
      message_of<UnknownFormat>([&] { check_writable_map(folder / "b.shp"); }),
      (folder / "b.shp").string() + ": unknown extension '.shp'; known are .geojson .json .svg");
  EXPECT_THROW(static_cast<void>(read_map(folder / "b.svg")), UnknownFormat);
  EXPECT_EQ(folder.size(), 3U);
}

TEST(Maps, GatherTheProblemsOfAllFiles) {
  const Folder folder;
  const std::vector<std::filesystem::path> paths{folder.write("a.geojson", "{}"),
                                                 folder.write("b.geojson", country),
                                                 folder.write("c.geojson", "[]")};
  const std::string message = message_of<InputError>([&] { static_cast<void>(read_maps(paths)); });
  EXPECT_NE(message.find("a.geojson: \"type\" is missing\n"), std::string::npos) << message;
  EXPECT_NE(message.find("c.geojson: expected an object"), std::string::npos) << message;
}

}  // namespace
}  // namespace loft::io
