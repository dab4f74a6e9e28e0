// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/bytes/little_endian.h"
#include "reconstruct/defect.h"

namespace loft::io {

/// Reads binary data piece by piece; never beyond its end. The bytes must outlive it.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::string_view name, std::endian order)
      : bytes_(bytes), name_(name), order_(order) {}

  [[nodiscard]] std::size_t place() const { return place_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - place_; }

  /// The next bytes. Throws InputError if the file ends before; `what` they are.
  std::string_view take(std::uint64_t count, std::string_view what) {
    if (count > left())
      fail(std::string(what) + ": " + std::to_string(count) + " bytes should come, the file ends " +
           "after " + std::to_string(left()) +
           "; it is cut off or damaged: copy or export it again");
    const std::string_view result = bytes_.substr(place_, static_cast<std::size_t>(count));
    place_ += result.size();
    return result;
  }
  template <class Number>
  Number number(std::string_view what) {
    return get<Number>(take(sizeof(Number), what).data(), order_);
  }
  /// The same of numbers that are `index` numbers into bytes that were taken.
  template <class Number>
  [[nodiscard]] Number number_in(std::string_view taken, std::size_t index) const {
    return get<Number>(taken.data() + index * sizeof(Number), order_);
  }

  /// Throws InputError `name: byte 123: message`.
  [[noreturn]] void fail(const std::string& message) const { fail(place_, message); }
  [[noreturn]] void fail(std::size_t place, const std::string& message) const {
    throw InputError(std::string(name_) + ": byte " + std::to_string(place) + ": " + message);
  }

 private:
  std::string_view bytes_;
  std::string_view name_;
  std::endian order_;
  std::size_t place_ = 0;
};

}  // namespace loft::io
