// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace loft::app {

/// Lines that come bit by bit, from standard input or from a file that grows. One that is followed
/// never ends; it is opened again when another file takes its place or it gets shorter.
class EditSource {
 public:
  static EditSource standard_input() { return EditSource({}, false); }
  /// A file; `is_followed`: wait for more at its end. It need not be there yet then.
  static EditSource file(std::filesystem::path path, bool is_followed) {
    return EditSource(std::move(path), is_followed);
  }
  ~EditSource();
  EditSource(EditSource&& other) noexcept;
  EditSource& operator=(EditSource&&) = delete;

  enum class State { line, waiting, ended };
  /// The next line, as soon as it is complete (its end has come, or that of the source); waits for
  /// it a while. Throws FileError where reading fails, InputError where a line is too long.
  State next(std::string& line, std::chrono::milliseconds patience);
  /// Of the last line, from 1.
  [[nodiscard]] std::size_t line_number() const { return line_number_; }
  /// `standard input` or the file's name.
  [[nodiscard]] std::string name() const;

 private:
  EditSource(std::filesystem::path path, bool is_followed);
  bool take_line(std::string& line, bool is_end);
  void look_again();

  std::filesystem::path path_;
  bool is_followed_;
  int file_ = -1;
  ino_t number_ = 0;  // of the file that is open
  off_t place_ = 0;
  std::string buffer_;
  std::size_t scanned_ = 0;  // no line ends before
  std::size_t line_number_ = 0;
  bool is_ended_ = false;
};

}  // namespace loft::app
