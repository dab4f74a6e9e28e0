// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "mesh/check.h"
#include "reconstruct/defect.h"
#include "reconstruct/reconstruct.h"

namespace loft::solids {

/// The names of all faults; empty for a valid solid.
inline std::string faults(const Surface& surface) {
  std::set<std::string> names;
  for (const Finding& finding : check(surface)) names.insert(name(finding.fault));
  std::string all;
  for (const std::string& name : names) all += name + ' ';
  return all;
}

/// Every random stack must make a valid solid: the product's promise.
inline void expect_solid(const std::vector<Slice>& slices, const Options& options = {}) {
  try {
    EXPECT_EQ(faults(reconstruct(slices, options).surface), "");
  } catch (const InputError&) {
    // Fewer than two slices with an area: rare, and right.
  }
}

}  // namespace loft::solids
