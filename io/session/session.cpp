// SPDX-License-Identifier: MIT
#include "io/session/session.h"

#include <sqlite3.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "io/session/session_database.h"
#include "io/session/session_salvage.h"

namespace loft::io {

namespace {

// "loft" in ASCII; what file(1) and SQLite itself look at.
constexpr int application_id = 0x6c6f6674;
constexpr int schema_version = 1;

/// No edit takes less room in the file: its line, its checksum, what SQLite puts around them.
constexpr std::uint64_t least_edit_bytes = 32;

using Statement = SessionDatabase::Statement;

std::uint64_t unsigned_number(const Statement& row, int column) {
  return static_cast<std::uint64_t>(sqlite3_column_int64(row.get(), column));
}

}  // namespace

class Session::Journal {
 public:
  Journal(const std::filesystem::path& path, Access access)
      : database_(path, access == Access::read ? loft::io::Access::read : loft::io::Access::write),
        access_(access) {
    identify(access);
    if (access == Access::write) prepare_to_write();
  }

  ~Journal() {
    if (access_ == Access::read) return;
    insert_.reset();
    database_.close_to_one_file();
  }
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  void append(std::span<const Edit> edits, const std::optional<InputPosition>& input,
              const std::optional<Undo>& undo) {
    if (edits.empty() && !input) return;
    const std::uint64_t count = count_;
    const std::uint64_t sum = sum_;
    try {
      database_.in_one_transaction([&] {
        for (const Edit& edit : edits) insert(to_line(edit));
        if (input) keep(*input);
        if (undo) keep(count, *undo);
        database_.check_in_place();
      });
    } catch (...) {
      count_ = count;
      sum_ = sum;
      throw;
    }
  }

  void for_each(const Take& take) const {
    if (!database_.notes().empty()) database_.fail_damaged(database_.notes().front());
    const Statement rows =
        database_.prepare("select number, line, checksum from edits order by number");
    std::uint64_t expected = 0;
    std::uint64_t sum = 0;
    for (; database_.step(rows); ++expected) {
      const std::string_view line = SessionDatabase::text(rows, 1);
      sum = edit_checksum(sum, line);
      const bool is_right = unsigned_number(rows, 0) == expected && sum == unsigned_number(rows, 2);
      EditLine read = parse_edit_line(line);
      if (!is_right || !read.problems.empty()) fail_damaged(expected);
      take(expected, std::move(read.edit));
    }
  }

  [[nodiscard]] Edit edit(std::uint64_t number) const {
    const Statement row = database_.prepare("select line from edits where number = ?");
    sqlite3_bind_int64(row.get(), 1, static_cast<sqlite3_int64>(number));
    if (!database_.step(row)) fail_damaged(number);
    EditLine read = parse_edit_line(SessionDatabase::text(row, 0));
    if (!read.problems.empty()) fail_damaged(number);
    return std::move(read.edit);
  }

  [[nodiscard]] std::map<std::uint64_t, Undo> undos() const {
    std::map<std::uint64_t, Undo> all;
    if (database_.number("select count(*) from sqlite_schema where name = 'undos'") == 0)
      return all;  // an older version of loft made it
    const Statement rows = database_.prepare("select number, of, is_redo from undos");
    while (database_.step(rows))
      all[unsigned_number(rows, 0)] = {unsigned_number(rows, 1), unsigned_number(rows, 2) != 0};
    return all;
  }

  [[nodiscard]] std::vector<std::string> salvage(const Take& take) const {
    // As long as there is that row, all is read as it was then.
    const Statement last =
        database_.prepare("select number from edits order by number desc limit 1");
    const Statement row = database_.prepare("select line, checksum from edits where number = ?");
    const std::optional<std::uint64_t> count = count_up_to(last);
    const std::uint64_t end = count.value_or(most_edits());
    SessionSalvage salvage(take);
    for (std::uint64_t number = 0; number < end; ++number) {
      sqlite3_reset(row.get());
      sqlite3_bind_int64(row.get(), 1, static_cast<sqlite3_int64>(number));
      if (database_.try_step(row) == true) {
        salvage.add(SessionDatabase::text(row, 0), unsigned_number(row, 1));
      } else {
        salvage.add_hole();
      }
    }
    std::vector<std::string> faults = database_.notes();
    std::ranges::move(salvage.finish(count.has_value()), std::back_inserter(faults));
    return faults;
  }

  [[nodiscard]] std::uint64_t count() const {
    const Statement row = database_.prepare("select count(*) from edits");
    return database_.step(row) ? unsigned_number(row, 0) : 0;
  }

  [[nodiscard]] std::optional<InputPosition> input_position(const std::string& path) const {
    const Statement row = database_.prepare("select place, checksum from inputs where path = ?");
    database_.bind(row, 1, path);
    if (!database_.step(row)) return {};
    return InputPosition{path, unsigned_number(row, 0), unsigned_number(row, 1)};
  }

  [[nodiscard]] std::map<std::string, std::string> settings() const {
    std::map<std::string, std::string> settings;
    const Statement rows = database_.prepare("select name, value from settings");
    while (database_.step(rows))
      settings.emplace(SessionDatabase::text(rows, 0), SessionDatabase::text(rows, 1));
    return settings;
  }

  void set_settings(const std::map<std::string, std::string>& settings) {
    database_.in_one_transaction([&] {
      for (const auto& [name, value] : settings) {
        const Statement row = database_.prepare("insert or replace into settings values (?, ?)");
        database_.bind(row, 1, name);
        database_.bind(row, 2, value);
        database_.step(row);
      }
    });
  }

  [[nodiscard]] std::vector<std::string> check() const {
    std::vector<std::string> all;
    const Statement rows = database_.prepare("pragma integrity_check");
    std::optional<bool> is_row = database_.try_step(rows);
    for (; is_row == true; is_row = database_.try_step(rows)) {
      std::istringstream words{std::string(SessionDatabase::text(rows, 0))};
      for (std::string line; std::getline(words, line);)
        if (line != "ok" && !line.starts_with("***")) all.push_back(line);
    }
    if (!is_row) all.emplace_back("the check ended there: the file is damaged");
    return all;
  }

 private:
  [[noreturn]] void fail_damaged(std::uint64_t number) const {
    database_.fail_damaged("edit " + std::to_string(number) +
                           " is damaged or missing; 'loft session verify' lists all that are, "
                           "'loft session export' saves the others");
  }

  /// Is it one of ours? An empty database becomes one.
  void identify(Access access) const {
    const bool is_ours = database_.number("pragma application_id") == application_id;
    const bool is_new = !is_ours && access == Access::write &&
                        database_.number("select count(*) from sqlite_schema") == 0;
    if (!is_ours && !is_new) database_.fail(SQLITE_NOTADB, "");
    if (is_ours && database_.number("pragma user_version") > schema_version)
      database_.fail(SQLITE_ERROR, "a newer version of loft made it; use that one");
  }

  void prepare_to_write() {
    database_.make_log();
    database_.execute("pragma journal_mode = wal");
    database_.execute("pragma synchronous = full");
    database_.execute("pragma wal_autocheckpoint = 1000");
    if (database_.number("pragma application_id") != application_id) {
      database_.execute(
          "begin immediate;"
          "create table edits (number integer primary key, line text not null,"
          " checksum integer not null) strict;"
          "create table settings (name text primary key, value text not null) strict;"
          "pragma user_version = 1;"
          "pragma application_id = 0x6c6f6674;"
          "commit");
    }
    database_.execute(
        "create table if not exists inputs (path text primary key, place integer not null,"
        " checksum integer not null) strict");
    database_.execute(
        "create table if not exists undos (number integer primary key, of integer not null,"
        " is_redo integer not null) strict");
    const Statement last =
        database_.prepare("select number, checksum from edits order by number desc limit 1");
    if (database_.step(last)) {
      count_ = unsigned_number(last, 0) + 1;
      sum_ = unsigned_number(last, 1);
    }
    insert_ = database_.prepare("insert into edits values (?, ?, ?)");
    database_.remember_log();
  }

  void insert(const std::string& line) {
    sum_ = edit_checksum(sum_, line);
    sqlite3_reset(insert_.get());
    sqlite3_bind_int64(insert_.get(), 1, static_cast<sqlite3_int64>(count_++));
    database_.bind(insert_, 2, line);
    sqlite3_bind_int64(insert_.get(), 3, static_cast<sqlite3_int64>(sum_));
    try {
      database_.step(insert_);
    } catch (...) {
      sqlite3_reset(insert_.get());
      throw;
    }
    sqlite3_reset(insert_.get());
  }

  void keep(const InputPosition& input) const {
    const Statement row = database_.prepare("insert or replace into inputs values (?, ?, ?)");
    database_.bind(row, 1, input.path);
    sqlite3_bind_int64(row.get(), 2, static_cast<sqlite3_int64>(input.offset));
    sqlite3_bind_int64(row.get(), 3, static_cast<sqlite3_int64>(input.checksum));
    database_.step(row);
  }

  void keep(std::uint64_t number, const Undo& undo) const {
    const Statement row = database_.prepare("insert or replace into undos values (?, ?, ?)");
    sqlite3_bind_int64(row.get(), 1, static_cast<sqlite3_int64>(number));
    sqlite3_bind_int64(row.get(), 2, static_cast<sqlite3_int64>(undo.of));
    sqlite3_bind_int64(row.get(), 3, undo.is_redo ? 1 : 0);
    database_.step(row);
  }

  /// How many edits there are, by the number of the last; nothing if that is damaged.
  [[nodiscard]] std::optional<std::uint64_t> count_up_to(const Statement& last) const {
    const std::optional<bool> is_there = database_.try_step(last);
    if (!is_there) return {};
    const std::uint64_t count = *is_there ? unsigned_number(last, 0) + 1 : 0;
    return count <= most_edits() ? std::optional(count) : std::nullopt;
  }

  /// As many as there is room for in the file.
  [[nodiscard]] std::uint64_t most_edits() const {
    const auto pages = static_cast<std::uint64_t>(database_.number("pragma page_count"));
    const auto size = static_cast<std::uint64_t>(database_.number("pragma page_size"));
    return pages * size / least_edit_bytes + 1;
  }

  SessionDatabase database_;
  Access access_;
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
  journal_->append(edits, input, {});
}
void Session::append(const Edit& edit, const Undo& undo) {
  journal_->append(std::span(&edit, 1), {}, undo);
}
Edit Session::edit(std::uint64_t number) const { return journal_->edit(number); }
std::map<std::uint64_t, Undo> Session::undos() const { return journal_->undos(); }
std::optional<InputPosition> Session::input_position(const std::string& path) const {
  return journal_->input_position(path);
}
void Session::for_each(const Take& take) const { journal_->for_each(take); }
std::vector<std::string> Session::salvage(const Take& take) const {
  return journal_->salvage(take);
}
std::uint64_t Session::edit_count() const { return journal_->count(); }
std::map<std::string, std::string> Session::settings() const { return journal_->settings(); }
void Session::set_settings(const std::map<std::string, std::string>& settings) {
  journal_->set_settings(settings);
}
std::vector<std::string> Session::check() const { return journal_->check(); }

bool is_session_file(const std::filesystem::path& path) {
  constexpr std::string_view mark = "SQLite format 3";
  std::string head(mark.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return file && head == mark;
}

}  // namespace loft::io
