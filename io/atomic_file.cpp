// SPDX-License-Identifier: MIT
#include "io/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "io/file.h"

namespace loft::io {

namespace {

std::filesystem::path folder_of(const std::filesystem::path& path) {
  const std::filesystem::path parent = path.parent_path();
  return parent.empty() ? std::filesystem::path(".") : parent;
}

/// Creates an empty file that did not exist before, so that two writers never share one.
bool create_new(const std::filesystem::path& path) {
  std::FILE* const file = std::fopen(path.string().c_str(), "wbx");
  if (file == nullptr) return false;
  std::fclose(file);
  return true;
}

std::filesystem::path create_temporary(const std::filesystem::path& path) {
  constexpr int attempts = 1000;
  for (int number = 0; number < attempts; ++number) {
    std::string name(1, '.');
    name += path.filename().string() + '.' + std::to_string(number) + ".part";
    const std::filesystem::path candidate = folder_of(path) / name;
    if (create_new(candidate)) return candidate;
    if (errno != EEXIST) break;
  }
  throw FileError(Access::write, path, last_cause());
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder_of(path_), ignored)) {
    throw FileError(Access::write, path_,
                    "folder " + folder_of(path_).string() + " does not exist; create it first");
  }
  if (std::filesystem::is_directory(path_, ignored)) {
    throw FileError(Access::write, path_, "it is a folder");
  }
  temporary_ = create_temporary(path_);
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  errno = 0;
  stream_.close();
  if (!stream_) throw FileError(Access::write, path_, errno != 0 ? last_cause() : "write failed");
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) throw FileError(Access::write, path_, error.message());
  committed_ = true;
}

}  // namespace loft::io
