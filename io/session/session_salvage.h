// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/session/session.h"

namespace loft::io {

/// Chained from edit to edit, so that it tells lost and swapped
/// ones from the right ones, too: `before` is that of the edit before, 0 for the first.
[[nodiscard]] std::uint64_t edit_checksum(std::uint64_t before, std::string_view line);

/// Takes the edits of a damaged session that are sound, and notes the others. As each checksum goes
/// on from the one that is stored before it, those behind a damaged edit can be checked, too.
class SessionSalvage {
 public:
  explicit SessionSalvage(const Session::Take& take) : take_(take) {}

  /// The next edit, as it is stored.
  void add(std::string_view line, std::uint64_t checksum);
  /// The next edit cannot be read.
  void add_hole();

  /// What was wrong, a line each. If the end is not known, the last holes stand for all from there.
  [[nodiscard]] std::vector<std::string> finish(bool is_end_known);

 private:
  enum class Fault { damaged, mended, unreadable, unchecked };
  struct Run {
    std::uint64_t first;
    std::uint64_t last;
    Fault fault;
  };
  /// An edit whose checksum is wrong: the one or the other is damaged.
  struct Doubtful {
    std::uint64_t number;
    Edit edit;
    std::uint64_t checksum;  // as it should be, if the edit is sound
  };

  void note(std::uint64_t number, Fault fault);
  void settle_doubt(bool is_sound);
  [[nodiscard]] static std::string words(const Run& run, bool is_open);

  const Session::Take& take_;
  std::uint64_t number_ = 0;                  // of the next edit
  std::optional<std::uint64_t> before_ = 0U;  // checksum of the edit before, if there is one
  std::optional<Doubtful> doubtful_;          // the edit before
  std::vector<Run> faults_;
};

}  // namespace loft::io
