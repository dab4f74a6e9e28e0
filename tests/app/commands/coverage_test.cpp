// SPDX-License-Identifier: MIT
// `loft coverage`, when all is well and when it is not.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/maps.h"

namespace loft::app {
namespace {

using namespace testing;

/// Two parcels that overlap, with a gap to a third one, which has a lake.
const std::string parcels = collection(
    {feature("west", '[' + box(0, 0, 2.125, 4) + ']'), feature("east", '[' + box(2, 0, 4, 4) + ']'),
     feature("north", "[[[0,4],[1,4.25],[2,4],[4,4],[4,9],[0,9],[0,4]]," + box(1, 6, 3, 8) + ']')});

const std::string sound = collection(
    {feature("west", '[' + box(0, 0, 2, 4) + ']'), feature("east", '[' + box(2, 0, 4, 4) + ']')});

TEST(CoverageCommand, ListsOverlapsAndGaps) {
  const Folder folder;
  static_cast<void>(folder.write("map.geojson", parcels));
  Outcome outcome = run(folder, "coverage map.geojson -o faults.csv -o faults.geojson -o f.svg");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "fault               area   width  at x  y\n"
            "overlap: west;east   0.5   0.125     2  0\n"
            "gap: west;north     0.25  0.2462     0  4\n"
            "gap: north             4       2     1  6\n");
  EXPECT_EQ(outcome.err,
            "3 layers: 1 overlap of area 0.5, 2 gaps of area 4.25\n"
            "wrote faults.csv\nwrote faults.geojson\nwrote f.svg\n");
  const std::string table = content(folder / "faults.csv");
  EXPECT_TRUE(table.starts_with(
      "kind,layers,area,width,x,y\r\noverlap,west;east,0.5,0.125,2,0\r\ngap,west;north,0.25,0.246"))
      << table;
  EXPECT_TRUE(table.ends_with(",0,4\r\ngap,north,4,2,1,6\r\n")) << table;
  const auto features = nlohmann::json::parse(content(folder / "faults.geojson"))["features"];
  ASSERT_EQ(features.size(), 3U);
  EXPECT_EQ(features[0]["properties"],
            nlohmann::json::parse(
                R"({"kind":"overlap","layers":["west","east"],"area":0.5,"width":0.125})"));
}

TEST(CoverageCommand, ChecksWithItsExitCode) {
  const Folder folder;
  static_cast<void>(folder.write("map.geojson", parcels));
  static_cast<void>(folder.write("sound.geojson", sound));
  EXPECT_EQ(run(folder, "coverage map.geojson --check").exit_code, 1);
  EXPECT_EQ(run(folder, "coverage map.geojson").exit_code, 0);
  const Outcome outcome = run(folder, "coverage sound.geojson --check");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "2 layers: 0 overlaps of area 0, 0 gaps of area 0\n");
}

TEST(CoverageCommand, ListsBorders) {
  const Folder folder;
  static_cast<void>(folder.write("map.geojson", sound));
  EXPECT_EQ(run(folder, "coverage map.geojson --borders").out,
            "border     length\n"
            "west;east       4\n");
  const Outcome outcome = run(folder, "coverage map.geojson --borders --json");
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["borders"],
            nlohmann::json::parse(R"([{"layers":["west","east"],"length":4.0}])"));
}

TEST(CoverageCommand, MendsTheMap) {
  const Folder folder;
  static_cast<void>(folder.write("map.geojson", parcels));
  Outcome outcome =
      run(folder, "coverage map.geojson --clean longest-border --gap-width 1 -o clean.geojson");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("1 gap that wide or wider: no fault"), std::string::npos);
  outcome = run(folder, "coverage clean.geojson --check --gap-width 1");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const auto features = nlohmann::json::parse(content(folder / "clean.geojson"))["features"];
  ASSERT_EQ(features.size(), 3U);
  EXPECT_EQ(features[0]["properties"]["name"], "west");
  EXPECT_EQ(features[2]["geometry"]["coordinates"].size(), 2U);  // the lake is there
}

TEST(CoverageCommand, ReportsAsJson) {
  const Folder folder;
  static_cast<void>(folder.write("map.geojson", parcels));
  const Outcome outcome = run(folder, "coverage map.geojson --json --quiet --check --gap-width 1");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err, "");
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["schema"], "loft-coverage");
  EXPECT_EQ(report["schema_version"], 1);
  EXPECT_EQ(report["layers"], 3);
  EXPECT_EQ(report["overlaps"],
            nlohmann::json::parse(
                R"([{"layers":["west","east"],"area":0.5,"width":0.125,"at":[2.0,0.0]}])"));
  EXPECT_EQ(report["gaps"].size(), 1U);
  EXPECT_EQ(report["seas"], 1);
  for (const char* stage : {"read", "check", "write", "total"})
    EXPECT_GE(report["seconds"][stage].get<double>(), 0) << stage;
}

TEST(CoverageCommand, FeaturesOfOneNameAreOneAreaWhereThatIsAsked) {
  const Folder folder;
  static_cast<void>(
      folder.write("map.geojson", collection({feature("a", '[' + box(0, 0, 2, 2) + ']'),
                                              feature("a", '[' + box(2, 0, 3, 2) + ']'),
                                              feature("b", '[' + box(2.5, 0, 4, 2) + ']')})));
  const auto run_with = [&](const std::string& options) {
    const Outcome outcome =
        run(folder, "coverage map.geojson --clean first -o clean.geojson " + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(content(folder / "clean.geojson"))["features"];
  };
  EXPECT_EQ(run_with("").size(), 3U);
  const auto merged = run_with("--layer-by name");
  ASSERT_EQ(merged.size(), 2U);
  EXPECT_EQ(merged[0]["properties"]["name"], "a");
  EXPECT_EQ(
      merged[0]["geometry"],
      nlohmann::json::parse(
          R"({"type":"Polygon","coordinates":[[[0,0],[2,0],[2.5,0],[3,0],[3,2],[2.5,2],[2,2],[0,2],[0,0]]]})"));
}

TEST(CoverageCommand, NamesWhatIsWrongAndWritesNothing) {
  expect_bad({{"map.geojson", parcels}, {"bad.geojson", collection({"3", "4"})}},
             {{"coverage", 2, {"MAP is required"}},
              {"coverage map.geojson --clean much", 2, {"--clean"}},
              {"coverage map.geojson --gap-width -1", 2, {"--gap-width", "no length"}},
              {"coverage map.geojson -o map.geojson", 2, {"map.geojson is an input, too"}},
              {"coverage map.geojson -o c.shp",
               2,
               {"unknown extension '.shp'; known are .csv .geojson .json .svg"}},
              {"coverage map.geojson -o none/c.csv", 4, {"folder none does not exist"}},
              {"coverage bad.geojson -o c.csv",
               3,
               {"bad.geojson: feature 0: expected a feature", "bad.geojson: feature 1: expected"}},
              {"coverage map.geojson --layer-by id -o c.csv",
               3,
               {"feature 0: has no text or number 'id'", "feature 2: has no"}}});
}

}  // namespace
}  // namespace loft::app
