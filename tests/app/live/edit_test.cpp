// SPDX-License-Identifier: MIT
// The door of the live page.
#include "app/live/edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace loft::app {
namespace {

using ::testing::HasSubstr;

/// The status and words that a text is refused with; nothing if it is taken.
std::string refusal(const std::string& text, const EditLimits& limits = {}) {
  try {
    static_cast<void>(read_edit(text, limits));
    return "";
  } catch (const Refusal& refused) {
    return std::to_string(refused.status()) + ' ' + refused.what();
  }
}

TEST(LiveEdit, IsReadAsItIsWritten) {
  const Edit move = read_edit(R"( {"do": "move", "id": 7, "at": [1.5, -2e3]} )");
  EXPECT_EQ(move.kind, Edit::Kind::move);
  EXPECT_EQ(move.id, 7U);
  EXPECT_EQ(move.at, (cdt::Point{1.5, -2000}));
  const Edit insert = read_edit(R"({"points": [[0, 0], [1, 0]], "do": "insert", "name": "wall"})");
  EXPECT_EQ(insert.points, (std::vector<cdt::Point>{{0, 0}, {1, 0}}));
  EXPECT_EQ(insert.name, "wall");
  const Edit set = read_edit(R"({"do": "set", "name": "expression", "text": "a | b"})");
  EXPECT_EQ(set.text, "a | b");
}

TEST(LiveEdit, SaysWhatIsWrong) {
  EXPECT_THAT(refusal(""), HasSubstr("400 "));
  EXPECT_THAT(refusal("[]"), HasSubstr("an edit is an object"));
  EXPECT_THAT(refusal("{}"), HasSubstr("it needs do"));
  EXPECT_THAT(refusal(R"({"do": "jump"})"), HasSubstr("do is move, reshape, insert"));
  EXPECT_THAT(refusal(R"({"do": "move", "id": 7})"), HasSubstr("it needs at"));
  EXPECT_THAT(refusal(R"({"do": "move", "at": [0, 0]})"), HasSubstr("it needs id"));
  EXPECT_THAT(refusal(R"({"do": "remove", "id": 7, "id": 8})"), HasSubstr("id is given twice"));
  EXPECT_THAT(refusal(R"({"do": "remove", "id": 7, "so": 8})"), HasSubstr("keys are"));
  EXPECT_THAT(refusal(R"({"do": "remove", "id": 7} {})"), HasSubstr("400 "));
  EXPECT_THAT(refusal(R"({"do": "set", "name": "radius"})"), HasSubstr("value or text"));
  EXPECT_THAT(refusal(R"({"do": "set", "name": "radius", "value": 1, "text": "1"})"),
              HasSubstr("one of them"));
}

TEST(LiveEdit, AdmitsUsableNumbersAlone) {
  for (const char* number : {"1e76", "1e-51", "1e999", "NaN", "\"1\"", "null", "[1]"})
    EXPECT_THAT(refusal(std::string(R"({"do": "move", "id": 1, "at": [0, )") + number + "]}"),
                HasSubstr("400 "))
        << number;
  for (const char* number : {"0", "-0", "1e75", "-1e-50"})
    EXPECT_EQ(refusal(std::string(R"({"do": "move", "id": 1, "at": [0, )") + number + "]}"), "")
        << number;
  for (const char* id : {"-1", "1.5", "4294967296", "1e30"})
    EXPECT_THAT(refusal(std::string(R"({"do": "remove", "id": )") + id + '}'), HasSubstr("id is"))
        << id;
  EXPECT_THAT(refusal(R"({"do": "move", "id": 1, "at": [0]})"), HasSubstr("fewer than two"));
  EXPECT_THAT(refusal(R"({"do": "move", "id": 1, "at": [0, 1, 2]})"), HasSubstr("more than two"));
  EXPECT_THAT(refusal(R"({"do": "insert", "points": []})"), HasSubstr("no point"));
}

TEST(LiveEdit, KeepsItsLimits) {
  const EditLimits limits{.most_points = 2, .most_text = 8, .most_name = 8};
  EXPECT_EQ(refusal(R"({"do": "insert", "points": [[0, 0], [1, 0]]})", limits), "");
  EXPECT_THAT(refusal(R"({"do": "insert", "points": [[0, 0], [1, 0], [2, 2]]})", limits),
              HasSubstr("413 more than 2 points"));
  EXPECT_THAT(refusal(R"({"do": "set", "name": "a", "text": "123456789"})", limits),
              HasSubstr("413 text has more than 8 bytes"));
  EXPECT_THAT(refusal(R"({"do": "set", "name": "123456789", "value": 1})", limits),
              HasSubstr("413 name has more than 8 bytes"));
  EXPECT_THAT(refusal(std::string(100'000, '[')), HasSubstr("400 "));
}

TEST(LiveQuestion, IsReadAsItIsWritten) {
  const Question question = read_question("owners", "7", "1.5,-2");
  EXPECT_EQ(question.id, 7U);
  EXPECT_EQ(question.at, (cdt::Point{1.5, -2}));
  EXPECT_EQ(read_question("owners", "", "").at, std::nullopt);
  for (const char* at : {"1", "1,", ",1", "1;2", "1,2,3", "inf,1", "nan,0", "1e76,0"})
    EXPECT_THROW(static_cast<void>(read_question("owners", "", at)), Refusal) << at;
  EXPECT_THROW(static_cast<void>(read_question("owners", "x", "")), Refusal);
}

}  // namespace
}  // namespace loft::app
