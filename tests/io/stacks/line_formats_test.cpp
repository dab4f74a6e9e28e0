// SPDX-License-Identifier: MIT
// Formats of contours as the table knows them, and through the door of all stacks.
#include "io/stack.h"
#include "tests/io/stacks/readers.h"

namespace loft::io {
namespace {

std::string_view format_of(const std::filesystem::path& path, std::string_view bytes = "") {
  const StackFormat* const format = find_stack_format(path, bytes);
  return format == nullptr ? "" : format->name;
}

TEST(LineFormats, AreKnownByTheirNames) {
  EXPECT_EQ(format_of("a.cli"), "CLI");
  EXPECT_EQ(format_of("A.MOD"), "IMOD");
  EXPECT_EQ(format_of("a.b.jser"), "PyReconstruct");
  EXPECT_EQ(format_of("a.geojson"), "GeoJSON");
  EXPECT_EQ(format_of("a.json"), "NDJSON");
  EXPECT_EQ(format_of("a.csl"), "CSL");
  EXPECT_EQ(format_of("a.contour"), "contour");
  EXPECT_EQ(format_of("a.cnt"), "Nuages");
  EXPECT_EQ(format_of("a.csv"), "CSV");
  EXPECT_EQ(format_of("a.xyz"), "CSV");
}

TEST(LineFormats, AreKnownByTheirFirstBytesWhateverTheNameIs) {
  EXPECT_EQ(format_of("a.txt", "$$HEADERSTART\n$$BINARY"), "CLI");
  EXPECT_EQ(format_of("a.fid", "IMODV1.2"), "IMOD");
  EXPECT_EQ(format_of("a.json", "{\"type\":\"FeatureCollection\""), "GeoJSON");
  EXPECT_EQ(format_of("a.txt", "CSLC\n3 2"), "CSL");
  EXPECT_EQ(format_of("a.txt", "x y z\n"), "CSV");
}

TEST(LineFormats, ComeInByOneDoor) {
  const testing::Folder folder;
  const auto file = folder.write("a.json", R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{"ELEV":7},"geometry":
      {"type":"LineString","coordinates":[[0,0],[1,0],[0,1],[0,0]]}}]})");
  ReadOptions options;
  options.fill = Fill::nonzero;
  const Stack stack = read_stack(file, options);
  EXPECT_EQ(stack.slices.at(0).z, 7);
  EXPECT_EQ(stack.fill, Fill::nonzero);  // a rule that is asked for wins
}

}  // namespace
}  // namespace loft::io
