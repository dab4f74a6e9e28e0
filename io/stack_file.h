// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "io/stack.h"
#include "io/stacks/slice_lines.h"
#include "reconstruct/out_of_core.h"
#include "reconstruct/slice.h"

namespace loft::io {

/// A stack that stays in its files: it knows where each slice is, and reads it when it is asked
/// for. Of other formats than NDJSON the outlines are kept in memory; the pixels of volumes are
/// not.
class StackFile {
 public:
  /// Gets to see each slice once, in order, and the share of the input that has been read.
  using Visit = std::function<void(const Slice& slice, double share)>;

  /// Reads the files through, slice by slice, to know where each is and that all can be read.
  /// Throws what read_stack() does, with all bad lines; and FileError for standard input, which
  /// cannot be read a second time.
  StackFile(std::span<const std::filesystem::path> paths, const ReadOptions& options,
            const Visit& visit);

  /// What the files say of the stack; of its slices only where their points are in the world.
  [[nodiscard]] const Stack& about() const { return about_; }
  /// For reconstruct_out_of_core(). Refers to this.
  [[nodiscard]] SliceSource source() const;
  /// Slice i, in the order of the files. By several threads at once if need be.
  /// Throws FileError where the file is no longer what it was.
  [[nodiscard]] Slice read(std::uint32_t i) const;

 private:
  void read_lines(unsigned threads, const Visit& visit);
  void keep_in_memory(const Visit& visit);

  struct Entry {
    std::size_t file;
    LinePlace place;
    double z;
    std::size_t points;
  };

  std::vector<std::filesystem::path> paths_;
  std::vector<std::string> labels_;  // of each file
  std::vector<Entry> entries_;
  Stack about_;                   // without slices, but for places
  std::vector<Slice> in_memory_;  // of formats that cannot be read slice by slice
};

}  // namespace loft::io
