// SPDX-License-Identifier: MIT
#include "io/volumes/raw_pixels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "reconstruct/defect.h"
#include "tests/io/bytes/gzipped.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using testing::gzipped;
using ::testing::HasSubstr;
using testing::message_of;

Volume volume(std::uint32_t layers) {
  Volume result;
  result.name = "a.file";
  result.columns = 3;
  result.rows = 2;
  result.slices = 4;
  result.layers = layers;
  return result;
}

std::vector<double> slice(const Volume& volume, std::uint32_t k, std::uint32_t layer) {
  std::vector<double> pixels(6);
  volume.read(k, layer, pixels);
  return pixels;
}

/// Packed pixels are the same as those that are not, in any order.
TEST(RawPixels, PackedOnesAreTheSame) {
  for (const std::uint32_t layers : {1U, 2U}) {
    for (const bool layers_first : {false, true}) {
      std::string bytes(std::size_t{24} * layers, '\0');
      std::iota(bytes.begin(), bytes.end(), '\1');
      const std::string packed = gzipped("front" + bytes);
      Volume plain = volume(layers);
      Volume unpacked = volume(layers);
      RawPixels pixels{.bytes = bytes, .layers_first = layers_first, .slope = 2, .intercept = 1};
      set_pixels(plain, pixels);
      pixels.bytes = packed;
      set_packed_pixels(unpacked, pixels, {5, "a.gz", 0});
      for (const std::uint32_t k : {0U, 1U, 3U, 3U, 2U, 0U})
        for (std::uint32_t layer = 0; layer < layers; ++layer)
          EXPECT_EQ(slice(unpacked, k, layer), slice(plain, k, layer)) << k << ' ' << layer;
    }
  }
}

TEST(RawPixels, TooFewPackedOnesAreNamed) {
  Volume one = volume(1);
  const std::string packed = gzipped("front" + std::string(20, '\1'));
  set_packed_pixels(one, {.bytes = packed}, {5, "a.gz", 0});
  EXPECT_EQ(slice(one, 2, 0), std::vector<double>(6, 1));
  EXPECT_THAT(
      message_of<InputError>([&] { static_cast<void>(slice(one, 3, 0)); }),
      HasSubstr("a.gz: byte 0: its header says 24 bytes of pixels, but packed there are 20"));
}

TEST(RawPixels, NoMemoryIsTakenForPackedOnesThatCannotBeThere) {
  Volume large = volume(1);
  large.columns = 1U << 20;
  const std::string packed = gzipped("abc");
  EXPECT_THROW(set_packed_pixels(large, {.bytes = packed}, {0, "a.gz", 0}), InputError);
}

}  // namespace
}  // namespace loft::io
