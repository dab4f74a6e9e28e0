// SPDX-License-Identifier: MIT
// `loft field`, when all is well and when it is not.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/maps.h"

namespace loft::app {
namespace {

using namespace testing;
using Document = nlohmann::json;

/// A roof: the ridge from (0, 5) to (10, 5) is in the lines.
const std::string eaves =
    "id,x,y,height\r\n"
    "1,0,0,0\r\n"
    "2,10,0,0\r\n"
    "3,10,10,0\r\n"
    "4,0,10,0\r\n";

[[nodiscard]] std::string with_kind(const std::string& properties, const std::string& coordinates) {
  return R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":)" + properties +
         R"(,"geometry":{"type":"LineString","coordinates":)" + coordinates + "}}]}";
}

const std::string ridge = with_kind("{}", "[[0,5,4],[10,5,4]]");

struct Roof {
  Roof() {
    static_cast<void>(folder.write("eaves.csv", eaves));
    static_cast<void>(folder.write("ridge.geojson", ridge));
    static_cast<void>(
        folder.write("places.csv", "x,y,name\r\n5,2.5,low\r\n5,5,top\r\n11,5,off\r\n"));
    static_cast<void>(folder.write("way.geojson", with_kind(R"({"name":"up"})", "[[5,0],[5,10]]")));
  }
  Folder folder;
};

TEST(FieldCommand, GivesValuesAtPlaces) {
  const Roof roof;
  const Outcome outcome =
      run(roof.folder,
          "field eaves.csv --lines ridge.geojson --at places.csv -o out.csv -o out.geojson");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err,
            "4 samples, 1 line; values from 0 to 4, asked at 3 places, 1 without value\n"
            "wrote out.csv\nwrote out.geojson\n");
  EXPECT_EQ(content(roof.folder / "out.csv"),
            "x,y,name,value\r\n5,2.5,low,2\r\n5,5,top,4\r\n11,5,off,\r\n");
  const Document points = Document::parse(content(roof.folder / "out.geojson"))["features"];
  EXPECT_EQ(points[0]["properties"]["value"], 2);
  EXPECT_TRUE(points[2]["properties"]["value"].is_null());
  EXPECT_EQ(
      run(roof.folder, "field eaves.csv --lines ridge.geojson --at places.csv --nearest -q").out,
      "x,y,name,value\r\n5,2.5,low,2\r\n5,5,top,4\r\n11,5,off,4\r\n");
}

TEST(FieldCommand, GoesAlongLines) {
  const Roof roof;
  const Outcome outcome =
      run(roof.folder, "field eaves.csv --lines ridge.geojson --profile way.geojson --json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Document report = Document::parse(outcome.out);
  EXPECT_EQ(report["schema"], "loft-field");
  EXPECT_EQ(report["climb"], 4);
  EXPECT_EQ(report["descent"], 4);
  const Outcome table =
      run(roof.folder, "field eaves.csv --lines ridge.geojson --profile way.geojson");
  EXPECT_NE(table.out.find("\r\nup,5,5,5,4,4\r\n"), std::string::npos) << table.out;
}

TEST(FieldCommand, DrawsIsolinesAndBands) {
  const Roof roof;
  EXPECT_EQ(run(roof.folder, "field eaves.csv --lines ridge.geojson --levels 1,3 -o lines.geojson")
                .exit_code,
            0);
  const Document lines = Document::parse(content(roof.folder / "lines.geojson"))["features"];
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0]["properties"]["level"], 1);
  const Outcome outcome =
      run(roof.folder,
          "field eaves.csv --lines ridge.geojson --levels 1,3 --bands -o bands.geojson --json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Document bands = Document::parse(content(roof.folder / "bands.geojson"))["features"];
  ASSERT_EQ(bands.size(), 3U);
  EXPECT_TRUE(bands[0]["properties"]["low"].is_null());
  EXPECT_EQ(bands[1]["properties"]["area"], 50);
}

TEST(FieldCommand, FindsLevelsWhereNumbersAreFarApart) {
  const Roof roof;
  static_cast<void>(
      roof.folder.write("high.csv", "x,y,z\n0,0,1e17\n1,0,100000000000000128\n0,1,1e17\n"));
  for (const char* count : {"1", "20", "10000"}) {
    const Outcome outcome = run(
        roof.folder, std::string("field high.csv --json --isolines ") + count + " -o high.geojson");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
}

TEST(FieldCommand, MeasuresVolumes) {
  const Roof roof;
  const Outcome outcome =
      run(roof.folder, "field eaves.csv --lines ridge.geojson --level 2 --json");
  const Document report = Document::parse(outcome.out);
  EXPECT_EQ(report["area"], 100);
  EXPECT_NEAR(report["volume"]["above"].get<double>(), 50, 1e-12);
  EXPECT_NEAR(report["volume"]["below"].get<double>(), 50, 1e-12);
}

TEST(FieldCommand, WritesGridsSurfacesAndPictures) {
  const Roof roof;
  const Outcome outcome = run(roof.folder,
                              "field eaves.csv --lines ridge.geojson --cell 2.5 -o out.asc "
                              "-o out.ply -o out.svg --triangles");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(content(roof.folder / "out.asc"),
            "ncols 4\nnrows 4\nxllcenter 1.25\nyllcenter 1.25\ncellsize 2.5\nNODATA_value -9999\n"
            "1 1 1 1\n3 3 3 3\n3 3 3 3\n1 1 1 1\n");
  EXPECT_NE(content(roof.folder / "out.ply").find("element vertex 6\n"), std::string::npos);
  EXPECT_NE(content(roof.folder / "out.ply").find("property double value\n"), std::string::npos);
  EXPECT_NE(content(roof.folder / "out.svg").find("class=\"triangles\""), std::string::npos);
}

TEST(FieldCommand, DrawsPixels) {
  const Roof roof;
  const Outcome outcome =
      run(roof.folder, "field eaves.csv --lines ridge.geojson --smooth --grid 20x30 -o out.png");
  if (outcome.err.find("this build writes no PNG") != std::string::npos) GTEST_SKIP();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(content(roof.folder / "out.png").substr(0, 4), "\x89PNG");
}

TEST(FieldCommand, KnowsKindsOfLines) {
  const Roof roof;
  static_cast<void>(roof.folder.write("wall.geojson",
                                      with_kind(R"({"left":[1,1],"right":3})", "[[5,0],[5,10]]")));
  const Outcome outcome =
      run(roof.folder, "field eaves.csv --lines wall.geojson --profile way.geojson --json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(Document::parse(outcome.out)["conflicts"].size(), 0U);
  static_cast<void>(
      roof.folder.write("soft.geojson", with_kind(R"({"kind":"soft"})", "[[5,1,99],[5,9,99]]")));
  const Outcome soft = run(roof.folder, "field eaves.csv --lines soft.geojson --json");
  EXPECT_EQ(Document::parse(soft.out)["most"], 0);
}

TEST(FieldCommand, TellsOfConflicts) {
  const Roof roof;
  static_cast<void>(roof.folder.write("twice.csv", "x,y,z\n0,0,1\n0,0,3\n4,0,1\n0,4,1\n4,0,2\n"));
  const Outcome outcome = run(roof.folder, "field twice.csv --json");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err,
            "5 samples, 0 lines; values from 1 to 3\n"
            "2 conflicts of values at one place, the first at 0, 0: values 1 to 3, 2 taken\n");
  const Document conflicts = Document::parse(outcome.out)["conflicts"];
  ASSERT_EQ(conflicts.size(), 2U);
  EXPECT_EQ(conflicts[1]["taken"], 1.5);
  const Outcome refused = run(roof.folder, "field twice.csv --on-conflict refuse");
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_NE(refused.err.find("at 0, 0: values 1 to 3"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("at 4, 0: values 1 to 2"), std::string::npos) << refused.err;
}

TEST(FieldCommand, ListsAllThatIsWrong) {
  const Roof roof;
  static_cast<void>(roof.folder.write("bad.csv", "x,y,height\n0,0,1\n0,,3\n1,1,high\n"));
  static_cast<void>(roof.folder.write("bad.geojson",
                                      R"({"type":"FeatureCollection","features":[
        {"type":"Feature","properties":{"kind":"fence"},"geometry":{"type":"LineString","coordinates":[[0,0],[1,1]]}},
        {"type":"Feature","properties":{"left":[1,2,3]},"geometry":{"type":"LineString","coordinates":[[0,0],[1,1]]}},
        {"type":"Feature","properties":{"kind":"feature"},"geometry":{"type":"LineString","coordinates":[[0,0],[1,1]]}}]})"));
  const Outcome outcome = run(roof.folder, "field bad.csv --lines bad.geojson");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  for (const char* part : {"bad.csv:3", "bad.csv:4", "'fence'", "3 numbers for 2 points",
                           "needs the property right", "third coordinate"})
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << '\n' << outcome.err;
}

TEST(FieldCommand, SaysWhatItNeeds) {
  const Roof roof;
  for (const char* arguments :
       {"field eaves.csv -o out.csv", "field eaves.csv -o out.geojson",
        "field eaves.csv -o out.asc", "field eaves.csv --cell 1e-9 -o out.asc",
        "field eaves.csv --grid 3 -o out.asc", "field eaves.csv --levels 1,nan -o out.geojson",
        "field - --at -", "field eaves.csv --at places.csv --profile way.geojson"}) {
    const Outcome outcome = run(roof.folder, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << '\n' << outcome.err;
    EXPECT_FALSE(outcome.err.empty());
  }
}

}  // namespace
}  // namespace loft::app
