// SPDX-License-Identifier: MIT
// Each pixel of volumes that other programs wrote is on the right side of its label's outlines; the
// voxels are read here once more, in a simple way.
#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/stack.h"
#include "tests/io/shapes.h"
#include "tests/io/volumes/raster.h"

namespace loft::io {
namespace {

using testing::Raster;

/// Voxels along the world's axes.
struct Voxels {
  std::array<std::size_t, 3> sizes;
  std::array<double, 3> origin;   ///< centre of the first one
  std::array<double, 3> spacing;  ///< negative where the axis runs the other way
  std::vector<int> values;
  std::map<std::string, int> by_name = {};  ///< values of labels; else their ids are
};

std::string sample(const char* name) {
  return (std::filesystem::path(LOFT_SAMPLES) / name).string();
}

std::string inflated(const std::string& bytes) {
  std::string result(std::size_t{4} << 20, '\0');
  z_stream stream{};
  constexpr int gzip = 15 + 16;
  EXPECT_EQ(inflateInit2(&stream, gzip), Z_OK);
  std::string input = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  result.resize(stream.total_out);
  inflateEnd(&stream);
  return result;
}

/// A segmentation of 3D Slicer: the lines of its header that count, and bytes.
Voxels chest() {
  const std::string bytes = testing::content(sample("slicer_chest.seg.nrrd"));
  const std::string header = bytes.substr(0, bytes.find("\n\n"));
  const auto field = [&](const std::string& name, const std::string& colon = ": ") {
    const std::size_t begin = header.find('\n' + name + colon) + name.size() + colon.size() + 1;
    return header.substr(begin, header.find('\n', begin) - begin);
  };
  Voxels voxels;
  std::array<double, 9> directions{};
  EXPECT_EQ(std::sscanf(field("sizes").c_str(), "%zu %zu %zu", &voxels.sizes[0], &voxels.sizes[1],
                        &voxels.sizes[2]),
            3);
  EXPECT_EQ(std::sscanf(field("space origin").c_str(), "(%lf,%lf,%lf)", &voxels.origin[0],
                        &voxels.origin[1], &voxels.origin[2]),
            3);
  EXPECT_EQ(
      std::sscanf(field("space directions").c_str(), "(%lf,%lf,%lf) (%lf,%lf,%lf) (%lf,%lf,%lf)",
                  &directions[0], &directions[1], &directions[2], &directions[3], &directions[4],
                  &directions[5], &directions[6], &directions[7], &directions[8]),
      9);
  for (std::size_t i = 0; i < 3; ++i) voxels.spacing[i] = directions[4 * i];
  for (int i = 0; i < 7; ++i) {
    const std::string segment = "Segment" + std::to_string(i);
    voxels.by_name[field(segment + "_Name", ":=")] =
        std::stoi(field(segment + "_LabelValue", ":="));
  }
  for (const char value : inflated(bytes.substr(header.size() + 2)))
    voxels.values.push_back(static_cast<unsigned char>(value));
  return voxels;
}

/// A segmentation of TotalSegmentator: NIfTI-1, little-endian bytes, an sform without rotation.
Voxels organs() {
  const std::string bytes =
      inflated(testing::content(sample("totalsegmentator_example_seg.nii.gz")));
  const auto number = [&]<class Number>(std::size_t at, Number result) {
    std::memcpy(&result, &bytes[at], sizeof(Number));
    return result;
  };
  Voxels voxels;
  for (std::size_t i = 0; i < 3; ++i) {
    voxels.sizes[i] = static_cast<std::size_t>(number(42 + 2 * i, std::int16_t{}));
    voxels.spacing[i] = number(280 + 20 * i, float{});
    voxels.origin[i] = number(292 + 16 * i, float{});
  }
  EXPECT_EQ(number(70, std::int16_t{}), 2) << "unsigned char";
  const auto begin = static_cast<std::size_t>(number(108, float{}));
  for (const char value : bytes.substr(begin))
    voxels.values.push_back(static_cast<unsigned char>(value));
  return voxels;
}

/// How many pixels are on the wrong side of the outlines of a label.
std::size_t count_wrong(const Voxels& voxels, const Stack& stack) {
  const auto& [columns, rows, slices] = voxels.sizes;
  EXPECT_EQ(voxels.values.size(), columns * rows * slices);
  const auto to_pixels = [&](const cdt::Point& p) {
    return cdt::Point{(p.x - voxels.origin[0]) / voxels.spacing[0],
                      (p.y - voxels.origin[1]) / voxels.spacing[1]};
  };
  std::size_t wrong = 0;
  std::vector<bool> is_met(slices);
  for (const Slice& slice : stack.slices) {
    const double at = (slice.z - voxels.origin[2]) / voxels.spacing[2];
    const auto k = static_cast<std::size_t>(std::lround(at));
    EXPECT_NEAR(at, static_cast<double>(k), 1e-4);
    is_met.at(k) = true;
    std::map<std::string, Raster> rasters;
    for (const Contour& contour : slice.contours)
      rasters.try_emplace(contour.label, columns, rows)
          .first->second.add(contour.points, to_pixels);
    const int* const pixels = &voxels.values[k * columns * rows];
    for (const StackLabel& label : stack.labels) {
      const auto named = voxels.by_name.find(label.name);
      const int value = named != voxels.by_name.end() ? named->second : std::stoi(label.id);
      const auto found = rasters.find(label.name);
      for (std::size_t i = 0; i < columns * rows; ++i)
        if ((found != rasters.end() && found->second[i]) != (pixels[i] == value)) ++wrong;
    }
  }
  EXPECT_EQ(std::ranges::count(is_met, false), 0);
  return wrong;
}

void expect_all_right(const Voxels& voxels, const char* name, std::size_t labels) {
  for (const Outline outline : {Outline::iso_lines, Outline::edges}) {
    const Stack stack = read_stack(sample(name), {.outline = outline});
    EXPECT_EQ(stack.labels.size(), labels);
    EXPECT_EQ(count_wrong(voxels, stack), 0U);
  }
}

TEST(Samples, EachPixelOfASegmentationOfSlicerIsOnTheRightSide) {
  expect_all_right(chest(), "slicer_chest.seg.nrrd", 7);
}

TEST(Samples, EachPixelOfASegmentationOfTotalSegmentatorIsOnTheRightSide) {
  expect_all_right(organs(), "totalsegmentator_example_seg.nii.gz", 41);
}

}  // namespace
}  // namespace loft::io
