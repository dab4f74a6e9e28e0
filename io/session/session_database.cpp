// SPDX-License-Identifier: MIT
#include "io/session/session_database.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <system_error>

#include "io/session/session.h"

namespace loft::io {

namespace {

/// For a URI, in which some characters have a meaning.
std::string escaped(const std::string& path) {
  std::string result;
  for (const char c : path) {
    if (c == '%') {
      result += "%25";
    } else if (c == '?') {
      result += "%3f";
    } else if (c == '#') {
      result += "%23";
    } else {
      result += c;
    }
  }
  return result;
}

bool may_not_open(int code) {
  return code == SQLITE_CANTOPEN || code == SQLITE_READONLY || code == SQLITE_PERM;
}

/// What reading a row says where its place in the file is damaged.
bool is_damage(int code) {
  return code == SQLITE_CORRUPT || code == SQLITE_IOERR || code == SQLITE_TOOBIG;
}

std::filesystem::path from_the_root(const std::filesystem::path& path, Access access) {
  if (path.empty()) throw FileError(access, path, "it has no name; give a file");
  std::error_code error;
  auto result = std::filesystem::absolute(path, error);
  if (error) throw FileError(access, path, error.message());
  return result;
}

std::optional<std::pair<std::uintmax_t, std::uintmax_t>> file_id(const char* path) {
  struct stat there {};
  if (::stat(path, &there) != 0) return {};
  return std::pair<std::uintmax_t, std::uintmax_t>(there.st_dev, there.st_ino);
}

}  // namespace

void SessionDatabase::Finalizer::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}
void SessionDatabase::Closer::operator()(sqlite3* database) const { sqlite3_close(database); }
SessionDatabase::Lock::~Lock() {
  if (file >= 0) ::close(file);
}

SessionDatabase::SessionDatabase(std::filesystem::path path, Access access)
    : path_(std::move(path)), file_(from_the_root(path_, access)), access_(access) {
  if (access == Access::read) {
    open_to_read();
  } else {
    lock();
    look_at_header();
    open(file_.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  }
}

// --- Opening ---

/// One writer at a time, for as long as it lives. SQLite's own locks are for single transactions.
void SessionDatabase::lock() {
  lock_.file = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  // Where a standard one is closed this must not become it.
  if (lock_.file >= 0 && lock_.file <= STDERR_FILENO) {
    const int low = std::exchange(lock_.file, ::fcntl(lock_.file, F_DUPFD_CLOEXEC, 3));
    ::close(low);
  }
  if (lock_.file < 0) fail(SQLITE_ERROR, last_cause());
  if (::flock(lock_.file, LOCK_EX | LOCK_NB) != 0) fail(SQLITE_BUSY);
}

void SessionDatabase::open(const std::string& name, int flags) {
  sqlite3* database = nullptr;
  const int code = sqlite3_open_v2(name.c_str(), &database, flags, nullptr);
  database_.reset(database);
  if (code != SQLITE_OK) fail(code);
  sqlite3_busy_timeout(database, 2000);
}

void SessionDatabase::open_to_read() {
  if (::access(file_.c_str(), R_OK) != 0) fail(SQLITE_ERROR, last_cause());
  if (std::filesystem::is_directory(file_)) fail(SQLITE_ERROR, "it is a folder");
  look_at_header();
  open((copy_ ? copy_->file() : file_).string(), SQLITE_OPEN_READONLY);
  const int code =
      sqlite3_exec(database_.get(), "pragma schema_version", nullptr, nullptr, nullptr);
  // SQLite wants to make files beside it. Where it may not nobody writes; and where there is no log
  // all is in this one.
  if (may_not_open(code) && !has_log()) {
    open("file://" + escaped(file_.string()) + "?immutable=1",
         SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
  }
  // Else a file that was cut off is refused as a whole.
  execute("pragma writable_schema = on");
}

/// Before SQLite opens it: closing the file would let go of SQLite's locks.
void SessionDatabase::look_at_header() {
  const SessionHeader header(file_);
  const bool is_damaged = header.is_of_session() && header.is_damaged();
  std::error_code ignored;
  const bool is_log_missing = !is_damaged && header.needs_log() &&
                              !std::filesystem::exists(file_.string() + "-wal", ignored);
  if (is_damaged) {
    notes_.emplace_back("its header is damaged; read from a copy with a header written anew");
    if (access_ == Access::write)
      fail_damaged("its header is damaged; 'loft session export --edits' saves what is in it");
    copy_ = std::make_unique<MendedCopy>(file_, header);
  }
  if (is_log_missing) notes_.push_back(missing_log());
  if (is_log_missing && access_ == Access::write) fail_damaged(notes_.back());
}

std::string SessionDatabase::missing_log() const {
  return "its log, " + path_.filename().string() +
         "-wal, is missing: the session was not closed, and its last edits are in that; put it "
         "beside the session, or save the others by 'loft session export --edits'";
}

/// Nobody else may be in it; SQLite's way out of its log takes the file for itself.
void SessionDatabase::close_to_one_file() noexcept {
  try {
    check_in_place();
  } catch (const Error&) {
    return;  // what has its name now is another's
  }
  sqlite3* const database = database_.get();
  sqlite3_busy_timeout(database, 100);
  constexpr const char* leave_log = "pragma journal_mode = delete";
  if (sqlite3_exec(database, leave_log, nullptr, nullptr, nullptr) == SQLITE_OK) return;
  // Somebody reads it: the log stays, as the file says that there is one.
  sqlite3_db_config(database, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
}

/// The name of SQLite's write-ahead log.
const char* SessionDatabase::log() const {
  return sqlite3_filename_wal(sqlite3_db_filename(database_.get(), "main"));
}

bool SessionDatabase::has_log() const {
  std::error_code missing;
  const auto size = std::filesystem::file_size(log(), missing);
  return !missing && size > 0;
}

// --- Where it lies ---

/// Empty, SQLite takes it for none. It is there before the header says that there is one, so that
/// who is killed between the two leaves no session whose log seems to be lost.
void SessionDatabase::make_log() const {
  const int file = ::open(log(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file >= 0) ::close(file);
}

void SessionDatabase::remember_log() { log_id_ = file_id(log()); }

void SessionDatabase::check_in_place() const {
  struct stat opened {};
  const bool is_open = ::fstat(lock_.file, &opened) == 0;
  const bool is_there = is_open && file_id(file_.c_str()) == FileId(opened.st_dev, opened.st_ino);
  if (is_there && (!log_id_ || file_id(log()) == log_id_)) return;
  fail(SQLITE_ERROR,
       "it (or its log, " + path_.filename().string() +
           "-wal) was deleted or replaced while in use; put it back, or end the stream and begin "
           "another session");
}

// --- Statements ---

void SessionDatabase::execute(const char* words) const {
  const int code = sqlite3_exec(database_.get(), words, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code);
}

/// Some errors have rolled back already: then this does nothing.
void SessionDatabase::roll_back() const {
  sqlite3_exec(database_.get(), "rollback", nullptr, nullptr, nullptr);
}

SessionDatabase::Statement SessionDatabase::prepare(const char* words) const {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(database_.get(), words, -1, &statement, nullptr);
  // The words are right: a table is not there.
  if (code == SQLITE_ERROR) fail(SQLITE_CORRUPT);
  if (code != SQLITE_OK) fail(code);
  return Statement(statement);
}

void SessionDatabase::bind(const Statement& statement, int place, std::string_view words) const {
  const int code = sqlite3_bind_text64(statement.get(), place, words.data(), words.size(),
                                       SQLITE_TRANSIENT, SQLITE_UTF8);
  if (code != SQLITE_OK) fail(code);
}

bool SessionDatabase::step(const Statement& statement) const {
  const int code = sqlite3_step(statement.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) fail(code);
  return false;
}

std::optional<bool> SessionDatabase::try_step(const Statement& statement) const {
  const int code = sqlite3_step(statement.get());
  if (code == SQLITE_ROW || code == SQLITE_DONE) return code == SQLITE_ROW;
  if (!is_damage(code & 0xff)) fail(code);
  return {};
}

std::string_view SessionDatabase::text(const Statement& row, int column) {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(row.get(), column));
  const int size = sqlite3_column_bytes(row.get(), column);
  return bytes == nullptr ? std::string_view()
                          : std::string_view(bytes, static_cast<std::size_t>(size));
}

int SessionDatabase::number(const char* words) const {
  const Statement row = prepare(words);
  return step(row) ? sqlite3_column_int(row.get(), 0) : 0;
}

// --- Failures ---

void SessionDatabase::fail(int code) const { fail(code, sqlite3_errmsg(database_.get())); }

void SessionDatabase::fail(int code, const std::string& words) const {
  const int kind = code & 0xff;
  if (kind == SQLITE_CORRUPT || (kind == SQLITE_NOTADB && bears_our_mark()))
    fail_damaged(cause(kind, words));
  throw FileError(access_, path_, cause(kind, words));
}

void SessionDatabase::fail_damaged(const std::string& words) const {
  throw DamagedSession(Access::read, path_, words);
}

/// What SQLite says, and the way out.
std::string SessionDatabase::cause(int kind, const std::string& words) const {
  switch (kind) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another process is writing to this session; end it first, or use another file";
    case SQLITE_FULL:
      return "the disk is full; make room, then send the slices again that were not acknowledged";
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_CANTOPEN:
      if (access_ == Access::write)
        return "it or its folder may not be written to; change the permissions, or use another "
               "file";
      return "a part of it is in its log, " + path_.filename().string() +
             "-wal, which SQLite reads only where the folder may be written to; copy both into "
             "such a folder";
    case SQLITE_NOTADB:
      if (!bears_our_mark()) return "it is no session file";
      return "its header is damaged; restore it from a copy, or make one and write the header "
             "anew: printf 'SQLite format 3\\0\\20\\0\\2\\2\\0@  ' | dd conv=notrunc of=COPY";
    case SQLITE_CORRUPT:
      return "it is damaged (" + words +
             "); 'loft session verify' says where, 'loft session export' saves what can be read; "
             "if that is nothing, restore it from a copy";
    default:
      return words;
  }
}

/// Whether the header of the file says that it is a session, whatever else is in it.
bool SessionDatabase::bears_our_mark() const {
  std::array<char, 72> header{};
  std::ifstream file(file_, std::ios::binary);
  file.read(header.data(), header.size());
  return file && std::string_view(header.data() + 68, 4) == "loft";
}

}  // namespace loft::io
