// SPDX-License-Identifier: MIT
#include "app/capture/edit_source.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "io/bytes/checksum.h"
#include "io/bytes/file.h"
#include "io/bytes/text.h"

namespace loft::app {

namespace {

constexpr std::size_t chunk = std::size_t{1} << 16U;

}  // namespace

EditSource::EditSource(Setup setup) : setup_(std::move(setup)) {
  start_over();
  if (setup_.path.empty()) {
    file_ = STDIN_FILENO;
  } else if (!open() && !setup_.is_followed) {
    throw io::FileError(io::Access::read, setup_.path, io::last_cause());
  }
}

EditSource::~EditSource() {
  if (file_ > STDIN_FILENO) ::close(file_);
}

std::string EditSource::name() const {
  return setup_.path.empty() ? "standard input" : setup_.path.string();
}

std::string EditSource::full_name(const std::filesystem::path& path) {
  const std::filesystem::path full = std::filesystem::absolute(path);
  std::error_code failure;
  const std::filesystem::path without_links = std::filesystem::weakly_canonical(full, failure);
  return (failure ? full : without_links).string();
}

std::optional<io::InputPosition> EditSource::position() const {
  if (!is_regular_) return {};
  const auto offset = static_cast<std::uint64_t>(place_) - (buffer_.size() - begin_);
  return io::InputPosition{full_name_, offset, checksum_};
}

std::size_t EditSource::unfinished_bytes() const {
  const bool has_end = buffer_.find('\n', scanned_) != std::string::npos;
  return is_skipping_ || has_end ? 0 : buffer_.size() - begin_;
}

EditSource::State EditSource::next(std::string& line, std::chrono::milliseconds patience) {
  for (bool has_waited = false;;) {
    if (const State state = take_line(line); state != State::waiting) return state;
    if (is_at_end_ && !setup_.is_followed) return State::ended;
    const Found found = read_more(patience);
    if (found == Found::bytes) continue;
    if (setup_.is_followed) {
      if (look_again()) continue;
    } else if (found == Found::end) {
      is_at_end_ = true;
      continue;
    }
    if (found == Found::nothing_yet || has_waited) return State::waiting;
    std::this_thread::sleep_for(patience);  // a file says nothing when it grows
    has_waited = true;
  }
}

// --- Lines ---

EditSource::State EditSource::take_line(std::string& line) {
  for (;;) {
    const std::size_t found = buffer_.find('\n', scanned_);
    const bool has_end = found != std::string::npos;
    scanned_ = has_end ? found : buffer_.size();
    const std::size_t end = has_end ? found + 1 : buffer_.size();
    const std::string_view text(buffer_.data() + begin_, scanned_ - begin_);
    const bool is_skipped = std::exchange(is_skipping_, false);
    if (is_skipped || text.size() > setup_.most_bytes) {
      leave_behind(end);
      is_skipping_ = !has_end;
      if (!is_skipped) {
        ++line_number_;
        return State::too_long;
      }
      if (!has_end) return State::waiting;
      continue;
    }
    if (!has_end && (!is_at_end_ || text.empty())) return State::waiting;
    line = line_number_ == 0 ? io::without_mark(text) : text;
    ++line_number_;
    leave_behind(end);
    return State::line;
  }
}

/// The buffer up to there.
void EditSource::leave_behind(std::size_t end) {
  checksum_ = io::checksum(std::string_view(buffer_).substr(begin_, end - begin_), checksum_);
  begin_ = end;
  scanned_ = end;
}

// --- The file ---

EditSource::Found EditSource::read_more(std::chrono::milliseconds patience) {
  if (file_ < 0) return Found::end;
  pollfd wait{file_, POLLIN, 0};
  const int ready = ::poll(&wait, 1, static_cast<int>(patience.count()));
  if (ready == 0 || (ready < 0 && errno == EINTR)) return Found::nothing_yet;
  buffer_.erase(0, begin_);
  scanned_ -= begin_;
  begin_ = 0;
  const std::size_t size = buffer_.size();
  buffer_.resize(size + chunk);
  const ssize_t count = ::read(file_, buffer_.data() + size, chunk);
  const int cause = errno;
  buffer_.resize(size + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  if (count > 0) {
    place_ += count;
    return Found::bytes;
  }
  if (count == 0) return Found::end;
  if (cause == EINTR || cause == EAGAIN) return Found::nothing_yet;
  errno = cause;
  throw io::FileError(io::Access::read, name(), io::last_cause());
}

/// When there is nothing more in the file: whether there is now, of it or of another.
bool EditSource::look_again() {
  if (file_ < 0) return open();
  struct stat there {};
  if (::stat(setup_.path.c_str(), &there) != 0) {
    say_waiting();
    return false;
  }
  if (there.st_dev == device_ && there.st_ino == number_) {
    if (!is_regular_ || there.st_size >= place_) return false;
    setup_.say(name() + " has become shorter: it is read from its beginning");
    ::lseek(file_, 0, SEEK_SET);
    start_over();
    return true;
  }
  // As long as nothing is in the other, who writes may still be at this one.
  if (S_ISREG(there.st_mode) && there.st_size == 0) return false;
  // Something may have come before it was replaced, and its last line may have no end.
  if (!std::exchange(is_replaced_, true)) return true;
  if (!std::exchange(is_at_end_, true)) return true;
  return open();
}

bool EditSource::open() {
  // A FIFO that has no writer yet would not let go.
  const int file = ::open(setup_.path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    if (setup_.is_followed) say_waiting();
    return false;
  }
  struct stat status {};
  if (::fstat(file, &status) == 0 && S_ISDIR(status.st_mode)) {
    ::close(file);
    throw io::FileError(io::Access::read, setup_.path, "it is a folder");
  }
  if (file_ >= 0) {
    ::close(file_);
    setup_.say(name() + " is another file now: going on with that");
  }
  file_ = file;
  full_name_ = full_name(setup_.path);
  device_ = status.st_dev;
  number_ = status.st_ino;
  is_regular_ = S_ISREG(status.st_mode);
  is_waited_for_ = false;
  start_over();
  const auto start = std::exchange(setup_.start, {});
  if (start && is_regular_) resume(*start);
  return true;
}

/// With a file that is at its beginning.
void EditSource::start_over() {
  place_ = 0;
  buffer_.clear();
  begin_ = 0;
  scanned_ = 0;
  checksum_ = io::no_checksum;
  line_number_ = 0;
  is_skipping_ = false;
  is_replaced_ = false;
  is_at_end_ = false;
}

void EditSource::resume(const io::InputPosition& start) {
  std::string bytes(chunk, '\0');
  std::uint64_t offset = 0;
  std::uint64_t sum = io::no_checksum;
  std::size_t lines = 0;
  while (offset < start.offset) {
    const auto most =
        static_cast<std::size_t>(std::min<std::uint64_t>(chunk, start.offset - offset));
    const ssize_t count = ::read(file_, bytes.data(), most);
    if (count <= 0) break;
    const std::string_view some(bytes.data(), static_cast<std::size_t>(count));
    sum = io::checksum(some, sum);
    lines += static_cast<std::size_t>(std::count(some.begin(), some.end(), '\n'));
    offset += some.size();
  }
  if (offset != start.offset || sum != start.checksum) {
    ::lseek(file_, 0, SEEK_SET);
    setup_.say(name() +
               " is not the file any more that edits in the session came from: it is "
               "read from its beginning");
    return;
  }
  place_ = static_cast<off_t>(offset);
  checksum_ = sum;
  line_number_ = lines;
  setup_.say("resumed at line " + std::to_string(lines + 1) + " of " + name());
}

void EditSource::say_waiting() {
  const std::string cause = io::last_cause();
  if (!std::exchange(is_waited_for_, true)) setup_.say("waiting for " + name() + ": " + cause);
}

}  // namespace loft::app
