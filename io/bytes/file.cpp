// SPDX-License-Identifier: MIT
#include "io/bytes/file.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "io/bytes/text.h"

namespace loft::io {

namespace {

std::string sentence(Access access, const std::filesystem::path& path, const std::string& cause) {
  const char* verb = access == Access::read ? "cannot read " : "cannot write ";
  return verb + path.string() + ": " + cause;
}

}  // namespace

FileError::FileError(Access access, std::filesystem::path path, const std::string& cause)
    : Error(sentence(access, path, cause)), access_(access), path_(std::move(path)) {}

UnknownFormat::UnknownFormat(const std::filesystem::path& path, std::string_view known)
    : Error(path.string() + ": unknown extension " + in_quotes(path.extension().string()) +
            "; known are " + std::string(known)) {}

std::string last_cause() { return std::generic_category().message(errno); }

std::string read_file(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    throw FileError(Access::read, path, "it is a folder");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(Access::read, path, last_cause());
  std::ostringstream content;
  // An empty file sets the fail bit of `content`, which is no error.
  content << file.rdbuf();
  if (file.bad()) throw FileError(Access::read, path, last_cause());
  return std::move(content).str();
}

std::string extension(const std::filesystem::path& path) {
  std::string result = path.extension().string();
  std::ranges::transform(result, result.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return result;
}

}  // namespace loft::io
