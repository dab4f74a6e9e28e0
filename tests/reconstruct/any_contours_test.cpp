// SPDX-License-Identifier: MIT
// Whatever the contours of two slices, what is made of them is a valid solid, and contours that
// need no repair are in it exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>

#include "reconstruct/clean/normal_form.h"
#include "reconstruct/reconstruct.h"
#include "tests/cases.h"
#include "tests/reconstruct/random_pairs.h"
#include "tests/reconstruct/shrink.h"
#include "tests/reconstruct/solid.h"

namespace loft {
namespace {

using stacks::Pair;

/// The edges of a mesh, by the places of their ends.
class PlacesOfEdges {
 public:
  explicit PlacesOfEdges(const Mesh& mesh) {
    for (const auto& face : mesh.faces)
      for (std::size_t i = 0; i < 3; ++i)
        edges_.insert(std::minmax(mesh.points[face[i]], mesh.points[face[(i + 1) % 3]]));
  }

  /// Whether there is an edge between two points of a slice, or two halves of one.
  [[nodiscard]] bool has(cdt::Point a, cdt::Point b, double z) const {
    const cdt::Point middle{a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2};
    return has_whole(a, b, z) || (has_whole(a, middle, z) && has_whole(middle, b, z)) ||
           has_whole(b, {b.x + (a.x - b.x) / 2, b.y + (a.y - b.y) / 2}, z);
  }

 private:
  [[nodiscard]] bool has_whole(cdt::Point a, cdt::Point b, double z) const {
    return edges_.contains(std::minmax(Vec3{a.x, a.y, z}, Vec3{b.x, b.y, z}));
  }

  std::set<std::pair<Vec3, Vec3>> edges_;
};

/// The first contour edge, of a slice that needed no repair, that is not in the surface. Contours
/// without an area are none: the part that ends in one has a ridge there, as far as it covers it.
std::string missing_edge(const std::vector<Slice>& slices, const Reconstructed& made) {
  const PlacesOfEdges edges(to_mesh(made.surface));
  for (std::uint32_t s = 0; s < slices.size(); ++s) {
    const auto is_here = [s](const Defect& defect) { return defect.slice == s; };
    if (std::ranges::any_of(made.repairs, is_here)) continue;
    for (std::uint32_t c = 0; c < slices[s].contours.size(); ++c) {
      const auto& points = slices[s].contours[c].points;
      if (are_in_line(points)) continue;
      for (std::uint32_t p = 0; p < points.size(); ++p)
        if (points[p] != points[(p + 1) % points.size()] &&
            !edges.has(points[p], points[(p + 1) % points.size()], slices[s].z))
          return "slice " + std::to_string(s) + " contour " + std::to_string(c) + " point " +
                 std::to_string(p) + " has lost its edge ";
    }
  }
  return {};
}

/// What is wrong with the surface between two slices; empty if nothing is.
std::string complaint(const Pair& pair, bool is_smooth) {
  try {
    const Reconstructed made = reconstruct(pair.slices, {.fill = pair.fill, .smooth = is_smooth});
    return missing_edge(pair.slices, made) + solids::faults(made.surface);
  } catch (const InputError& error) {
    // Fewer than two slices with an area: nothing to make a solid of.
    const auto& defects = error.defects();
    return defects.size() == 1 && defects[0].kind == DefectKind::too_few_slices ? "" : error.what();
  }
}

/// Whether the slices were left apart because no valid surface was found between them.
bool is_left_apart(const Pair& pair) {
  try {
    const auto repairs = reconstruct(pair.slices, {.fill = pair.fill}).repairs;
    return std::ranges::count(repairs, DefectKind::unlinked_slices, &Defect::kind) > 0;
  } catch (const InputError&) {
    return false;
  }
}

/// How many pairs: a few seconds' worth, or what the long run asks for.
std::uint64_t pairs_wanted() {
  const char* wanted = std::getenv("LOFT_SOAK_PAIRS");
  return wanted == nullptr ? cases(480) : std::strtoull(wanted, nullptr, 10);
}

std::uint64_t first_pair() {
  const char* first = std::getenv("LOFT_SOAK_FIRST");
  return first == nullptr ? 0 : std::strtoull(first, nullptr, 10);
}

void expect_solids(bool is_smooth, std::uint64_t wanted) {
  const std::uint64_t first = first_pair();
  int failures = 0;
  for (std::uint64_t seed = first; seed < first + wanted && failures < 8; ++seed) {
    const Pair pair = stacks::random_pair(seed);
    const std::string wrong = complaint(pair, is_smooth);
    if (wrong.empty()) continue;
    ++failures;
    const std::string kind = wrong.substr(0, wrong.find(' '));
    const auto small = stacks::shrink(pair.slices, [&](const std::vector<Slice>& slices) {
      return complaint({slices, pair.fill}, is_smooth).starts_with(kind);
    });
    ADD_FAILURE() << "seed " << seed << " (" << stacks::kind_of_pair(seed) << "): " << wrong
                  << "\nfill " << static_cast<int>(pair.fill) << "\n"
                  << stacks::as_code(small);
  }
}

TEST(AnyContours, MakeASolid) { expect_solids(false, pairs_wanted()); }

TEST(AnyContours, MakeASmoothSolid) { expect_solids(true, pairs_wanted() / 4); }

TEST(AnyContours, MidpointsOfEdgesAtOnePlaceAreTheSame) {
  const std::vector<Slice> slices{
      {-20.999863, {{{{28, 16}, {-14, 16}, {6, -1}}, ""}}},
      {-19,
       {{{{26, 15}, {-1.8, 15.4}, {-2, 12}}, ""}, {{{14.9, 15.3}, {-12.4, 15.3}, {8, 2}}, ""}}},
      {-17, {{{{27.6, 15.3}, {-1.9, 15.3}, {-2, 8}}, ""}}}};
  EXPECT_EQ(solids::faults(reconstruct(slices).surface), "");
}

// The chord across the mouth of a needle had triangles on both sides that are a last place high.
TEST(AnyContours, AChordBetweenSliversIsFlippedAway) {
  const std::vector<Slice> slices{{0,
                                   {{{{0, 2},
                                      {3, 3},
                                      {0, 1},
                                      {2, 3},
                                      {3, 3},
                                      {-3.9168562526984598e-10, 2.0000000000784821},
                                      {-2.3657663139486966e-10, 2.0000000000031504},
                                      {2.9999999995955093, 3.0000000002942264},
                                      {3.0000000004773666, 2.9999999997910973}},
                                     ""}}},
                                  {1, {}}};
  EXPECT_EQ(complaint({slices, Fill::nonzero}, false), "");
  EXPECT_EQ(complaint({slices, Fill::nonzero}, true), "");
}

TEST(AnyContours, ALineThatAPartEndsInNeedsNoEdgesOfItsOwn) {
  const std::vector<Slice> slices{{0, {{{{1, 2}, {1, 4}, {6, 6}}, ""}}},
                                  {1, {{{{1, 4}, {3.5, 4}, {2, 4}}, ""}}}};
  EXPECT_EQ(complaint({slices, Fill::keyhole_aware}, false), "");
}

TEST(AnyContours, AreLinkedButForOneInAThousand) {
  const std::uint64_t first = first_pair();
  const std::uint64_t wanted = pairs_wanted();
  std::uint64_t apart = 0;
  for (std::uint64_t seed = first; seed < first + wanted; ++seed)
    apart += is_left_apart(stacks::random_pair(seed)) ? 1U : 0U;
  EXPECT_LE(apart, wanted / 1000);
}

}  // namespace
}  // namespace loft
