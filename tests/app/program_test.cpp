// SPDX-License-Identifier: MIT
// The program's commands when all is well.
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace loft::app {
namespace {

using namespace testing;

const std::string labelled = R"({"z": 0, "contours": [)" + ring(2) + ", " + ring(3, 12, 10, 0) +
                             R"(], "labels": ["heart", "lung"]})"
                             "\n"
                             R"({"z": 1, "contours": [)" +
                             ring(3, 12, 10, 0) + ", " + ring(2) +
                             R"(], "labels": ["lung", "heart"]})";

TEST(Loft, HelpNamesCommandsAndExitCodes) {
  const Folder folder;
  const Outcome outcome = run(folder, "--help");
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* words : {"reconstruct", "check", "info", "triangulate",
                            "Exit codes: 0 ok, 1 check failed, "
                            "2 usage, 3 bad input, 4 cannot write",
                            "Examples:"}) {
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words;
  }
  EXPECT_TRUE(run(folder, "--version").out.starts_with("loft "));
}

TEST(Loft, WritesEveryFormatAndWordsToStderr) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  const Outcome outcome = run(folder,
                              "reconstruct -o a.glb -o a.gltf -o a.ply -o a.obj -o a.stl -o a.off "
                              "--unit cm --cap dome --fill nonzero in.ndjson");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("wrote a.off\n"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find('\r'), std::string::npos) << "no progress bar into a file";
  for (const char* name : {"a.glb", "a.gltf", "a.ply", "a.obj", "a.stl", "a.off"}) {
    EXPECT_EQ(run(folder, std::string("check ") + name).exit_code, 0) << name;
    EXPECT_EQ(run(folder, std::string("info ") + name).exit_code, 0) << name;
  }
  EXPECT_EQ(folder.size(), 9U);
}

TEST(Loft, QuietSaysNothing) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel(slice(2, ring(10) + ", [[1, 1]]"))));
  const Outcome loud = run(folder, "reconstruct in.ndjson -o a.ply");
  EXPECT_NE(loud.err.find("warning: in.ndjson: slice 2 (z = 2) contour 1"), std::string::npos)
      << loud.err;
  const Outcome quiet = run(folder, "reconstruct in.ndjson -o a.ply --quiet");
  EXPECT_EQ(quiet.exit_code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST(Loft, WarnsTwentyTimesOfAKind) {
  const Folder folder;
  std::string stray;
  for (int i = 0; i < 30; ++i) stray += ", [[1, 1]]";
  static_cast<void>(folder.write("in.ndjson", barrel(slice(2, ring(10) + stray))));
  const Outcome outcome = run(folder, "reconstruct in.ndjson -o a.ply --json");
  std::size_t warnings = 0;
  for (std::size_t at = 0; (at = outcome.err.find("warning: ", at)) != std::string::npos; ++at) {
    ++warnings;
  }
  EXPECT_EQ(warnings, 21U) << outcome.err;
  EXPECT_NE(outcome.err.find("and 10 more of kind too_few_points"), std::string::npos);
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["parts"][0]["repairs"].size(), 30U);
  EXPECT_EQ(report["parts"][0]["repairs"][0]["contour"], 1);
}

TEST(Loft, MakesSmallerAndFewerTriangles) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", slice(0, ring(2, 32)) + slice(6, ring(3, 32))));
  const auto faces = [&](const std::string& option) {
    const Outcome outcome =
        run(folder, "reconstruct in.ndjson -o a.ply -o a.gltf --json " + option);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(run(folder, "check a.ply").exit_code, 0) << option;
    return nlohmann::json::parse(outcome.out)["faces"].get<int>();
  };
  const int plain = faces("");
  EXPECT_GT(faces("--max-edge 1"), plain);
  EXPECT_GT(faces("--target-edge 1"), plain);
  EXPECT_LT(faces("--simplify 0.5"), plain);
}

TEST(Loft, RecordsLengthsInReportsAndFiles) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  const Outcome outcome =
      run(folder, "reconstruct in.ndjson -o a.gltf -o a.ply --json --simplify 0.1");
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["options"]["simplify"], 0.1);
  EXPECT_FALSE(report["options"].contains("max_edge"));
  EXPECT_GE(report["seconds"]["simplify"].get<double>(), 0);
  const auto gltf = nlohmann::json::parse(content(folder / "a.gltf"));
  EXPECT_EQ(gltf["asset"]["extras"]["settings"]["simplify"], "0.1");
}

TEST(Loft, TellsAngles) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  const Outcome made = run(folder, "reconstruct in.ndjson -o a.ply --json");
  const auto angles = nlohmann::json::parse(made.out)["parts"][0]["angles"];
  EXPECT_GT(angles["least"].get<double>(), 0);
  EXPECT_LE(angles["least"], angles["percentile_5"]);
  EXPECT_LE(angles["percentile_5"], angles["median"]);
  EXPECT_LE(angles["median"].get<double>(), 60);
  EXPECT_GE(angles["worst_aspect"].get<double>(), 1);
  EXPECT_NE(run(folder, "info a.ply").out.find("smallest angles: least "), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(run(folder, "info a.ply --json").out)["parts"][0]["angles"],
            angles);
}

TEST(Loft, RefusesLengthsThatMakeNoSense) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  for (const char* options :
       {"--max-edge 0", "--max-edge -1", "--max-edge nan", "--max-edge inf", "--target-edge 0",
        "--target-edge wide", "--simplify -0.5", "--simplify nan", "--max-edge 1 --target-edge 1",
        "--max-edge 1 --simplify 1", "--simplify 0 --target-edge 1"}) {
    const Outcome outcome = run(folder, std::string("reconstruct in.ndjson -o a.ply ") + options);
    EXPECT_EQ(outcome.exit_code, 2) << options;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.ply")) << options;
  }
  EXPECT_NE(run(folder, "reconstruct in.ndjson -o a.ply --max-edge 0")
                .err.find("give a number from 1e-30 to 1e70, in the unit of the input"),
            std::string::npos);
  EXPECT_EQ(run(folder, "reconstruct in.ndjson -o a.ply --max-edge 1e-9").exit_code, 3);
}

TEST(Loft, ReportsAsJson) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", labelled));
  const Outcome outcome = run(folder, "reconstruct in.ndjson -o a.glb --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["schema"], "loft-reconstruct");
  EXPECT_EQ(report["schema_version"], 2);
  EXPECT_EQ(report["slices"], 2);
  EXPECT_EQ(report["contours"], 4);
  EXPECT_EQ(report["vertices_in"], 40);
  EXPECT_EQ(report["vertices"], 40);
  EXPECT_EQ(report["components"], 2);
  EXPECT_EQ(report["options"]["fill"], "evenodd");
  for (const char* stage : {"read", "clean", "tile", "sew", "write", "total"}) {
    EXPECT_GE(report["seconds"][stage].get<double>(), 0) << stage;
  }
  ASSERT_EQ(report["parts"].size(), 2U);
  EXPECT_EQ(report["parts"][0]["label"], "heart");
  EXPECT_EQ(report["parts"][0]["vertices_of_kind"]["contour"], 16);
  EXPECT_EQ(report["parts"][1]["label"], "lung");
}

TEST(Loft, LinksPartsThatMoveSideways) {
  const Folder folder;
  std::string stack;
  for (int i = 0; i < 5; ++i) stack += slice(i, ring(1, 20, 2.5 * i));
  static_cast<void>(folder.write("in.ndjson", stack));
  static_cast<void>(
      folder.write("links.ndjson", "{\"from\": [1, 0], \"to\": [2, 0], \"link\": false}\n"));
  const auto components = [&](const std::string& options) {
    const Outcome outcome = run(folder, "reconstruct in.ndjson -o a.ply --json " + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(run(folder, "check a.ply --stack in.ndjson").exit_code, 0) << options;
    return nlohmann::json::parse(outcome.out)["components"].get<int>();
  };
  EXPECT_EQ(components(""), 1);
  EXPECT_EQ(components("--link overlap"), 5);
  EXPECT_EQ(components("--link none"), 5);
  EXPECT_EQ(components("--max-shift 2"), 5);
  EXPECT_EQ(components("--links links.ndjson"), 2);
  EXPECT_EQ(components("--link none --links links.ndjson"), 5);
}

TEST(Loft, ReportsLinks) {
  const Folder folder;
  static_cast<void>(
      folder.write("in.ndjson", slice(0, ring(1, 20)) + slice(1, ring(1, 20, 2.5)) +
                                    slice(2, ring(1, 20, 5) + ", " + ring(1, 20, 50))));
  static_cast<void>(folder.write("links.ndjson",
                                 "{\"from\": [1, 0], \"to\": [2, 1], \"link\": true}\n"
                                 "{\"from\": [1, 0], \"to\": [2, 0], \"link\": false}\n"));
  const Outcome outcome =
      run(folder,
          "reconstruct in.ndjson -o a.ply --json --list-slabs --links links.ndjson --max-shift 3");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["options"]["link"], "auto");
  EXPECT_EQ(report["options"]["max_shift"], 3);
  EXPECT_EQ(report["options"]["links"], "links.ndjson");
  const auto& slabs = report["parts"][0]["slabs"];
  ASSERT_EQ(slabs.size(), 2U);
  EXPECT_EQ(slabs[0]["slices"], nlohmann::json::parse("[0, 1]"));
  EXPECT_EQ(slabs[0]["z"], nlohmann::json::parse("[0.0, 1.0]"));
  ASSERT_EQ(slabs[1]["links"].size(), 2U);
  const auto& link = slabs[1]["links"][0];
  EXPECT_EQ(link["kind"], "link");
  EXPECT_EQ(link["of"], "part");
  EXPECT_EQ(link["rule"], "order");
  EXPECT_EQ(link["lower"]["contours"], nlohmann::json::parse("[[1, 0]]"));
  EXPECT_EQ(link["upper"]["contours"], nlohmann::json::parse("[[2, 1]]"));
  EXPECT_NEAR(link["shift"].get<double>(), 47.5, 1e-3);
  const auto& birth = slabs[1]["links"][1];
  EXPECT_EQ(birth["kind"], "birth");
  EXPECT_TRUE(birth["lower"]["place"].is_null());
  EXPECT_EQ(birth["confidence"], 0);
}

TEST(Loft, NamesBadLinks) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  static_cast<void>(folder.write("links.ndjson", "{\"from\": [0, 0], \"to\": [3, 0]}\nnonsense\n"));
  const Outcome outcome = run(folder, "reconstruct in.ndjson -o a.ply --links links.ndjson");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("links.ndjson:1: slice 0 contour 0 and slice 3 contour 0 are not in "
                             "neighbouring slices"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("links.ndjson:2: "), std::string::npos) << outcome.err;
  EXPECT_EQ(run(folder, "reconstruct in.ndjson -o a.ply --link all").exit_code, 2);
  EXPECT_EQ(run(folder, "reconstruct in.ndjson -o a.ply --max-shift=-1").exit_code, 2);
  EXPECT_EQ(run(folder, "reconstruct in.ndjson -o a.ply --max-shift nan").exit_code, 2);
  EXPECT_EQ(run(folder, "reconstruct in.ndjson -o a.ply --keyhole-width nan").exit_code, 2);
}

TEST(Loft, ReadsSeveralFilesAndStandardInput) {
  const Folder folder;
  static_cast<void>(folder.write("stdin", slice(0, ring(8)) + slice(1, ring(9))));
  static_cast<void>(folder.write("b.jsonl", slice(2, ring(7))));
  EXPECT_EQ(run(folder, "reconstruct --merge - b.jsonl -o two.ply").exit_code, 0);
  static_cast<void>(
      folder.write("stdin", slice(0, ring(8)) + slice(1, ring(9)) + slice(2, ring(7))));
  EXPECT_EQ(run(folder, "reconstruct - -o one.ply").exit_code, 0);
  EXPECT_EQ(content(folder / "one.ply"), content(folder / "two.ply"));
}

TEST(Loft, ChecksAgainstTheStack) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  static_cast<void>(folder.write("other.ndjson", barrel(slice(2, ring(11)))));
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -o a.ply -o a.glb").exit_code, 0);
  const Outcome good = run(folder, "check a.ply --stack in.ndjson");
  EXPECT_EQ(good.exit_code, 0) << good.out;
  EXPECT_NE(good.out.find("all 40 contour vertices and 40 contour edges"), std::string::npos);
  const Outcome bad = run(folder, "check a.ply --stack other.ndjson");
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_NE(bad.out.find("8 of 40 contour vertices, 8 of 40 contour edges; first: slice 2 (z = 2) "
                         "contour 0 point 0"),
            std::string::npos)
      << bad.out;
  const auto report =
      nlohmann::json::parse(run(folder, "check a.ply --stack other.ndjson --json").out);
  EXPECT_EQ(report["schema"], "loft-check");
  EXPECT_EQ(report["valid"], true);
  EXPECT_EQ(report["stack"]["missing_vertices"], 8);
}

TEST(Loft, ChecksFailWhereTheSurfaceIsOpen) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -o a.ply --cap open").exit_code, 0);
  const Outcome outcome = run(folder, "check a.ply");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("not a valid solid"), std::string::npos);
  EXPECT_NE(outcome.out.find("boundary_edge: 16"), std::string::npos) << outcome.out;
}

TEST(Loft, TellsTouchingFromCrossing) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", slice(0, ring(1, 4) + ", " + ring(1, 4, 2, 0)) +
                                                  slice(1, ring(1, 4) + ", " + ring(1, 4, 2, 0))));
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -o a.off --quiet").exit_code, 0);
  const Outcome outcome = run(folder, "check a.off");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("touches itself in 2 points and 1 edges"), std::string::npos)
      << outcome.out;
  const auto report = nlohmann::json::parse(run(folder, "check a.off --json").out);
  EXPECT_EQ(report["parts"][0]["touching"]["points"], 2);
  EXPECT_EQ(report["parts"][0]["touching"]["edges"], 1);
}

TEST(Loft, SumsUpTheCleaning) {
  const Folder folder;
  const std::string crossing = "[[0, 0], [4, 0], [4, 4], [0, 4]], [[3, 3], [7, 3], [7, 7], [3, 7]]";
  static_cast<void>(folder.write("in.ndjson", slice(0, crossing) + slice(1, crossing)));
  const Outcome outcome = run(folder, "reconstruct in.ndjson -o a.ply --json");
  EXPECT_NE(outcome.err.find("cleaning: 2 overlap in 2 slices; area in question 2"),
            std::string::npos)
      << outcome.err;
  const auto report = nlohmann::json::parse(outcome.out)["parts"][0]["cleaning"];
  EXPECT_EQ(report["area"], 2);
  EXPECT_EQ(report["counts"]["overlap"], 2);
  EXPECT_EQ(report["slices"][1]["slice"], 1);
  EXPECT_EQ(report["slices"][1]["area"], 1);
}

TEST(Loft, CheckNamesTheFirstFacesOfACrowdedEdge) {
  const Folder folder;
  std::string mesh = "OFF\n3 500 0\n0 0 0\n1 0 0\n0 1 0\n";
  for (int i = 0; i < 500; ++i) mesh += "3 0 1 2\n";
  static_cast<void>(folder.write("in.off", mesh));
  const Outcome checked = run(folder, "check in.off");
  EXPECT_EQ(checked.exit_code, 1);
  EXPECT_NE(checked.out.find("faces 0 1 2 3 4 5 6 7 and 492 more"), std::string::npos);
}

TEST(Loft, CheckSaysWhatIsBeyondNumbersInWords) {
  const Folder folder;
  static_cast<void>(folder.write("far.off",
                                 "OFF\n4 4 0\n0 0 0\n1e300 0 0\n0 1e300 0\n0 0 1e300\n"
                                 "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"));
  const Outcome check = run(folder, "check far.off");
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.out.find("volume out of range"), std::string::npos) << check.out;
  EXPECT_EQ(check.out.find("nan"), std::string::npos) << check.out;
}

TEST(Loft, ShowsWhatIsInAStack) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", labelled + "\n" + slice(4, "")));
  const Outcome outcome = run(folder, "info in.ndjson");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("3 slices, 4 contours, 40 vertices, 1 slice empty"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("gaps between slices 1 to 3"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("label 'lung': 2 slices, 2 contours, 24 vertices"), std::string::npos);
  const auto report = nlohmann::json::parse(run(folder, "info in.ndjson --json").out);
  EXPECT_EQ(report["kind"], "stack");
  EXPECT_EQ(report["labels"][0]["label"], "heart");
}

}  // namespace
}  // namespace loft::app
