// SPDX-License-Identifier: MIT
// Solids that move, turn, fold and fork come out of their slices with the components, the genus and
// the volume that they had, in 19 of 20, as long as a slice is moved by no more than 1.5
// thicknesses from the one below; and valid whatever they do.
#include "tests/reconstruct/registration/phantoms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>

#include "mesh/measure.h"
#include "tests/reconstruct/solid.h"

namespace loft {
namespace {

using stacks::Phantom;

struct Count {
  int all = 0;
  int whole = 0;  ///< as many components, and of the genus, as the truth
  int full = 0;   ///< the volume to 5%
};

void look_at(std::uint64_t seed, bool is_smooth, std::map<std::string, Count>& counts) {
  Phantom phantom = stacks::phantom_from_seed(seed);
  phantom.options.smooth = is_smooth;
  const Surface surface = reconstruct(phantom.slices, phantom.options).surface;
  EXPECT_EQ(solids::faults(surface), "") << "seed " << seed;
  if (phantom.shift > 1.5) return;
  const Measures measured = measure(to_mesh(surface));
  const bool is_whole =
      measured.components == phantom.components && measured.genus == phantom.genus;
  const double volume = measured.volume / phantom.volume;
  for (const std::string& group : {std::string("all"), std::string(name(phantom.kind))}) {
    Count& count = counts[group];
    ++count.all;
    count.whole += is_whole ? 1 : 0;
    count.full += std::abs(volume - 1) <= 0.05 ? 1 : 0;
  }
  if (std::getenv("LOFT_SOAK_PHANTOMS") != nullptr && (!is_whole || std::abs(volume - 1) > 0.05))
    std::cout << "seed " << seed << ' ' << name(phantom.kind) << " moves " << phantom.shift << ": "
              << measured.components << " components, genus " << measured.genus << ", volume "
              << volume << '\n';
}

void expect_whole(bool is_smooth) {
  const char* wanted = std::getenv("LOFT_SOAK_PHANTOMS");
  const std::uint64_t seeds =
      wanted == nullptr ? (is_smooth ? 10 : 20) : std::strtoull(wanted, nullptr, 10);
  std::map<std::string, Count> counts;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) look_at(seed, is_smooth, counts);
  for (const auto& [group, count] : counts)
    std::cout << group << ": " << count.all << ", whole " << count.whole << ", full " << count.full
              << '\n';
  const Count& all = counts["all"];
  EXPECT_GE(all.whole, 0.95 * all.all);
  EXPECT_GE(all.full, 0.95 * all.all);
}

TEST(Phantoms, StayWhole) { expect_whole(false); }
TEST(Phantoms, StayWholeWhenSmooth) { expect_whole(true); }

}  // namespace
}  // namespace loft
