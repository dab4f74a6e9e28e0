// SPDX-License-Identifier: MIT
#include "io/contours/terrain.h"

#include "tests/io/stacks/readers.h"

namespace loft::io {
namespace {

using testing::problem;
using testing::read;
using Points = std::vector<cdt::Point>;

std::string feature(const std::string& properties, const std::string& type,
                    const std::string& coordinates) {
  return R"({"type":"Feature","properties":)" + properties + R"(,"geometry":{"type":")" + type +
         R"(","coordinates":)" + coordinates + "}}";
}

std::string collection(const std::vector<std::string>& features, const std::string& more = "") {
  std::string text = "{\"type\": \"FeatureCollection\"," + more + "\"features\":[";
  for (const std::string& one : features) text += (text.back() == '[' ? "" : ",") + one;
  return text + "]}";
}

std::string square_line(const std::string& z, double corner, double side,
                        const std::string& third = "") {
  const auto point = [&](double x, double y) {
    return '[' + std::to_string(x) + ',' + std::to_string(y) + third + ']';
  };
  const double far = corner + side;
  return feature(z, "LineString",
                 '[' + point(corner, corner) + ',' + point(far, corner) + ',' + point(far, far) +
                     ',' + point(corner, far) + ',' + point(corner, corner) + ']');
}

std::string elev(double z) { return "{\"ELEV\":" + std::to_string(z) + '}'; }
std::string line(double z, const std::string& coordinates) {
  return feature(elev(z), "LineString", coordinates);
}

ReadOptions closing() {
  ReadOptions options;
  options.open_lines = OpenLines::close_along_border;
  return options;
}

/// Whether a place is in an odd number of contours.
bool is_inside(const Slice& slice, double x, double y) {
  bool inside = false;
  for (const Contour& contour : slice.contours) {
    const Points& p = contour.points;
    for (std::size_t i = 0, k = p.size() - 1; i < p.size(); k = i++)
      if ((p[i].y > y) != (p[k].y > y) &&
          x < p[k].x + (y - p[k].y) / (p[i].y - p[k].y) * (p[i].x - p[k].x))
        inside = !inside;
  }
  return inside;
}

TEST(Terrain, ReadsClosedIsolinesWithAProperty) {
  const Stack stack =
      read(read_terrain, collection({square_line(elev(20), 0, 10), square_line(elev(10), -5, 20)}));
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.slices[0].z, 10);
  EXPECT_EQ(stack.slices[1].contours.at(0),
            (Contour{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, "", "feature 0"}));
  EXPECT_EQ(stack.fill, Fill::even_odd);
  EXPECT_EQ(stack.notes.at(0), "heights are the property ELEV");
}

TEST(Terrain, TakesTheFirstOfTheUsualProperties) {
  const std::string both = R"({"CONTOUR":3,"z":"12.5","label":"hill"})";
  const Stack stack = read(read_terrain, collection({square_line(both, 0, 10)}));
  EXPECT_EQ(stack.slices.at(0).z, 12.5);
  EXPECT_EQ(stack.slices[0].contours.at(0).label, "hill");
  EXPECT_EQ(stack.notes.at(0), "heights are the property z");
}

TEST(Terrain, TakesThePropertyThatItIsTold) {
  ReadOptions options;
  options.z_property = "depth";
  const std::string text = collection({square_line(R"({"ELEV":1,"depth":-7})", 0, 10, ",5")});
  EXPECT_EQ(read(read_terrain, text, options).slices.at(0).z, -7);
  options.z_property = "Depth";
  EXPECT_EQ(problem(read_terrain, text, options),
            "a.file: no feature has a number 'Depth'; name the one that has them by --z-property; "
            "the first feature has 'ELEV', 'depth'");
}

TEST(Terrain, TakesThirdCoordinatesUnlessTheyAreAllTheSame) {
  const Stack third =
      read(read_terrain,
           collection({square_line(elev(1), 0, 9, ",5"), square_line(elev(2), 0, 9, ",6.5")}));
  EXPECT_EQ(third.slices.at(1).z, 6.5);
  EXPECT_TRUE(third.notes.empty());
  const Stack property =
      read(read_terrain,
           collection({square_line(elev(1), 0, 9, ",0"), square_line(elev(2), 0, 9, ",0")}));
  EXPECT_EQ(property.slices.at(1).z, 2);
}

TEST(Terrain, BringsHeightsTogetherThatDifferByRounding) {
  const Stack stack = read(
      read_terrain,
      collection({square_line("{}", 0, 9, ",36.000003814697266"), square_line("{}", 20, 9, ",36"),
                  square_line("{}", 40, 9, ",36"), square_line("{}", 0, 9, ",38")}));
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.slices[0].z, 36);
}

TEST(Terrain, UnitesPolygonsAndKeepsTheirHoles) {
  // The outer ring clockwise, its hole too.
  const std::string rings = "[[[0,0],[0,9],[9,9],[9,0],[0,0]],[[1,1],[1,2],[2,2],[2,1],[1,1]]]";
  const Stack stack =
      read(read_terrain,
           collection({feature(elev(1), "Polygon", rings),
                       feature(elev(1), "MultiPolygon", "[[[[5,5],[20,5],[20,20],[5,5]]]]")}));
  EXPECT_EQ(stack.fill, Fill::nonzero);
  ASSERT_EQ(stack.slices.at(0).contours.size(), 3U);
  EXPECT_EQ(stack.slices[0].contours[0].points, (Points{{0, 0}, {9, 0}, {9, 9}, {0, 9}}));
  EXPECT_EQ(stack.slices[0].contours[1].points, (Points{{1, 1}, {1, 2}, {2, 2}, {2, 1}}));
}

TEST(Terrain, SumsBandsFromTheirLowerHeights) {
  const auto band = [](int low, const std::string& rings) {
    return feature(
        "{\"EMIN\":" + std::to_string(low) + ",\"EMAX\":" + std::to_string(low + 10) + '}',
        "Polygon", rings);
  };
  const std::string inner = "[[3,3],[6,3],[6,6],[3,6],[3,3]]";
  // A pit in the upper band's hole, of the lowest one.
  const Stack stack =
      read(read_terrain, collection({band(0, "[[[4,4],[5,4],[5,5],[4,5],[4,4]]]"),
                                     band(10, "[[[0,0],[9,0],[9,9],[0,9],[0,0]]," + inner + "]"),
                                     band(20, "[" + inner + ",[[4,4],[4,5],[5,5],[5,4],[4,4]]]")}));
  ASSERT_EQ(stack.slices.size(), 3U);
  ASSERT_EQ(stack.slices[0].contours.size(), 1U);  // all of the box
  EXPECT_EQ(stack.slices[0].contours[0].points.size(), 4U);
  EXPECT_EQ(stack.slices[1].contours.size(), 2U);  // with the pit
  EXPECT_FALSE(is_inside(stack.slices[1], 4.5, 4.5));
  EXPECT_TRUE(is_inside(stack.slices[1], 3.5, 3.5));
  EXPECT_EQ(stack.slices[2].z, 20);
  EXPECT_FALSE(is_inside(stack.slices[2], 1, 1));
}

TEST(Terrain, RefusesBandsThatAreNone) {
  std::vector<std::string> features;
  for (int i = 0; i < 1200; ++i) {
    const std::string x = std::to_string(1000 * i);
    features.push_back(feature("{\"EMIN\":" + std::to_string(i) + '}', "Polygon",
                               "[[[" + x + ",0],[" + x + ",9],[" + x + ".5,0],[" + x + ",0]]]"));
  }
  EXPECT_NE(problem(read_terrain, collection(features)).find("a.file: has bands at 1200 heights"),
            std::string::npos);
}

TEST(Terrain, RefusesOpenIsolinesWithTheirNumber) {
  EXPECT_EQ(problem(read_terrain, collection({square_line(elev(1), 0, 9), line(2, "[[0,0],[9,9]]"),
                                              line(3, "[[0,1],[8,9]]")})),
            "a.file: 2 of 3 isolines are open: they end at the border of the data; --close border "
            "closes them along it");
}

TEST(Terrain, JoinsPiecesOfAnIsoline) {
  const Stack stack =
      read(read_terrain, collection({line(2, "[[0,0],[9,0]]"), line(2, "[[0,9],[9,9]]"),
                                     line(2, "[[9,0],[9,9]]"), line(2, "[[0,0],[0,9]]")}));
  EXPECT_EQ(stack.slices.at(0).contours.at(0).points, (Points{{9, 0}, {9, 9}, {0, 9}, {0, 0}}));
}

/// A slope up to the right, with a hill and a pit in it, in the box from 0 to 100.
std::vector<std::string> slope() {
  return {line(10, "[[10,0],[12,50],[10,100]]"), line(20, "[[50,100],[48,50],[50,0]]"),
          line(30, "[[90,0],[88,50],[90,100]]"), square_line(elev(30), 60, 10),
          square_line(elev(10), 20, 10),         line(40, "[[100,40],[97,50],[100,60]]"),
          line(5, "[[0,40],[3,50],[0,60]]")};
}

TEST(Terrain, ClosesIsolinesRoundTheHigherSide) {
  const Stack stack = read(read_terrain, collection(slope()), closing());
  ASSERT_EQ(stack.slices.size(), 5U);
  EXPECT_EQ(stack.notes.at(1), "5 isolines closed along the border of the data");
  const auto heights = [&](double x, double y) {
    std::vector<double> result;
    for (const Slice& slice : stack.slices)
      if (is_inside(slice, x, y)) result.push_back(slice.z);
    return result;
  };
  EXPECT_EQ(heights(1, 50), (std::vector<double>{}));
  EXPECT_EQ(heights(1, 1), (std::vector<double>{5}));
  EXPECT_EQ(heights(15, 50), (std::vector<double>{5, 10}));
  EXPECT_EQ(heights(25, 25), (std::vector<double>{5}));  // the pit
  EXPECT_EQ(heights(55, 99), (std::vector<double>{5, 10, 20}));
  EXPECT_EQ(heights(65, 65), (std::vector<double>{5, 10, 20, 30}));
  EXPECT_EQ(heights(95, 1), (std::vector<double>{5, 10, 20, 30}));
  EXPECT_EQ(heights(99, 50), (std::vector<double>{5, 10, 20, 30, 40}));
}

TEST(Terrain, ClosesIsolinesRoundCorners) {
  // All of the border is high but one corner; the ridge in it says so.
  const Stack stack = read(
      read_terrain,
      collection({line(10, "[[30,0],[30,30],[0,30]]"), line(20, "[[100,60],[60,60],[60,100]]")}),
      closing());
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_TRUE(is_inside(stack.slices[0], 99, 1));
  EXPECT_TRUE(is_inside(stack.slices[0], 1, 99));
  EXPECT_FALSE(is_inside(stack.slices[0], 1, 1));
  EXPECT_TRUE(is_inside(stack.slices[1], 99, 99));
  EXPECT_FALSE(is_inside(stack.slices[1], 1, 99));
}

TEST(Terrain, GivesAPitTheBoxAroundIt) {
  const Stack stack = read(read_terrain,
                           collection({square_line(elev(10), 40, 20), square_line(elev(20), 30, 40),
                                       line(30, "[[0,0],[100,100]]")}),
                           closing());
  EXPECT_FALSE(is_inside(stack.slices.at(0), 50, 50));
  EXPECT_TRUE(is_inside(stack.slices[0], 10, 5));
}

TEST(Terrain, RefusesIsolinesThatEndInside) {
  std::vector<std::string> lines = slope();
  lines.push_back(line(20, "[[70,20],[80,30]]"));
  const std::string text = problem(read_terrain, collection(lines), closing());
  EXPECT_NE(text.find("a.file: 1 isoline of 8 that end inside the data"), std::string::npos)
      << text;
  EXPECT_NE(text.find("feature 7"), std::string::npos);
}

TEST(Terrain, RefusesDegrees) {
  const std::vector<std::string> lines{square_line(elev(100), 8, 1),
                                       square_line(elev(200), 8.2, 0.5)};
  EXPECT_NE(problem(read_terrain, collection(lines)).find("as it seems by their extent"),
            std::string::npos);
  const std::vector<std::string> flat{square_line(elev(1), 8, 1), square_line(elev(2), 8.2, 0.5)};
  EXPECT_EQ(read(read_terrain, collection(flat)).slices.size(), 2U);
  const std::string crs =
      R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:OGC:1.3:CRS84"}},)";
  EXPECT_NE(problem(read_terrain, collection(flat, crs)).find("by its coordinate system"),
            std::string::npos);
}

TEST(Terrain, CountsWhatItLeavesOut) {
  const Stack stack =
      read(read_terrain, collection({square_line(elev(1), 0, 9), square_line("{}", 0, 9),
                                     feature(elev(1), "Point", "[1,1]"),
                                     R"({"type":"Feature","properties":null,"geometry":null})"}));
  EXPECT_EQ(stack.notes.at(1), "1 line without a height, 1 point left out");
  const Stack tilted = read(
      read_terrain, collection({square_line("{}", 0, 9, ",5"), square_line("{}", 0, 9, ",6"),
                                feature("{}", "LineString", "[[0,0,1],[1,0,2],[0,1,3],[0,0,1]]")}));
  EXPECT_EQ(tilted.notes.at(0), "1 line that is in no plane left out");
}

TEST(Terrain, SaysWhatIsWrong) {
  EXPECT_NE(
      problem(read_terrain, collection({square_line("{\"a\":1}", 0, 9)})).find("has no heights"),
      std::string::npos);
  EXPECT_EQ(problem(read_terrain, collection({square_line(elev(1e80), 0, 9)})),
            "a.file: feature 0: height: 1e+80 is beyond 1e+70");
  EXPECT_NE(problem(read_terrain, "{\"type\":\"FeatureCollection\"").find("broken JSON"),
            std::string::npos);
  EXPECT_NE(
      problem(read_terrain, collection({line(1, "[[0,NaN],[1,1]]")})).find("NaN is not a number"),
      std::string::npos);
}

TEST(Terrain, IsKnownByItsFirstWords) {
  EXPECT_TRUE(begins_like_terrain("{\n\"type\" : \"FeatureCollection\","));
  EXPECT_FALSE(begins_like_terrain("{\"z\": 1, \"labels\": [\"FeatureCollection\"]}"));
  EXPECT_FALSE(begins_like_terrain(""));
}

TEST(Terrain, IsHurtByNoCut) {
  testing::expect_no_cut_hurts(read_terrain, collection({square_line(elev(1), 0, 9)}));
}

}  // namespace
}  // namespace loft::io
