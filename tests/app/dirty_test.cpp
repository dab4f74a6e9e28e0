// SPDX-License-Identifier: MIT
// Stacks with something wrong that a user would want repaired: the surface is always a valid
// solid, and the report names what was done.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace loft::app {
namespace {

using namespace testing;

/// The ring of the barrel's middle slice with some points changed.
std::string middle(const std::string& points) { return slice(2, "[" + points + "]"); }

const std::string corner[] = {"[10, 0]",  "[7, 7]",   "[0, 10]",  "[-7, 7]",
                              "[-10, 0]", "[-7, -7]", "[0, -10]", "[7, -7]"};

std::string join(const std::vector<std::string>& points) {
  std::string text;
  for (const std::string& point : points) text += (text.empty() ? "" : ", ") + point;
  return text;
}

const std::string clean = join({std::begin(corner), std::end(corner)});

struct DirtyStack {
  std::string name;
  std::string stack;
  std::vector<std::string> repairs;         ///< kinds that the report must name
  std::optional<std::string> same_as = {};  ///< a stack that must give the same volume
  double tolerance = 0;                     ///< of the volume, relative
  int components = 1;
  int genus = 0;
  std::string options = {};  ///< of the command line
};

/// What GoogleTest prints of a stack.
void PrintTo(const DirtyStack& shown, std::ostream* out) { *out << shown.name; }

std::string each(const std::string& contours) {
  return slice(0, contours) + slice(1, contours) + slice(2, contours);
}

const std::string barrel_reversed =
    slice(0, "[[8, 0], [0, -8], [-8, 0], [0, 8]]") + slice(1, "[[9, 0], [0, 9], [-9, 0], [0, -9]]");
const std::string barrel_oriented =
    slice(0, "[[8, 0], [0, 8], [-8, 0], [0, -8]]") + slice(1, "[[9, 0], [0, 9], [-9, 0], [0, -9]]");
const std::string holes = "[[0, 0], [9, 0], [9, 9], [0, 9]], [[3, 3], [6, 3], [6, 6], [3, 6]]";
const std::string touching = "[[0, 0], [4, 0], [4, 4], [0, 4]], [[4, 4], [8, 4], [8, 8], [4, 8]]";
const std::string overlapping = ring(5, 16, 0, 0) + ", " + ring(5, 16, 4, 0);

const std::string squared = "[0, 0], [9, 0], [9, 9], [0, 9]";
/// A square with a square hole, drawn as one line: in at a corner, and out `width` to the right.
std::string keyhole(const std::string& width) {
  return "[[0, 0], [3, 3], [3, 6], [6, 6], [6, 3], [3." + width.substr(width.find('.') + 1) +
         ", 3], [0." + width.substr(width.find('.') + 1) + ", 0], [9, 0], [9, 9], [0, 9]]";
}

const std::vector<DirtyStack> dirty_stacks{
    {"Clean", barrel(), {}, barrel()},
    {"SelfCrossing",
     barrel(middle(join({corner[0], corner[2], corner[1], corner[3], corner[4], corner[5],
                         corner[6], corner[7]}))),
     {"self_crossing"},
     barrel(middle(clean)),
     0.1},
    {"DuplicatePoints",
     barrel(middle(join({corner[0], corner[0], corner[1], corner[2], corner[2], corner[2],
                         corner[3], corner[4], corner[5], corner[6], corner[7], corner[0]}))),
     {},
     barrel(middle(clean))},
    {"RepeatedContour",
     barrel(slice(2, "[" + clean + "], [" + clean + "]")),
     {"repeated_contour"},
     barrel(middle(clean))},
    {"ReversedOrientation", barrel_reversed, {}, barrel_oriented},
    {"Spike",
     barrel(middle(clean + ", [20, -14], " + corner[7])),
     {"spike"},
     barrel(middle(clean))},
    {"OneAndTwoPoints",
     barrel(slice(2, "[" + clean + "], [[1, 1]], [[1, 1], [2, 2]], []")),
     {"too_few_points"},
     barrel(middle(clean))},
    {"ZeroArea",
     barrel(slice(2, "[" + clean + "], [[1, 1], [2, 2], [3, 3]]")),
     {"zero_area"},
     barrel(middle(clean))},
    {"OutOfOrder",
     slice(2, ring(7)) + slice(0, ring(8)) + slice(1, ring(9)),
     {},
     slice(0, ring(8)) + slice(1, ring(9)) + slice(2, ring(7))},
    {"EqualHeights",
     slice(0, ring(4)) + slice(1, ring(2)) + slice(1, ring(2, 8, 9, 9)) + slice(2, ring(2)),
     {"merged_slices"},
     slice(0, ring(4)) + slice(1, ring(2) + ", " + ring(2, 8, 9, 9)) + slice(2, ring(2)),
     0,
     2},
    {"EmptySliceInTheMiddle", barrel(slice(2, "")), {"empty_slice"}, {}, 0, 2},
    {"EmptySlicesAtTheEnds",
     slice(-1, "") + barrel() + slice(5, "") + slice(6, ""),
     {},
     slice(-1, "") + barrel() + slice(5, "")},
    {"HolesOfTheSameOrientation", each(holes), {}, {}, 0, 1, 1},
    {"TouchingContours", each(touching), {}, {}, 0, 2},
    // By parity two overlapping discs leave two crescents, which touch in two points.
    {"OverlappingContours", each(overlapping), {"overlap"}, {}, 0, 2},
    {"OverlappingContoursNonzero", each(overlapping), {"overlap"}, {}, 0, 1, 0, "--fill nonzero"},
    {"KeyholeWithoutWidth", each(keyhole("0")), {"spike"}, {}, 0, 1, 1},
    {"SlitOfAKeyhole", each(keyhole("0.001")), {}, {}, 0, 1, 0},
    {"KeyholeCut",
     each(keyhole("0.001")),
     {"keyhole"},
     each(keyhole("0")),
     1e-3,
     1,
     1,
     "--fill keyhole-aware"},
    {"KeyholeWiderThanAskedFor",
     each(keyhole("0.001")),
     {},
     {},
     0,
     1,
     0,
     "--fill keyhole-aware --keyhole-width 1e-4"},
    {"TwiceRound", each("[" + squared + ", " + squared + "]"), {"repeated_contour"}, {}},
    {"TinyUnits", slice(0, ring(1e-5)) + slice(1e-6, ring(2e-5)) + slice(2e-6, ring(1e-5)), {}, {}},
    {"HugeUnits", slice(0, ring(1e9)) + slice(1e8, ring(2e9)) + slice(2e8, ring(1e9)), {}, {}},
};

nlohmann::json reconstruct(const Folder& folder, const std::string& stack,
                           const std::string& options) {
  static_cast<void>(folder.write("in.ndjson", stack));
  const Outcome outcome =
      run(folder, "reconstruct in.ndjson -o out.ply -o out.glb --json " + options);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.exit_code == 0 ? nlohmann::json::parse(outcome.out) : nlohmann::json();
}

class Dirty : public ::testing::TestWithParam<DirtyStack> {};

TEST_P(Dirty, GivesAValidSolidAndIsReported) {
  const DirtyStack& wanted = GetParam();
  const Folder folder;
  const nlohmann::json report = reconstruct(folder, wanted.stack, wanted.options);
  ASSERT_FALSE(report.is_null());
  const Outcome check = run(folder, "check out.ply");
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;

  EXPECT_EQ(report["components"], wanted.components);
  EXPECT_EQ(report["genus"], wanted.genus);
  EXPECT_GT(report["volume"], 0);
  const std::string repairs = report["parts"][0]["repairs"].dump();
  for (const std::string& kind : wanted.repairs) {
    EXPECT_NE(repairs.find('"' + kind + '"'), std::string::npos) << repairs;
  }
  EXPECT_TRUE(wanted.name != "Clean" || repairs == "[]") << repairs;
  if (!wanted.same_as) return;
  const double volume = reconstruct(folder, *wanted.same_as, wanted.options)["volume"];
  EXPECT_NEAR(report["volume"].get<double>() / volume, 1, std::max(wanted.tolerance, 1e-12));
}

INSTANTIATE_TEST_SUITE_P(Loft, Dirty, ::testing::ValuesIn(dirty_stacks),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace loft::app
