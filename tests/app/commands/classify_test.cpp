// SPDX-License-Identifier: MIT
// `loft classify`, when all is well and when it is not.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/maps.h"

namespace loft::app {
namespace {

using namespace testing;

/// Criteria for people: a level line that bends, and a steep one; and what divides nothing.
const std::string criteria = collection({feature("Skill", "[[20,5],[40,5],[60,8]]", "LineString"),
                                         feature("Age", "[[30,0],[30,1]]", "LineString")});

const std::string people =
    "name,x,y,value\r\n"
    "\"Ada, L.\",36,12,3\r\n"
    "Bob,20,2,1.5\r\n"
    "Cyd,30,5,2\r\n"
    "Dan,80,11,4\r\n"
    "Eve,80,10,0.25\r\n";

TEST(ClassifyCommand, TellsTheClassOfEachPoint) {
  const Folder folder;
  static_cast<void>(folder.write("people.csv", people));
  static_cast<void>(folder.write("lines.geojson", criteria));
  const Outcome outcome =
      run(folder, "classify people.csv --separators lines.geojson -o out.csv -o out.geojson");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out,
            "Skill;Age    points  sum of value\n"
            "right;right       1          0.25\n"
            "right;left        1           1.5\n"
            "on;right          1             4\n"
            "on;on             1             2\n"
            "left;right        1             3\n");
  EXPECT_EQ(outcome.err, "5 points, 2 separators: 5 classes\nwrote out.csv\nwrote out.geojson\n");
  EXPECT_EQ(content(folder / "out.csv"),
            "name,x,y,value,class\r\n"
            "\"Ada, L.\",36,12,3,left;right\r\n"
            "Bob,20,2,1.5,right;left\r\n"
            "Cyd,30,5,2,on;on\r\n"
            "Dan,80,11,4,on;right\r\n"
            "Eve,80,10,0.25,right;right\r\n");
  const auto points = nlohmann::json::parse(content(folder / "out.geojson"))["features"];
  ASSERT_EQ(points.size(), 5U);
  EXPECT_EQ(points[0]["properties"],
            nlohmann::json::parse(R"({"name":"Ada, L.","value":3.0,"class":"left;right"})"));
  EXPECT_EQ(points[0]["geometry"],
            nlohmann::json::parse(R"({"type":"Point","coordinates":[36,12]})"));
}

/// What it writes can be read again, and says the same.
TEST(ClassifyCommand, ReadsItsOwnTable) {
  const Folder folder;
  static_cast<void>(folder.write("stdin", people));
  static_cast<void>(folder.write("lines.geojson", criteria));
  ASSERT_EQ(run(folder, "classify - --separators lines.geojson -o a.csv -q").exit_code, 0);
  const Outcome again = run(folder, "classify a.csv --separators lines.geojson -o b.geojson -q");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.err, "");
  const std::string once = content(folder / "b.geojson");
  EXPECT_NE(once.find(R"("class":"on;on")"), std::string::npos);
}

TEST(ClassifyCommand, DrawsClassesInTheirHues) {
  const Folder folder;
  static_cast<void>(folder.write("people.csv", people));
  static_cast<void>(folder.write("lines.geojson", criteria));
  ASSERT_EQ(run(folder, "classify people.csv --separators lines.geojson -o out.svg").exit_code, 0);
  EXPECT_EQ(
      content(folder / "out.svg"),
      R"SVG(<svg xmlns="http://www.w3.org/2000/svg" width="1200" height="344.73" viewBox="0 0 120000 34473" fill="none" stroke-linecap="round" stroke-linejoin="round">
<title>5 points, 2 separators</title>
<g class="classes" fill-rule="evenodd">
<path fill="#e3eaf5" d="m24364 33273 94436 0 0-25748-40982 6148-35636 5345-17818 0 0 7127 0 1782z"/>
<path fill="#e6f0dd" d="m1200 33273 23164 0 0-5346 0-1782 0-7127-17819 0-5345 0z"/>
<path fill="#f5eedb" d="m24364 1200 0 17818 17818 0 35636-5345 40982-6148 0-6325z"/>
<path fill="#fae8d9" d="m1200 19018 5345 0 17819 0 0-17818-23164 0z"/>
</g>
<g class="separators" stroke-width="200">
<path stroke="#3a4350" d="m-228655 19018 235200 0 35637 0 35636-5345 235200-35280m-288654 284734 0-235200 0-1782 0-235200"/>
</g>
<g class="points" stroke-width="800">
<path stroke="#a68a44" d="m35055 6545h0"/>
<path stroke="#99ba80" d="m6545 24364h0"/>
<path stroke="#546070" d="m24364 19018h0"/>
<path stroke="#3a4350" d="m113455 8327h0"/>
<path stroke="#b9c9e6" d="m113455 10109h0"/>
</g>
</svg>
)SVG");
}

TEST(ClassifyCommand, ReportsAsJson) {
  const Folder folder;
  static_cast<void>(folder.write("p.csv", "lat;lon;income\n12;36;7,5\n2;20;1\n2;21;2\n"));
  static_cast<void>(folder.write(
      "lines.geojson",
      collection({feature("Skill", "[[[20,5],[40,5]],[[30,0],[30,1]]]", "MultiLineString"),
                  feature("Lake", '[' + box(0, 0, 1, 1) + ']')})));
  Outcome outcome = run(folder, "classify p.csv --separators lines.geojson --value income --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err,
            "3 points, 2 separators: 2 classes\n"
            "left out 1 polygon or point among the separators\n");
  auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["schema"], "loft-classify");
  EXPECT_EQ(report["schema_version"], 1);
  EXPECT_EQ(report["inputs"], (nlohmann::json{"p.csv", "lines.geojson"}));
  EXPECT_EQ(report["points"], 3);
  EXPECT_EQ(report["separators"], (nlohmann::json{"Skill", "Skill (2)"}));
  EXPECT_EQ(report["value"], "income");
  EXPECT_EQ(report["classes"], nlohmann::json::parse(R"([
      {"signs": ["right", "left"], "points": 2, "sum": 3.0},
      {"signs": ["left", "right"], "points": 1, "sum": 7.5}])"));
  for (const char* stage : {"read", "classify", "write", "total"})
    EXPECT_GE(report["seconds"][stage].get<double>(), 0) << stage;
  outcome = run(folder, "classify p.csv --separators lines.geojson --json --quiet");
  EXPECT_EQ(outcome.err, "");
  report = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(report["value"].is_null());
  EXPECT_TRUE(report["classes"][0]["sum"].is_null());
}

TEST(ClassifyCommand, NamesWhatIsWrongAndWritesNothing) {
  const std::string bad =
      collection({feature("A", "[[[20,5],[20,5],[60,8]],[[0,0],[1,1],[1,1]]]", "MultiLineString"),
                  feature("B", "[[30,0]]", "LineString")});
  expect_bad(
      {{"p.csv", "x,y\n1,2\n"},
       {"bad.csv", "x,y\n1,b\n3\n"},
       {"lines.geojson", criteria},
       {"bad.geojson", bad},
       {"none.geojson", collection({feature("Lake", '[' + box(0, 0, 1, 1) + ']')})}},
      {{"classify p.csv", 2, {"--separators is required"}},
       {"classify - --separators -", 2, {"one file from standard input"}},
       {"classify p.csv --separators lines.geojson -o p.csv", 2, {"p.csv is an input, too"}},
       {"classify p.csv --separators lines.geojson -o q.shp",
        2,
        {"unknown extension '.shp'; known are .csv .geojson .json .svg"}},
       {"classify p.csv --separators lines.geojson -o no/q.csv", 4, {"folder no does not exist"}},
       {"classify p.csv --separators p.csv", 2, {"known are .geojson .json"}},
       {"classify lines.geojson --separators lines.geojson",
        2,
        {"known are .csv .tsv .txt .xy .xyz"}},
       {"classify gone.csv --separators lines.geojson", 3, {"cannot read gone.csv"}},
       {"classify p.csv --separators none.geojson -o q.csv",
        3,
        {"none.geojson: no line in it; a separator is a LineString"}},
       {"classify bad.csv --separators bad.geojson --value income -o q.csv",
        3,
        {"bad.csv: no column 'income'; the columns are 'x', 'y'",
         "bad.csv:2: expected a number for y, found 'b'", "bad.csv:3: y is missing",
         "bad.geojson: 'A': point 1 of the separator repeats the one before it",
         "bad.geojson: 'A (2)': point 2 of the separator repeats the one before it",
         "bad.geojson: 'B': the separator has 1 point and needs two"}}});
}

}  // namespace
}  // namespace loft::app
