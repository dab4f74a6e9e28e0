// SPDX-License-Identifier: MIT
#include "io/planar/moving_ai.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "overlay/boolean.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using cdt::Point;
using overlay::MultiPolygon;
using testing::message_of;

std::string map_text(const std::vector<std::string>& rows) {
  std::string text = "type octile\nheight " + std::to_string(rows.size()) + "\nwidth " +
                     std::to_string(rows.front().size()) + "\nmap\n";
  for (const std::string& row : rows) text += row + '\n';
  return text;
}

MultiPolygon free_of(const std::vector<std::string>& rows) {
  const Map map = read_moving_ai_map(map_text(rows), "a.map");
  EXPECT_EQ(map.features.size(), 1U);
  EXPECT_EQ(property(map.features.front(), "layer"), "free");
  return map.features.front().polygons;
}

std::string map_problem(const std::string& text) {
  return message_of<InputError>([&] { static_cast<void>(read_moving_ai_map(text, "a.map")); });
}

std::string scenario_problem(const std::string& text) {
  return message_of<InputError>(
      [&] { static_cast<void>(read_moving_ai_scenario(text, "a.scen")); });
}

TEST(MovingAiMaps, AreOutlinesOfWhatIsFree) {
  EXPECT_EQ(
      free_of({"@@@", "@GS", "@.T"}),
      (MultiPolygon{{.outer = {{1, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 3}, {1, 3}}, .holes = {}}}));
  EXPECT_EQ(free_of({"...", ".W.", "..."}),
            (MultiPolygon{{.outer = {{0, 0}, {3, 0}, {3, 3}, {0, 3}},
                           .holes = {{{1, 2}, {2, 2}, {2, 1}, {1, 1}}}}}));
}

TEST(MovingAiMaps, HoldWhatIsInAHoleAPolygonOfItsOwn) {
  EXPECT_EQ(free_of({".....", ".@@@.", ".@.@.", ".@@@.", "....."}),
            (MultiPolygon{{.outer = {{0, 0}, {5, 0}, {5, 5}, {0, 5}},
                           .holes = {{{1, 4}, {4, 4}, {4, 1}, {1, 1}}}},
                          {.outer = {{2, 2}, {3, 2}, {3, 3}, {2, 3}}, .holes = {}}}));
}

TEST(MovingAiMaps, AreNotJoinedInCorners) {
  EXPECT_EQ(free_of({".@", "@."}),
            (MultiPolygon{{.outer = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, .holes = {}},
                          {.outer = {{1, 1}, {2, 1}, {2, 2}, {1, 2}}, .holes = {}}}));
  // A ring around two blocked cells that touch in a corner goes through that twice.
  EXPECT_EQ(free_of({"....", ".@..", "..@.", "...."})[0].holes.size(), 1U);
}

TEST(MovingAiMaps, HaveTheAreaOfTheirFreeCells) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::string> rows(1 + random() % 9, std::string(1 + random() % 9, '@'));
    rows[0][0] = '.';
    for (std::string& row : rows)
      for (char& cell : row)
        if (random() % 2 == 0) cell = '.';
    double cells = 0;
    std::vector<overlay::Ring> rings;
    for (const std::string& row : rows) cells += static_cast<double>(std::ranges::count(row, '.'));
    const MultiPolygon polygons = free_of(rows);
    EXPECT_EQ(area(polygons).to_double(), cells);
    for (const overlay::Polygon& polygon : polygons) {
      EXPECT_GT(overlay::area(polygon.outer).sign(), 0);
      rings.push_back(polygon.outer);
      for (const overlay::Ring& hole : polygon.holes) {
        EXPECT_LT(overlay::area(hole).sign(), 0);
        rings.push_back(hole);
      }
    }
    EXPECT_EQ(area(overlay::fill(rings, overlay::FillRule::even_odd)).to_double(), cells);
  }
}

TEST(MovingAiMaps, NameTheLine) {
  EXPECT_EQ(map_problem(""), "a.map: no line `map`, with the rows of cells behind it");
  EXPECT_EQ(map_problem("type octile\nheight 0\nwidth x 1\nhigh 2\nmap\n.\n"),
            "a.map:2: expected `height` and a number of cells from 1 on\n"
            "a.map:3: expected `width` and a number of cells from 1 on\n"
            "a.map:4: expected `type`, `height`, `width` or `map`, found 'high'");
  EXPECT_EQ(map_problem("type octile\nmap\n.\n"),
            "a.map:2: no line `height` before it\na.map:2: no line `width` before it");
  EXPECT_EQ(map_problem("type octile\nheight 3\nwidth 2\nmap\n..\r\n...\n"),
            "a.map:6: row 1 has 3 cells instead of 2\n"
            "a.map: the file ends where row 2 of 3 should be");
  EXPECT_EQ(map_problem("height 1\nwidth 1\nmap\n.\n\n.\n"),
            "a.map:6: more rows than the 1 that `height` says");
  EXPECT_EQ(map_problem("height 1\nwidth 2\nmap\n@T\n"), "a.map: no cell of it is free");
  EXPECT_EQ(map_problem("height 1000000000\nwidth 1000000000\nmap\n"),
            "a.map: the file ends where row 0 of 1000000000 should be");
}

TEST(MovingAiScenarios, AreTakenAsTheyAre) {
  EXPECT_EQ(read_moving_ai_scenario("version 1\n"
                                    "0\tmaps/dao/arena.map\t49\t49\t1\t11\t1\t12\t1\n"
                                    "\n"
                                    "3 my map.map 49 49 1.5 11 40 2 38.5\r\n",
                                    "a.scen"),
            (std::vector<PathQuery>{{{1, 11}, {1, 12}}, {{1.5, 11}, {40, 2}}}));
  EXPECT_EQ(read_moving_ai_scenario("version 1.0\n0 a 1 1 0 0 1 1 1", "a.scen").size(), 1U);
}

TEST(MovingAiScenarios, NameTheLine) {
  EXPECT_EQ(scenario_problem(""), "a.scen:1: expected `version 1`");
  EXPECT_EQ(scenario_problem("0 a 1 1 0 0 1 1 1\n"), "a.scen:1: expected `version 1`");
  EXPECT_EQ(scenario_problem("version 1\n"), "a.scen: no queries in it");
  EXPECT_EQ(scenario_problem("version 1\n0 a 1 1 0 0 1 1\n0 a 1 1 x 0 1e80 1 1\n"),
            "a.scen:2: expected `bucket map width height x0 y0 x1 y1 length`, found 8 words\n"
            "a.scen:3: expected a number for x0, found 'x'\n"
            "a.scen:3: x1: 1e+80 is beyond 1e+75");
}

}  // namespace
}  // namespace loft::io
