// SPDX-License-Identifier: MIT
// What tests of readers of stacks have in common.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes/little_endian.h"
#include "io/stacks/stack_format.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io::testing {

using Reader = Stack (*)(const StackInput&, const ReadOptions&);

/// `name` is that of the file, for its messages.
inline Stack read(Reader reader, std::string_view bytes, const ReadOptions& options = {}) {
  return reader({bytes, "a.file"}, options);
}

/// What the reader says of a bad file; "nothing" if it takes it.
inline std::string problem(Reader reader, std::string_view bytes, const ReadOptions& options = {}) {
  return message_of<InputError>([&] { static_cast<void>(read(reader, bytes, options)); });
}

/// Cut off anywhere, a file is refused with words or read, and nothing else happens.
inline void expect_no_cut_hurts(Reader reader, std::string_view bytes) {
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string cut(bytes.substr(0, size));  // of its own, for sanitizers to see its end
    try {
      EXPECT_FALSE(read(reader, cut).slices.empty()) << size;
    } catch (const InputError& error) {
      EXPECT_NE(std::string_view(error.what()).find("a.file"), std::string_view::npos) << size;
    }
  }
}

/// Appends a number as a file has it.
template <class Number>
void append(std::string& bytes, Number number, std::endian order) {
  char place[sizeof(Number)];
  io::put(place, number);
  if (order == std::endian::big) std::reverse(std::begin(place), std::end(place));
  bytes.append(place, sizeof(Number));
}

/// The labels of the contours of a slice, in order.
inline std::vector<std::string> labels_in(const Slice& slice) {
  std::vector<std::string> labels;
  for (const Contour& contour : slice.contours) labels.push_back(contour.label);
  return labels;
}

}  // namespace loft::io::testing
