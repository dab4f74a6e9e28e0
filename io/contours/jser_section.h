// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cdt/point.h"
#include "io/bytes/json_reader.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// A trace of PyReconstruct, in the coordinates of its section.
struct JserTrace {
  std::vector<double> x;
  std::vector<double> y;
  Colour colour;
  bool is_closed = true;
  bool is_negative = false;
  bool is_hidden = false;
};

/// x' = m0 x + m1 y + m2, y' = m3 x + m4 y + m5.
using JserTransform = std::array<double, 6>;
inline constexpr JserTransform jser_identity{1, 0, 0, 0, 1, 0};

/// What a section says beside its traces.
struct JserSection {
  std::optional<double> thickness;
  std::map<std::string, JserTransform> alignments;
  std::optional<JsonReader> contours;  ///< bookmark of the object that has a list of traces a name
};

/// What is wrong, without the place of the section.
using JserComplain = std::function<void(const std::string&)>;

/// Reads the section that comes next, an object. Throws JsonError.
[[nodiscard]] JserSection read_jser_section(JsonReader& json, const JserComplain& complain);

/// Reads its traces, in the order of the file: `take(name, number in name, trace)`. Those with
/// something wrong are complained of and left out. Throws JsonError.
void read_jser_traces(
    JsonReader contours, const JserComplain& complain,
    const std::function<void(const std::string&, std::size_t, const JserTrace&)>& take);

}  // namespace loft::io
