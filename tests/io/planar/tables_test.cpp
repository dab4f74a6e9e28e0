// SPDX-License-Identifier: MIT
#include "io/tables.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "io/bytes/csv_rows.h"
#include "io/bytes/file.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using cdt::Point;
using testing::Folder;
using testing::message_of;

const std::array wanted_height{WantedColumn{{"height", "value"}}};

PointTable table_of(const std::string& text) {
  return read_point_table_csv(text, "t.csv", wanted_height);
}

std::string table_problem(const std::string& text) {
  return message_of<InputError>([&] { static_cast<void>(table_of(text)); });
}

TEST(CsvRows, AreThoseOfRfc4180) {
  const std::string text =
      "\xEF\xBB\xBF"
      "# made by hand\r\n"
      "name,\"a, b\",x\r\n"
      "\"say \"\"so\"\"\", 1 ,\r\n"
      "\r\n"
      "\"two\n# lines\",2,\"3\"\n"
      "plain \"quotes\",4";
  CsvRows rows(text);
  EXPECT_EQ(rows.names(), (std::vector<std::string>{"name", "a, b", "x"}));
  const std::vector<std::pair<std::size_t, std::vector<std::string>>> expected{
      {3, {"say \"so\"", "1", ""}},
      {5, {"two\n# lines", "2", "3"}},
      {7, {"plain \"quotes\"", "4"}}};
  for (const auto& [line, cells] : expected) {
    ASSERT_TRUE(rows.next());
    EXPECT_EQ(rows.line(), line);
    EXPECT_EQ(std::vector<std::string>(rows.cells().begin(), rows.cells().end()), cells);
  }
  EXPECT_FALSE(rows.next());
  EXPECT_FALSE(rows.next());
  EXPECT_FALSE(rows.ends_in_quotes());
}

TEST(CsvRows, FindWhatPartsTheCells) {
  for (const char* text : {"a,b;c\n1,2\n", "a\tb;c\n1\t2\n", "a;b\n1;2\n", "a b\n1   2\n",
                           "\"a;\tb\",c\n1,2", "1,2\n", "1\t2"}) {
    CsvRows rows(text);
    ASSERT_TRUE(rows.next()) << text;
    if (std::string(text).starts_with("a,b;c")) continue;  // semicolons before commas
    ASSERT_EQ(rows.cells().size(), 2U) << text;
    EXPECT_EQ(rows.cells()[1], "2") << text;
  }
}

TEST(PointTables, HaveCoordinatesAndWhatIsWanted) {
  const std::vector<Point> expected{{1, 2.5}, {-3e-2, 4}};
  for (const char* text :
       {"x,y,Height\n1,2.5,10\n-3e-2,4,20\n",
        "\xEF\xBB\xBFid;value;Y;X\r\na;10;2,5;1\r\n\r\nb;20;4;-0,03",
        "1 2.5 10\n# no point\n-3e-2   4 20\n", "HEIGHT\tlat\tlon\n10\t2.5\t1\n20\t4\t-3e-2\n",
        "\"x\",\"y\",\"the\nheight\",\"height\"\n\"1\",\"2,5\",,10\n\"-0.03\",4,\"a\"\"b\","
        "\"20\"\n"}) {
    const PointTable table = table_of(text);
    EXPECT_EQ(std::vector<Point>(table.points().begin(), table.points().end()), expected) << text;
    ASSERT_EQ(table.values().size(), 1U);
    ASSERT_TRUE(table.values()[0]) << text;
    EXPECT_EQ(table.values()[0]->values, (std::vector<double>{10, 20})) << text;
  }
}

TEST(PointTables, KeepAllCells) {
  const PointTable table = read_point_table_csv("id,x,y,note\n7,1,2\n8,3,4,\"a, b\",more\n",
                                                "t.csv", std::array{WantedColumn{{"z"}, false}});
  EXPECT_FALSE(table.values()[0]);
  EXPECT_EQ(table.names().size(), 4U);
  EXPECT_EQ(table.cell(0, 0), "7");
  EXPECT_EQ(table.cell(0, 3), "");
  EXPECT_EQ(table.cell(1, 3), "a, b");
  EXPECT_EQ(table.cell(1, 4), "more");
  EXPECT_EQ(table.cell(1, 5), "");
  EXPECT_EQ(table.x_column(), 1U);
  EXPECT_EQ(table.y_column(), 2U);
  const PointTable without_header = read_point_table_csv("1 2 3 4\n", "t.csv", {});
  EXPECT_EQ(std::vector<std::string>(without_header.names().begin(), without_header.names().end()),
            (std::vector<std::string>{"x", "y", "value", "column 4"}));
}

TEST(PointTables, NameLineAndColumnOfAllThatIsWrong) {
  EXPECT_EQ(table_problem(""), "t.csv: no column 'height'; the columns are none");
  EXPECT_EQ(table_problem("x,y,height\n"), "t.csv: no points in it");
  EXPECT_EQ(table_problem("x,y,depth\n1,b,3\n"),
            "t.csv: no column 'height'; the columns are 'x', 'y', 'depth'\n"
            "t.csv:2: expected a number for y, found 'b'");
  EXPECT_EQ(table_problem("x,y,height\n1\n\nb,2,\n3,nan,inf\n4,5,6\n1e80,c,x\n1,2,3,\"4\n"),
            "t.csv:2: y is missing\n"
            "t.csv:2: height is missing\n"
            "t.csv:4: expected a number for x, found 'b'\n"
            "t.csv:4: height is missing\n"
            "t.csv:5: y: NaN is not a number\n"
            "t.csv:5: height: inf is not finite\n"
            "t.csv:7: x: 1e+80 is beyond 1e+75\n"
            "t.csv:7: expected a number for y, found 'c'\n"
            "t.csv:7: expected a number for height, found 'x'\n"
            "t.csv:8: a quotation mark has no mate; double those inside a text");
  std::string many = "x,y,height\n";
  for (int i = 0; i < 25; ++i) many += "1,2,\n";
  EXPECT_TRUE(table_problem(many).ends_with("\nt.csv: and 5 more"));
}

TEST(PointTables, ChooseTheReaderByExtension) {
  const Folder folder;
  EXPECT_EQ(read_point_table(folder.write("a.csv", "1,2\n")).points().size(), 1U);
  EXPECT_EQ(read_point_table(folder.write("a.XYZ", "1 2 3\n"), wanted_height).points().size(), 1U);
  EXPECT_THROW(static_cast<void>(read_point_table(folder.write("a.shp", "1 2\n"))), UnknownFormat);
}

}  // namespace
}  // namespace loft::io
