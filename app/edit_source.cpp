// SPDX-License-Identifier: MIT
#include "app/edit_source.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <thread>
#include <utility>

#include "io/file.h"

namespace loft::app {

namespace {

/// A line longer than that is no slice.
constexpr std::size_t most_bytes = std::size_t{1} << 30U;

}  // namespace

EditSource::EditSource(std::filesystem::path path, bool is_followed)
    : path_(std::move(path)), is_followed_(is_followed) {
  if (path_.empty()) {
    file_ = STDIN_FILENO;
  } else {
    look_again();
    if (file_ < 0 && !is_followed_) throw io::FileError(io::Access::read, path_, io::last_cause());
  }
}

EditSource::EditSource(EditSource&& other) noexcept
    : path_(std::move(other.path_)),
      is_followed_(other.is_followed_),
      file_(std::exchange(other.file_, -1)),
      number_(other.number_),
      place_(other.place_),
      buffer_(std::move(other.buffer_)),
      scanned_(other.scanned_),
      line_number_(other.line_number_),
      is_ended_(other.is_ended_) {}

EditSource::~EditSource() {
  if (file_ > STDIN_FILENO) ::close(file_);
}

std::string EditSource::name() const { return path_.empty() ? "standard input" : path_.string(); }

/// Opens the file if it is there for the first time or again.
void EditSource::look_again() {
  struct stat there {};
  if (::stat(path_.c_str(), &there) != 0) return;
  const bool is_same = file_ >= 0 && there.st_ino == number_ && there.st_size >= place_;
  if (is_same) return;
  const int file = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  if (file_ >= 0) ::close(file_);
  file_ = file;
  number_ = there.st_ino;
  place_ = 0;
  buffer_.clear();  // of a file that is no more
  scanned_ = 0;
}

bool EditSource::take_line(std::string& line, bool is_end) {
  const std::size_t end = buffer_.find('\n', scanned_);
  if (end == std::string::npos) {
    scanned_ = buffer_.size();
    if (scanned_ > most_bytes)
      throw InputError(name() + ": line " + std::to_string(line_number_ + 1) +
                       " has no end within a gigabyte; slices are a line each");
    if (!is_end || buffer_.empty()) return false;
    line = std::exchange(buffer_, {});
    scanned_ = 0;
  } else {
    line.assign(buffer_, 0, end);
    buffer_.erase(0, end + 1);
    scanned_ = 0;
  }
  ++line_number_;
  return true;
}

EditSource::State EditSource::next(std::string& line, std::chrono::milliseconds patience) {
  for (bool has_waited = false;;) {
    if (take_line(line, is_ended_)) return State::line;
    if (is_ended_) return State::ended;
    if (is_followed_) look_again();
    if (file_ >= 0) {
      pollfd wait{file_, POLLIN, 0};
      const int ready = ::poll(&wait, 1, static_cast<int>(patience.count()));
      if (ready == 0 || (ready < 0 && errno == EINTR)) return State::waiting;
      std::array<char, 1 << 16> bytes{};
      const ssize_t count = ::read(file_, bytes.data(), bytes.size());
      if (count < 0 && (errno == EINTR || errno == EAGAIN)) return State::waiting;
      if (count < 0) throw io::FileError(io::Access::read, name(), io::last_cause());
      buffer_.append(bytes.data(), static_cast<std::size_t>(count));
      place_ += count;
      if (count > 0) continue;
      if (!is_followed_) {
        is_ended_ = true;
        continue;
      }
    }
    if (has_waited) return State::waiting;
    std::this_thread::sleep_for(patience);  // a file says nothing when it grows
    has_waited = true;
  }
}

}  // namespace loft::app
