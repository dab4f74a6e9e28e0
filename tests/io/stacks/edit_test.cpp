// SPDX-License-Identifier: MIT
#include "io/stacks/edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "io/session/stack_state.h"

namespace loft::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Edit edit(Edit::Kind kind, double z) {
  if (kind == Edit::Kind::remove) return {kind, {z, {}}};
  return {kind, {z, {{{{0.1, 1e-40}, {1.0 / 3, -7}, {4, 5e20}}, "heart \"left\" \xC3\xA9"}}}};
}

TEST(EditLine, WhatIsWrittenIsRead) {
  for (const auto kind : {Edit::Kind::insert, Edit::Kind::replace, Edit::Kind::remove}) {
    for (const double z : {0.1, -3.0, 1e-300, std::numeric_limits<double>::denorm_min()}) {
      const EditLine read = parse_edit_line(to_line(edit(kind, z)));
      EXPECT_THAT(read.problems, ElementsAre());
      EXPECT_EQ(read.edit, edit(kind, z));
      EXPECT_EQ(read.z, z);
    }
  }
}

TEST(EditLine, InsertIsWhatIsMeantWithoutOp) {
  EXPECT_EQ(parse_edit_line(R"({"z": 1, "contours": []})").edit, (Edit{{}, {1, {}}}));
  EXPECT_EQ(parse_edit_line(R"({"op": "insert", "z": 1, "contours": []})").edit,
            (Edit{{}, {1, {}}}));
}

TEST(EditLine, RemovalNeedsItsHeightAlone) {
  const EditLine read = parse_edit_line(R"({"op": "remove", "z": 2, "contours": [[[0, 0]]]})");
  EXPECT_THAT(read.problems, ElementsAre());
  EXPECT_EQ(read.edit, (Edit{Edit::Kind::remove, {2, {}}}));
  EXPECT_THAT(parse_edit_line(R"({"op": "remove"})").problems,
              ElementsAre(HasSubstr("\"z\" is missing")));
}

TEST(EditLine, AllThatIsWrongIsSaid) {
  EXPECT_THAT(parse_edit_line(R"({"op": "undo", "z": NaN})").problems,
              ElementsAre(HasSubstr("unknown; write \"insert\", \"replace\" or \"remove\""),
                          HasSubstr("NaN is not a number"), HasSubstr("\"contours\" is missing")));
}

TEST(EditLine, MisspeltKeysAreNamed) {
  EXPECT_THAT(parse_edit_line(R"({"opp": "remove", "z": 2, "contours": []})").problems,
              ElementsAre("unknown key 'opp'; write \"op\""));
  EXPECT_THAT(parse_edit_line(R"({"Op": "remove", "z": 2})").problems,
              ElementsAre("unknown key 'Op'; write \"op\"", HasSubstr("\"contours\" is missing")));
}

TEST(StackState, AHeightThatIsNotThereNamesTheNearest) {
  StackState state;
  const auto remove = [&](double z) {
    return state.problem({Edit::Kind::remove, {z, {}}}).value_or("");
  };
  EXPECT_EQ(remove(1), "there is no slice at z = 1; there are no slices");
  for (const double z : {14.60316, 15.0, 17.0})
    state.set(z, std::make_shared<const Slice>(Slice{z, {}}));
  EXPECT_EQ(remove(14.603), "there is no slice at z = 14.603; the nearest is at z = 14.60316");
  EXPECT_EQ(remove(16), "there is no slice at z = 16; the nearest is at z = 15");
  EXPECT_EQ(remove(16.5), "there is no slice at z = 16.5; the nearest is at z = 17");
  EXPECT_EQ(remove(99), "there is no slice at z = 99; the nearest is at z = 17");
}

TEST(StackState, EditsAreAppliedInOrder) {
  StackState state;
  const auto apply = [&](const char* line) { return state.apply(parse_edit_line(line).edit); };
  EXPECT_FALSE(apply(R"({"z": 2, "contours": [[[0, 0]]]})"));
  EXPECT_FALSE(apply(R"({"z": 1, "contours": [[[1, 1]]]})"));
  EXPECT_FALSE(apply(R"({"z": 2, "contours": [[[2, 2]]]})"));
  EXPECT_TRUE(apply(R"({"op": "replace", "z": 3, "contours": []})"));
  EXPECT_TRUE(apply(R"({"op": "remove", "z": 3})"));
  EXPECT_EQ(state.stack(),
            (std::vector<Slice>{{1, {{{{1, 1}}, ""}}}, {2, {{{{0, 0}}, ""}, {{{2, 2}}, ""}}}}));
  EXPECT_FALSE(apply(R"({"op": "remove", "z": 1})"));
  EXPECT_FALSE(apply(R"({"op": "replace", "z": 2, "contours": []})"));
  EXPECT_EQ(state.stack(), (std::vector<Slice>{{2, {}}}));
}

}  // namespace
}  // namespace loft::io
