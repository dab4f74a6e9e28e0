// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "io/edit.h"

namespace loft::io {

/// How far the edits of a file have been taken in.
struct InputPosition {
  std::string path;
  std::uint64_t offset = 0;    ///< in bytes
  std::uint64_t checksum = 0;  ///< of all bytes before it (checksum.h)

  friend bool operator==(const InputPosition&, const InputPosition&) = default;
};

/// The journal of a capture: every edit that was acknowledged, in order, in an SQLite file
/// (write-ahead log, synchronous full). What append() has returned for survives the end of the
/// process and the loss of power. One process at a time may write; any number may read.
class Session {
 public:
  enum class Access { read, write };

  /// Opens the journal; with Access::write makes it where there is none. Throws FileError that says
  /// what is wrong and the way out: not writable, in use by another process, not a session file,
  /// made by a newer loft, damaged.
  Session(const std::filesystem::path& path, Access access);
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  /// Adds edits, all or none; on return they are durable. Throws FileError (disk full, device
  /// error); then none of them is kept.
  /// `input`, where they came from, is kept with them, instead of what was kept for that file.
  void append(std::span<const Edit> edits, const std::optional<InputPosition>& input = {});
  /// Calls take() for each edit, in order; with little in memory. Throws FileError where the
  /// journal is damaged, naming the edit: each one has a checksum.
  void for_each(const std::function<void(std::uint64_t number, Edit&& edit)>& take) const;
  [[nodiscard]] std::uint64_t edit_count() const;
  /// How far a file has been taken in; none if nothing came from it. Needs Access::write.
  [[nodiscard]] std::optional<InputPosition> input_position(const std::string& path) const;

  /// Settings of the capture that resuming it needs (fill rule, unit, ...), as text; kept in the
  /// journal.
  [[nodiscard]] std::map<std::string, std::string> settings() const;
  void set_settings(const std::map<std::string, std::string>& settings);

  /// Checks the file itself, all of it; the edits are checked by for_each(). Throws FileError.
  void check() const;

 private:
  class Journal;
  std::unique_ptr<Journal> journal_;
};

}  // namespace loft::io
