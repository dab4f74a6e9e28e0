// SPDX-License-Identifier: MIT
// `loft path`, when all is well and when it is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/maps.h"

namespace loft::app {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// A feature with an id, and what else its properties are.
std::string with_id(const std::string& id, const std::string& properties,
                    const std::string& coordinates, const std::string& type = "Polygon") {
  return R"({"type":"Feature","id":)" + id + R"(,"properties":{)" + properties +
         R"(},"geometry":{"type":")" + type + R"(","coordinates":)" + coordinates + "}}";
}

/// Two boxes that overlap, one of them clockwise, and a wall on the second.
const std::string room =
    collection({with_id("\"box\"", "", '[' + box(2, 2, 4, 6) + ']'),
                feature("bar", "[[[3,5],[3,6],[7,6],[7,5],[3,5]]]"),
                feature("door", "[[7,6],[7,9]]", "LineString"), feature("lamp", "[1,1]", "Point")});

TEST(PathCommand, FindsTheShortestWay) {
  const Folder folder;
  static_cast<void>(folder.write("room.geojson", room));
  const std::string table =
      "query,edit,status,radius,length,points\r\n"
      "0,0,found,0,10.30308784984488,1 4;2 6;7 9;8 7\r\n";
  const Outcome outcome = run(folder, "path room.geojson --from 1,4 --to 8,7");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, table);
  EXPECT_EQ(outcome.err, "1 path: 1 found\nleft out 1 point of the scene\n");
  ASSERT_EQ(run(folder, "path room.geojson --from 1,4 --to 8,7 -o a.csv -o a.geojson -o a.svg -q")
                .exit_code,
            0);
  EXPECT_EQ(content(folder / "a.csv"), table);
  EXPECT_EQ(content(folder / "a.geojson"),
            R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"query":0,"edit":0,"status":"found","radius":0,"length":10.30308784984488},"geometry":{"type":"LineString","coordinates":[[1,4],[2,6],[7,9],[8,7]]}}
]}
)");
  const std::string picture = content(folder / "a.svg");
  EXPECT_THAT(picture, HasSubstr("<title>1 path</title>"));
  EXPECT_THAT(picture, HasSubstr("class=\"walls\""));
}

TEST(PathCommand, SaysWhyThereIsNone) {
  const Folder folder;
  static_cast<void>(
      folder.write("cell.geojson", collection({feature("wall", box(0, 0, 4, 4), "LineString"),
                                               feature("box", '[' + box(1, 1, 2, 2) + ']')})));
  static_cast<void>(folder.write("q.csv",
                                 "x0,y0,x1,y1,radius\n3,3,5,5,\n1.5,1.5,3,3,\n3,3,1.5,1.5,\n"
                                 "3,3,3,3,0\n0.5,3,3,0.5,\n"));
  const Outcome outcome = run(folder, "path cell.geojson --queries q.csv");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out,
            "query,edit,status,radius,length,points\r\n"
            "0,0,unreachable,0,,\r\n"
            "1,0,start blocked,0,,\r\n"
            "2,0,goal blocked,0,,\r\n"
            "3,0,found,0,0,3 3\r\n"
            "4,0,found,0,3.605551275463989,0.5 3;2 2;3 0.5\r\n");
  EXPECT_EQ(outcome.err, "5 paths: 2 found, 1 unreachable, 1 start blocked, 1 goal blocked\n");
  ASSERT_EQ(run(folder, "path cell.geojson --queries q.csv -o a.geojson").exit_code, 0);
  const auto features = nlohmann::json::parse(content(folder / "a.geojson"))["features"];
  EXPECT_TRUE(features[0]["geometry"].is_null());
  EXPECT_TRUE(features[0]["properties"]["length"].is_null());
  EXPECT_EQ(features[3]["geometry"],
            nlohmann::json::parse(R"({"type":"LineString","coordinates":[[3,3],[3,3]]})"));
  const Outcome single = run(folder, "path cell.geojson --from 3,3 --to 5,5 -o one.csv");
  EXPECT_EQ(single.exit_code, 1);
  EXPECT_EQ(content(folder / "one.csv"),
            "query,edit,status,radius,length,points\r\n0,0,unreachable,0,,\r\n");
  const Outcome given_up =
      run(folder, "path cell.geojson --from 0.5,3 --to 3,0.5 --most-expansions 1");
  EXPECT_EQ(given_up.exit_code, 1);
  EXPECT_THAT(given_up.out, HasSubstr("gave up"));
}

TEST(PathCommand, FollowsWhatMoves) {
  const Folder folder;
  static_cast<void>(folder.write("room.geojson", room));
  static_cast<void>(
      folder.write("stdin", R"({"move": "box", "by": [1, 0.5]})"
                            "\n"
                            R"({"ring": "box", "points": [[3, 3], [3, 4], [6, 4], [6, 3], [3, 3]]})"
                            "\n"
                            R"({"remove": "door"})"
                            "\n"
                            R"({"insert": {"id": 8, "points": [[3,3],[6,3],[6,8],[3,8]]}})"
                            "\n"
                            R"({"insert": {"id": "door", "line": [[3, 8], [3, 12], [6, 12]]}})"
                            "\n"
                            R"({"remove": "8"})"));
  const Outcome outcome =
      run(folder, "path room.geojson --from 1,4 --to 8,7 --moves - -o a.svg -o a.csv");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(content(folder / "a.csv"),
            "query,edit,status,radius,length,points\r\n"
            "0,0,found,0,10.30308784984488,1 4;2 6;7 9;8 7\r\n"
            "0,1,found,0,9.937630096216214,1 4;3 2.5;5 2.5;7 5;8 7\r\n"
            "0,2,found,0,8.318830507798008,1 4;7 5;8 7\r\n"
            "0,3,found,0,7.927446638338974,1 4;3 6;8 7\r\n"
            "0,4,found,0,9.70820393249937,1 4;3 8;6 8;8 7\r\n"
            "0,5,found,0,9.70820393249937,1 4;3 3;6 3;8 7\r\n"
            "0,6,found,0,7.927446638338974,1 4;3 6;8 7\r\n");
  const std::string picture = content(folder / "a.svg");
  EXPECT_THAT(picture, HasSubstr("stroke-opacity=\"0.25\""));
}

TEST(PathCommand, KeepsADiscAwayFromCorners) {
  const Folder folder;
  static_cast<void>(
      folder.write("box.geojson", collection({feature("box", '[' + box(2, 0, 4, 4) + ']')})));
  static_cast<void>(folder.write("m.ndjson", R"({"move": "box", "by": [0, -1]})"));
  const Outcome outcome =
      run(folder,
          "path box.geojson --from 0,3 --to 6,3 --radius 1 --moves m.ndjson -o a.geojson "
          "-o a.svg -q");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto paths = nlohmann::json::parse(content(folder / "a.geojson"))["features"];
  ASSERT_EQ(paths.size(), 2U);
  const double arc = std::atan2(4.0, 3.0);
  EXPECT_NEAR(paths[0]["properties"]["length"].get<double>(), 2 * (2 + arc) + 2, 1e-14);
  EXPECT_LT(paths[1]["properties"]["length"].get<double>(), 7);
  for (const auto& point : paths[0]["geometry"]["coordinates"]) {
    const double x = std::abs(point[0].get<double>() - 3) - 1;
    const double y = point[1].get<double>() - 4;
    EXPECT_GE(std::hypot(std::max(x, 0.0), std::max(y, 0.0)), 1 - 1e-14);
  }
  EXPECT_GT(paths[0]["geometry"]["coordinates"].size(), 20U);
  const std::string picture = content(folder / "a.svg");
  EXPECT_THAT(picture, HasSubstr("class=\"band\""));
  EXPECT_THAT(picture, HasSubstr(" 0 0 1 "));  // to the right
}

TEST(PathCommand, KnowsWhereADiscHasRoom) {
  const Folder folder;
  static_cast<void>(folder.write(
      "gap.geojson", collection({with_id("1", R"("layer":"free")", '[' + box(0, 0, 9, 9) + ']'),
                                 feature("low", '[' + box(4, 0, 5, 3) + ']'),
                                 feature("high", '[' + box(4, 5, 5, 9) + ']')})));
  static_cast<void>(folder.write("q.csv",
                                 "x0,y0,x1,y1,radius\n2,4,7,4,\n2,4,7,4,1.25\n"
                                 "0.5,4,7,4,0.5\n0.5,4,7,4,0.75\n2,4,7,8.5,1\n2,2,7,2,0\n"));
  const Outcome outcome = run(folder, "path gap.geojson --queries q.csv --radius 1");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\n0,0,found,1,5,2 4;"));
  EXPECT_THAT(outcome.out, HasSubstr("\n1,0,unreachable,1.25,,\r\n2,0,found,0.5,6.5,0.5 4;"));
  EXPECT_THAT(outcome.out, HasSubstr("\n3,0,start blocked,0.75,,\r\n4,0,goal blocked,1,,\r\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\n5,0,found,0,5.47213595499958,2 2;4 3;5 3;7 2\r\n"));
}

/// A square of free ground with a pond; its features are not in the way of each other.
const std::string ground =
    collection({with_id("1", R"("layer":"free","kind":"lawn")", '[' + box(0, 0, 10, 10) + ']'),
                with_id("2", R"("layer":"water","kind":"pond")", '[' + box(4, 0, 6, 8) + ']'),
                with_id("3", R"("kind":"house")", '[' + box(4, 8, 6, 9) + ']')});

TEST(PathCommand, KnowsLayers) {
  const Folder folder;
  static_cast<void>(folder.write("g.geojson", ground));
  const auto points = [&](const std::string& options) {
    const Outcome outcome =
        run(folder, "path g.geojson --from 1,5 --to 9,5 " + options + " -o a.csv");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string table = content(folder / "a.csv");
    return table.substr(table.find_last_of(',') + 1);
  };
  EXPECT_EQ(points(""), "1 5;4 9;6 9;9 5\r\n");
  EXPECT_EQ(points("--free 'free - obstacles'"), "1 5;9 5\r\n");
  EXPECT_EQ(points("--free 'frame - water'"), "1 5;4 8;6 8;9 5\r\n");
  EXPECT_EQ(points("--layer-by kind --free 'lawn - pond'"), "1 5;4 8;6 8;9 5\r\n");
}

TEST(PathCommand, ReadsMovingAiMapsAndScenarios) {
  const Folder folder;
  static_cast<void>(
      folder.write("a.map", "type octile\nheight 3\nwidth 5\nmap\n.....\n.@@@.\n.@T..\n"));
  static_cast<void>(folder.write("a.scen",
                                 "version 1\n0\ta.map\t5\t3\t0\t3\t4\t3\t6\n"
                                 "0\ta.map\t5\t3\t2\t2\t4\t3\t6\n"));
  const Outcome outcome = run(folder, "path a.map --queries a.scen -o a.csv -o a.svg");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(content(folder / "a.csv"),
            "query,edit,status,radius,length,points\r\n"
            "0,0,found,0,7.23606797749979,0 3;1 1;4 1;4 3\r\n"
            "1,0,start blocked,0,,\r\n");
}

TEST(PathCommand, ReportsAsJson) {
  const Folder folder;
  static_cast<void>(folder.write("room.geojson", room));
  static_cast<void>(folder.write("q.txt", "1 4 8 7\n1 4 3 3\n"));
  static_cast<void>(folder.write("m.ndjson", R"({"remove": "door"})"));
  const Outcome outcome =
      run(folder, "path room.geojson --queries q.txt --moves m.ndjson --json --quiet");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["schema"], "loft-path");
  EXPECT_EQ(report["schema_version"], 1);
  EXPECT_EQ(report["inputs"], (nlohmann::json{"room.geojson", "q.txt", "m.ndjson"}));
  EXPECT_EQ(report["queries"], 2);
  EXPECT_EQ(report["edits"], 1);
  EXPECT_EQ(report["statuses"], (nlohmann::json{{"found", 2}, {"goal blocked", 2}}));
  ASSERT_EQ(report["paths"].size(), 4U);
  EXPECT_EQ(report["paths"][0]["length"], 10.30308784984488);
  EXPECT_TRUE(report["paths"][1]["length"].is_null());
  EXPECT_EQ(report["paths"][2]["edit"], 1);
  for (const char* stage : {"read", "overlay", "find", "write", "total"})
    EXPECT_GE(report["seconds"][stage].get<double>(), 0) << stage;
}

TEST(PathCommand, NamesWhatIsWrongAndWritesNothing) {
  expect_bad(
      {{"room.geojson", room},
       {"twins.geojson",
        collection({feature("a", '[' + box(0, 0, 1, 1) + ']'),
                    feature("a", '[' + box(2, 0, 3, 1) + ']'),
                    feature("b", "[[" + box(4, 0, 5, 1) + "],[" + box(6, 0, 7, 1) + "]]",
                            "MultiPolygon")})},
       {"bad.geojson", "{}"},
       {"bad.csv", "x0,y0,x1,y1\n1,b,3,4\n"},
       {"bad.ndjson", R"({"move": "box"})"},
       {"q.csv", "1,4,8,7\n"},
       {"m.ndjson", R"({"move": "box", "by": [1, 1]})"
                    "\n"
                    R"({"remove": "bax"})"
                    "\n"
                    R"({"insert": {"id": "bar", "layer": "water", "points": [[1, 1]]}})"
                    "\n"
                    R"({"remove": "box"})"
                    "\n"
                    R"({"remove": "box"})"},
       {"t.ndjson", R"({"remove": "a"})"
                    "\n"
                    R"({"ring": "b", "points": [[1, 1]]})"},
       {"far.ndjson", R"({"move": "box", "by": [1e75, 0]})"
                      "\n"
                      R"({"move": "box", "by": [1e75, 0]})"}},
      {{"path room.geojson", 2, {"needs --from and --to, or --queries"}},
       {"path room.geojson --from 1,4", 2, {"needs --from and --to, or --queries"}},
       {"path room.geojson --from 1,4 --to 1", 2, {"'1' is no place; give two numbers X,Y"}},
       {"path room.geojson --from 1,4 --queries q.csv", 2, {"--queries", "excludes"}},
       {"path room.geojson --queries q.csv --radius -1", 2, {"'-1' is no distance"}},
       {"path room.geojson --queries q.csv --most-expansions 0", 2, {"--most-expansions"}},
       {"path - --queries -", 2, {"one file from standard input"}},
       {"path room.geojson --queries q.csv -o q.csv", 2, {"q.csv is an input, too"}},
       {"path room.geojson --queries q.csv -o q.shp",
        2,
        {"unknown extension '.shp'; known are .csv .geojson .json .svg"}},
       {"path room.geojson --queries q.csv -o none/q.csv", 4, {"folder none does not exist"}},
       {"path q.csv --queries q.csv", 2, {"known are .geojson .json .map"}},
       {"path room.geojson --queries room.geojson", 2, {"known are .csv .tsv .txt .xy .scen"}},
       {"path room.geojson --queries q.csv --moves q.csv", 2, {"known are .ndjson .jsonl"}},
       {"path bad.geojson --queries bad.csv --moves bad.ndjson -o a.csv",
        3,
        {"bad.geojson: \"type\" is missing\n", "bad.csv:2: expected a number for y0, found 'b'\n",
         "bad.ndjson:1: \"by\" is missing"}},
       {"path room.geojson --queries q.csv --moves m.ndjson -o a.csv",
        3,
        {"m.ndjson:2: no feature is called 'bax'\n",
         "m.ndjson:3: a feature 'bar' is there already\n",
         "m.ndjson:3: no layer is called 'water'; layers are obstacles, frame, walls\n",
         "m.ndjson:5: no feature is called 'box'\n"}},
       {"path twins.geojson --queries q.csv --moves t.ndjson -o a.csv",
        3,
        {"t.ndjson:1: several features are called 'a'\n",
         "t.ndjson:2: 'b' has 2 rings and lines, not one\n"}},
       {"path room.geojson --queries q.csv --moves far.ndjson -o a.csv", 3, {"far.ndjson:2: "}},
       {"path room.geojson --queries q.csv --layer-by kind",
        3,
        {"room.geojson: no feature has a text or number 'kind'"}},
       {"path room.geojson --queries q.csv --free 'frame - sea'",
        2,
        {"--free: ", "'sea'", "layers are obstacles, frame, walls"}},
       {"path room.geojson --queries q.csv --free '~obstacles'", 2, {"without bounds"}}});
}

TEST(PathCommand, HelpExplainsEditsAndStatuses) {
  const Folder folder;
  const std::string help = run(folder, "path --help").out;
  for (const char* word : {"\nQueries:\n", "\nScene:\n", "\nResults:\n", "start blocked", "gave up",
                           "{\"move\": \"box7\"", "Exit code 1"})
    EXPECT_THAT(help, HasSubstr(word));
}

}  // namespace
}  // namespace loft::app
