// SPDX-License-Identifier: MIT
#include "io/stacks/slices_json.h"

#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "io/bytes/file.h"
#include "io/stack.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using testing::Folder;
using testing::message_of;

std::vector<Slice> slices_in(const std::string& text) {
  std::istringstream in(text);
  return read_slices_json(in, "stack.ndjson");
}

std::string problem_of_slices(const std::string& text) {
  return message_of<InputError>([&] { static_cast<void>(slices_in(text)); });
}

std::vector<Slice> random_stack(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(-1e6, 1e6);
  std::vector<Slice> stack(1 + random() % 5);
  for (Slice& slice : stack) {
    slice.z = coordinate(random);
    slice.contours.resize(random() % 4);
    for (Contour& contour : slice.contours) {
      contour.label = random() % 2 == 0 ? "" : "a \"label\" \xc3\xa9\n";
      for (auto points = random() % 6; points > 0; --points) {
        contour.points.push_back({coordinate(random), coordinate(random) * 1e-300});
      }
    }
  }
  return stack;
}

TEST(SlicesJson, WhatIsWrittenIsReadBackExactly) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const std::vector<Slice> stack = random_stack(seed);
    std::ostringstream out;
    write_slices_json(out, stack);
    EXPECT_EQ(slices_in(out.str()), stack) << "seed " << seed;
  }
}

TEST(SlicesJson, IgnoresWhatDoesNoHarm) {
  const std::vector<Slice> expected{{1, {{{{0, 0}, {1, 0}, {0, 1}}, ""}}}, {2, {}}};
  EXPECT_EQ(slices_in("\xEF\xBB\xBF{\"z\": 1, \"contours\": [[[0,0],[1,0],[0,1]]]}\r\n\r\n   \n"
                      "{\"contours\": [], \"z\": 2.0, \"who\": {\"a\": [1, \"x\", null]}}"),
            expected);
  EXPECT_EQ(slices_in("{\"op\":\"insert\",\"z\":2,\"contours\":[]}").size(), 1U);
}

TEST(SlicesJson, KeysThatAreNearNoneOfOursAreIgnored) {
  EXPECT_EQ(problem_of_slices(
                R"({"z":2,"contours":[],"x":1,"colours":1,"spacing":2,"label":"a","labels":[]})"),
            "nothing");
}

TEST(SlicesJson, KeepsSmallContoursAndEqualHeights) {
  const auto stack =
      slices_in("{\"z\":1,\"contours\":[[],[[1,2]],[[1,2],[3,4]]]}\n{\"z\":1,\"contours\":[]}");
  ASSERT_EQ(stack.size(), 2U);
  ASSERT_EQ(stack[0].contours.size(), 3U);
  EXPECT_EQ(stack[0].contours[2].points.size(), 2U);
}

TEST(SlicesJson, LabelsMayComeBeforeTheirContours) {
  const auto stack = slices_in(R"({"labels":["heart","lung"],"z":1,"contours":[[],[]]})");
  EXPECT_EQ(stack[0].contours[0].label, "heart");
  EXPECT_EQ(stack[0].contours[1].label, "lung");
}

struct Bad {
  const char* text;
  const char* message;  ///< the whole of it
};

TEST(SlicesJson, NamesLineSliceContourAndPoint) {
  const Bad cases[] = {
      {"", "stack.ndjson: no slices in it; expected lines {\"z\": ..., \"contours\": [...]}"},
      {"\n\n", "stack.ndjson: no slices in it; expected lines {\"z\": ..., \"contours\": [...]}"},
      {"{\"z\":1,\"contours\":[]}\n{\"z\":2,\"contours\":[[",
       "stack.ndjson:2: slice 1 (z = 2) broken JSON at column 21: expected a value, but the line "
       "ends"},
      {"{\"contours\":[]}", "stack.ndjson:1: slice 0 \"z\" is missing; a slice needs its height"},
      {"{\"z\":1}",
       "stack.ndjson:1: slice 0 (z = 1) \"contours\" is missing; an empty slice has \"contours\": "
       "[]"},
      {"{\"z\":\"1\",\"contours\":[]}",
       "stack.ndjson:1: slice 0 \"z\": expected a finite number, found a string"},
      {"{\"z\":NaN,\"contours\":[]}",
       "stack.ndjson:1: slice 0 \"z\": NaN is not a number; write a finite number"},
      {"{\"z\":2,\"contours\":[[],[[0,0],[1,NaN]]]}",
       "stack.ndjson:1: slice 0 (z = 2) contour 1 point 1: NaN is not a number; write a finite "
       "number or leave the point out"},
      {"{\"z\":2,\"contours\":[[[-Infinity,0]]]}",
       "stack.ndjson:1: slice 0 (z = 2) contour 0 point 0: -Infinity is not a number; write a "
       "finite "
       "number or leave the point out"},
      {"{\"z\":2,\"contours\":[[[null,0]]]}",
       "stack.ndjson:1: slice 0 (z = 2) contour 0 point 0: expected a finite number or leave the "
       "point out, found null"},
      {"{\"z\":2,\"contours\":[[[1e999,0]]]}",
       "stack.ndjson:1: slice 0 (z = 2) contour 0 point 0: 1e999 is too large for a number; write "
       "a "
       "finite number or leave the point out"},
      {"{\"z\":2,\"contours\":[[[1,2,2]]]}",
       "stack.ndjson:1: slice 0 (z = 2) contour 0 point 0: has 3 coordinates instead of [x, y]"},
      {"{\"z\":2,\"contours\":[[1,2]]}",
       "stack.ndjson:1: slice 0 (z = 2) contour 0 point 0: expected a point [x, y], found a "
       "number\n"
       "stack.ndjson:1: slice 0 (z = 2) contour 0 point 1: expected a point [x, y], found a "
       "number"},
      {"{\"z\":2,\"contours\":[],\"labels\":[\"a\"]}",
       "stack.ndjson:1: slice 0 (z = 2) 1 labels for 0 contours; each contour needs one"},
      {"{\"op\":\"remove\",\"z\":2}",
       "stack.ndjson:1: slice 0 (z = 2) \"op\": \"remove\" is an edit; a stack holds its slices "
       "only, "
       "without \"op\"\n"
       "stack.ndjson:1: slice 0 (z = 2) \"contours\" is missing; an empty slice has \"contours\": "
       "[]"},
      {"{\"z\":2,\"contours\":[]} {}",
       "stack.ndjson:1: slice 0 (z = 2) broken JSON at column 23: something behind the closing "
       "bracket; one slice a line"},
      {"{\"z\":2,\"contour\":[[[0,0]]]}",
       "stack.ndjson:1: slice 0 (z = 2) unknown key 'contour'; write \"contours\""},
      {"{\"Z\":2,\"contours\":[]}", "stack.ndjson:1: slice 0 unknown key 'Z'; write \"z\""},
      {"{\"z\":2,\"contours\":[],\"lables\":[]}",
       "stack.ndjson:1: slice 0 (z = 2) unknown key 'lables'; write \"labels\""},
      {"[1]",
       "stack.ndjson:1: slice 0 expected a slice {\"z\": ..., \"contours\": [...]}, found a list"},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(problem_of_slices(text), message) << text;
}

TEST(SlicesJson, GathersAllBadLinesButShowsTwenty) {
  std::string text;
  for (int i = 0; i < 25; ++i) text += "{}x\n";
  const std::string message = problem_of_slices(text);
  EXPECT_EQ(std::ranges::count(message, '\n'), 20);
  EXPECT_TRUE(message.ends_with("\nstack.ndjson: and 5 more")) << message;
}

TEST(SlicesJson, SurvivesEveryTruncation) {
  std::ostringstream out;
  write_slices_json(out, random_stack(3));
  const std::string text = out.str();
  for (std::size_t size = 0; size < text.size(); ++size) {
    try {
      static_cast<void>(slices_in(text.substr(0, size)));
    } catch (const InputError&) {
      continue;
    }
  }
}

TEST(Slices, ChoosesTheReaderByExtension) {
  const Folder folder;
  const std::string text = "{\"z\":1,\"contours\":[]}\n";
  for (const char* name : {"a.ndjson", "b.jsonl", "c.json", "D.NDJSON"}) {
    EXPECT_EQ(read_stack(folder.write(name, text)).slices.size(), 1U) << name;
  }
  const auto unknown = folder.write("stack.unknown", text);
  EXPECT_NE(
      message_of<UnknownFormat>([&] { static_cast<void>(read_stack(unknown)); }).find(".ndjson"),
      std::string::npos);
}

TEST(Slices, NamesAFileThatIsNotThere) {
  const Folder folder;
  const auto path = folder / "none.ndjson";
  EXPECT_EQ(message_of<FileError>([&] { static_cast<void>(read_stack(path)); }),
            "cannot read " + path.string() + ": No such file or directory");
}

TEST(Slices, GathersTheProblemsOfAllFiles) {
  const Folder folder;
  const std::vector<std::filesystem::path> paths{folder.write("a.ndjson", "x"),
                                                 folder.write("b.ndjson", "")};
  const std::string message = message_of<InputError>([&] { static_cast<void>(read_stack(paths)); });
  EXPECT_NE(message.find("a.ndjson:1: slice 0 broken JSON"), std::string::npos) << message;
  EXPECT_NE(message.find("b.ndjson: no slices"), std::string::npos) << message;
}

}  // namespace
}  // namespace loft::io
