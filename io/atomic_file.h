// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>

namespace loft::io {

/// A file that appears whole or not at all: written under another name in the same folder,
/// renamed by commit(). Without commit() nothing is left behind.
class AtomicFile {
 public:
  /// Creates the temporary file `.NAME.N.part`, N the first number that is free.
  /// Throws FileError where the folder is missing or not writable, or `path` is a folder.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// What it is called until it is committed.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

  /// Puts the file in its place, over what was there. Throws FileError if a write had failed.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
  bool committed_ = false;
};

}  // namespace loft::io
