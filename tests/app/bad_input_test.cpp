// SPDX-License-Identifier: MIT
// What the program says and returns when something is wrong with its input or its command line.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace loft::app {
namespace {

using namespace testing;

struct Mistake {
  std::string name;
  std::string stack;  ///< content of in.ndjson; no file if it is "-"
  std::string arguments;
  int exit_code;
  std::vector<std::string> words;  ///< all of them are on stderr
};

/// What GoogleTest prints of a mistake.
void PrintTo(const Mistake& shown, std::ostream* out) { *out << shown.name; }

const std::string to_ply = "reconstruct in.ndjson -o out.ply";
const std::string nan_slice =
    R"({"z": 2, "contours": [[[0, 0], [9, 0], [9, 9]], [[1, 1], [2, NaN], [2, 2]]]})"
    "\n";

const std::vector<Mistake> mistakes{
    // Files.
    {"MissingFile", "-", to_ply, 3, {"cannot read in.ndjson: No such file or directory"}},
    {"EmptyFile", "", to_ply, 3, {"in.ndjson: no slices in it"}},
    {"UnknownInput", "-", "info in.abc", 2, {"in.abc: unknown extension '.abc'", ".ndjson"}},
    {"MissingMesh", "-", "check in.ply", 3, {"cannot read in.ply: No such file or directory"}},
    {"BrokenMesh", "-", "check in.ndjson", 2, {"unknown extension '.ndjson'", ".ply"}},

    // Lines.
    {"BrokenLine",
     barrel("{\"z\": 2, \"contours\"\n"),
     to_ply,
     3,
     {"in.ndjson:3: slice 2 (z = 2) broken JSON at column 20"}},
    {"MissingZ",
     barrel("{\"contours\": []}\n"),
     to_ply,
     3,
     {"in.ndjson:3: slice 2 \"z\" is missing"}},
    {"NanPoint",
     barrel(nan_slice),
     to_ply,
     3,
     {"in.ndjson:3: slice 2 (z = 2) contour 1 point 1: NaN is not a number"}},
    {"InfinitePoint",
     barrel(slice(2, "[[0, 0], [1, -Infinity], [2, 2]]")),
     to_ply,
     3,
     {"in.ndjson:3: slice 2 (z = 2) contour 0 point 1: -Infinity is not a number"}},
    {"OverflowingPoint",
     barrel(slice(2, "[[0, 0], [1, 0], [1e999, 2]]")),
     to_ply,
     3,
     {"in.ndjson:3: slice 2 (z = 2) contour 0 point 2: 1e999 is too large"}},
    {"AllBadLines",
     nan_slice + "x\n" + nan_slice,
     to_ply,
     3,
     {"in.ndjson:1: slice 0", "in.ndjson:2: slice 1", "in.ndjson:3: slice 2"}},

    // Stacks.
    {"AllSlicesEmpty", slice(0, "") + slice(1, "") + slice(2, ""), to_ply, 3, {"in.ndjson: "}},
    {"OneSliceOnly", slice(0, ring(8)), to_ply, 3, {"in.ndjson: "}},
    {"OneHeightOnly", slice(0, ring(8)) + slice(0, ring(8)), to_ply, 3, {"in.ndjson: "}},
    {"NothingOfAnyLabel",
     R"({"z": 0, "contours": [[[0,0],[1,0],[0,1]], [[5,5],[6,5],[5,6]]], "labels": ["a", "b"]})",
     to_ply,
     3,
     {"in.ndjson: label 'a': ", "in.ndjson: label 'b': "}},

    // Outputs.
    {"MissingFolder",
     barrel(),
     "reconstruct in.ndjson -o none/out.ply",
     4,
     {"cannot write none/out.ply: folder none does not exist"}},
    {"OutputIsAFolder", barrel(), "reconstruct in.ndjson -o ../.ply/.. -o out.ply", 2, {"unknown"}},
    {"UnknownOutput",
     barrel(),
     "reconstruct in.ndjson -o out.vtk",
     2,
     {"out.vtk: unknown extension '.vtk'", ".glb .gltf .ply .obj .stl .off"}},
    {"OutputIsInput", barrel(), "reconstruct in.ndjson -o in.ndjson", 2, {"in.ndjson"}},

    // Command lines.
    {"NoCommand", "-", "", 2, {"subcommand"}},
    {"UnknownCommand", "-", "weave", 2, {"subcommand"}},
    {"NoOutput", barrel(), "reconstruct in.ndjson", 2, {"--output is required"}},
    {"BadUnit", barrel(), to_ply + " --unit parsec", 2, {"'parsec' is no unit", "mm"}},
    {"NegativeUnit", barrel(), to_ply + " --unit=-1", 2, {"'-1' is no unit"}},
    {"BadFill", barrel(), to_ply + " --fill odd", 2, {"odd", "evenodd"}},
    {"BadCap", barrel(), to_ply + " --cap round", 2, {"round", "dome"}},
};

class BadInput : public ::testing::TestWithParam<Mistake> {};

TEST_P(BadInput, IsNamedAndNothingIsWritten) {
  const Mistake& wanted = GetParam();
  const Folder folder;
  if (wanted.stack != "-") static_cast<void>(folder.write("in.ndjson", wanted.stack));
  const Outcome outcome = run(folder, wanted.arguments);
  EXPECT_EQ(outcome.exit_code, wanted.exit_code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  for (const std::string& words : wanted.words) {
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(folder.size(), wanted.stack == "-" ? 2U : 3U);  // out.txt, err.txt, in.ndjson
}

INSTANTIATE_TEST_SUITE_P(Loft, BadInput, ::testing::ValuesIn(mistakes),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace loft::app
