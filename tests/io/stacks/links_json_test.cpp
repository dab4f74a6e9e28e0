// SPDX-License-Identifier: MIT
#include "io/stacks/links_json.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "io/bytes/file.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using testing::Folder;
using testing::message_of;

/// Slices at 0, 2.5 and 5, with two contours each.
std::vector<Slice> three_slices() {
  const Contour triangle{{{0, 0}, {1, 0}, {0, 1}}, ""};
  std::vector<Slice> slices;
  for (const double z : {0.0, 2.5, 5.0}) slices.push_back({z, {triangle, triangle}});
  return slices;
}

std::vector<LinkOrder> orders_in(const std::string& text) {
  std::istringstream in(text);
  return read_links_json(in, "links.ndjson", three_slices());
}

std::string problem_of_orders(const std::string& text) {
  return message_of<InputError>([&] { static_cast<void>(orders_in(text)); });
}

TEST(LinksJson, NamesContoursByIndexOrHeight) {
  const auto orders = orders_in(
      "\xEF\xBB\xBF{\"from\": [0, 1], \"to\": [1, 0]}\r\n\n"
      "{\"to\": {\"z\": 2.5, \"contour\": 1}, \"link\": false, \"from\": [2, 0], \"by\": 7}");
  ASSERT_EQ(orders.size(), 2U);
  EXPECT_EQ(orders[0].from, (ContourId{0, 1}));
  EXPECT_EQ(orders[0].to, (ContourId{1, 0}));
  EXPECT_TRUE(orders[0].is_link);
  EXPECT_EQ(orders[0].place, "links.ndjson:1");
  EXPECT_EQ(orders[1].from, (ContourId{2, 0}));
  EXPECT_EQ(orders[1].to, (ContourId{1, 1}));
  EXPECT_FALSE(orders[1].is_link);
  EXPECT_EQ(orders[1].place, "links.ndjson:3");
  EXPECT_TRUE(orders_in("").empty());
}

TEST(LinksJson, NamesEveryProblemWithItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {R"([1, 2])",
       R"(expected an order {"from": ..., "to": ..., "link": true or false}, found a list)"},
      {R"({"from": [0, 1]})",
       R"("to" is missing; write [slice, contour] or {"z": ..., "contour": ...})"},
      {R"({"from": [0], "to": [1, 0]})", R"("from": has 1 numbers instead of [slice, contour])"},
      {R"({"from": [0, 0.5], "to": [1, 0]})",
       R"("from": 0.5 is no index; write a whole number, counted from 0)"},
      {R"({"from": [0, 0], "to": [1, -1]})",
       R"("to": -1 is no index; write a whole number, counted from 0)"},
      {R"({"from": [0, 0], "to": {"z": 3, "contour": 0}})",
       R"("to": "z": there is no slice at z = 3; the nearest is at z = 2.5)"},
      {R"({"from": [0, 0], "to": {"z": 2.5}})", R"("to": needs "z" and "contour")"},
      {R"({"from": [0, 0], "to": [1, 0], "link": "no"})",
       R"("link": expected true or false, found a string)"},
      {R"({"from": [0, 0], "to": [1, 0]} {})",
       R"(broken JSON at column 32: something behind the closing bracket; one order a line)"},
      {R"({"from": [0, 0], "to": [9, 0]})", "there is no slice 9; the stack has 3, counted from 0"},
      {R"({"from": [0, 0], "to": [2, 0]})",
       "slice 0 contour 0 and slice 2 contour 0 are not in neighbouring slices"}};
  for (const auto& [line, expected] : cases)
    EXPECT_EQ(problem_of_orders("\n" + line), "links.ndjson:2: " + expected) << line;
  EXPECT_EQ(problem_of_orders("{}\n{\"from\": [0, 0], \"to\": [7, 0]}"),
            "links.ndjson:1: \"from\" is missing; write [slice, contour] or {\"z\": ..., "
            "\"contour\": ...}\n"
            "links.ndjson:1: \"to\" is missing; write [slice, contour] or {\"z\": ..., "
            "\"contour\": ...}\n"
            "links.ndjson:2: there is no slice 7; the stack has 3, counted from 0");
}

TEST(LinksJson, MisspeltKeysAreNamed) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {R"({"form": [0, 1], "to": [1, 0]})", R"(unknown key 'form'; write "from")"},
      {R"({"from": [0, 1], "to": [1, 0], "lnik": false})", R"(unknown key 'lnik'; write "link")"},
      {R"({"from": {"Z": 0, "contour": 1}, "to": [1, 0]})",
       R"("from": unknown key 'Z'; write "z")"},
      {R"({"from": {"z": 0, "contours": 1}, "to": [1, 0]})",
       R"("from": unknown key 'contours'; write "contour")"},
  };
  for (const auto& [line, words] : cases)
    EXPECT_EQ(problem_of_orders(line), "links.ndjson:1: " + words);
}

TEST(LinksJson, AFileThatIsNotThereIsNamed) {
  const Folder folder;
  const auto path = folder / "none.ndjson";
  const std::string message =
      message_of<FileError>([&] { static_cast<void>(read_links_json(path, three_slices())); });
  EXPECT_NE(message.find("none.ndjson"), std::string::npos) << message;
  EXPECT_THROW(static_cast<void>(read_links_json(folder / "", three_slices())), FileError);
}

}  // namespace
}  // namespace loft::io
