// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

namespace loft::io {

/// The unsigned integer with as many bytes as a number.
template <std::size_t Size>
struct BitsOf;
template <>
struct BitsOf<1> {
  using type = std::uint8_t;
};
template <>
struct BitsOf<2> {
  using type = std::uint16_t;
};
template <>
struct BitsOf<4> {
  using type = std::uint32_t;
};
template <>
struct BitsOf<8> {
  using type = std::uint64_t;
};
template <class Number>
using Bits = typename BitsOf<sizeof(Number)>::type;

/// Puts a number, least significant byte first, into the bytes at `place`.
/// Precondition: room for it. Returns the place behind it.
template <class Number>
char* put(char* place, Number number) {
  const auto bits = std::bit_cast<Bits<Number>>(number);
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    place[i] = static_cast<char>(static_cast<std::uint8_t>(bits >> (8 * i)));
  }
  return place + sizeof(Number);
}

/// The number in the bytes at `place`, least or most significant byte first.
/// Precondition: that many bytes are there.
template <class Number>
Number get(const char* place, std::endian order = std::endian::little) {
  Bits<Number> bits = 0;
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    const std::size_t shift = order == std::endian::little ? i : sizeof(Number) - 1 - i;
    const auto byte = static_cast<Bits<Number>>(static_cast<std::uint8_t>(place[i]));
    bits = static_cast<Bits<Number>>(bits | static_cast<Bits<Number>>(byte << (8 * shift)));
  }
  return std::bit_cast<Number>(bits);
}

}  // namespace loft::io
