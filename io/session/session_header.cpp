// SPDX-License-Identifier: MIT
#include "io/session/session_header.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include "io/bytes/file.h"

namespace loft::io {

namespace {

using std::filesystem::path;

constexpr std::size_t header_size = 100;
constexpr std::size_t page_size = 4096;

// Places in the header.
constexpr std::size_t write_version = 18;
constexpr std::size_t read_version = 19;
constexpr std::size_t change_counter = 24;
constexpr std::size_t page_count = 28;
constexpr std::size_t valid_for = 92;

struct Constant {
  std::size_t place;
  std::string_view bytes;
};

using namespace std::string_view_literals;

/// The same in every session. What counts (changes, pages, free pages, versions of the schema and
/// of SQLite) is not here, and not the versions, which tell whether there is a log.
constexpr std::array constants{Constant{0, "SQLite format 3\0"sv},  // what it is
                               Constant{16, "\x10\0"sv},            // size of a page
                               Constant{20, "\0\x40\x20\x20"sv},    // reserved, fractions
                               Constant{44, "\0\0\0\4\0\0\0\0"sv},  // format of the schema, cache
                               Constant{52, "\0\0\0\0\0\0\0\1"sv},  // vacuum, UTF-8
                               Constant{64, "\0\0\0\0loft"sv},      // vacuum, whose it is
                               Constant{72, "\0\0\0\0\0\0\0\0\0\0"sv},   // for later
                               Constant{82, "\0\0\0\0\0\0\0\0\0\0"sv}};  // for later
constexpr std::size_t user_version = 60;

bool is_version(char byte) { return byte == 1 || byte == 2; }

void put(std::string& bytes, std::size_t place, std::uint32_t number) {
  for (std::size_t i = 0; i < 4; ++i)
    bytes[place + i] = static_cast<char>(number >> (24 - 8 * i) & 0xffU);
}

path log_of(path file) { return file += "-wal"; }

path new_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "loft-session-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw FileError(Access::write, name, last_cause());
  return name;
}

void write_over(const path& file, const std::string& bytes) {
  std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw FileError(Access::write, file, last_cause());
}

}  // namespace

SessionHeader::SessionHeader(const path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string page(page_size, '\0');
  in.read(page.data(), static_cast<std::streamsize>(page.size()));
  page.resize(static_cast<std::size_t>(in.gcount()));
  if (page.size() < header_size) return;
  // The first page holds the schema.
  is_session_ = page.find("CREATE TABLE edits") != std::string::npos;
  std::error_code error;
  size_ = std::filesystem::file_size(file, error);
  if (error) size_ = 0;
  bytes_ = page.substr(0, header_size);
}

std::uint32_t SessionHeader::number(std::size_t place) const {
  std::uint32_t result = 0;
  for (std::size_t i = 0; i < 4; ++i)
    result = result << 8U | static_cast<unsigned char>(bytes_[place + i]);
  return result;
}

bool SessionHeader::is_damaged() const {
  if (bytes_.empty()) return false;
  for (const auto& [place, bytes] : constants)
    if (std::string_view(bytes_).substr(place, bytes.size()) != bytes) return true;
  if (!is_version(bytes_[write_version]) || bytes_[read_version] != bytes_[write_version])
    return true;
  // A newer one is the next; no flipped bit makes that of this one.
  if (number(user_version) == 0 || number(user_version) > 2) return true;
  const bool is_counted = number(change_counter) == number(valid_for);
  return !needs_log() && is_counted && number(page_count) < size_ / page_size;
}

bool SessionHeader::needs_log() const {
  // A new one has its schema in the log, and nothing but the header here.
  const bool may_be = is_session_ || (!bytes_.empty() && size_ <= page_size);
  return may_be && bytes_[write_version] == 2 && bytes_[read_version] == 2;
}

std::string SessionHeader::mended() const {
  std::string result = bytes_;
  for (const auto& [place, bytes] : constants) result.replace(place, bytes.size(), bytes);
  result[write_version] = result[read_version] = 2;  // reads the log if there is one
  put(result, user_version, 1);
  put(result, page_count, static_cast<std::uint32_t>(size_ / page_size));
  put(result, valid_for, number(change_counter));
  return result;
}

MendedCopy::MendedCopy(const path& session, const SessionHeader& header)
    : folder_(new_folder()), file_(folder_ / "session") {
  std::error_code error;
  std::filesystem::copy_file(session, file_, error);
  if (!error && std::filesystem::exists(log_of(session), error))
    std::filesystem::copy_file(log_of(session), log_of(file_), error);
  std::filesystem::permissions(file_, std::filesystem::perms::owner_write,
                               std::filesystem::perm_options::add, error);
  try {
    if (error) throw FileError(Access::read, session, error.message());
    write_over(file_, header.mended());
  } catch (...) {
    std::filesystem::remove_all(folder_, error);
    throw;
  }
}

MendedCopy::~MendedCopy() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace loft::io
