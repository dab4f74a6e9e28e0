// SPDX-License-Identifier: MIT
#include "io/points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "io/bytes/file.h"
#include "io/planar/points_csv.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using cdt::Point;
using testing::Folder;
using testing::message_of;

std::string problem(const std::string& text) {
  return message_of<InputError>([&] { static_cast<void>(read_points_csv(text, "p.csv")); });
}

TEST(Points, AreInTheColumnsOfTheHeader) {
  const std::vector<Point> expected{{1, 2.5}, {-3e-2, 4}};
  const char* cases[] = {
      "x,y\n1,2.5\n-3e-2,4\n",
      "\xEF\xBB\xBFid;Y;X\r\na;2.5;1\r\n\r\nb;4;-3e-2",
      "1 2.5\n# no point\n-3e-2 4\n",
      "1,2.5,9\n-3e-2,4,8\n",
      "name\tlat\tlon\nhere\t2.5\t1\nthere\t4\t-3e-2\n",
      "east north\n1 2.5\n-3e-2 4\n",
      "x;y\n1;2,5\n-3e-2;4\n",
  };
  for (const char* text : cases) EXPECT_EQ(read_points_csv(text, "p.csv"), expected) << text;
}

TEST(Points, NameTheLine) {
  EXPECT_EQ(problem(""), "p.csv: no points in it");
  EXPECT_EQ(problem("x,y\n"), "p.csv: no points in it");
  EXPECT_EQ(problem("x,y\n1\n\nb,2\n3,nan\n4,5\n1e80,c\n"),
            "p.csv:2: y is missing\n"
            "p.csv:4: expected a number for x, found 'b'\n"
            "p.csv:5: y: NaN is not a number\n"
            "p.csv:7: x: 1e+80 is beyond 1e+75\n"
            "p.csv:7: expected a number for y, found 'c'");
  std::string many = "x,y\n";
  for (int i = 0; i < 25; ++i) many += "1,\n";
  EXPECT_TRUE(problem(many).ends_with("\np.csv: and 5 more"));
}

TEST(Points, ChooseTheReaderByExtension) {
  const Folder folder;
  const std::vector<Point> expected{{1, 2}};
  EXPECT_EQ(read_points(folder.write("a.csv", "1,2\n")), expected);
  EXPECT_EQ(read_points(folder.write("a.XY", "1 2\n")), expected);
  EXPECT_THROW(static_cast<void>(read_points(folder.write("a.shp", "1 2\n"))), UnknownFormat);
}

}  // namespace
}  // namespace loft::io
