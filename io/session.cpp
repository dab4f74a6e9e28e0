// SPDX-License-Identifier: MIT
#include "io/session.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <string_view>
#include <utility>

#include "io/checksum.h"
#include "io/file.h"

namespace loft::io {

namespace {

// "loft" in ASCII; what file(1) and SQLite itself look at.
constexpr int application_id = 0x6c6f6674;
constexpr int schema_version = 1;

/// Chained from row to row, so that it tells lost and swapped rows from the right ones, too.
std::uint64_t chained(std::uint64_t before, std::string_view line) {
  return checksum(line, no_checksum ^ before);
}

/// What SQLite says, and the way out.
std::string cause(int code, const std::string& words) {
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another process is writing to this session; end it first, or use another file";
    case SQLITE_FULL:
      return "the disk is full; make room, then send the slices again that were not acknowledged";
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return "it may not be written to; change its permissions, or use another file";
    case SQLITE_CANTOPEN:
      return "it cannot be opened: " + words;
    case SQLITE_NOTADB:
      return "it is no session file";
    case SQLITE_CORRUPT:
      return "it is damaged (" + words +
             "); 'loft session verify' says where, 'loft session "
             "export' saves what can be read";
    default:
      return words;
  }
}

struct Finalizer {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
/// A file that this process has locked.
struct Lock {
  Lock() = default;
  ~Lock() {
    if (file >= 0) ::close(file);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  int file = -1;
};
struct Closer {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};

}  // namespace

class Session::Journal {
 public:
  Journal(std::filesystem::path path, Access access) : path_(std::move(path)), access_(access) {
    if (access == Access::write) lock();
    const int flags =
        access == Access::write ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY;
    sqlite3* database = nullptr;
    const int code = sqlite3_open_v2(path_.c_str(), &database, flags, nullptr);
    database_.reset(database);
    if (access == Access::read && !std::filesystem::exists(path_))
      fail(SQLITE_ERROR, "No such file or directory");
    if (code != SQLITE_OK) fail(code);
    sqlite3_busy_timeout(database, 2000);
    identify();
    if (access == Access::write) prepare_to_write();
  }

  void append(std::span<const Edit> edits, const std::optional<InputPosition>& input) {
    if (edits.empty() && !input) return;
    execute("begin immediate");
    const std::uint64_t count = count_;
    const std::uint64_t sum = sum_;
    try {
      for (const Edit& edit : edits) insert(to_line(edit));
      if (input) keep(*input);
      execute("commit");
    } catch (...) {
      // Some errors have rolled back already: then this one does nothing.
      sqlite3_exec(database_.get(), "rollback", nullptr, nullptr, nullptr);
      count_ = count;
      sum_ = sum;
      throw;
    }
  }

  void for_each(const std::function<void(std::uint64_t, Edit&&)>& take) const {
    const Statement rows = prepare("select number, line, checksum from edits order by number");
    std::uint64_t expected = 0;
    std::uint64_t sum = 0;
    while (step(rows)) {
      const auto number = static_cast<std::uint64_t>(sqlite3_column_int64(rows.get(), 0));
      const std::string_view line = text(rows, 1);
      sum = chained(sum, line);
      if (number != expected ||
          sum != static_cast<std::uint64_t>(sqlite3_column_int64(rows.get(), 2)))
        damaged(expected);
      EditLine read = parse_edit_line(line);
      if (!read.problems.empty()) damaged(expected);
      take(number, std::move(read.edit));
      ++expected;
    }
  }

  [[nodiscard]] std::uint64_t count() const {
    const Statement row = prepare("select count(*) from edits");
    return step(row) ? static_cast<std::uint64_t>(sqlite3_column_int64(row.get(), 0)) : 0;
  }

  [[nodiscard]] std::optional<InputPosition> input_position(const std::string& path) const {
    const Statement row = prepare("select place, checksum from inputs where path = ?");
    bind(row, 1, path);
    if (!step(row)) return {};
    return InputPosition{path, static_cast<std::uint64_t>(sqlite3_column_int64(row.get(), 0)),
                         static_cast<std::uint64_t>(sqlite3_column_int64(row.get(), 1))};
  }

  [[nodiscard]] std::map<std::string, std::string> settings() const {
    std::map<std::string, std::string> settings;
    const Statement rows = prepare("select name, value from settings");
    while (step(rows)) settings.emplace(text(rows, 0), text(rows, 1));
    return settings;
  }

  void set_settings(const std::map<std::string, std::string>& settings) {
    execute("begin immediate");
    try {
      for (const auto& [name, value] : settings) {
        const Statement row = prepare("insert or replace into settings values (?, ?)");
        bind(row, 1, name);
        bind(row, 2, value);
        step(row);
      }
      execute("commit");
    } catch (...) {
      sqlite3_exec(database_.get(), "rollback", nullptr, nullptr, nullptr);
      throw;
    }
  }

  void check() const {
    const Statement rows = prepare("pragma integrity_check");
    while (step(rows))
      if (const std::string words(text(rows, 0)); words != "ok") fail(SQLITE_CORRUPT, words);
  }

 private:
  using Statement = std::unique_ptr<sqlite3_stmt, Finalizer>;

  [[noreturn]] void fail(int code) const { fail(code, sqlite3_errmsg(database_.get())); }
  [[noreturn]] void fail(int code, const std::string& words) const {
    throw FileError(access_ == Access::write ? loft::io::Access::write : loft::io::Access::read,
                    path_, cause(code, words));
  }
  [[noreturn]] void damaged(std::uint64_t number) const {
    throw FileError(loft::io::Access::read, path_,
                    "edit " + std::to_string(number) +
                        " is damaged or missing; those before it are fine: 'loft session export' "
                        "saves them");
  }

  void execute(const char* words) const {
    const int code = sqlite3_exec(database_.get(), words, nullptr, nullptr, nullptr);
    if (code != SQLITE_OK) fail(code);
  }

  [[nodiscard]] Statement prepare(const char* words) const {
    sqlite3_stmt* statement = nullptr;
    const int code = sqlite3_prepare_v2(database_.get(), words, -1, &statement, nullptr);
    if (code != SQLITE_OK) fail(code);
    return Statement(statement);
  }

  /// Whether there is a row.
  bool step(const Statement& statement) const {
    const int code = sqlite3_step(statement.get());
    if (code == SQLITE_ROW) return true;
    if (code != SQLITE_DONE) fail(code);
    return false;
  }

  [[nodiscard]] static std::string_view text(const Statement& row, int column) {
    const auto* bytes = static_cast<const char*>(sqlite3_column_blob(row.get(), column));
    const int size = sqlite3_column_bytes(row.get(), column);
    return bytes == nullptr ? std::string_view()
                            : std::string_view(bytes, static_cast<std::size_t>(size));
  }

  void bind(const Statement& statement, int place, std::string_view words) const {
    const int code = sqlite3_bind_text64(statement.get(), place, words.data(), words.size(),
                                         SQLITE_TRANSIENT, SQLITE_UTF8);
    if (code != SQLITE_OK) fail(code);
  }

  [[nodiscard]] int number(const char* words) const {
    const Statement row = prepare(words);
    return step(row) ? sqlite3_column_int(row.get(), 0) : 0;
  }

  /// One writer at a time, for as long as it lives. SQLite's own locks are for single transactions.
  void lock() {
    lock_.file = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (lock_.file < 0) fail(SQLITE_ERROR, last_cause());
    if (::flock(lock_.file, LOCK_EX | LOCK_NB) != 0) fail(SQLITE_BUSY, last_cause());
  }

  /// Is it one of ours? An empty database becomes one.
  void identify() const {
    const int id = number("pragma application_id");
    const bool is_empty = number("select count(*) from sqlite_schema") == 0;
    if (id != application_id && !(is_empty && access_ == Access::write)) fail(SQLITE_NOTADB);
    if (id == application_id && number("pragma user_version") > schema_version)
      fail(SQLITE_ERROR, "a newer version of loft made it; use that one");
  }

  void prepare_to_write() {
    execute("pragma journal_mode = wal");
    execute("pragma synchronous = full");
    execute("pragma wal_autocheckpoint = 1000");
    if (number("pragma application_id") != application_id) {
      execute(
          "begin immediate;"
          "create table edits (number integer primary key, line text not null,"
          " checksum integer not null) strict;"
          "create table settings (name text primary key, value text not null) strict;"
          "pragma user_version = 1;"
          "pragma application_id = 0x6c6f6674;"
          "commit");
    }
    execute(
        "create table if not exists inputs (path text primary key, place integer not null,"
        " checksum integer not null) strict");
    const Statement last =
        prepare("select number, checksum from edits order by number desc limit 1");
    if (step(last)) {
      count_ = static_cast<std::uint64_t>(sqlite3_column_int64(last.get(), 0)) + 1;
      sum_ = static_cast<std::uint64_t>(sqlite3_column_int64(last.get(), 1));
    }
    insert_ = prepare("insert into edits values (?, ?, ?)");
  }

  void insert(const std::string& line) {
    sum_ = chained(sum_, line);
    sqlite3_reset(insert_.get());
    sqlite3_bind_int64(insert_.get(), 1, static_cast<sqlite3_int64>(count_++));
    bind(insert_, 2, line);
    sqlite3_bind_int64(insert_.get(), 3, static_cast<sqlite3_int64>(sum_));
    try {
      step(insert_);
    } catch (...) {
      sqlite3_reset(insert_.get());
      throw;
    }
    sqlite3_reset(insert_.get());
  }

  void keep(const InputPosition& input) const {
    const Statement row = prepare("insert or replace into inputs values (?, ?, ?)");
    bind(row, 1, input.path);
    sqlite3_bind_int64(row.get(), 2, static_cast<sqlite3_int64>(input.offset));
    sqlite3_bind_int64(row.get(), 3, static_cast<sqlite3_int64>(input.checksum));
    step(row);
  }

  std::filesystem::path path_;
  Access access_;
  Lock lock_;  // let go last: closing a file lets go of SQLite's locks on it
  std::unique_ptr<sqlite3, Closer> database_;
  Statement insert_;
  std::uint64_t count_ = 0;  // number of the next edit
  std::uint64_t sum_ = 0;    // checksum of the last one
};

Session::Session(const std::filesystem::path& path, Access access)
    : journal_(std::make_unique<Journal>(path, access)) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

void Session::append(std::span<const Edit> edits, const std::optional<InputPosition>& input) {
  journal_->append(edits, input);
}
std::optional<InputPosition> Session::input_position(const std::string& path) const {
  return journal_->input_position(path);
}
void Session::for_each(const std::function<void(std::uint64_t, Edit&&)>& take) const {
  journal_->for_each(take);
}
std::uint64_t Session::edit_count() const { return journal_->count(); }
std::map<std::string, std::string> Session::settings() const { return journal_->settings(); }
void Session::set_settings(const std::map<std::string, std::string>& settings) {
  journal_->set_settings(settings);
}
void Session::check() const { journal_->check(); }

}  // namespace loft::io
