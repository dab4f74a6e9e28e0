// SPDX-License-Identifier: MIT
#include "io/stacks/stack_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "io/bytes/file.h"
#include "io/bytes/natural_order.h"
#include "io/stack.h"
#include "io/stack_writer.h"
#include "io/stacks/slices_json.h"
#include "io/stacks/stack_format.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using ::testing::ElementsAre;
using testing::Folder;
using ::testing::HasSubstr;
using testing::message_of;

Stack full_stack() {
  Stack stack;
  stack.unit = "um";
  stack.frame = WorldFrame{{{{0, 0, 1, 5}, {1, 0, 0, 0.1}, {0, 1, 0, -3}, {0, 0, 0, 1}}}};
  stack.labels = {{"heart", Colour{208, 32, 48}, "3", "ORGAN", 2.5}, {"a \"b\"", {}, "", "", {}}};
  stack.fill = Fill::keyhole_aware;
  stack.keyhole_width = 0.3;
  stack.gap = 1.25;
  stack.notes = {"one point left out"};
  stack.slices = {
      {1.5,
       {{{{0, 0}, {4, 0}, {0, 4}}, "heart", "ROI 3 contour 0", {{1, 2, 3}, {4, 5, 6}, {7, 8, 0.1}}},
        {{{9, 0}, {13, 0}, {9, 4}}, "a \"b\"", "", {}}}},
      {3, {}}};
  return stack;
}

TEST(StackLine, GivesBackAllOfAStack) {
  std::stringstream file;
  write_stack_json(file, full_stack());
  EXPECT_EQ(read_stack_json(file, "a.ndjson"), full_stack());
}

TEST(StackLine, IsLeftOutWhereThereAreOnlySlices) {
  Stack stack;
  stack.slices = {{1, {}}};
  std::stringstream file;
  write_stack_json(file, stack);
  EXPECT_EQ(file.str(), "{\"z\":1,\"contours\":[]}\n");
}

TEST(StackLine, NamesAllThatIsWrong) {
  const std::string line =
      R"({"stack": {"unit": 5, "frame": [1, 0], "fill": "odd", "gap": -1, "colour": 1,)"
      R"( "labels": [{"colour": "red"}], "lables": []}})";
  const auto parsed = parse_stack_line(line);
  ASSERT_TRUE(parsed);
  EXPECT_THAT(parsed->problems,
              ElementsAre(HasSubstr("\"unit\""), HasSubstr("16 numbers"), HasSubstr("'odd'"),
                          HasSubstr("\"gap\""), HasSubstr("'red'"), HasSubstr("\"name\"")));
}

TEST(StackLine, RefusesFramesThatCannotBeUsed) {
  const auto fault_of = [](const std::string& numbers) {
    const auto parsed = parse_stack_line("{\"stack\": {\"frame\": [" + numbers + "]}}");
    return parsed && parsed->problems.size() == 1 ? parsed->problems[0] : "";
  };
  EXPECT_THAT(fault_of("-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1"), HasSubstr("mirror"));
  EXPECT_THAT(fault_of("1,0,0,0, 0,1,0,0, 1,1,0,0, 0,0,0,1"), HasSubstr("one plane"));
  EXPECT_THAT(fault_of("1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,1"), HasSubstr("last row"));
  EXPECT_THAT(fault_of("1,0,0,1e99, 0,1,0,0, 0,0,1,0, 0,0,0,1"), HasSubstr("usable"));
}

TEST(StackLine, CountsOnlyAsTheFirstLine) {
  std::istringstream in("{\"z\":0,\"contours\":[]}\n{\"stack\":{}}\n");
  EXPECT_THAT(message_of<InputError>([&] { static_cast<void>(read_stack_json(in, "a.ndjson")); }),
              HasSubstr("a.ndjson:2"));
}

TEST(StackLine, ColoursAreSixDigits) {
  EXPECT_EQ(to_colour("#0a10ff"), (Colour{10, 16, 255}));
  EXPECT_EQ(to_text({10, 16, 255}), "#0a10ff");
  for (const char* wrong : {"", "#12345", "#12345g", "0a10ff0", "#+a10ff"})
    EXPECT_FALSE(to_colour(wrong)) << wrong;
}

TEST(ReadStack, TellsWhatToDoWithFormatsThatItDoesNotRead) {
  const Folder folder;
  EXPECT_THAT(
      message_of<InputError>([&] { static_cast<void>(read_stack(folder.write("a.ilt", "PK"))); }),
      HasSubstr("export"));
}

TEST(ReadStack, RefusesFilesOfUnlikeUnits) {
  const Folder folder;
  const auto file = [&](const char* name, const std::string& unit) {
    return folder.write(name, "{\"stack\":{\"unit\":\"" + unit +
                                  "\"}}\n{\"z\":0,\"contours\":[[[0,0],[1,0],[0,1]]]}\n");
  };
  const std::vector<std::filesystem::path> paths{file("a.ndjson", "mm"), file("b.ndjson", "um")};
  EXPECT_THAT(message_of<InputError>([&] { static_cast<void>(read_stack(paths)); }),
              HasSubstr("unit"));
}

TEST(ReadStack, AnExplicitFillRuleWins) {
  const Folder folder;
  const auto path =
      folder.write("a.ndjson", "{\"stack\":{\"fill\":\"nonzero\"}}\n{\"z\":0,\"contours\":[]}\n");
  EXPECT_EQ(read_stack(path).fill, Fill::nonzero);
  EXPECT_EQ(read_stack(path, {.fill = Fill::even_odd}).fill, Fill::even_odd);
}

TEST(NaturalOrder, TakesDigitsForNumbers) {
  EXPECT_TRUE(in_natural_order("slice_2.png", "slice_10.png"));
  EXPECT_TRUE(in_natural_order("a9b1", "a09b2"));
  EXPECT_FALSE(in_natural_order("slice_10.png", "slice_2.png"));
  EXPECT_FALSE(in_natural_order("a", "a"));
  EXPECT_TRUE(in_natural_order("a", "a1"));
  EXPECT_TRUE(in_natural_order("x99999999999999999998", "x99999999999999999999"));
}

TEST(WriteStack, AsCsvHasPlacesInTheWorld) {
  const Folder folder;
  const auto path = folder.write("out.csv", "");
  const auto losses = write_stack(path, full_stack());
  EXPECT_EQ(losses.size(), 2U);
  EXPECT_EQ(read_file(path).substr(0, 62),
            "x,y,z,contour,label\r\n1,2,3,0,heart\r\n4,5,6,0,heart\r\n7,8,0.1,0,h");
}

}  // namespace
}  // namespace loft::io
