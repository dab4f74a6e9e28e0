// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

namespace loft::io {

/// What was joined.
struct JoinedPly {
  std::size_t labels = 0;
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
};

/// Joins the parts of a surface that `loft reconstruct --slabs` made, all of one stack, given in
/// any order, to the file that the whole stack would have made: the same bytes.
///
/// All parts are read through before anything is written. Throws InputError with all that is wrong,
/// each with its files: what is no part, or damaged; parts of different stacks or options; ranges
/// that overlap or are missing; parts that do not fit each other. Throws FileError as reading and
/// writing do; the output is whole or not there. `follow` gets the share that is done; Cancelled
/// where it returns false. Cost: three passes over the parts, and memory for their headers.
JoinedPly join_ply_parts(std::span<const std::filesystem::path> parts,
                         const std::filesystem::path& output,
                         const std::function<bool(double share)>& follow = {});

}  // namespace loft::io
