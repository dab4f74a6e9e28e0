// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/bytes/file.h"
#include "io/session/session_header.h"

struct sqlite3;
struct sqlite3_stmt;

namespace loft::io {

/// The SQLite file of a session: opened, locked by who writes, and what goes wrong with it in
/// words. Every function may throw FileError, and DamagedSession (session.h).
class SessionDatabase {
 public:
  struct Finalizer {
    void operator()(sqlite3_stmt* statement) const;
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Finalizer>;

  SessionDatabase(std::filesystem::path path, Access access);

  void execute(const char* words) const;
  /// All or nothing.
  template <class Action>
  void in_one_transaction(Action action) const {
    execute("begin immediate");
    try {
      action();
      execute("commit");
    } catch (...) {
      roll_back();
      throw;
    }
  }
  [[nodiscard]] Statement prepare(const char* words) const;
  void bind(const Statement& statement, int place, std::string_view words) const;
  /// Whether there is a row.
  bool step(const Statement& statement) const;
  /// As step(); nothing where the row's place in the file is damaged.
  [[nodiscard]] std::optional<bool> try_step(const Statement& statement) const;
  [[nodiscard]] static std::string_view text(const Statement& row, int column);
  /// The first number that a query gives.
  [[nodiscard]] int number(const char* words) const;

  /// Throws where the name no longer means the file that is open: what is written there is lost.
  void check_in_place() const;
  /// Makes an empty log, if there is none, before the database is told to use one.
  void make_log() const;
  /// From now on check_in_place() looks for SQLite's log, too.
  void remember_log();

  /// What is wrong with the file as a whole though it could be opened, a line each: a header that
  /// was written anew in a copy, a log that is missing.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  /// Puts everything into the one file, for who wrote and has ended well.
  void close_to_one_file() noexcept;

  [[noreturn]] void fail(int code, const std::string& words) const;
  [[noreturn]] void fail_damaged(const std::string& words) const;

 private:
  /// A file that this process has locked.
  struct Lock {
    Lock() = default;
    ~Lock();
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

    int file = -1;
  };
  struct Closer {
    void operator()(sqlite3* database) const;
  };
  using FileId = std::pair<std::uintmax_t, std::uintmax_t>;  // device, number in it

  [[noreturn]] void fail(int code) const;
  [[nodiscard]] std::string cause(int code, const std::string& words) const;
  [[nodiscard]] bool bears_our_mark() const;
  [[nodiscard]] const char* log() const;
  [[nodiscard]] bool has_log() const;
  [[nodiscard]] std::string missing_log() const;
  void look_at_header();
  void lock();
  void open(const std::string& name, int flags);
  void open_to_read();
  void roll_back() const;

  std::filesystem::path path_;
  std::filesystem::path file_;  // from the root, whatever path_ is
  Access access_;
  Lock lock_;  // let go last: closing a file lets go of SQLite's locks on it
  std::unique_ptr<MendedCopy> copy_;
  std::unique_ptr<sqlite3, Closer> database_;
  std::vector<std::string> notes_;
  std::optional<FileId> log_id_;
};

}  // namespace loft::io
