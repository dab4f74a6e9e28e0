// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <ostream>

namespace loft::io {

/// A file that appears whole or not at all: written under another name in the same folder,
/// renamed by commit(). Without commit() nothing is left behind. A link stays, what it leads to is
/// replaced. What is there and is no regular file (a pipe, a device, /dev/stdout) is written to as
/// it is, and nothing is taken back. What is replaced hands on its permissions; what is read-only
/// is refused. On return from commit() the file and its name are durable.
class AtomicFile {
 public:
  /// Creates the temporary file `.NAME.N.part`, N the first number that no process uses; one that
  /// a killed process has left is taken over.
  /// Throws FileError where the folder is missing or not writable, or `path` is a folder or
  /// read-only.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// A pipe is opened by the first call, which waits for its reader. Throws FileError.
  [[nodiscard]] std::ostream& stream();
  /// What it is called until it is committed.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

  /// Puts the file in its place, over what was there. Throws FileError if a write had failed.
  void commit();

 private:
  void forbid_replacing_protected();
  void create_temporary();
  void put_in_place();

  std::filesystem::path path_;
  std::filesystem::path target_;  // where links lead
  std::filesystem::path temporary_;
  int lock_ = -1;  // on the temporary file, as long as it has that name; -1: there is none
  std::optional<unsigned> mode_;  // of what is replaced
  std::ofstream stream_;
  bool committed_ = false;
};

/// Removes the temporary files of all AtomicFiles; none can be made or committed any more. For who
/// is about to end the process.
void abandon_atomic_files();

}  // namespace loft::io
