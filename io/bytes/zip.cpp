// SPDX-License-Identifier: MIT
#include "io/bytes/zip.h"

#include <zip.h>

#include <cstdint>
#include <cstdio>

#include "reconstruct/defect.h"

namespace loft::io {

namespace {

class ZipArchive {
 public:
  ZipArchive() : bytes_(zip_source_buffer_create(nullptr, 0, 0, nullptr)) {
    archive_ = bytes_ == nullptr ? nullptr : zip_open_from_source(bytes_, ZIP_TRUNCATE, nullptr);
    if (archive_ == nullptr) fail();
    zip_source_keep(bytes_);
  }
  ~ZipArchive() {
    if (archive_ != nullptr) zip_discard(archive_);
    if (bytes_ != nullptr) zip_source_free(bytes_);
  }
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  /// Its content must stay until bytes().
  void add(const ZipEntry& entry) {
    constexpr std::uint16_t first_day = (1U << 5U) | 1U;  // of 1980: no earlier date can be said
    zip_source_t* const content =
        zip_source_buffer(archive_, entry.content.data(), entry.content.size(), 0);
    if (content == nullptr) fail();
    const auto index = zip_file_add(archive_, entry.name.c_str(), content, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      zip_source_free(content);
      fail();
    }
    const auto place = static_cast<zip_uint64_t>(index);
    if (zip_file_set_dostime(archive_, place, 0, first_day, 0) != 0 ||
        zip_set_file_compression(archive_, place, ZIP_CM_DEFLATE, 0) != 0)
      fail();
  }

  std::string bytes() {
    if (zip_close(archive_) != 0) fail();
    archive_ = nullptr;
    if (zip_source_open(bytes_) != 0 || zip_source_seek(bytes_, 0, SEEK_END) != 0) fail();
    std::string result(static_cast<std::size_t>(zip_source_tell(bytes_)), '\0');
    zip_source_seek(bytes_, 0, SEEK_SET);
    const zip_int64_t count = zip_source_read(bytes_, result.data(), result.size());
    zip_source_close(bytes_);
    if (count != static_cast<zip_int64_t>(result.size())) fail();
    return result;
  }

 private:
  [[noreturn]] static void fail() { throw Error("libzip failed to make an archive"); }

  zip_source_t* bytes_;
  zip_t* archive_ = nullptr;
};

}  // namespace

bool has_zip() { return true; }

std::string zip(std::span<const ZipEntry> entries) {
  ZipArchive archive;
  for (const ZipEntry& entry : entries) archive.add(entry);
  return archive.bytes();
}

}  // namespace loft::io
