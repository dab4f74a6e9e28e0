// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "app/json.h"
#include "io/session/session.h"
#include "io/session/stack_state.h"
#include "io/stacks/edit.h"

namespace loft::app {

/// Back to what was before an edit, or forth again.
enum class Way { undo, redo };
[[nodiscard]] constexpr const char* name(Way way) { return way == Way::undo ? "undo" : "redo"; }

/// The edits that were taken, and the way back and forth between them. Each undo and redo is an
/// edit of its own that comes behind the others, so that a journal only grows. What was undone can
/// be redone until another edit comes.
///
/// With a journal all edits can be undone; without one the last 1,000, as long as their slices have
/// no more than 4 million points together. Cost of each edit: 40 bytes.
class History {
 public:
  using SharedSlice = io::StackState::SharedSlice;

  /// The next edit; `undo` where it is one that undid or did again another one.
  void add(const io::Edit& edit, const std::optional<io::Undo>& undo);
  /// What was at the height of the edit that was added last, and is now; for what has no journal.
  void remember(SharedSlice before, SharedSlice after);

  /// The number of the edit that would be undone or done again; none if there is none, or what was
  /// before it is not known any more.
  [[nodiscard]] std::optional<std::uint64_t> next(Way way) const;
  /// The edit that does so, where the stack is as the edits have left it. Precondition: next().
  /// `journal`: that of these edits, or null. Throws FileError where it cannot be read.
  [[nodiscard]] io::Edit edit(Way way, const io::Session* journal,
                              const io::StackState& stack) const;

  [[nodiscard]] std::uint64_t size() const { return entries_.size(); }
  /// `{"edits":[{"number","op","z","is_undone"}],"can_undo","can_redo"}`: the last 1,000, numbered
  /// from 1; op: insert, replace, remove, undo, redo.
  [[nodiscard]] Json to_json() const;

 private:
  struct Entry {
    double z = 0;
    io::Edit::Kind kind = io::Edit::Kind::insert;
    std::optional<io::Undo> undo = {};
    bool is_undone = false;
  };
  struct Exchange {
    SharedSlice before;
    SharedSlice after;
    [[nodiscard]] std::size_t points() const;
  };

  [[nodiscard]] bool is_known(std::uint64_t number) const;
  [[nodiscard]] SharedSlice slice(std::uint64_t count, double z, const io::Session& journal) const;

  std::vector<Entry> entries_;
  std::vector<std::uint64_t> done_;    // plain edits that can be undone, the last one at the end
  std::vector<std::uint64_t> undone_;  // those that can be done again
  bool has_journal_ = true;
  std::deque<Exchange> exchanges_;  // of the last entries
  std::size_t points_ = 0;          // in them
};

/// The next edit of a session, and, where it is one, which edit it undid or did again.
using TakeUndo =
    std::function<void(std::uint64_t number, io::Edit&& edit, const std::optional<io::Undo>& undo)>;
/// Calls take() for each edit, in order. Throws as Session::for_each().
void for_each_with_undo(const io::Session& session, const TakeUndo& take);

/// The history of a session. Throws as Session::for_each().
[[nodiscard]] History history_of(const io::Session& session);

}  // namespace loft::app
