// SPDX-License-Identifier: MIT
// `loft query`, when all is well and when it is not.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/maps.h"

namespace loft::app {
namespace {

using namespace testing;

/// Two countries side by side, a third without a name that overlaps the second.
const std::string countries =
    collection({feature("West; old", '[' + box(-1, -1, 0, 1) + ']'),
                feature("East", '[' + box(0, -1, 1, 1) + ']'),
                R"({"type":"Feature","properties":{"code":7},"geometry":{"type":"Polygon",)"
                R"("coordinates":[)" +
                    box(0.5, 0.5, 2, 2) + "]}}"});

const std::string rivers =
    collection({feature("Long", "[[[-2,0],[3,0]],[[0,-2],[0,2]]]", "MultiLineString"),
                feature("Short", "[[0.6,0.75],[0.9,0.75]]", "LineString"),
                feature("Lake", '[' + box(0, 0, 1, 1) + ']')});

TEST(QueryCommand, TellsWhoCoversPoints) {
  const Folder folder;
  static_cast<void>(folder.write("map.geojson", countries));
  static_cast<void>(folder.write("p.csv", "id,y,x\na,0,0\nb,0,-0.5\nc,0.75,0.75\nd,9,9\ne,1,0\n"));
  const std::string table =
      "x,y,inside,on_border\r\n"
      "0,0,,West; old;East\r\n"
      "-0.5,0,West; old,\r\n"
      "0.75,0.75,East;feature 2,\r\n"
      "9,9,,\r\n"
      "0,1,,West; old;East\r\n";
  const Outcome outcome = run(folder, "query map.geojson --points p.csv");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, table);
  EXPECT_EQ(outcome.err, "3 layers; 5 points: 2 inside, 2 on a border\n");
  ASSERT_EQ(run(folder, "query map.geojson --points p.csv -o out.csv -q").exit_code, 0);
  EXPECT_EQ(content(folder / "out.csv"), table);
}

TEST(QueryCommand, CutsLinesWithLengthsByOwner) {
  const Folder folder;
  static_cast<void>(folder.write("map.geojson", countries));
  static_cast<void>(folder.write("stdin", rivers));
  const Outcome outcome =
      run(folder, "query map.geojson --lines - -o out.csv -o out.geojson -o out.svg");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err,
            "3 layers; 3 lines in 8 pieces\n"
            "left out 1 polygon and 0 points among the lines\n"
            "wrote out.csv\nwrote out.geojson\nwrote out.svg\n");
  EXPECT_EQ(content(folder / "out.csv"),
            "line,inside,on_border,length\r\n"
            "Long,,,5\r\n"
            "Long,,West; old;East,2\r\n"
            "Long,West; old,,1\r\n"
            "Long,East,,1\r\n"
            "Short,East;feature 2,,0.30000000000000004\r\n");
  const auto pieces = nlohmann::json::parse(content(folder / "out.geojson"))["features"];
  ASSERT_EQ(pieces.size(), 8U);
  EXPECT_EQ(pieces[1]["properties"],
            nlohmann::json::parse(
                R"({"line":"Long","inside":["West; old"],"on_border":[],"length":1.0})"));
  EXPECT_EQ(pieces[1]["geometry"],
            nlohmann::json::parse(R"({"type":"LineString","coordinates":[[-1,0],[0,0]]})"));
}

TEST(QueryCommand, ReportsAsJson) {
  const Folder folder;
  static_cast<void>(folder.write("map.geojson", countries));
  static_cast<void>(folder.write("p.txt", "0 0\n0.75 0.75\n"));
  static_cast<void>(folder.write("r.geojson", rivers));
  Outcome outcome = run(folder, "query map.geojson --points p.txt --json --quiet");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["schema"], "loft-query");
  EXPECT_EQ(report["schema_version"], 1);
  EXPECT_EQ(report["inputs"], (nlohmann::json{"map.geojson", "p.txt"}));
  EXPECT_EQ(report["layers"], 3);
  EXPECT_EQ(report["points"], 2);
  EXPECT_EQ(report["inside"], 1);
  EXPECT_EQ(report["on_border"], 1);
  outcome = run(folder, "query map.geojson --lines r.geojson --json -o out.csv");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["lines"], 3);
  EXPECT_EQ(report["lengths"].size(), 5U);
  EXPECT_EQ(report["lengths"][0],
            nlohmann::json::parse(R"({"inside":[],"on_border":[],"length":5.0})"));
  for (const char* stage : {"read", "overlay", "ask", "write", "total"})
    EXPECT_GE(report["seconds"][stage].get<double>(), 0) << stage;
}

TEST(QueryCommand, NamesWhatIsWrongAndWritesNothing) {
  expect_bad(
      {{"map.geojson", countries},
       {"p.csv", "x,y\n1,2\n"},
       {"bad.csv", "x,y\n1,b\n3\n"},
       {"r.geojson", rivers}},
      {{"query map.geojson", 2, {"needs --points or --lines"}},
       {"query map.geojson --points p.csv --lines r.geojson", 2, {"--lines", "excludes"}},
       {"query - --points -", 2, {"one file from standard input"}},
       {"query map.geojson --points p.csv -o p.csv", 2, {"p.csv is an input, too"}},
       {"query map.geojson --points p.csv -o q.geojson",
        2,
        {"unknown extension '.geojson'; known are .csv"}},
       {"query map.geojson --lines r.geojson -o q.shp",
        2,
        {"unknown extension '.shp'; known are .csv .geojson .json .svg"}},
       {"query map.geojson --points p.csv -o none/q.csv", 4, {"folder none does not exist"}},
       {"query map.geojson --points r.geojson", 2, {"known are .csv .tsv .txt .xy"}},
       {"query map.geojson --points bad.csv -o q.csv",
        3,
        {"bad.csv:2: expected a number for y, found 'b'", "bad.csv:3: y is missing"}},
       {"query map.geojson --points none.csv", 3, {"cannot read none.csv"}},
       {"query map.geojson --points p.csv --layer-by name -o q.csv",
        3,
        {"map.geojson: feature 2: has no text or number 'name'; its properties are 'code'"}}});
}

}  // namespace
}  // namespace loft::app
