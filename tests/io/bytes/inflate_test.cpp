// SPDX-License-Identifier: MIT
#include "io/bytes/inflate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/io/bytes/gzipped.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using testing::gzipped;
using ::testing::HasSubstr;
using testing::message_of;

std::string some_bytes(std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * i / 7);
  return bytes;
}

TEST(InflateStream, GivesTheSameInPiecesOfAnySize) {
  const auto seed = std::random_device()();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const std::string bytes = some_bytes(300'000);
  for (const std::size_t members : {1U, 3U}) {
    const std::string packed = gzipped(bytes, members);
    EXPECT_EQ(inflate_all(packed, bytes.size(), "a.gz"), bytes);
    InflateStream stream(packed, "a.gz");
    std::string found;
    for (bool is_over = false; !is_over;) {
      std::string piece(1 + random() % 100'000, '\0');
      const std::size_t count = stream.read(piece);
      found.append(piece, 0, count);
      is_over = count < piece.size();
    }
    EXPECT_EQ(found, bytes);
    char more = 0;
    EXPECT_EQ(stream.read({&more, 1}), 0U);
  }
}

TEST(InflateStream, NamesWhereItWasCutOff) {
  const std::string packed = gzipped(some_bytes(10'000)).substr(0, 500);
  InflateStream stream(packed, "a.gz", 100);
  std::string all(10'000, '\0');
  EXPECT_THAT(message_of<InputError>([&] { static_cast<void>(stream.read(all)); }),
              HasSubstr("a.gz: byte 600: what is packed here ends too early"));
}

TEST(Inflate, TakesNoMemoryForWhatCannotBeThere) {
  EXPECT_THAT(message_of<InputError>(
                  [&] { static_cast<void>(inflate_all(gzipped("abc"), 1ULL << 40, "a.gz")); }),
              HasSubstr("cannot hold so many"));
}

}  // namespace
}  // namespace loft::io
