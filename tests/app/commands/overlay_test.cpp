// SPDX-License-Identifier: MIT
// `loft overlay`, when all is well and when it is not.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/maps.h"

namespace loft::app {
namespace {

using namespace testing;

const std::string plate =
    feature("plate", '[' + box(0, 0, 10, 10) + ",[[1,1],[1,2],[2,2],[2,1],[1,1]]]");
const std::string disc = collection({feature("disc", '[' + box(5, 5, 15, 15) + ']'),
                                     feature("way", "[[0,0],[1,1]]", "LineString"),
                                     feature("towns", "[[0,0],[1,1]]", "MultiPoint")});

void write_both(const Folder& folder) {
  static_cast<void>(folder.write("A.geojson", plate));
  static_cast<void>(folder.write("B.json", disc));
}

TEST(OverlayCommand, KeepsWhatAnExpressionSays) {
  const Folder folder;
  write_both(folder);
  const Outcome outcome =
      run(folder, "overlay A.geojson B.json --keep 'A - B' -o c.geojson -o c.svg --areas");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "layer  area\n"
            "A        99\n"
            "B       100\n"
            "A - B    74\n");
  EXPECT_EQ(outcome.err,
            "2 layers: 1 polygon with 1 hole in 1 feature\n"
            "left out 1 line and 2 points: only polygons have an inside\n"
            "wrote c.geojson\nwrote c.svg\n");
  EXPECT_EQ(content(folder / "c.geojson"),
            R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"expression":"A - B","area":74},"geometry":{"type":"Polygon","coordinates":[[[0,0],[10,0],[10,5],[5,5],[5,10],[0,10],[0,0]],[[1,1],[1,2],[2,2],[2,1],[1,1]]]}}
]}
)");
  EXPECT_TRUE(content(folder / "c.svg").ends_with("</svg>\n"));
}

TEST(OverlayCommand, WritesAllPiecesWithTheirOwners) {
  const Folder folder;
  write_both(folder);
  ASSERT_EQ(run(folder, "overlay A.geojson B.json --all-pieces -o c.geojson").exit_code, 0);
  const std::string shared =
      R"({"type":"Feature","properties":{"layers":["A","B"],"area":25},"geometry":{"type":"Polygon","coordinates":[[[5,5],[10,5],[10,10],[5,10],[5,5]]]}})";
  const std::string second =
      R"({"type":"Feature","properties":{"layers":["B"],"area":75},"geometry":{"type":"Polygon","coordinates":[[[5,10],[10,10],[10,5],[15,5],[15,15],[5,15],[5,10]]]}})";
  const std::string begin = "{\"type\":\"FeatureCollection\",\"features\":[\n";
  EXPECT_EQ(
      content(folder / "c.geojson"),
      begin +
          R"({"type":"Feature","properties":{"layers":["A"],"area":74},"geometry":{"type":"Polygon","coordinates":[[[0,0],[10,0],[10,5],[5,5],[5,10],[0,10],[0,0]],[[1,1],[1,2],[2,2],[2,1],[1,1]]]}},
)" + shared +
          ",\n" + second + "\n]}\n");
  ASSERT_EQ(run(folder, "overlay A.geojson B.json --all-pieces --keep B -o c.geojson").exit_code,
            0);
  EXPECT_EQ(content(folder / "c.geojson"), begin + shared + ",\n" + second + "\n]}\n");
}

TEST(OverlayCommand, ReportsAsJson) {
  const Folder folder;
  write_both(folder);
  const Outcome outcome =
      run(folder, "overlay A.geojson B.json --keep 'A | B' -o c.geojson --json --quiet");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["schema"], "loft-overlay");
  EXPECT_EQ(report["schema_version"], 1);
  EXPECT_EQ(report["layers"][0], (nlohmann::json{{"name", "A"}, {"rings", 2}, {"area", 99.0}}));
  EXPECT_EQ(report["layers"][1]["area"], 100.0);
  EXPECT_EQ(report["expression"], "A | B");
  EXPECT_EQ(report["area"], 174.0);
  EXPECT_EQ(report["polygons"], 1);
  EXPECT_EQ(report["holes"], 1);
  EXPECT_EQ(report["area_error_bound"], 0.0);
  EXPECT_EQ(report["snaps"], 0);
  for (const char* stage : {"read", "overlay", "trace", "write", "total"})
    EXPECT_GE(report["seconds"][stage].get<double>(), 0) << stage;
}

TEST(OverlayCommand, TakesLayersFromAProperty) {
  const Folder folder;
  static_cast<void>(
      folder.write("stdin", collection({feature("two words", '[' + box(0, 0, 2, 2) + ']'),
                                        feature("b", '[' + box(1, 0, 3, 2) + ']'),
                                        feature("two words", '[' + box(5, 0, 6, 1) + ']')})));
  const Outcome outcome =
      run(folder, "overlay - --layer-by name --keep '\"two words\" & b' --areas");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "layer            area\n"
            "two words           5\n"
            "b                   4\n"
            "\"two words\" & b     2\n");
}

TEST(OverlayCommand, FillsByARule) {
  const Folder folder;
  static_cast<void>(folder.write(
      "a.geojson",
      feature("a",
              "[[" + box(0, 0, 3, 3) + "],[" + box(1, 1, 2, 2) + "],[[[5,5],[5,7],[7,5],[5,5]]]]",
              "MultiPolygon")));
  const auto area = [&](const std::string& rule) {
    const Outcome outcome = run(folder, "overlay a.geojson --keep a --json --fill " + rule);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out)["area"].get<double>();
  };
  EXPECT_EQ(area("evenodd"), 10);
  EXPECT_EQ(area("even-odd"), 10);
  EXPECT_EQ(area("nonzero"), 11);
  EXPECT_EQ(area("positive"), 9);
  EXPECT_EQ(area("negative"), 2);
}

TEST(OverlayCommand, KeepsTheCoordinateSystem) {
  const Folder folder;
  const std::string crs = R"("crs":{"type":"name","properties":{"name":"EPSG:3857"}},)";
  std::string map = collection({plate});
  map.insert(map.find("\"features\""), crs);
  static_cast<void>(folder.write("a.geojson", map));
  static_cast<void>(folder.write("b.geojson", plate));
  ASSERT_EQ(run(folder, "overlay b.geojson a.geojson --keep 'a | b' -o c.geojson").exit_code, 0);
  EXPECT_NE(content(folder / "c.geojson").find(crs), std::string::npos);
}

TEST(OverlayCommand, ItsOutputIsReadBackAsItWas) {
  const Folder folder;
  write_both(folder);
  ASSERT_EQ(run(folder, "overlay A.geojson B.json --keep 'A ^ B' -o c.geojson").exit_code, 0);
  const Outcome outcome = run(folder, "overlay c.geojson --keep c -o d.geojson --areas");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("149"), std::string::npos) << outcome.out;
  const auto geometry = [&](const char* file) {
    return nlohmann::json::parse(content(folder / file))["features"][0]["geometry"];
  };
  EXPECT_EQ(geometry("c.geojson"), geometry("d.geojson"));
}

TEST(OverlayCommand, NamesWhatIsWrongAndWritesNothing) {
  const std::string other_crs =
      R"({"type":"FeatureCollection","crs":{"type":"name"},"features":[)" + plate + "]}";
  expect_bad({{"A.geojson", plate},
              {"B.json", disc},
              {"A.json", plate},
              {"bad.geojson", R"({"type":"Polygon","coordinates":[[[0,0],[1,x],[NaN,2]]]})"},
              {"worse.geojson", R"({"type":"Polygon","coordinates":[[[0,0],[1],[NaN,2]]]})"},
              {"c1.geojson", other_crs},
              {"c2.geojson",
               R"({"type":"FeatureCollection","crs":{"type":"link"},"features":[)" + plate + "]}"}},
             {{"overlay", 2, {"IN is required"}},
              {"overlay A.geojson", 2, {"needs --keep, --all-pieces or --areas"}},
              {"overlay A.geojson --keep A", 2, {"needs --output, --areas or --json"}},
              {"overlay A.geojson --areas -o c.geojson", 2, {"needs --keep or --all-pieces"}},
              {"overlay A.geojson --keep A -o c.shp",
               2,
               {"unknown extension '.shp'", ".geojson .json .svg"}},
              {"overlay A.shp --keep A -o c.svg", 2, {"A.shp: unknown extension"}},
              {"overlay A.geojson --keep A -o A.geojson", 2, {"A.geojson is an input, too"}},
              {"overlay A.geojson --keep A -o none/c.svg", 4, {"folder none does not exist"}},
              {"overlay A.geojson A.json --keep A -o c.svg",
               2,
               {"A.geojson and A.json would both be the layer 'A'; rename one"}},
              {"overlay A.geojson --keep A --fill much -o c.svg", 2, {"--fill"}},
              {"overlay A.geojson B.json --keep 'A - C' -o c.svg",
               2,
               {"--keep: expression, byte 5: there is no layer 'C'; layers are A, B"}},
              {"overlay A.geojson --keep '(A' -o c.svg", 2, {"byte 3: ')' is missing here"}},
              {"overlay A.geojson --keep '~A' -o c.svg",
               2,
               {"--keep: the expression is true where no layer"}},
              {"overlay none.geojson --keep none -o c.svg", 3, {"cannot read none.geojson"}},
              {"overlay bad.geojson worse.geojson --keep bad -o c.svg",
               3,
               {"bad.geojson:1:44: broken JSON", "worse.geojson: ring 0 point 1: has 1 coordinates",
                "worse.geojson: ring 0 point 2: NaN is not a number"}},
              {"overlay A.geojson B.json --layer-by id --keep A -o c.svg",
               3,
               {"A.geojson: feature 0: has no text or number 'id'; its properties are 'name'",
                "B.json: feature 2: has no text or number 'id'"}},
              {"overlay A.geojson A.json --layer-by name --keep plate -o c.svg",
               3,
               {"A.json: a layer 'plate' is in an input before it, too"}},
              {"overlay c1.geojson c2.geojson --keep c1 -o c.svg",
               3,
               {"c2.geojson: its coordinate system is not that of c1.geojson"}}});
}

}  // namespace
}  // namespace loft::app
