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
#include <vector>

#include "io/bytes/file.h"
#include "io/stacks/edit.h"

namespace loft::io {

/// How far the edits of a file have been taken in.
struct InputPosition {
  std::string path;
  std::uint64_t offset = 0;    ///< in bytes
  std::uint64_t checksum = 0;  ///< of all bytes before it (checksum.h)

  friend bool operator==(const InputPosition&, const InputPosition&) = default;
};

/// What an edit is that undid another one, or did it again.
struct Undo {
  std::uint64_t of = 0;  ///< the number of that one
  bool is_redo = false;

  friend bool operator==(const Undo&, const Undo&) = default;
};

/// A session does not hold what was written into it.
class DamagedSession : public FileError {
 public:
  using FileError::FileError;
};

/// The journal of a capture: every edit that was acknowledged, in order, in an SQLite file
/// (write-ahead log, synchronous full; one file once it is closed). What append() has returned for
/// survives the end of the process and the loss of power. One process at a time may write; any
/// number may read, also where they may not write.
class Session {
 public:
  enum class Access { read, write };
  using Take = std::function<void(std::uint64_t number, Edit&& edit)>;

  /// Opens the journal; with Access::write makes it where there is none. Throws FileError that says
  /// what is wrong and the way out: not writable, in use by another process, not a session file,
  /// made by a newer loft; DamagedSession.
  Session(const std::filesystem::path& path, Access access);
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  /// Adds edits, all or none; on return they are durable. Throws FileError (disk full, device
  /// error, the file was deleted or replaced meanwhile); then none of them is kept.
  /// `input`, where they came from, is kept with them, instead of what was kept for that file.
  void append(std::span<const Edit> edits, const std::optional<InputPosition>& input = {});
  /// Adds an edit that undoes another one, or does it again; in the same way.
  void append(const Edit& edit, const Undo& undo);
  /// Calls take() for each edit, in order; with little in memory. Throws DamagedSession where the
  /// journal is damaged, naming the edit: each one has a checksum.
  void for_each(const Take& take) const;
  /// As for_each(), but leaves out what is damaged. Returns that, a line each; none if all is well.
  /// Where the header is damaged, a copy is read that has another; a log that is missing is named.
  [[nodiscard]] std::vector<std::string> salvage(const Take& take) const;
  [[nodiscard]] std::uint64_t edit_count() const;
  /// One edit by its number. Throws DamagedSession where it is damaged or missing; whether those
  /// before it are sound is not looked at.
  [[nodiscard]] Edit edit(std::uint64_t number) const;
  /// The edits that undid others, by their numbers. Not checked: the edits alone say what there is.
  [[nodiscard]] std::map<std::uint64_t, Undo> undos() const;
  /// How far a file has been taken in; none if nothing came from it. Needs Access::write.
  [[nodiscard]] std::optional<InputPosition> input_position(const std::string& path) const;

  /// Settings of the capture that resuming it needs (fill rule, unit, ...), as text; kept in the
  /// journal.
  [[nodiscard]] std::map<std::string, std::string> settings() const;
  void set_settings(const std::map<std::string, std::string>& settings);

  /// What is wrong with the file itself, a line each; salvage() tells what is with the edits.
  [[nodiscard]] std::vector<std::string> check() const;

 private:
  class Journal;
  std::unique_ptr<Journal> journal_;
};

/// Whether a file begins as those of sessions do, whatever it is called.
[[nodiscard]] bool is_session_file(const std::filesystem::path& path);

}  // namespace loft::io
