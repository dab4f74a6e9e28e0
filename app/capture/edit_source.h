// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "io/session/session.h"

namespace loft::app {

/// Lines that come bit by bit, from standard input, a file or a FIFO. One that is followed never
/// ends: a FIFO goes on with its next writer, a file when it grows. When another file takes its
/// place it is read to its end, then the other from its beginning; so is a file that gets shorter.
class EditSource {
 public:
  struct Setup {
    std::filesystem::path path = {};  ///< empty: standard input
    bool is_followed = false;         ///< wait for more at its end; it need not be there yet
    /// Go on there, if the file still has the bytes before.
    std::optional<io::InputPosition> start = {};
    std::size_t most_bytes = std::size_t{256} << 20U;  ///< in a line
    /// What the user should know: that it is waited for, replaced, shorter.
    std::function<void(const std::string&)> say = [](const std::string&) {};
  };

  /// Throws FileError where the file cannot be opened, unless it is followed.
  explicit EditSource(Setup setup);
  ~EditSource();
  EditSource(const EditSource&) = delete;
  EditSource& operator=(const EditSource&) = delete;

  enum class State { line, too_long, waiting, ended };
  /// The next line, as soon as it is complete (its end has come, or that of the source), without a
  /// byte order mark; waits for it a while. A line that is too long is left out. Throws FileError
  /// where reading fails.
  State next(std::string& line, std::chrono::milliseconds patience);
  /// Of the last line, from 1, in the file that it came from.
  [[nodiscard]] std::size_t line_number() const { return line_number_; }
  /// Behind the last line; none of what is no file.
  [[nodiscard]] std::optional<io::InputPosition> position() const;
  /// So many bytes have come of a line whose end has not.
  [[nodiscard]] std::size_t unfinished_bytes() const;
  /// `standard input` or the file's name.
  [[nodiscard]] std::string name() const;
  /// The name that positions have for a file, whatever links lead to it.
  [[nodiscard]] static std::string full_name(const std::filesystem::path& path);

 private:
  enum class Found { bytes, nothing_yet, end };
  [[nodiscard]] State take_line(std::string& line);
  void leave_behind(std::size_t end);
  [[nodiscard]] Found read_more(std::chrono::milliseconds patience);
  [[nodiscard]] bool look_again();
  [[nodiscard]] bool open();
  void start_over();
  void resume(const io::InputPosition& start);
  void say_waiting();

  Setup setup_;
  int file_ = -1;
  std::string full_name_;
  dev_t device_ = 0;  // where the open file is, and its number there
  ino_t number_ = 0;
  bool is_regular_ = false;
  bool is_waited_for_ = false;  // and that was said

  off_t place_ = 0;          // read so far
  std::string buffer_;       // its last bytes
  std::size_t begin_ = 0;    // of the next line in it
  std::size_t scanned_ = 0;  // that line has no end before
  std::uint64_t checksum_ = 0;
  std::size_t line_number_ = 0;
  bool is_skipping_ = false;  // the rest of a line that is too long
  bool is_replaced_ = false;  // by another file
  bool is_at_end_ = false;    // no more comes of this file
};

}  // namespace loft::app
