// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace loft::io {

/// The first 100 bytes of a session, as SQLite describes them ("The Database Header"). Most of them
/// are the same in every session, so that a damaged one can be told and written anew.
class SessionHeader {
 public:
  /// Reads the head of a file, which may be shorter than that or not be there.
  explicit SessionHeader(const std::filesystem::path& file);

  /// Whether the file's first page is that of a session, whatever its header says.
  [[nodiscard]] bool is_of_session() const { return is_session_; }
  /// Whether something that is the same in every session is not, or pages are left out.
  [[nodiscard]] bool is_damaged() const;
  /// Whether the file was in use, and not closed: a part of it may be in its log.
  [[nodiscard]] bool needs_log() const;
  /// The header as it should be.
  [[nodiscard]] std::string mended() const;

 private:
  [[nodiscard]] std::uint32_t number(std::size_t place) const;

  std::string bytes_;
  std::uint64_t size_ = 0;  // of the file
  bool is_session_ = false;
};

/// A copy of a session and its log, with a header written anew; gone with this.
class MendedCopy {
 public:
  /// Throws FileError.
  MendedCopy(const std::filesystem::path& session, const SessionHeader& header);
  ~MendedCopy();
  MendedCopy(const MendedCopy&) = delete;
  MendedCopy& operator=(const MendedCopy&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path folder_;
  std::filesystem::path file_;
};

}  // namespace loft::io
