// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstddef>
#include <string>

namespace loft::io::testing {

/// By gzip, in as many members as asked for.
inline std::string gzipped(const std::string& bytes, std::size_t members = 1) {
  std::string result;
  const std::size_t step = bytes.size() / members + 1;
  for (std::size_t at = 0; at < bytes.size(); at += step) {
    std::string part = bytes.substr(at, step);
    std::string packed(part.size() + 100, '\0');
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, 31, 8, Z_DEFAULT_STRATEGY), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(part.data());
    stream.avail_in = static_cast<uInt>(part.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    result.append(packed, 0, stream.total_out);
    deflateEnd(&stream);
  }
  return result;
}

/// By zlib, without gzip's header.
inline std::string deflated(const std::string& bytes) {
  std::string packed(compressBound(bytes.size()), '\0');
  uLongf size = packed.size();
  EXPECT_EQ(compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                     reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
            Z_OK);
  packed.resize(size);
  return packed;
}

}  // namespace loft::io::testing
