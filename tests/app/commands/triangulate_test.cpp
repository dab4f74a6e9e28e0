// SPDX-License-Identifier: MIT
// `loft triangulate`, when all is well and when it is not.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace loft::app {
namespace {

using namespace testing;

const std::string cross = "4 1\n0 0\n10 0\n10 10\n0 10\n2 0\n5 -5\n5 15\n";
const std::string map =
    R"({"type":"Feature","properties":{"name":"land"},"geometry":{"type":"Polygon",
        "coordinates":[[[0,0],[10,0],[10,10],[0,10],[0,0]]]}})";

TEST(Triangulate, WritesEveryFormatAndWordsToStderr) {
  const Folder folder;
  static_cast<void>(folder.write("in.txt", cross));
  const Outcome outcome = run(folder, "triangulate in.txt -o a.svg -o a.ply -o a.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err,
            "2 polylines of 6 points: 8 vertices, 8 triangles, 9 constrained edges, 2 crossings, 6 "
            "regions\nwrote a.svg\nwrote a.ply\nwrote a.json\n");
  EXPECT_EQ(folder.size(), 6U);
  EXPECT_TRUE(content(folder / "a.svg").ends_with("</svg>\n"));
  EXPECT_EQ(nlohmann::json::parse(content(folder / "a.json"))["vertices"].size(), 8U);
  EXPECT_EQ(run(folder, "info a.ply").exit_code, 0);
}

TEST(Triangulate, ReportsAsJson) {
  const Folder folder;
  static_cast<void>(folder.write("in.txt", cross));
  const Outcome outcome = run(folder, "triangulate in.txt -o a.svg --json --quiet");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["schema"], "loft-triangulate");
  EXPECT_EQ(report["schema_version"], 1);
  EXPECT_EQ(report["constraints"], 2);
  EXPECT_EQ(report["points"], 6);
  EXPECT_EQ(report["vertices"], 8);
  EXPECT_EQ(report["triangles"], 8);
  EXPECT_EQ(report["constrained_edges"], 9);
  EXPECT_EQ(report["crossings"], 2);
  EXPECT_EQ(report["regions"], 6);
  for (const char* stage : {"read", "triangulate", "number", "write", "total"}) {
    EXPECT_GE(report["seconds"][stage].get<double>(), 0) << stage;
  }
}

TEST(Triangulate, MergesWhatIsCloserThanEpsilon) {
  const Folder folder;
  static_cast<void>(folder.write("in.txt", "2 0\n0 0\n10 0\n1 0\n5 0.01\n1 0\n10.01 0\n"));
  const auto report = [&](const std::string& options) {
    const Outcome outcome = run(folder, "triangulate in.txt -o a.json --json --quiet " + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  };
  EXPECT_EQ(report("")["vertices"], 4);
  EXPECT_EQ(report("")["constrained_edges"], 1);
  EXPECT_EQ(report("")["snaps"], 0);
  EXPECT_EQ(report("--epsilon 0.1")["vertices"], 3);
  EXPECT_EQ(report("--epsilon 0.1")["constrained_edges"], 2);
  EXPECT_EQ(run(folder, "triangulate in.txt -o a.json --epsilon -1").exit_code, 2);
  EXPECT_EQ(run(folder, "triangulate in.txt -o a.json --epsilon much").exit_code, 2);
}

TEST(Triangulate, ReadsSeveralFilesAndStandardInput) {
  const Folder folder;
  static_cast<void>(folder.write("a.geojson", map));
  static_cast<void>(folder.write("b.txt", "2 0\n5 -5\n5 15\n"));
  EXPECT_EQ(run(folder, "triangulate a.geojson b.txt -o files.json").exit_code, 0);
  static_cast<void>(folder.write("stdin", "2 0\n5 -5\n5 15\n"));
  EXPECT_EQ(run(folder, "triangulate a.geojson - -o text.json").exit_code, 0);
  static_cast<void>(folder.write("stdin", "\n " + map));
  EXPECT_EQ(run(folder, "triangulate - b.txt -o json.json").exit_code, 0);
  EXPECT_EQ(content(folder / "files.json"), content(folder / "text.json"));
  EXPECT_EQ(content(folder / "files.json"), content(folder / "json.json"));
}

TEST(Triangulate, DrawsAsItIsTold) {
  const Folder folder;
  static_cast<void>(folder.write("in.txt", cross));
  ASSERT_EQ(run(folder, "triangulate in.txt -o a.svg --no-fill --no-edges --width 300").exit_code,
            0);
  const std::string svg = content(folder / "a.svg");
  EXPECT_NE(svg.find("width=\"300\""), std::string::npos);
  EXPECT_EQ(svg.find("class=\"regions\""), std::string::npos);
  EXPECT_EQ(svg.find("class=\"edges\""), std::string::npos);
}

struct Case {
  std::string name;
  std::string input;  ///< content of in.txt; no file if it is "-"
  std::string arguments;
  int exit_code;
  std::vector<std::string> words;  ///< all of them are on stderr
};

/// What GoogleTest prints of a case.
void PrintTo(const Case& shown, std::ostream* out) { *out << shown.name; }

const std::vector<Case> cases{
    {"MissingFile", "-", "in.txt -o a.svg", 3, {"cannot read in.txt: No such file"}},
    {"EmptyFile", "", "in.txt -o a.svg", 3, {"in.txt: no polylines in it"}},
    {"BadLine", "2 0\n1 2\n1 x\n", "in.txt -o a.svg", 3, {"in.txt:3: expected y, found 'x'"}},
    {"NoGeoJson", "-", "- -o a.svg", 3, {"standard input: no polylines in it"}},
    {"UnknownInput", "-", "in.shp -o a.svg", 2, {"in.shp: unknown extension '.shp'", ".geojson"}},
    {"UnknownOutput", cross, "in.txt -o a.png", 2, {"unknown extension '.png'", ".svg .ply .json"}},
    {"MissingFolder", cross, "in.txt -o none/a.svg", 4, {"folder none does not exist"}},
    {"NoOutput", cross, "in.txt", 2, {"--output is required"}},
    {"OutputIsInput", cross, "in.txt -o in.txt", 2, {"in.txt is an input, too"}},
    {"BadWidth", cross, "in.txt -o a.svg --width 0", 2, {"--width"}},
};

class BadTriangulate : public ::testing::TestWithParam<Case> {};

TEST_P(BadTriangulate, IsNamedAndNothingIsWritten) {
  const Case& wanted = GetParam();
  const Folder folder;
  if (wanted.input != "-") static_cast<void>(folder.write("in.txt", wanted.input));
  const Outcome outcome = run(folder, "triangulate " + wanted.arguments);
  EXPECT_EQ(outcome.exit_code, wanted.exit_code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  for (const std::string& words : wanted.words) {
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(folder.size(), wanted.input == "-" ? 2U : 3U);  // out.txt, err.txt, in.txt
}

INSTANTIATE_TEST_SUITE_P(Loft, BadTriangulate, ::testing::ValuesIn(cases),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace loft::app
