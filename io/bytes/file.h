// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "reconstruct/defect.h"

namespace loft::io {

enum class Access { read, write };

/// A file or folder cannot be read or written; `what()` is `cannot read PATH: CAUSE`.
class FileError : public Error {
 public:
  FileError(Access access, std::filesystem::path path, const std::string& cause);

  [[nodiscard]] Access access() const { return access_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  Access access_;
  std::filesystem::path path_;
};

/// No reader or writer goes by the extension of a file.
class UnknownFormat : public Error {
 public:
  /// `known` lists the extensions that would do: `.ply .obj`.
  UnknownFormat(const std::filesystem::path& path, std::string_view known);
};

/// The whole content of a file, which is read, or, where it is large, mapped: its bytes then take
/// no memory that others cannot have. A file must not get shorter meanwhile.
class FileBytes {
 public:
  /// Throws FileError.
  explicit FileBytes(const std::filesystem::path& path);
  ~FileBytes();
  FileBytes(FileBytes&& other) noexcept;
  FileBytes& operator=(FileBytes&& other) = delete;

  [[nodiscard]] std::string_view view() const;

 private:
  std::string content_;
  void* mapping_ = nullptr;
  std::size_t size_ = 0;  // of the mapping
};

/// The whole content of a file. Throws FileError.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// What messages call standard input.
inline constexpr std::string_view standard_input = "standard input";
/// All that comes from it. Throws FileError.
[[nodiscard]] std::string read_standard_input();

/// What the system said about the last call that failed (`errno`).
[[nodiscard]] std::string last_cause();

/// The extension in lower case, with its dot: `.ply` for `OUT.PLY`.
[[nodiscard]] std::string extension(const std::filesystem::path& path);

}  // namespace loft::io
