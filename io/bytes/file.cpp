// SPDX-License-Identifier: MIT
#include "io/bytes/file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <utility>

#include "io/bytes/text.h"
#include "io/bytes/words.h"

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

std::string read_standard_input() {
  std::string content{std::istreambuf_iterator<char>(std::cin), {}};
  if (std::cin.bad()) throw FileError(Access::read, standard_input, last_cause());
  return content;
}

namespace {

/// A file that is open as long as the object lives.
class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& path) : number_(open(path.c_str(), O_RDONLY)) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

}  // namespace

FileBytes::FileBytes(const std::filesystem::path& path) {
  constexpr std::uintmax_t large = std::uintmax_t{1} << 26;
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored && size >= large) {
    const Descriptor file(path);
    void* const mapping = file.number() < 0
                              ? MAP_FAILED
                              : mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.number(), 0);
    if (mapping != MAP_FAILED) {
      mapping_ = mapping;
      size_ = size;
      return;
    }
  }
  content_ = read_file(path);
}

FileBytes::~FileBytes() {
  if (mapping_ != nullptr) munmap(mapping_, size_);
}

FileBytes::FileBytes(FileBytes&& other) noexcept
    : content_(std::move(other.content_)),
      mapping_(std::exchange(other.mapping_, nullptr)),
      size_(std::exchange(other.size_, 0)) {}

std::string_view FileBytes::view() const {
  if (mapping_ != nullptr) return {static_cast<const char*>(mapping_), size_};
  return content_;
}

std::string extension(const std::filesystem::path& path) {
  return in_lower_case(path.extension().string());
}

}  // namespace loft::io
