// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "fields/field.h"

namespace loft::fields {

/// Of a line: what it claims.
struct Field::Values {
  LineKind kind = LineKind::feature;
  std::vector<double> left;   // by point; of a feature, on both sides
  std::vector<double> right;  // of a wall
  std::uint64_t order = 0;
  LineId firm{};  // its id in firm_
};

/// What a sample or a line says of a vertex.
struct Field::Claimed {
  Claim claim;
  std::uint64_t order = 0;
  double slack = 0;  // how much rounding may have done to the value
};

}  // namespace loft::fields
