// SPDX-License-Identifier: MIT
#include "io/meshes/ply_join.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "io/bytes/checksum.h"
#include "io/meshes.h"
#include "io/meshes/ply_part.h"
#include "io/meshes/ply_pieces.h"
#include "reconstruct/out_of_core.h"
#include "reconstruct/reconstruct.h"
#include "tests/cases.h"
#include "tests/io/shapes.h"
#include "tests/reconstruct/stacks.h"

namespace loft::io {
namespace {

using std::filesystem::path;
using ::testing::AllOf;
using testing::content;
using testing::Folder;
using ::testing::HasSubstr;

SliceSource source_of(const std::vector<Slice>& slices) {
  SliceSource source;
  for (const Slice& slice : slices) source.slices.push_back({slice.z, std::size_t{1} << 15U});
  source.read = [&slices](std::uint32_t i) { return slices[i]; };
  return source;
}

/// A stack, its labels, and what is to be made of it.
struct Job {
  std::vector<Slice> slices;
  Options options;
  std::vector<std::string> labels = {""};

  [[nodiscard]] Options options_for(const std::string& label) const {
    Options one = options;
    if (labels.size() > 1) one.label = label;
    return one;
  }
  [[nodiscard]] std::size_t slab_count() const { return count_slabs(source_of(slices), options); }
};

void make_whole(const Job& job, const path& output) {
  PlyPieces pieces(output, job.labels);
  for (const std::string& label : job.labels)
    (void)reconstruct_out_of_core(source_of(job.slices), job.options_for(label), pieces);
  pieces.commit();
}

void make_part(const Job& job, SlabRange range, const path& output, unsigned threads = 1) {
  PlyPieces pieces(output, job.labels);
  PlyPartNote note{range, job.slab_count(), {{"stack", "0"}}, {}};
  std::vector<std::uint32_t> places;
  for (const std::string& label : job.labels) {
    Options options = job.options_for(label);
    options.threads = threads;
    const SlabsReport made = reconstruct_slabs(source_of(job.slices), options, range, {}, pieces);
    note.surfaces.push_back(made.sizes);
    std::ranges::copy(made.lower_places, std::back_inserter(places));
    std::ranges::copy(made.upper_places, std::back_inserter(places));
  }
  pieces.commit(note, places);
}

/// Cuts between slabs, each with that probability.
std::vector<SlabRange> random_ranges(std::size_t slabs, std::mt19937_64& random, double often) {
  std::vector<SlabRange> ranges{{0, 0}};
  for (std::size_t slab = 1; slab <= slabs; ++slab) {
    ranges.back().bound = slab;
    if (slab < slabs && std::bernoulli_distribution(often)(random)) ranges.push_back({slab, slab});
  }
  return ranges;
}

void expect_joined_as_whole(const Job& job, std::mt19937_64& random, double often) {
  const Folder folder;
  make_whole(job, folder / "whole.ply");
  auto ranges = random_ranges(job.slab_count(), random, often);
  std::ranges::shuffle(ranges, random);
  std::vector<path> parts;
  for (const SlabRange& range : ranges) {
    parts.push_back(folder / ("part" + std::to_string(range.first) + ".ply"));
    make_part(job, range, parts.back(), 1 + static_cast<unsigned>(parts.size() % 2));
  }
  std::ranges::shuffle(parts, random);
  (void)join_ply_parts(parts, folder / "joined.ply");
  EXPECT_TRUE(content(folder / "joined.ply") == content(folder / "whole.ply"));
}

const std::vector<Options>& all_options() {
  static const std::vector<Options> all{
      {},
      {.cap = Cap::dome},
      {.cap = Cap::open},
      {.cap = Cap::extend},
      {.smooth = true},
      {.cap = Cap::dome, .smooth = true},
      {.smooth = true, .smooth_tolerance = 0.05},
      {.fair = 0.2},
      {.fair = 0.2, .cap = Cap::extend, .smooth = true},
      {.target_edge = 0.7},
      {.max_edge = 0.9},
      {.cap = Cap::dome, .link = LinkRule::none},
      {.link = LinkRule::overlap},
      {.max_shift = 3},
  };
  return all;
}

/// Parts made of any ranges of masks: there parts touch in edges and corners all over.
TEST(JoinPly, PartsOfMasksAreTheWhole) {
  for (std::uint64_t seed = 0; seed < cases(45); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    Job job{{}, all_options()[seed % all_options().size()]};
    const int count = std::uniform_int_distribution(2, 14)(random);
    const double density = std::uniform_real_distribution(0.3, 0.7)(random);
    for (int i = 0; i < count; ++i)
      job.slices.push_back(stacks::random_mask(i, random, 7, density));
    std::ranges::shuffle(job.slices, random);
    expect_joined_as_whole(job, random, seed % 3 == 0 ? 1 : 0.4);
  }
}

TEST(JoinPly, PartsOfAnyContoursAreTheWhole) {
  for (std::uint64_t seed = 0; seed < cases(30); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    Job job{{}, all_options()[seed % all_options().size()]};
    const int count = std::uniform_int_distribution(2, 12)(random);
    for (int i = 0; i < count; ++i)
      job.slices.push_back(std::bernoulli_distribution(0.15)(random)
                               ? Slice{static_cast<double>(i), {}}
                               : stacks::random_slice(i, random, seed % 2 == 0));
    job.slices.push_back(stacks::random_slice(1, random, true));  // the same height twice
    job.slices.push_back({2, {{{{0, 0}}, ""}, {{{1, 1}, {2, 2}}, ""}}});
    expect_joined_as_whole(job, random, 0.5);
  }
}

/// Labels that begin and end anywhere, in one slice only, in points, or with gaps.
TEST(JoinPly, PartsOfLabelsAreTheWhole) {
  for (std::uint64_t seed = 0; seed < cases(30); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    Job job{{}, all_options()[seed % all_options().size()], {"a", "b", "c", "d"}};
    job.options.gap = 0.5;
    constexpr int count = 11;
    for (int i = 0; i < count; ++i) job.slices.push_back({static_cast<double>(i), {}});
    for (const std::string& label : job.labels) {
      const int first = std::uniform_int_distribution(0, count - 1)(random);
      const int last = std::uniform_int_distribution(first, count - 1)(random);
      for (int i = first; i <= last; ++i) {
        if (i != first && i != last && std::bernoulli_distribution(0.2)(random)) continue;
        Contour ring = stacks::circle(7, 2 + 0.1 * i, {0.9 * i, 0}, i);
        ring.label = label;
        job.slices[static_cast<std::size_t>(i)].contours.push_back(std::move(ring));
      }
      if (last + 1 < count && seed % 2 == 0)
        job.slices[static_cast<std::size_t>(last) + 1].contours.push_back(
            {{{0.9 * last, 0}}, label});
    }
    expect_joined_as_whole(job, random, 0.5);
  }
}

TEST(JoinPly, PartsOfShapesAreTheWhole) {
  std::mt19937_64 random(5);
  for (const Options& options : all_options()) {
    expect_joined_as_whole({stacks::Torus::slices(25, 20), options}, random, 0.3);
    expect_joined_as_whole({stacks::y_branch(9, 30), options}, random, 1);
  }
}

/// Reading what it says it reads and nothing else.
TEST(JoinPly, APartLooksAtSoManySlicesBeside) {
  const auto slices = stacks::Torus::slices(60, 12);
  std::vector<bool> is_read(slices.size());
  SliceSource source = source_of(slices);
  source.read = [&](std::uint32_t i) {
    is_read[i] = true;
    return slices[i];
  };
  const Folder folder;
  PlyPieces pieces(folder / "part.ply", {""});
  (void)reconstruct_slabs(source, {.smooth = true, .threads = 1}, {20, 30}, {}, pieces);
  std::vector<std::size_t> read;
  for (std::size_t i = 3; i + 3 < slices.size(); ++i)  // the ends are looked for
    if (is_read[i]) read.push_back(i);
  EXPECT_EQ(read.front(), 20 - slices_beside_range);
  EXPECT_EQ(read.back(), 30 + slices_beside_range);
}

TEST(JoinPly, APartIsAMeshOfItsOwn) {
  const Folder folder;
  make_part({stacks::Torus::slices(25, 20), {}}, {5, 9}, folder / "part.ply");
  const auto meshes = read_meshes(folder / "part.ply");
  ASSERT_EQ(meshes.size(), 1U);
  EXPECT_GT(meshes[0].mesh.faces.size(), 100U);
  EXPECT_EQ(read_ply_part_header(folder / "part.ply").note.range, (SlabRange{5, 9}));
}

/// Three parts of a stack.
class Parts : public ::testing::Test {
 protected:
  Parts() {
    for (int i = 0; i < 9; ++i) job_.slices.push_back(stacks::random_mask(i, random_, 7, 0.5));
    const std::vector<SlabRange> ranges{{0, 2}, {2, 5}, {5, 8}};
    for (const SlabRange& range : ranges) {
      parts_.push_back(folder_ / ("p" + std::to_string(parts_.size()) + ".ply"));
      make_part(job_, range, parts_.back());
    }
  }

  /// What joining says; there is no output.
  std::string refusal(const std::vector<path>& parts) {
    try {
      (void)join_ply_parts(parts, folder_ / "out.ply");
    } catch (const InputError& error) {
      EXPECT_FALSE(std::filesystem::exists(folder_ / "out.ply"));
      return error.what();
    }
    return "joined";
  }

  std::mt19937_64 random_{3};
  Job job_;
  Folder folder_;
  std::vector<path> parts_;
};

TEST_F(Parts, ThatAreMissingOrTwiceThereAreNamed) {
  EXPECT_EQ(refusal({parts_[2], parts_[1], parts_[0]}), "joined");
  std::filesystem::remove(folder_ / "out.ply");
  EXPECT_THAT(refusal({parts_[1]}), AllOf(HasSubstr("no part has the slabs 0..2"),
                                          HasSubstr("no part has the slabs 5..8")));
  EXPECT_THAT(refusal({parts_[0], parts_[2]}), HasSubstr("no part has the slabs 2..5"));
  make_part(job_, {1, 6}, folder_ / "wide.ply");
  const std::string text = refusal({parts_[0], folder_ / "wide.ply", parts_[2]});
  EXPECT_THAT(text, AllOf(HasSubstr("p0.ply and "), HasSubstr("wide.ply both have the slabs 1..2"),
                          HasSubstr("p2.ply both have the slabs 5..6")));
}

TEST_F(Parts, OfOtherStacksAreRefused) {
  PlyPartHeader header = read_ply_part_header(parts_[1]);
  const std::string text = header.text();
  const std::string rest = content(parts_[1]).substr(text.size());
  const auto rewrite = [&](const PlyPartHeader& changed, const std::string& name) {
    std::string bytes = changed.text() + rest.substr(0, rest.size() - ply_checksum_size);
    std::uint64_t sum = checksum(bytes);
    for (std::size_t i = 0; i < 8; ++i, sum >>= 8U) bytes += static_cast<char>(sum & 0xffU);
    return folder_.write(name, bytes);
  };
  header.note.origin["stack"] = "1";
  EXPECT_THAT(refusal({parts_[0], rewrite(header, "other.ply"), parts_[2]}),
              HasSubstr("other.ply is of another stack than"));
  header.note.origin = {{"stack", "0"}, {"smooth", "yes"}};
  EXPECT_THAT(refusal({parts_[0], rewrite(header, "bent.ply"), parts_[2]}),
              HasSubstr("bent.ply was made with other options than"));
}

TEST_F(Parts, OfSlicesThatDoNotMeetAreRefused) {
  Job other = job_;
  other.slices[2] = stacks::random_mask(2, random_, 7, 0.5);
  make_part(other, {2, 5}, folder_ / "other.ply");
  EXPECT_THAT(refusal({parts_[0], folder_ / "other.ply", parts_[2]}),
              HasSubstr("do not fit where they meet"));
}

TEST_F(Parts, ThatAreNoneAreAllNamed) {
  const path text = folder_.write("text.ply", "hello\n");
  const path mesh = folder_.write("mesh.ply", "ply\nformat ascii 1.0\nend_header\n");
  EXPECT_THAT(refusal({text, parts_[0], mesh, folder_ / "none.ply"}),
              AllOf(HasSubstr("text.ply: is no part"), HasSubstr("mesh.ply: is no part"),
                    HasSubstr("none.ply")));
}

/// Whatever is done to the bytes of a part, it is found out.
TEST_F(Parts, ThatAreDamagedAreRefused) {
  const std::string sound = content(parts_[1]);
  std::mt19937_64 random(9);
  for (std::uint64_t i = 0; i < cases(300); ++i) {
    SCOPED_TRACE(i);
    std::string bytes = sound;
    const auto at =
        std::uniform_int_distribution<std::size_t>(0, i % 2 == 0 ? 700 : bytes.size() - 1)(random);
    if (i % 5 == 0) {
      bytes.resize(at);
    } else {
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << (i % 7)));
    }
    EXPECT_NE(refusal({parts_[0], folder_.write("bad.ply", bytes), parts_[2]}), "joined");
  }
}

TEST_F(Parts, StopWhenAskedTo) {
  EXPECT_THROW(
      (void)join_ply_parts(parts_, folder_ / "out.ply", [](double share) { return share < 0.7; }),
      Cancelled);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out.ply"));
}

}  // namespace
}  // namespace loft::io
