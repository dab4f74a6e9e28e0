// SPDX-License-Identifier: MIT
#include "io/bytes/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <mutex>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "io/bytes/file.h"

namespace loft::io {

namespace {

using std::filesystem::path;

path folder_of(const path& file) {
  const path parent = file.parent_path();
  return parent.empty() ? path(".") : parent;
}

/// The name of something that a process has open, like what /dev/stdout leads to.
bool is_open_file(const path& file) {
  std::error_code ignored;
  return std::filesystem::canonical(folder_of(file), ignored).string().starts_with("/proc/");
}

/// The temporary files that there are, of all threads.
struct Temporaries {
  std::mutex mutex;
  std::set<path> names;
};

/// Never destroyed: threads may write while the program ends.
Temporaries& temporaries() {
  static auto* const all = new Temporaries;
  return *all;
}

/// Where links lead, whether there is a file or not.
path follow_links(path file) {
  constexpr int most_links = 40;  // as Linux
  std::error_code ignored;
  for (int i = 0; i < most_links && std::filesystem::is_symlink(file, ignored); ++i) {
    if (is_open_file(file)) break;
    file = folder_of(file) / std::filesystem::read_symlink(file, ignored);
  }
  return file;
}

/// Whether a file may take the place of what is there.
bool is_replaceable(const path& file) {
  std::error_code ignored;
  const auto kind = std::filesystem::status(file, ignored).type();
  return kind == std::filesystem::file_type::not_found ||
         (kind == std::filesystem::file_type::regular && !is_open_file(file));
}

/// Whether a process of this user left it, and nobody has renamed or removed it meanwhile.
bool is_left_over(int file, const path& name) {
  struct stat opened {};
  struct stat there {};
  return ::fstat(file, &opened) == 0 && ::lstat(name.c_str(), &there) == 0 &&
         opened.st_dev == there.st_dev && opened.st_ino == there.st_ino &&
         S_ISREG(opened.st_mode) && opened.st_nlink == 1 && opened.st_uid == ::geteuid();
}

/// Makes the file and locks it, so that nobody takes it over. -1 if that cannot be, see errno.
int make(const path& name, mode_t mode) {
  const int file = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (file < 0) return -1;
  // Where files cannot be locked nobody can take them over.
  if (::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return file;
  ::close(file);
  errno = EEXIST;
  return -1;
}

/// What fsync() says of files that it is not for, as on some network file systems.
bool cannot_sync(int error) { return error == EINVAL || error == ENOTSUP || error == EROFS; }

/// The new name is durable, too. The file itself is written by then: where a folder cannot be
/// synced, no more can be done.
void sync_folder(const path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

/// Takes over a file that no process holds any more. -1 if it is no such file.
int take_over(const path& name) {
  const int file = ::open(name.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return -1;
  if (::flock(file, LOCK_EX | LOCK_NB) == 0 && is_left_over(file, name)) return file;
  ::close(file);
  return -1;
}

}  // namespace

AtomicFile::AtomicFile(path name) : path_(std::move(name)), target_(follow_links(path_)) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder_of(target_), ignored)) {
    throw FileError(Access::write, path_,
                    "folder " + folder_of(target_).string() + " does not exist; create it first");
  }
  if (std::filesystem::is_directory(target_, ignored)) {
    throw FileError(Access::write, path_, "it is a folder");
  }
  if (is_replaceable(target_)) {
    forbid_replacing_protected();
    create_temporary();
  } else if (::access(target_.c_str(), W_OK) != 0) {
    throw FileError(Access::write, path_, last_cause());
  }
}

/// Renaming asks the folder alone: a file that may not be written to would be replaced.
void AtomicFile::forbid_replacing_protected() {
  struct stat there {};
  if (::stat(target_.c_str(), &there) != 0) return;
  constexpr mode_t all_write = S_IWUSR | S_IWGRP | S_IWOTH;
  // Root may write to everything, also where nobody is meant to.
  if (::access(target_.c_str(), W_OK) != 0 || (there.st_mode & all_write) == 0)
    throw FileError(Access::write, path_,
                    "it is read-only; make it writable, remove it, or write to another file");
  mode_ = there.st_mode & 07777;
}

void abandon_atomic_files() {
  Temporaries& all = temporaries();
  all.mutex.lock();  // for good
  std::error_code ignored;
  for (const path& name : all.names) std::filesystem::remove(name, ignored);
}

void AtomicFile::create_temporary() {
  const std::lock_guard lock(temporaries().mutex);
  constexpr int attempts = 1000;
  for (int number = 0; number < attempts && lock_ < 0; ++number) {
    std::string name(1, '.');
    name += target_.filename().string() + '.' + std::to_string(number) + ".part";
    temporary_ = folder_of(target_) / name;
    lock_ = make(temporary_, mode_.value_or(0666));
    if (lock_ < 0 && errno != EEXIST) break;
    if (lock_ < 0) lock_ = take_over(temporary_);
  }
  if (lock_ < 0) throw FileError(Access::write, path_, last_cause());
  // At once, before anything is in it: what the mask left out, or what was taken over has.
  if (mode_ && ::fchmod(lock_, *mode_) != 0) {
    const std::string cause = last_cause();
    ::unlink(temporary_.c_str());
    ::close(std::exchange(lock_, -1));
    throw FileError(Access::write, path_, cause);
  }
  temporaries().names.insert(temporary_);
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
}

AtomicFile::~AtomicFile() {
  if (lock_ < 0) return;
  stream_.close();
  const std::lock_guard lock(temporaries().mutex);
  std::error_code ignored;
  if (!committed_) std::filesystem::remove(temporary_, ignored);
  temporaries().names.erase(temporary_);
  ::close(lock_);
}

std::ostream& AtomicFile::stream() {
  const bool is_direct = lock_ < 0;
  if (is_direct && !stream_.is_open()) {
    // At the end: /dev/stdout may be a file that has something in it already.
    stream_.open(target_, std::ios::binary | std::ios::app);
    if (!stream_) throw FileError(Access::write, path_, last_cause());
  }
  return stream_;
}

void AtomicFile::commit() {
  errno = 0;
  stream().flush();
  stream_.close();
  if (!stream_) throw FileError(Access::write, path_, errno != 0 ? last_cause() : "write failed");
  if (lock_ >= 0) put_in_place();
  committed_ = true;
}

/// Content first, then the name: whenever power is lost, the name means the old or the new file.
void AtomicFile::put_in_place() {
  if (::fsync(lock_) != 0 && !cannot_sync(errno))
    throw FileError(Access::write, path_, last_cause());
  {
    const std::lock_guard lock(temporaries().mutex);
    if (::rename(temporary_.c_str(), target_.c_str()) != 0)
      throw FileError(Access::write, path_, last_cause());
    committed_ = true;
  }
  sync_folder(folder_of(target_));
}

}  // namespace loft::io
